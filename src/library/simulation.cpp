// Running a Simulation: the Driver's run, in parts.
#include <cmath>
#include <cstring>

#include "blocks/kinematics.hpp"
#include "library/impl.hpp"
#include "results/files.hpp"
#include "step/changes.hpp"
#include "study/limit_analysis.hpp"

namespace edda::api {
namespace {

constexpr std::uint64_t no_step = std::numeric_limits<std::uint64_t>::max();
constexpr double no_time = std::numeric_limits<double>::infinity();

/// Keeps a flag true during its own lifetime, also where an exception ends it.
class Within {
 public:
  explicit Within(bool& flag) : flag_(flag) { flag = true; }
  ~Within() { flag_ = false; }
  Within(const Within&) = delete;
  Within& operator=(const Within&) = delete;

 private:
  bool& flag_;
};

/// Compared by bits, so that NaN equals itself.
bool same(const edda::Nodes& a, const edda::Nodes& b) {
  for (std::size_t k = 0; k < nodes_per_block; ++k) {
    if (a[k].size() != b[k].size()) return false;
    if (std::memcmp(a[k].data(), b[k].data(), a[k].size() * sizeof(double)) != 0) return false;
  }
  return true;
}

PreparedRun prepare(const Model& model, const Options& options) {
  use_threads();
  const edda::Model& given = model.impl().model;
  const bool goes_on = options.resume || options.from_stage;
  if (!options.results.empty()) {
    const std::string input = goes_on ? "" : given.file;
    if (const Trouble trouble = check_folder(options.results, input)) raise(Faults{*trouble});
  } else if (goes_on) {
    raise("results", "names no folder to continue from", "name the folder of the run");
  }
  if (options.from_stage == 0u) {
    raise("from_stage", "is 0, and stages count from 1", "give the number in stages.csv");
  }
  check_memory(given);
  return value_or_raise(prepare_run(given));
}

/// Makes the folder and checks that no other run is writing to it. Raises an Error, whereas the run
/// itself would only fail.
void check_for_writing(const std::string& folder) {
  FolderLock lock;  // unlocked at the end of this function: the run locks it itself
  if (const Trouble trouble = make_folder(folder)) raise(Faults{*trouble});
  if (const Trouble trouble = lock.take(folder)) raise(Faults{*trouble});
}

Outcome outcome_of(const edda::Outcome& o) {
  Outcome outcome;
  outcome.status = static_cast<Status>(o.status);
  outcome.message = o.message;
  outcome.time = o.time;
  outcome.steps = o.steps;
  outcome.contacts = o.contacts;
  outcome.drift = o.largest_energy_error;
  outcome.wall_seconds = o.wall.total;
  outcome.at_rest = o.at_rest;
  outcome.fastest = o.fastest == no_id ? -1 : static_cast<std::int32_t>(o.fastest);
  outcome.speed = o.speed;
  outcome.failed_checks = o.failed_checks;
  return outcome;
}

}  // namespace

std::string_view name_of(Status status) {
  return status_name(static_cast<edda::Status>(status));
}

Simulation::Impl::Impl(const Model& given, Options&& wanted)
    : model(given), options(std::move(wanted)), prepared(prepare(given, options)) {
  run_options.folder = options.results;
  run_options.resume = options.resume;
  if (options.from_stage) run_options.from_stage = *options.from_stage - 1;
  if (options.warn) run_options.warn = [this](const std::string& text) { warn(text); };
  run_options.stop = &stop;
  run_options.after_step = [this] { return after_step(); };
  run_options.rigid_factor = [this](const edda::Simulation& sim) {
    const bool as_read = !changed && !options.resume && !options.from_stage;
    return as_read ? rigid_factor(model.impl().model, sim) : std::nullopt;
  };
  if (options.progress) {
    run_options.progress_every = options.progress_every;
    run_options.progress = [this](const edda::Progress& p) { report(p); };
  }
  driver.emplace(prepared, run_options);
  const Faults faults = take_up_folder(*driver, run_options);
  if (!faults.empty()) raise(faults);
  velocities_ = sim().motion.state.velocity.x[0].data();
  if (options.resume || options.from_stage) enter();
}

Simulation::Impl::~Impl() {
  if (!begun || finished || options.results.empty()) return;
  options.progress = {};
  for (int attempt = 0; attempt < 2 && !finished; ++attempt) {
    try {
      finish();
    } catch (...) {  // no caller is left to receive it; refused velocities cannot come again
    }
  }
}

void Simulation::Impl::refuse_within_step(const char* function) const {
  if (stepping_) {
    raise(function, "called while the simulation is running",
          "pause() it, and call this afterwards");
  }
}

void Simulation::Impl::enter() {
  if (begun) return;
  take_back();
  const bool goes_on = options.resume || options.from_stage;
  if (!options.results.empty() && !goes_on) check_for_writing(options.results);
  begun = true;
  driver->begin();  // changes the present velocities to those half a step before
  instant_.reset();
  hand_over();
  if (driver->over()) finish();
}

void Simulation::Impl::go(std::uint64_t to_step, double to_time) {
  refuse_within_step("run");
  use_threads();
  if (finished) return take_back();
  enter();
  if (finished) return;
  take_back();
  pause = false;
  pause_step_ = to_step;
  pause_time_ = to_time;
  {
    const Within within(stepping_);
    keep_thrown([&] { driver->go_on(); });
  }
  instant_.reset();
  hand_over();
  if (driver->over()) finish();
  throw_kept();
}

void Simulation::Impl::finish() {
  refuse_within_step("finish");
  use_threads();
  if (finished) return take_back();
  enter();
  if (finished) return;
  take_back();
  finished = true;
  outcome = outcome_of(driver->finish());
  last_stage = driver->stage_row();
  driver.reset();  // and with it the lock of the folder
  hand_over();
  throw_kept();
}

template <class Part>
void Simulation::Impl::keep_thrown(Part part) {
  try {
    part();
  } catch (...) {
    if (!thrown_) thrown_ = std::current_exception();
  }
}

void Simulation::Impl::throw_kept() {
  if (thrown_) std::rethrow_exception(std::exchange(thrown_, nullptr));
}

template <class Action>
void Simulation::Impl::between_steps(Action action) {
  instant_.reset();
  hand_over();
  keep_thrown(action);
  keep_thrown([&] { take_back(); });
}

bool Simulation::Impl::after_step() {
  instant_.reset();
  if (!run_callbacks()) return true;
  const State& state = sim().motion.state;
  return pause || state.steps >= pause_step_ || state.time >= pause_time_;
}

bool Simulation::Impl::run_callbacks() {
  const std::uint64_t step = sim().motion.state.steps;
  std::vector<std::function<void()>> due;  // a copy, since an action may add and remove others
  for (const Repeated& r : callbacks) {
    if (step % r.steps == 0) due.push_back(r.action);
  }
  if (!due.empty()) {
    between_steps([&] {
      for (const auto& action : due) action();
    });
  }
  return !thrown_;
}

void Simulation::Impl::report(const edda::Progress& p) {
  if (!options.progress || thrown_) return;
  const Progress progress{p.fraction,     p.time,    p.steps,           p.rate,
                          p.seconds_left, p.kinetic, p.largest_overlap, p.largest_velocity,
                          p.stage + 1,    p.stages,  p.stage_name};
  between_steps([&] {
    if (!options.progress(progress)) stop = true;
  });
}

void Simulation::Impl::warn(const std::string& text) {
  if (velocities_ == nullptr) return options.warn(text);  // in the constructor
  between_steps([&] { options.warn(text); });
}

void Simulation::Impl::hand_over() {
  if (sim().motion.state.velocity.x[0].data() != velocities_) exchange_velocity_arrays(sim());
  if (!lent_) return;
  lent_vx_ = sim().motion.state.velocity.x;
  lent_vy_ = sim().motion.state.velocity.y;
}

void Simulation::Impl::take_back() {
  State& state = sim().motion.state;
  if (!lent_ || (same(state.velocity.x, lent_vx_) && same(state.velocity.y, lent_vy_))) return;
  const BodyVectors written = state.velocity;
  state.velocity.x = lent_vx_;
  state.velocity.y = lent_vy_;
  instant_.reset();
  if (finished) {
    raise("node_vx", "velocities were written, but the run is over",
          "make a new Simulation; those of the end are there again");
  }
  for (std::size_t i = 0; i < sim().scene->blocks.size(); ++i) {
    if (!is_free(sim().scene->blocks, state, i) || is_finite(sim().scene->blocks, written, i))
      continue;
    raise("node_vx", "the velocity written for block " + std::to_string(i) + " is no number",
          "write finite ones; those of before are there again");
  }
  change_velocities(written);
}

void Simulation::Impl::change_velocities(const BodyVectors& velocity) {
  const double work = sim().accounts.external_work;
  edda::change_velocities(sim(), velocity);
  if (!begun) sim().accounts.external_work = work;  // the run begins with them
  instant_.reset();
  lent_vx_ = sim().motion.state.velocity.x;
  lent_vy_ = sim().motion.state.velocity.y;
}

void Simulation::Impl::lend_velocities() {
  if (lent_) return;
  lent_ = true;
  hand_over();
}

void Simulation::Impl::begin_change(const char* function) {
  use_threads();
  enter();
  if (finished) raise(function, "the run is over", "make a new Simulation");
  take_back();
  changed = true;
}

void Simulation::Impl::end_change() {
  edda::Simulation& s = sim();
  change_damping(s, s.motion.damping, s.motion.dynamic);  // updates the allowed step
  driver->aim_again();
  instant_.reset();
  hand_over();
}

const Instant& Simulation::Impl::look() {
  use_threads();
  take_back();
  if (!instant_) {
    if (begun && driver) driver->count_revolutions_now();
    observe(sim(), instant_.emplace());
  }
  return *instant_;
}

Simulation::Simulation(const Model& model, Options options)
    : impl_(std::make_unique<Impl>(model, std::move(options))) {}
Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;

Outcome Simulation::run() {
  impl_->go(no_step, no_time);
  if (impl_->finished) return impl_->outcome;
  Outcome paused;
  paused.status = Status::interrupted;
  paused.message = "paused";
  paused.time = time();
  paused.steps = steps();
  return paused;
}

bool Simulation::step(std::uint64_t count) {
  if (count > 0) impl_->go(steps() + std::min(count, no_step - steps()), no_time);
  return !impl_->finished;
}

bool Simulation::advance_to(double until) {
  if (std::isnan(until)) raise("advance_to", "the time is no number", "give one in s");
  if (!(time() >= until)) impl_->go(no_step, until);
  return !impl_->finished;
}

bool Simulation::over() const {
  return impl_->finished;
}

Outcome Simulation::finish() {
  impl_->finish();
  return impl_->outcome;
}

void Simulation::pause() {
  impl_->pause = true;
}

void Simulation::stop() {
  impl_->stop = true;
}

std::size_t Simulation::every(std::uint64_t count, std::function<void()> action) {
  if (count == 0) raise("every", "0 steps", "give 1 or more");
  if (!action) raise("every", "an empty function", "give one that can be called");
  impl_->callbacks.push_back({impl_->next_callback, count, std::move(action)});
  return impl_->next_callback++;
}

void Simulation::forget(std::size_t callback) {
  std::erase_if(impl_->callbacks, [&](const auto& c) { return c.number == callback; });
}

}  // namespace edda::api
