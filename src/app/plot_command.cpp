// edda plot
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <memory>

#include "app/along_picture.hpp"
#include "app/common.hpp"
#include "app/curve_picture.hpp"
#include "app/nm_picture.hpp"
#include "app/plot_source.hpp"

namespace edda {
namespace {

constexpr std::size_t most_drawings = 4;
const std::string every_lining;

int refuse(const Fault& fault) {
  print({fault});
  return exit_code::bad_input;
}

int finish(const Trouble& trouble, const std::string& path) {
  if (trouble) {
    print({*trouble});
    return exit_code::failed;
  }
  fmt::print("wrote {}\n", path);
  return exit_code::done;
}

int draw_histories(const PlotArguments& args, const std::string& path) {
  if (!std::filesystem::is_directory(args.source)) {
    return refuse({{"--history", {}, 0, 0},
                   args.source + " is no folder of results",
                   "run the model, and give the folder of its results"});
  }
  HistorySource source;
  if (const Trouble trouble = read_histories(args, source)) return refuse(*trouble);
  return finish(plot_history(source.picture, path), path);
}

int draw_line(const PlotArguments& args, const std::string& path) {
  const Trouble trouble = draw_along(args, path);
  return trouble ? refuse(*trouble) : finish({}, path);
}

int draw_frames(const PlotArguments& args, const std::string& path) {
  Result<PlotSource> read =
      std::filesystem::is_directory(args.source) ? from_folder(args) : from_model(args);
  if (!read.ok()) {
    print(read.faults());
    return exit_code::bad_input;
  }
  const PlotSource& source = read.value();
  if (const Trouble trouble = check_window(source.shots, source.options)) return refuse(*trouble);
  for (const std::string& note : source.notes) fmt::print(stderr, "note: {}\n", note);
  return finish(plot(source.shots, source.options, path), path);
}

/// Checks of options in combination.
Trouble check(const PlotArguments& args) {
  const auto fault = [](const char* key, std::string problem, std::string remedy) {
    return Fault{{key, {}, 0, 0}, std::move(problem), std::move(remedy)};
  };
  const bool is_table = (!args.along.empty() || args.is_nm) && ending_of(args.output) == ".csv";
  if (!args.output.empty() && !is_picture(ending_of(args.output)) && !is_table) {
    return Fault{{{}, args.output, 0, 0}, "ends in none of .png .svg .pdf", "name the file so"};
  }
  std::vector<double> numbers = args.compare;
  numbers.insert(numbers.end(), args.range.begin(), args.range.end());
  numbers.insert(numbers.end(), args.window.begin(), args.window.end());
  numbers.insert(numbers.end(), args.times.begin(), args.times.end());
  numbers.insert(numbers.end(), args.along.begin(), args.along.end());
  for (const auto& number : {args.time, args.scale}) numbers.push_back(number.value_or(0.0));
  if (!std::all_of(numbers.begin(), numbers.end(), [](double v) { return std::isfinite(v); }))
    return fault("edda plot", "was given a value that is no finite number", "give another one");
  const bool has_pixels = args.output.empty() || ending_of(args.output) == ".png";
  if (args.width_pixels > 0 && !has_pixels)
    return fault("--width", "is in pixels, which only a .png has", "give mm, as 90mm");
  if (args.dpi && !has_pixels)
    return fault("--dpi", "is for a .png: the others have no pixels", "leave it out");
  if (args.width_pixels > 0 && args.dpi)
    return fault("--dpi", "has no effect where --width is in pixels", "leave it out, or give mm");
  if (!args.overrides.empty() && std::filesystem::is_directory(args.source))
    return fault("--set", "changes a model, not its results", "run the model with it");
  if (!args.history.empty() && (args.scale || !args.window.empty()))
    return fault("--history", "draws lines over time",
                 "leave out --scale and --window; --times and --range say which part is shown");
  if (args.history.empty() && !args.times.empty())
    return fault("--times", "is for the lines of --history", "give --time or --compare for frames");
  if (!args.times.empty() && !(args.times[0] < args.times[1]))
    return fault("--times", "is empty", "give T0,T1 with T0 below T1");
  if (!args.range.empty() && !(args.range[0] < args.range[1]))
    return fault("--range", "is empty", "give LO,HI with LO below HI");
  if (const auto& w = args.window; !w.empty() && !(w[0] < w[2] && w[1] < w[3]))
    return fault("--window", "is empty", "give x0,y0,x1,y1 with x0 below x1 and y0 below y1");
  if (!args.along.empty() && (args.scale || !args.window.empty()))
    return fault("--along", "draws values over a distance", "leave out --scale and --window");
  if (const auto& l = args.along; !l.empty() && l[0] == l[2] && l[1] == l[3])
    return fault("--along", "has no length", "give x0,y0,x1,y1 of two points");
  if (args.is_nm && (args.scale || !args.window.empty() || !args.range.empty()))
    return fault("--nm", "draws thrust over moment", "leave out --scale, --window and --range");
  if (!args.along.empty() && !std::filesystem::is_directory(args.source))
    return fault("--along", "shows results, and " + args.source + " is no folder of them",
                 "run the model, and give the folder of its results");
  if (args.compare.size() == 1 || args.compare.size() > most_drawings) {
    return fault("--compare",
                 fmt::format("names {} {}", args.compare.size(),
                             args.compare.size() == 1 ? "time" : "times"),
                 fmt::format("give two to {}", most_drawings));
  }
  return {};
}

int draw(const PlotArguments& args) {
  if (const Trouble trouble = check(args)) return refuse(*trouble);
  const std::string path = args.output.empty() ? name_of(args.source) + ".png" : args.output;
  if (args.curve) {
    if (!has_curve(args.source)) return refuse(*draw_curve(args.source, path, args.title));
    return finish(draw_curve(args.source, path, args.title), path);
  }
  if (!args.along.empty()) return draw_line(args, path);
  if (args.is_nm) {
    const Trouble trouble = draw_nm(args, path);
    return trouble ? refuse(*trouble) : finish({}, path);
  }
  return args.history.empty() ? draw_frames(args, path) : draw_histories(args, path);
}

/// "90", "90mm" or "1200px"; what is wrong with it otherwise.
std::string read_width(const std::string& text, PlotArguments& args) {
  double value = 0.0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  const std::string unit(stop, end);
  const bool pixels = unit == "px";
  const double least = pixels ? 100.0 : 30.0, most = pixels ? 20000.0 : 2000.0;
  if (error != std::errc{} || (!pixels && !unit.empty() && unit != "mm"))
    return "is no width: give mm as 90mm, or pixels as 1200px";
  if (!(value >= least && value <= most))
    return fmt::format("is not between {0:.0f} and {1:.0f} {2}", least, most, pixels ? "px" : "mm");
  if (pixels) {
    args.width_pixels = static_cast<int>(std::lround(value));
  } else {
    args.width = value;
  }
  return {};
}

void add_what(CLI::App& command, PlotArguments& args) {
  command
      .add_option("--field", args.field,
                  "What to colour by (default: displacement; with --principal: none; of a "
                  "model: its materials)")
      ->type_name("FIELD");
  CLI::Option* const time = command
                                .add_option("--time", args.time,
                                            "The frame nearest to this time in s (default: the "
                                            "last)")
                                ->type_name("T");
  CLI::Option* const compare =
      command
          .add_option("--compare", args.compare,
                      "The frames nearest to these times (s) side by side, with one scale")
          ->type_name("T0,T1")
          ->delimiter(',')
          ->allow_extra_args(false)
          ->excludes(time);
  command.add_flag("--before", args.before, "The first frame beside the one that is drawn")
      ->excludes(compare);
  command
      .add_option("--vectors", args.vectors,
                  "Arrows at the centres of blocks or zones: displacement or velocity")
      ->check(CLI::IsMember({"displacement", "velocity"}));
  command.add_flag("--forces", args.forces,
                   "Contact forces as arrows, and the pressure along each joint");
  command.add_flag("--principal", args.principal,
                   "Principal stresses: crosses at the centres of blocks or zones, tension as "
                   "arrows");
  command.add_flag("--bolts", args.bolts, "Bolts, their width in proportion to their axial force");
  command
      .add_option(
          "--lining", args.lining,
          "Thrust, moment, shear or utilisation along linings, positive values on the side of the "
          "wall")
      ->check(CLI::IsMember({"thrust", "moment", "shear", "utilisation"}));
  command.add_flag("--cracks", args.cracks,
                   "Joints with fracture energy that have broken, in tension and in shear");
  command
      .add_option("--relative-to", args.relative_to,
                  "Displacements (and velocities) relative to a monitor, drawn unmoved")
      ->type_name("MONITOR");
}

/// What is drawn in the place of frames.
void add_graphs(CLI::App& command, PlotArguments& args) {
  const std::vector<const char*> of_frames{"--compare",   "--before", "--vectors", "--forces",
                                           "--principal", "--bolts",  "--lining",  "--cracks"};
  CLI::Option* const history =
      command
          .add_option("--history", args.history,
                      "Lines over time instead: columns of history.csv, a monitor's name for all "
                      "of it, or energy")
          ->type_name("NAME[,NAME...]")
          ->delimiter(',')
          ->allow_extra_args(false);
  CLI::Option* const curve =
      command
          .add_flag("--curve", args.curve,
                    "The curve of a ramp instead: what it varies against the monitors' "
                    "displacements")
          ->excludes(history);
  CLI::Option* const along =
      command
          .add_option("--along", args.along,
                      "The values of --field (several: a,b) along a line instead, m; with -o "
                      "FILE.csv as a table")
          ->type_name("X0,Y0,X1,Y1")
          ->delimiter(',')
          ->expected(4)
          ->excludes(history)
          ->excludes(curve);
  CLI::Option* const nm =
      command
          .add_option_function<std::string>(
              "--nm",
              [&args](const std::string& lining) {
                args.is_nm = true;
                if (lining != every_lining) args.nm = lining;
              },
              "Thrust over moment of a lining (of all, without a name) at the ends of stages, or "
              "at --time or --compare, within its strength instead; with -o FILE.csv as a table")
          ->type_name("LINING")
          ->expected(0, 1)
          ->default_str(every_lining)
          ->excludes(history)
          ->excludes(curve)
          ->excludes(along)
          ->excludes(command.get_option("--field"));
  for (const char* other : of_frames) {
    if (std::string_view(other) != "--compare") nm->excludes(command.get_option(other));
  }
  for (CLI::Option* graph : {history, curve, along}) {
    for (const char* other : of_frames) graph->excludes(command.get_option(other));
  }
  for (CLI::Option* graph : {history, curve}) {
    for (const char* other : {"--field", "--time"}) graph->excludes(command.get_option(other));
  }
  for (CLI::Option* graph : {curve, along, nm})
    graph->excludes(command.get_option("--relative-to"));
}

void add_how(CLI::App& command, PlotArguments& args) {
  command.add_option("--scale", args.scale, "Draw displacements this many times as large")
      ->type_name("FACTOR");
  CLI::Option* const range = command
                                 .add_option("--range", args.range,
                                             "Values at the ends of the colour scale, in SI units; "
                                             "with --history: of the value axis")
                                 ->type_name("LO,HI")
                                 ->delimiter(',')
                                 ->expected(2);
  command
      .add_flag("--whole-range", args.whole_range,
                "Colours and vectors up to the largest value, even where few blocks come near it")
      ->excludes(range);
  command.add_option("--window", args.window, "The part of the model to show, m")
      ->type_name("X0,Y0,X1,Y1")
      ->delimiter(',')
      ->expected(4);
  command.add_option("--times", args.times, "The part of the time that --history shows, s")
      ->type_name("T0,T1")
      ->delimiter(',')
      ->expected(2);
  command.add_flag("--no-marks", args.no_marks, "Leave out monitors and convergence lines");
  command.add_option("--title", args.title, "In place of the model's")->type_name("TEXT");
  command
      .add_option_function<std::string>(
          "--width",
          [&args](const std::string& text) {
            if (const std::string problem = read_width(text, args); !problem.empty())
              throw CLI::ValidationError("--width", '"' + text + "\" " + problem);
          },
          "Width on paper, as 90mm (default 160mm), or pixels of a PNG, as 1200px")
      ->type_name("LENGTH");
  command.add_option("--dpi", args.dpi, "Pixels per inch of a PNG (default 254, 10 per mm)")
      ->type_name("N")
      ->check(CLI::Range(30.0, 2400.0));
  command.add_option("--font-size", args.font, "Of the text, in points on paper (default 8)")
      ->type_name("PT")
      ->check(CLI::Range(3.0, 40.0));
}

}  // namespace

void add_plot(CLI::App& app, int& code) {
  CLI::App* command =
      app.add_subcommand("plot", "Draw the results in a folder, or a model's blocks");
  command->footer(
      "Examples:\n"
      "  edda plot slope                              the last state, coloured by displacement, as "
      "slope.png\n"
      "  edda plot slope --time 0.5 --field stress.yy -o stress.svg\n"
      "  edda plot slope --scale 200 --vectors velocity --forces\n"
      "  edda plot tunnel --principal --bolts -o tunnel.pdf\n"
      "  edda plot disc --field none --cracks         joints that have broken, in tension and in "
      "shear\n"
      "  edda plot slope --before --range 0,0.5       before and after, one scale\n"
      "  edda plot slope --history energy,drift       lines over time\n"
      "  edda plot slope --history crest.ux --times 0,0.5 --range 0,0.1\n"
      "  edda plot tunnel --along 3,0,20,0 --field stress.xx,stress.yy\n"
      "  edda plot tunnel --nm shell                  thrust and moment of a lining, its strength\n"
      "  edda plot wall --curve                       what a ramp varied over displacements\n"
      "  edda plot slope.toml                         the blocks before the run\n\n"
      "Fields: " +
      field_names() +
      ".\n"
      "Fixed blocks are grey and hatched; monitors are circles with their names, bolts blue lines "
      "(orange: yielded), convergence lines dashed. Where blocks are small, vectors and crosses "
      "are drawn of some only, evenly spread.");
  auto args = std::make_shared<PlotArguments>();
  command->add_option("DIR", args->source, "A folder of results, or a model file")
      ->required()
      ->type_name("DIR|MODEL");
  command
      ->add_option("-o,--output", args->output,
                   "The picture, .png, .svg or .pdf (default: the source's stem + .png); with "
                   "--along and --nm also .csv")
      ->type_name("FILE");
  add_what(*command, *args);
  add_graphs(*command, *args);
  add_how(*command, *args);
  add_overrides(*command, args->overrides);
  command->callback([args, &code] { code = draw(*args); });
}

}  // namespace edda
