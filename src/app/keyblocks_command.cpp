// edda keyblocks
#include <fmt/format.h>

#include <cmath>
#include <memory>

#include "app/common.hpp"
#include "app/mechanism_picture.hpp"
#include "app/study_folder.hpp"
#include "base/text.hpp"
#include "model/write_model.hpp"
#include "observe/observe.hpp"
#include "results/columns.hpp"
#include "results/files.hpp"
#include "results/frames.hpp"
#include "study/key_blocks.hpp"

namespace edda {
namespace {

struct KeyBlockArguments {
  std::string model, folder;
  std::vector<std::string> overrides;
  KeyBlockOptions options;
  bool quiet = false, json = false;
};

/// Blocks in the colours of their classes, key blocks by their generation.
Trouble draw(const Model& model, const KeyBlocks& found, const std::string& folder) {
  Instant instant;
  observe(*found.drawn, instant);
  Snapshot shot{
      block_grid(block_cells(found.drawn->scene->blocks), picture_of(*found.drawn, instant))};
  const Result<ShownField> field = shown_field("material", shot.blocks, nullptr);
  if (!field.ok()) return field.faults().front();
  shot.field = field.value();
  const Result<ShownField> ids = shown_field("id", shot.blocks, nullptr);
  if (!ids.ok()) return ids.faults().front();
  constexpr std::size_t most_generations = 4;
  for (std::size_t cell = 0; cell < shot.field.values.size(); ++cell) {
    const auto i = static_cast<std::size_t>(ids.value().values[cell]);
    const bool is_fixed = found.rigid.body[i] == no_id;
    const auto kind = static_cast<std::size_t>(found.of_block[i]);
    const std::size_t generation = std::min(found.generation_of_block[i], most_generations);
    shot.field.values[cell] = static_cast<double>(is_fixed         ? 0
                                                  : generation > 0 ? 3 + generation
                                                                   : 1 + kind);
  }
  shot.field.label = "class";
  PlotOptions options = options_of(model, found.drawn->scene->blocks.size());
  options.materials = {"fixed",     "locked", "stable", "held by friction",
                       "key block", "second", "third",  "later"};
  options.subtitle = found.message;
  for (const RemovableBlock& b : found.blocks) {
    if (b.kind != BlockClass::key || b.generation > 1) continue;
    for (const std::size_t k : b.joints) {
      const RigidJoint& joint = found.rigid.joints[k];
      const Vec2 origin = found.drawn->scene->blocks.origin;
      options.joints.push_back({joint.ends[0] + origin, joint.ends[1] + origin});
    }
  }
  return draw_in_both_forms(shot, options, folder, "keyblocks");
}

Trouble write_results(const Model& model, const KeyBlocks& found, const std::string& folder) {
  const auto write = [&](const char* name, const std::string& text) {
    return write_file(folder + "/" + name, text);
  };
  if (Trouble t = write("model.toml", to_toml(model))) return t;
  if (Trouble t = write("keyblocks.csv", key_blocks_csv(found))) return t;
  if (Trouble t = draw(model, found, folder)) return t;
  if (Trouble t = write_columns_csv(folder)) return t;
  return write("summary.json", key_blocks_summary(model, found));
}

/// To centimetres, without a minus sign before 0.
double rounded(double x) {
  return 0.01 * std::round(100.0 * x) + 0.0;
}

void print_end(const KeyBlocks& found, const std::string& folder) {
  fmt::print("{}\n", found.message);
  constexpr std::size_t most = 20;
  std::size_t shown = 0;
  for (const RemovableBlock& b : found.blocks) {
    if (b.kind != BlockClass::key) break;
    if (shown++ == 0) {
      fmt::print("  {:>5}  {:>18}  {:>8}  {:>9}  {:>8}  {:>10}  {}\n", "block", "at (m)", "area",
                 "weight kN", "factor", "support kN", "mode");
    }
    if (shown > most) continue;
    fmt::print("  {:>5}  {:>18}  {:>8.4g}  {:>9.4g}  {:>8.4g}  {:>10}  {}{}\n", b.blocks.front(),
               fmt::format("({:.2f}, {:.2f})", rounded(b.centroid.x), rounded(b.centroid.y)),
               b.area, 1e-3 * b.weight, b.factor.value_or(0.0),
               b.support ? fmt::format("{:.4g}", 1e-3 * *b.support) : "", removal_mode_name(b.mode),
               b.generation > 1 ? fmt::format(", generation {}", b.generation) : "");
  }
  if (shown > most) fmt::print("  and {} more (keyblocks.csv)\n", shown - most);
  fmt::print("  {} of wall time; results in {}/ (keyblocks.csv, keyblocks.png)\n",
             duration_text(found.seconds), folder);
}

int key_blocks_of(const KeyBlockArguments& args) {
  const std::optional<Model> model =
      read_or_print(args.model, args.overrides, args.json, ReadFor::no_run);
  if (!model) return exit_code::bad_input;
  const std::string folder = args.folder.empty() ? stem_of(args.model) + "-keyblocks" : args.folder;
  if (const Trouble trouble = check_folder(folder, args.model)) {
    print({*trouble}, args.json);
    return exit_code::bad_input;
  }
  const Result<KeyBlocks> found = key_blocks(*model, args.options);
  if (!found.ok()) {
    print(found.faults(), args.json);
    return exit_code::bad_input;
  }
  const KeyBlocks& k = found.value();
  if (!args.quiet && !args.json) say([&] { print_warnings(k.warnings); });
  const Trouble trouble =
      fill_study_folder(folder, [&] { return write_results(*model, k, folder); });
  if (trouble) {
    print({*trouble}, args.json);
    return exit_code::failed;
  }
  print_answer(args.json, args.quiet, key_blocks_summary(*model, k), k.message,
               [&] { print_end(k, folder); });
  return exit_code::done;
}

}  // namespace

void add_keyblocks(CLI::App& app, int& code) {
  CLI::App* command =
      app.add_subcommand("keyblocks", "Find the blocks that can leave the rock, and those that do");
  command->footer(
      "Example:\n"
      "  edda keyblocks tunnel.toml\n"
      "  edda keyblocks slope.toml --factor 1.3\n"
      "\n"
      "Block theory (Goodman and Shi) of the model as drawn, without a run: which blocks can "
      "leave\n"
      "along some direction, which of them fall or slide with a factor below the one asked for,\n"
      "and which can once those have gone. The folder (default: the model's name without .toml "
      "and\n"
      "with -keyblocks, here) then holds\n"
      "  summary.json     how many there are, their area and weight; written last\n"
      "  keyblocks.csv    every block that can leave: mode, factors, generation, support\n"
      "  keyblocks.png, keyblocks.svg  the blocks by their class");
  auto args = std::make_shared<KeyBlockArguments>();
  command->add_option("MODEL", args->model, "The model, a TOML file")
      ->required()
      ->type_name("FILE");
  command
      ->add_option("-o,--output", args->folder, "Folder for the results (default: stem-keyblocks)")
      ->type_name("DIR");
  command
      ->add_option("--factor", args->options.factor,
                   "Key blocks have a factor below this (default: 1)")
      ->check(CLI::PositiveNumber);
  command
      ->add_option("--generations", args->options.generations,
                   "At most so many: 1 for the blocks that leave first (default: all)")
      ->check(CLI::PositiveNumber);
  add_overrides(*command, args->overrides);
  add_threads(*command);
  command->add_flag("--quiet", args->quiet, "Print the sentence alone, no warnings");
  add_json(*command, args->json,
           "Print the summary as one JSON object on stdout, and nothing on stderr");
  command->callback([args, &code] { code = key_blocks_of(*args); });
}

}  // namespace edda
