// Checkpoints of a run: the data of the simulation, those of the driver, and the lengths of the
// files written so far.
#include <fmt/format.h>

#include <algorithm>

#include "checkpoint/archive.hpp"
#include "checkpoint/envelope.hpp"
#include "checkpoint/hdf5_image.hpp"
#include "model/stage_names.hpp"
#include "model/write_model.hpp"
#include "results/version.hpp"
#include "run/driver.hpp"
#include "run/ramp_memory.hpp"
#include "run/simulation_memory.hpp"
#include "run/wall_clock.hpp"

namespace edda {
namespace {

constexpr auto all_stages = static_cast<std::size_t>(-1);

/// State at the start of the named parts of the model, as it follows from the stages that name
/// them.
std::string first_states(const Model& model) {
  std::string text;
  const auto add = [&](const auto& items, const char* what, auto state) {
    for (const auto& item : items) {
      if (!item.name.empty())
        text += fmt::format("{}.{} at first = {}\n", what, item.name, state(item));
    }
  };
  const auto acts = [&](const auto& item) { return acts_at_first(model, item.name); };
  const auto there = [&](const auto& item) { return installed_at_first(model, item.name); };
  add(model.loads, "load", acts);
  add(model.waters, "water", acts);
  add(model.boundaries, "boundary", acts);
  add(model.shakings, "shaking", acts);
  add(model.bolts, "bolt", there);
  add(model.bolt_patterns, "bolt_pattern", there);
  add(model.linings, "lining", there);
  add(model.fills, "fill", [&](const Fill& f) { return excavated_in(model, f.name).has_value(); });
  add(model.openings, "opening", [](const Opening& o) { return o.staged; });
  return text;
}

/// The model's text without what may change between a run and its resumption. `stages`: only this
/// many are included; if that is not all, the intervals of rows and frames are left out.
std::string identity(const Model& model, std::size_t stages) {
  Model m = model;
  m.title.clear();
  if (stages < m.stages.size()) m.stages.resize(stages);
  m.output.every = m.output.history_every = 1.0;
  m.output.settling = true;
  m.solver.duration = 1.0;
  m.output.checkpoint_every = 1.0;
  m.fos.reset();
  m.limit.reset();
  // The content of a history matters, not the place of its file.
  for (Load& load : m.loads) load.history.clear();
  for (Water& water : m.waters) water.history.clear();
  for (Boundary& boundary : m.boundaries) boundary.history.clear();
  for (Shaking& shaking : m.shakings) shaking.acceleration.file.clear();
  std::string text = to_toml(m) + first_states(model);
  if (stages == all_stages) {
    text += fmt::format("[output]\nevery = {}\nhistory_every = {}\nsettling = {}\n",
                        model.output.every, model.output.history_every, model.output.settling);
  }
  auto add = [&](const std::string& key, const TimeHistory& curve) {
    for (std::size_t k = 0; k < curve.time.size(); ++k)
      text += fmt::format("{}.history, row {},{}\n", key, curve.time[k], curve.value[k]);
  };
  for (const Load& load : model.loads) add(load.where.key, load.factor);
  for (const Water& water : model.waters) add(water.where.key, water.rise);
  for (const Boundary& boundary : model.boundaries) add(boundary.where.key, boundary.factor);
  for (const Shaking& shaking : model.shakings) {
    const Accelerogram& r = shaking.record;
    for (std::size_t k = 0; k < r.time.size(); ++k)
      text += fmt::format("{}.acceleration, row {},{},{}\n", shaking.where.key, r.time[k],
                          r.acceleration[k].x, r.acceleration[k].y);
  }
  return text;
}

/// Reads names and hashes, on alternate lines.
std::vector<InputFile> input_files(std::string_view text) {
  std::vector<InputFile> files;
  const auto line = [&] {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string found(text.substr(0, end));
    text.remove_prefix(std::min(text.size(), end + 1));
    return found;
  };
  while (!text.empty()) {
    InputFile f;
    f.file = line();
    f.sha256 = line();
    files.push_back(f);
  }
  return files;
}

/// Removes the first line and returns it.
std::string_view take_line(std::string_view& text) {
  const std::string_view line = text.substr(0, text.find('\n'));
  text.remove_prefix(std::min(text.size(), line.size() + 1));
  return line;
}

/// "safety" for "safety = 0.5"; empty for other lines.
std::string_view key_of(std::string_view line) {
  const std::size_t equals = line.find(" = ");
  return equals == std::string_view::npos ? std::string_view{} : line.substr(0, equals);
}

/// The first line in which two models differ, with its value in the checkpoint ("there") and now
/// ("here").
std::string difference(std::string_view now, std::string_view then) {
  std::string table, element;
  std::size_t number = 0;
  std::string_view a, b;
  do {
    a = take_line(now);
    b = take_line(then);
    if (a != b) break;
    if (a.starts_with('[')) {
      const bool is_list = a.starts_with("[[");
      const std::string_view name = a.substr(is_list ? 2 : 1, a.size() - (is_list ? 4 : 2));
      number = is_list && name == table ? number + 1 : 0;
      table = name;
      element = is_list ? std::to_string(number) + '.' : "";
    } else if (key_of(a) == "name") {
      element = std::string(a.substr(8, a.size() - 9)) + '.';  // name = "..."
    }
  } while (!now.empty() || !then.empty());
  const std::string_view key = key_of(a);
  if (key.empty() || key != key_of(b)) {
    const auto line = [](std::string_view text) {
      return text.empty() ? std::string("nothing") : std::string(text);
    };
    return line(b) + " there, " + line(a) + " here";
  }
  const auto value = [&](std::string_view text) { return text.substr(key.size() + 3); };
  return fmt::format("{}{}{}{}: {} there, {} here", table, table.empty() ? "" : ".", element, key,
                     value(b), value(a));
}

template <class Archive>
void list_energy_balance(Archive& a, const std::string& of, EnergyBalance& l) {
  for (const EnergyTerm& term : energy_terms) a(of + term.name, l.*term.value);
}

Fault refused(const std::string& folder, std::string problem, std::string remedy) {
  return {{{}, folder, 0, 0}, std::move(problem), std::move(remedy)};
}

}  // namespace

template <class Archive>
void Driver::list_stages(Archive& a) {
  a("stage.index", stage_);
  a("stage.start", stage_start_);
  a("stage.steps", stage_steps_);
  a("stage.longest", stage_longest_);
  judge_.list(a, "stage.");
  if constexpr (Archive::loads) {
    if (!judge_.fits(sim_)) return a.refuse("what the judge remembers does not fit the model");
  }
  a("outcome.unsettled", outcome_.unsettled);
  a("stage.has_ended", stage_has_ended_);
  if constexpr (Archive::loads) {
    if (stage_ >= plans_.size()) {
      a.refuse("stages do not fit the model");
      return;
    }
    ends_.resize(stage_ + (stage_has_ended_ ? 1 : 0));
    stage_longest_ = std::max(stage_longest_, stage().longest());  // which may have grown
    times_.end_at(stage_start_ + stage_longest_);
  }
  for (std::size_t q = 0; q < ends_.size(); ++q) {
    const std::string of = fmt::format("stage.{}.", q);
    StageRecord& r = ends_[q];
    a(of + "reached", r.reached);
    a(of + "start", r.start);
    a(of + "end", r.end);
    a(of + "steps", r.steps);
    a(of + "mean", r.balance.mean);
    a(of + "largest", r.balance.largest);
    a(of + "block", r.balance.block);
    a(of + "resting", r.balance.resting);
    a(of + "detached", r.balance.detached);
    a(of + "loose", r.balance.loose);
    list_energy_balance(a, of, r.energy);
    a(of + "closed", r.closed);
    a(of + "sliding", r.sliding);
    a(of + "bonded", r.bonded);
    a(of + "open", r.open);
    a(of + "broken", r.broken);
    a(of + "yielded", r.yielded);
    a(of + "convergences", r.convergences);
    if constexpr (Archive::loads) {
      if (r.convergences.size() != run_.gauges.convergences.size()) {
        a.refuse("stages do not fit the model");
      }
    }
  }
}

template <class Archive>
static void list_chatter(Archive& a, Chatter& c) {
  a("chatter.sum", c.sum);
  a("chatter.squares", c.squares);
  a("chatter.samples", c.samples);
  a("chatter.before", c.before);
  a("chatter.looks", c.looks);
  a("chatter.rebuilds", c.rebuilds);
  a("chatter.last", c.last);
  a("chatter.count", c.count);
  a("chatter.worst", c.worst);
  a("chatter.block_i", c.block_i);
  a("chatter.block_j", c.block_j);
  a("chatter.time", c.time);
}

template <class Archive>
static void list_peaks(Archive& a, std::vector<BoltPeak>& peaks) {
  const auto member = [&](const char* name, auto part) {
    std::vector<double> values;
    for (BoltPeak& p : peaks) values.push_back(part(p));
    a(name, values);
    peaks.resize(values.size());
    for (std::size_t r = 0; r < peaks.size(); ++r) part(peaks[r]) = values[r];
  };
  member("files.bolt_peaks.force", [](BoltPeak& p) -> double& { return p.force; });
  member("files.bolt_peaks.time", [](BoltPeak& p) -> double& { return p.time; });
  member("files.bolt_peaks.distance", [](BoltPeak& p) -> double& { return p.distance; });
  member("files.bolt_peaks.x", [](BoltPeak& p) -> double& { return p.place.x; });
  member("files.bolt_peaks.y", [](BoltPeak& p) -> double& { return p.place.y; });
  member("files.bolt_peaks.dowel", [](BoltPeak& p) -> double& { return p.dowel; });
}

template <class Archive>
void Driver::list(Archive& a) {
  RecorderMemory files = recorder_.memory();
  a("files.history_bytes", files.history_bytes);
  a("files.reactions_bytes", files.reactions_bytes);
  a("files.bolts_bytes", files.bolts_bytes);
  if (!sim_.scene->model.linings.empty()) a("files.linings_bytes", files.linings_bytes);
  if (sim_.scene->model.flow) a("files.flow_bytes", files.flow_bytes);
  a("files.frame_times", files.frame_times);
  a("files.velocities", files.velocities);
  if (has_bolts(sim_.scene->model)) list_peaks(a, files.bolt_peaks);
  // For each file its name, a line break, and its hash.
  std::string inputs;
  for (const InputFile& f : files.inputs) inputs += f.file + '\n' + f.sha256 + '\n';
  a("files.inputs", inputs);
  if constexpr (Archive::loads) files.inputs = input_files(inputs);
  std::uint64_t row = times_.next_row(), frame = times_.next_frame();
  a("events.next_row", row);
  a("events.next_frame", frame);
  a("events.time", event_.time);
  a("events.row", event_.row);
  a("events.frame", event_.frame);
  a("events.end", event_.end);
  a("events.counted_row", event_.counted_row);
  a("events.counted_frame", event_.counted_frame);
  list_stages(a);
  const Model& model = sim_.scene->model;
  list_ramp(a, ramp_, stage_ < plans_.size() && stage().ramp);
  list_curve(a, curve_, model, run_.gauges.monitors.size());
  a("driver.angle", angle_);
  a("driver.last_row", last_row_);
  a("driver.last_frame", last_frame_);
  a("outcome.largest_drift", outcome_.largest_energy_error);
  a("outcome.largest_transfer", outcome_.largest_transfer);
  a("outcome.unbalanced", outcome_.unbalanced);
  a("outcome.overlap.ratio", outcome_.overlap.ratio);
  a("outcome.overlap.depth", outcome_.overlap.depth);
  a("outcome.overlap.x", outcome_.overlap.place.x);
  a("outcome.overlap.y", outcome_.overlap.place.y);
  a("outcome.overlap.block_i", outcome_.overlap.block_i);
  a("outcome.overlap.block_j", outcome_.overlap.block_j);
  a("outcome.overlap.time", outcome_.overlap.time);
  a("outcome.critical_step", outcome_.critical_step);
  a("outcome.step_over_critical", outcome_.step_over_critical);
  a("outcome.reaction_error", outcome_.reaction_error);
  a("outcome.slowed_in_fall", outcome_.slowed_in_fall);
  a("outcome.loose", outcome_.loose);
  list_chatter(a, outcome_.chatter);
  a("outcome.stepping", outcome_.wall.stepping);
  a("outcome.output", outcome_.wall.output);
  list_energy_balance(a, "energy_balance.", outcome_.energy);
  double wall = wall_before_ + since(started_);
  a("driver.wall", wall);
  if constexpr (Archive::loads) {
    wall_before_ = wall;
    times_.go_on_from(row, frame);
    files_ = std::move(files);
  }
}

void Driver::write_memory(ImageBytes& image, std::size_t stages) {
  write_hdf5(image, [&](RecordSink& sink) {
    Saver saver(sink);
    saver("version", std::string(version));
    saver("model", identity(sim_.scene->model, stages));
    list(saver);
    remember(sim_, sink);
  });
}

void Driver::save_checkpoint() {
  forget_instant();
  saved_ = Clock::now();
  Trouble trouble = recorder_.sync();
  if (!trouble) {
    trouble = write_checkpoint(options_.folder,
                               [&](ImageBytes& image) { write_memory(image, all_stages); });
  }
  // A checkpoint that cannot be written does not end the run; the previous one remains.
  if (trouble && options_.warn) options_.warn("no checkpoint: " + to_string(*trouble));
}

bool Driver::save_stage_joints() {
  if (ended_by(recorder_.finish_frame())) return false;
  const Picture picture = picture_of(sim_, look());
  forget_instant();
  return !ended_by(recorder_.stage_joints(stage_, picture));
}

void Driver::save_stage() {
  if (!recorder_.writes() || !sim_.scene->model.output.stages || sim_.scene->model.stages.empty())
    return;
  if (!save_stage_joints()) return;
  stage_has_ended_ = true;
  Trouble trouble = recorder_.sync();
  if (!trouble) {
    trouble = write_stage_checkpoint(options_.folder, stage_,
                                     [&](ImageBytes& image) { write_memory(image, stage_ + 1); });
  }
  stage_has_ended_ = false;
  if (trouble && options_.warn) options_.warn("no checkpoint: " + to_string(*trouble));
}

Trouble Driver::restore(const Record& record) {
  Loader loader(record);
  std::string by, model;
  loader("version", by);
  loader("model", model);
  const std::string& folder = options_.folder;
  if (!loader.flaw().empty()) {
    return refused(folder, "holds no checkpoint of a run: " + loader.flaw(),
                   "run without --resume");
  }
  if (by != version) {
    return refused(folder,
                   "its checkpoint is of version " + by + ", this is " + std::string(version),
                   "resume with that version, or run without --resume");
  }
  const std::size_t stages = options_.from_stage ? *options_.from_stage + 1 : all_stages;
  if (const std::string now = identity(sim_.scene->model, stages); now != model) {
    return refused(
        folder,
        "the model is not the one of the checkpoint; first difference: " + difference(now, model),
        "resume with the model as it was (model.toml in that folder), or run without "
        "--resume");
  }
  list(loader);
  std::string flaw = loader.flaw();
  if (flaw.empty()) repeat_changes(sim_, plans_, stage_);
  if (flaw.empty()) flaw = recall(sim_, record);
  if (flaw.empty() && angle_.size() != sim_.scene->blocks.size() && !angle_.empty()) {
    flaw = "driver.angle has another size than the model asks for";
  }
  const bool goes_on = stage_has_ended_ && stage_ + 1 < plans_.size();
  const Model& given = sim_.scene->model;
  const double end = given.stages.empty() ? given.solver.duration : latest_end();
  if (flaw.empty() && !goes_on && sim_.motion.state.time >= end) {
    return refused(folder,
                   fmt::format("its checkpoint is at {:.6g} s, the duration is {:.6g} s",
                               sim_.motion.state.time, end),
                   "give a longer solver.duration");
  }
  if (!flaw.empty()) {
    return refused(folder, "its checkpoint does not fit the model: " + flaw,
                   "run without --resume");
  }
  if (options_.from_stage) begin_ramps_after(sim_, stage_);
  started_ = Clock::now();
  resumed_ = true;
  if (stage_has_ended_) times_.go_on_after(sim_.motion.state.time);
  // Where the duration has changed, the next event has, too.
  if (!stage_has_ended_ && (event_.end || event_.time > end)) {
    times_.put_back(event_);
    const Event next = times_.next();
    if (next.time != event_.time) fit_step_to(sim_, next.time);
    event_ = next;
  }
  return recorder_.resume(sim_, run_.gauges, files_);
}

}  // namespace edda
