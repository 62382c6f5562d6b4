#include "run/recorder.hpp"

#include <fmt/format.h>

#include <utility>

#include "model/files/time_history.hpp"
#include "model/write_model.hpp"
#include "observe/attachment_rows.hpp"
#include "observe/summary.hpp"
#include "results/sha256.hpp"
#include "results/tables.hpp"

namespace edda {
namespace {

ColumnOwners owners_of(const Model& model, const Gauges& gauges) {
  return {.monitors = names_in(gauges.monitors),
          .convergences = names_in(gauges.convergences),
          .boundaries = boundary_names(model),
          .measurements = names_in(gauges.measurements)};
}

/// Recorder::velocities_ at an instant.
std::vector<double> velocities_of(const Simulation& sim, const Instant& at, const Gauges& gauges) {
  std::vector<double> velocities{at.state.time};
  for (const MonitorPoint& m : gauges.monitors) {
    const Vec2 v = absolute_velocity(sim, at, m);
    velocities.insert(velocities.end(), {v.x, v.y});
  }
  return velocities;
}

/// The files that the model was read from; none for a model built in memory.
std::vector<InputFile> inputs_of(const Model& model) {
  std::vector<InputFile> inputs;
  std::vector<std::string> files = files_beside(model);
  files.insert(files.begin(), model.file);
  for (const std::string& name : files) {
    const Result<std::string> text = read_file(name);
    if (text.ok()) inputs.push_back({name, sha256(text.value())});
  }
  return inputs;
}

}  // namespace

Trouble Recorder::begin(const Simulation& sim, const Gauges& gauges) {
  if (!writes()) return {};
  inputs_ = inputs_of(sim.scene->model);
  if (auto t = make_folder(folder_)) return t;
  if (auto t = lock_.take(folder_)) return t;
  if (auto t = clear_folder(folder_)) return t;
  if (auto t = write_file(path("model.toml"), to_toml(sim.scene->model))) return t;
  if (auto t = history_.open(path("history.csv"))) return t;
  owners_ = owners_of(sim.scene->model, gauges);
  const auto header = [this](ResultFile file) { return begin_table(file, owners_).text(); };
  if (auto t = history_.add(header(ResultFile::history))) return t;
  if (!sim.scene->model.boundaries.empty()) {
    if (auto t = reactions_.open(path("reactions.csv"))) return t;
    if (auto t = reactions_.add(header(ResultFile::reactions))) return t;
  }
  if (has_bolts(sim.scene->model)) {
    if (auto t = bolts_.open(path("bolts.csv"))) return t;
    if (auto t = bolts_.add(header(ResultFile::bolts))) return t;
  }
  if (!sim.scene->model.linings.empty()) {
    if (auto t = linings_.open(path("linings.csv"))) return t;
    if (auto t = linings_.add(header(ResultFile::linings))) return t;
  }
  if (sim.scene->model.flow) {
    if (auto t = flow_.open(path("flow.csv"))) return t;
    if (auto t = flow_.add(header(ResultFile::flow))) return t;
  }
  frames_.emplace(folder_, sim.scene->blocks);
  return write_columns_csv(folder_, owners_);
}

RecorderMemory Recorder::memory() const {
  return {history_.bytes(), reactions_.bytes(),
          bolts_.bytes(),   linings_.bytes(),
          flow_.bytes(),    frames_ ? frames_->times() : std::vector<double>{},
          bolt_peaks_,      inputs_,
          velocities_};
}

Trouble Recorder::sync() {
  if (auto t = history_.sync()) return t;
  if (auto t = reactions_.sync()) return t;
  if (auto t = bolts_.sync()) return t;
  if (auto t = linings_.sync()) return t;
  if (auto t = flow_.sync()) return t;
  return frames_ ? frames_->write_series() : Trouble{};
}

Trouble Recorder::resume(const Simulation& sim, const Gauges& gauges,
                         const RecorderMemory& memory) {
  if (!writes()) return {};
  owners_ = owners_of(sim.scene->model, gauges);
  if (auto t = lock_.take(folder_)) return t;
  inputs_ = memory.inputs;
  velocities_ = memory.velocities;
  bolt_peaks_ = memory.bolt_peaks;
  if (auto t = history_.reopen(path("history.csv"), memory.history_bytes)) return t;
  if (!sim.scene->model.boundaries.empty()) {
    if (auto t = reactions_.reopen(path("reactions.csv"), memory.reactions_bytes)) return t;
  }
  if (has_bolts(sim.scene->model)) {
    if (auto t = bolts_.reopen(path("bolts.csv"), memory.bolts_bytes)) return t;
  }
  if (!sim.scene->model.linings.empty()) {
    if (auto t = linings_.reopen(path("linings.csv"), memory.linings_bytes)) return t;
  }
  if (sim.scene->model.flow) {
    if (auto t = flow_.reopen(path("flow.csv"), memory.flow_bytes)) return t;
  }
  frames_.emplace(folder_, sim.scene->blocks);
  frames_->go_on_after(memory.frame_times);
  if (auto t = forget_end(folder_, memory.frame_times.size())) return t;
  if (auto t = write_columns_csv(folder_, owners_)) return t;
  return write_model_file(sim.scene->model);
}

/// A resumed run may have another duration, and one resumed from a stage may have other stages
/// after it.
Trouble Recorder::write_model_file(const Model& model) {
  const std::string file = path("model.toml"), text = to_toml(model);
  const Result<std::string> told = read_file(file);
  if (told.ok() && told.value() == text) return {};
  if (!is_same_file(model.file, file)) inputs_ = inputs_of(model);
  return write_file(file, text);
}

void Recorder::begin_stage(const Simulation& sim, const Instant& at, const Gauges& gauges) {
  velocities_ = velocities_of(sim, at, gauges);
}

Trouble Recorder::row(const Simulation& sim, const Instant& at, const Gauges& gauges,
                      const EnergyBalance& l, double unbalanced) {
  if (!writes()) return {};
  if (auto t = frames_ ? frames_->collect() : Trouble{}) return t;
  Csv csv;
  csv.add(sim.motion.state.time);
  const std::vector<double> before = std::exchange(velocities_, velocities_of(sim, at, gauges));
  // The mean since the row before: what swings between rows cannot alias into it as into values at
  // their times. 0 in the first row.
  const auto mean = [&](std::size_t k) {
    const double between = before.empty() ? 0.0 : velocities_[0] - before[0];
    return between > 0.0 ? (velocities_[k] - before[k]) / between : 0.0;
  };
  for (std::size_t q = 0; q < gauges.monitors.size(); ++q) {
    const MonitorReading r = read_monitor(sim, at, gauges.monitors[q]);
    csv.add(r.displacement.x).add(r.displacement.y).add(r.velocity.x).add(r.velocity.y);
    csv.add(mean(2 * q + 1)).add(mean(2 * q + 2));
    csv.add(r.stress.xx).add(r.stress.yy).add(r.stress.xy);
  }
  for (const ConvergenceLine& line : gauges.convergences)
    csv.add(convergence(sim.scene->blocks, at.state, line));
  for (const MeasuredRegion& region : gauges.measurements) {
    const auto [stress, strain] = mean_state(sim, at, region);
    csv.add(stress.xx).add(stress.yy).add(stress.zz).add(stress.xy);
    csv.add(strain.xx).add(strain.yy).add(strain.xy);
  }
  for (const double v : {l.kinetic, l.strain, l.contact, l.gravity, l.friction, l.damping,
                         l.fracture, l.external, l.step_change, l.error, unbalanced, l.transfer}) {
    csv.add(v);
  }
  csv.add(sim.motion.contacts.cracks_tension).add(sim.motion.contacts.cracks_shear);
  if (!sim.scene->model.boundaries.empty()) {
    if (auto t = reactions_.add(reactions_row(sim, at))) return t;
  }
  return history_.add(csv.end().text());
}

Trouble Recorder::stages(const std::string& csv) {
  if (!writes()) return {};
  if (auto t = write_file(path("stages.csv"), csv)) return t;
  return write_columns_csv(folder_, owners_);
}

Trouble Recorder::curve(const std::string& csv) {
  if (!writes()) return {};
  if (auto t = write_file(path("curve.csv"), csv)) return t;
  return write_columns_csv(folder_, owners_);
}

Trouble Recorder::stage_joints(std::size_t stage, const Picture& picture) {
  if (!writes()) return {};
  const std::string file = fmt::format("{}/joints_{}.csv", folder_, stage + 1);
  if (auto t = write_joints_csv(file, picture.contacts)) return t;
  return write_columns_csv(folder_, owners_);
}

Trouble Recorder::frame(const Simulation& sim, Picture picture) {
  if (has_bolts(sim.scene->model)) {
    if (auto t = bolts_.add(bolts_rows(sim))) return t;
    raise_peaks(sim, bolt_peaks_);
  }
  if (!sim.scene->model.linings.empty()) {
    if (auto t = linings_.add(linings_rows(sim))) return t;
  }
  if (sim.scene->model.flow) {
    if (auto t = flow_.add(flow_rows(sim))) return t;
  }
  return frames_ ? frames_->add(std::move(picture)) : Trouble{};
}

Trouble Recorder::tables(const Simulation& sim, const Picture& picture) {
  if (!writes()) return {};
  Trouble first = history_.close();
  const auto also = [&](const Trouble& t) { first = first ? first : t; };
  for (RowFile* file : {&reactions_, &bolts_, &linings_, &flow_}) also(file->close());
  if (frames_) also(frames_->write_series());
  if (auto t = write_blocks_csv(path("blocks.csv"), picture.blocks)) return t;
  if (auto t = write_joints_csv(path("joints.csv"), picture.contacts)) return t;
  if (has_bolts(sim.scene->model)) {
    const std::string text =
        begin_table(ResultFile::bolt_summary).text() + bolt_summary_rows(sim, bolt_peaks_);
    if (auto t = write_file(path("bolt_summary.csv"), text)) return t;
  }
  if (auto t = write_columns_csv(folder_, owners_)) return t;
  return first;
}

Trouble Recorder::summary(const Simulation& sim, const Outcome& outcome,
                          const std::string& governed_by) {
  if (!writes()) return {};
  return write_file(path("summary.json"), summary_json(sim, outcome, governed_by, inputs_));
}

}  // namespace edda
