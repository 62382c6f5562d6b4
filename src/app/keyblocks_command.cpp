// edda keyblocks
#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <utility>

#include "app/analysis_command.hpp"
#include "app/mechanism_picture.hpp"
#include "base/text.hpp"
#include "observe/observe.hpp"
#include "results/files.hpp"
#include "results/frames.hpp"
#include "study/key_blocks.hpp"

namespace edda {
namespace {

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
  if (Trouble t = write_file(folder + "/keyblocks.csv", key_blocks_csv(found))) return t;
  return draw(model, found, folder);
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

Result<AnalysisResult> find_key_blocks(const Model& model, const KeyBlockOptions& options) {
  Result<KeyBlocks> found = key_blocks(model, options);
  if (!found.ok()) return found.faults();
  const auto k = std::make_shared<const KeyBlocks>(std::move(found.value()));
  AnalysisResult analysis{k->message, key_blocks_summary(model, *k), k->warnings};
  analysis.print = [k](const std::string& folder) { print_end(*k, folder); };
  analysis.write = [k, &model](const std::string& folder) {
    return write_results(model, *k, folder);
  };
  return analysis;
}

}  // namespace

void add_keyblocks(CLI::App& app, int& code) {
  AnalysisCommand command{
      "keyblocks", "Find the blocks that can leave the rock, and those that do",
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
      "  keyblocks.png, keyblocks.svg  the blocks by their class",
      "Print the sentence alone, no warnings"};
  const auto options = std::make_shared<KeyBlockOptions>();
  command.find = [options](const Model& model, const AnalysisRun&) {
    return find_key_blocks(model, *options);
  };
  CLI::App& added = add_analysis(app, code, std::move(command));
  added.add_option("--factor", options->factor, "Key blocks have a factor below this (default: 1)")
      ->check(CLI::PositiveNumber);
  added
      .add_option("--generations", options->generations,
                  "At most so many: 1 for the blocks that leave first (default: all)")
      ->check(CLI::PositiveNumber);
}

}  // namespace edda
