#include "study/limit_analysis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "base/text.hpp"
#include "judge/judge.hpp"
#include "model/stage_names.hpp"
#include "observe/balance.hpp"
#include "observe/observe.hpp"
#include "run/run_model.hpp"
#include "run/wall_clock.hpp"
#include "step/labels.hpp"
#include "study/fault_at.hpp"
#include "study/limit_case.hpp"
#include "study/limit_watch.hpp"
#include "study/side_by_side.hpp"
#include "study/staged_model.hpp"

namespace edda {
namespace {

/// A stage until collapse that ends before what is asked begins; null: there is none. What varies
/// the same as its ramp begins where that did.
const Stage* collapsed_before(const Model& model, const Fos& fos) {
  const std::size_t last =
      fos.stage.empty() ? model.stages.size() : stage_called(model, fos.stage).value_or(0) + 1;
  for (std::size_t q = 0; q < last; ++q) {
    const Stage& stage = model.stages[q];
    const bool same = q + 1 == last && stage.ramp && stage.ramp->varied == fos.varied &&
                      stage.ramp->target == fos.target;
    if (stage.until == StageEnd::collapse && !same) return &stage;
  }
  return nullptr;
}

std::optional<Fault> without_limit(const Model& model, const Fos& fos) {
  if (!model.linings.empty()) {
    return fault_at(model, model.linings.front().where, "lining",
                    "rigid limit analysis has no linings",
                    "leave them out, or run edda fos, which has them");
  }
  if (fos.varied == Varied::shaking) {
    return fault_at(model, fos.where, "fos.vary",
                    "a ground motion has no limit load: limit analysis is statics",
                    "vary \"kh\", the seismic coefficient");
  }
  if (fos.varied == Varied::water && model.flow) {
    return fault_at(model, fos.where, "fos.vary",
                    "a multiplier of the pressure of a water changes the flow through the joints, "
                    "which limit analysis takes as it is",
                    "run edda fos, or vary \"strength\"");
  }
  if (model.contact.model == ContactModel::points) {
    return fault_at(model, model.contact.where, "contact.model",
                    "\"points\" is the paper's contact model, without joints that have a length",
                    "use contact.model = \"faces\"");
  }
  for (const JointLaw& law : model.joints) {
    if (!law.fracture_energy) continue;
    return fault_at(model, law.where, (law.where.key + ".fracture_energy").c_str(),
                    "limit analysis is of a strength that does not fall as cracks open",
                    "run edda fos, or leave out the fracture energies");
  }
  const bool has_ucs =
      std::any_of(model.materials.begin(), model.materials.end(),
                  [](const auto& m) { return m.strength && m.strength->ucs > 0.0; });
  if (model.limit && model.limit->crushing && !has_ucs) {
    return fault_at(model, model.limit->where, "limit.crushing",
                    "no material has a compressive strength",
                    "give materials.X.strength = { ucs = ..., tension = ... }");
  }
  if (fos.varied == Varied::boundary &&
      model.boundaries[static_cast<std::size_t>(fos.target)].type == BoundaryType::displacement) {
    return fault_at(model, fos.where, "fos.vary",
                    "rigid blocks have no limit to the displacement of their support",
                    "vary a load, or run edda fos, which follows the displacement");
  }
  if (const Stage* stage = collapsed_before(model, fos); stage != nullptr) {
    return fault_at(model, stage->where, "stage.until",
                    "at the end of a stage until collapse there is no equilibrium to start from",
                    "vary what its ramp varies, or name a stage before it in fos.stage");
  }
  if (changes_gravity(fos.varied) && model.gravity == Vec2{}) {
    return fault_at(model, fos.where, "fos.vary", "the model has no gravity that this could act on",
                    "give gravity = [0, -9.81]");
  }
  return {};
}

LimitValue value_of(const LimitCase::Answer& answer) {
  return {answer.end, answer.lower, answer.upper};
}

/// The forces of the joints, each at the point through which its resultant goes.
std::vector<ContactRecord> thrust(const Simulation& sim, const RigidBlocks& rigid,
                                  const std::vector<RigidStrength>& strength,
                                  const LimitState& state) {
  std::vector<ContactRecord> all;
  const Vec2 origin = sim.scene->blocks.origin;
  for (std::size_t k = 0; k < state.forces.size(); ++k) {
    const RigidJoint& joint = rigid.joints[k];
    const RigidJointForce& f = state.forces[k];
    constexpr double little = 1e-9;  // of a mean weight
    if (std::abs(f.whole()) + std::abs(f.shear) <= little * rigid.force) continue;
    ContactRecord c;
    c.block_i = joint.block_a;
    c.block_j = joint.block_b;
    c.joint = joint.law < sim.scene->model.joints.size()
                  ? std::string_view(sim.scene->model.joints[joint.law].name)
                  : std::string_view("glued");
    const FaceSet& faces = sim.motion.contacts;
    c.table = sim.scene->blocks.table_of(faces.edge[joint.face], faces.facing[joint.face]);
    c.a = joint.ends[0] + origin;
    c.b = joint.ends[1] + origin;
    const double part = f.whole() != 0.0 ? f.normal[1] / f.whole() : 0.5;
    c.position = c.a + std::clamp(part, 0.0, 1.0) * (c.b - c.a);
    c.force = -f.whole() * joint.n - f.shear * joint.t;  // on block i
    c.normal_force = f.whole();
    c.shear_force = -f.shear;
    c.length = joint.length();
    const double most = strength[k].shear + strength[k].friction * f.whole();
    c.mobilised = most > 0.0 ? std::min(1.0, std::abs(f.shear) / most) : 0.0;
    all.push_back(c);
  }
  return all;
}

std::string message_of(const Fos& fos, const LimitResult& r) {
  const std::string what = quantity_varied(fos);
  if (r.interrupted && r.largest.status == LimitEnd::not_solved)
    return "interrupted before the limit was found";
  switch (r.largest.status) {
    case LimitEnd::no_limit:
      // Below no weight at all everything moves.
      return r.smallest && r.smallest->status == LimitEnd::found &&
                     std::abs(r.smallest->lower) > 1e-6
                 ? fmt::format(
                       "no larger {} moves the rigid blocks; at the other end the limit is {:.5g}",
                       what, r.smallest->lower)
                 : fmt::format("no {} moves the rigid blocks", what);
    case LimitEnd::no_equilibrium:
      return "the rigid blocks have no equilibrium" +
             std::string(fos.varied == Varied::strength ? " at any strength of their joints"
                                                        : ", whatever the " + what);
    case LimitEnd::not_solved:
      return "the linear program could not be solved: its numbers are too far apart";
    case LimitEnd::found:
      break;
  }
  std::string text = fmt::format("{} {:.5g}", what, r.largest.lower);
  if (r.without_dilation) text += fmt::format(", {:.5g} without dilation", *r.without_dilation);
  if (r.residual) text += fmt::format(", {:.5g} with residual strength", *r.residual);
  if (r.bolts_as_now)
    text += fmt::format(", {:.5g} with the force that bolts have before they are stretched",
                        *r.bolts_as_now);
  if (r.smallest && r.smallest->status == LimitEnd::found)
    text += fmt::format("; at the other end {:.5g}{}", r.smallest->lower,
                        r.other_governs ? ", which is nearer" : "");
  return r.interrupted ? text + "; interrupted before the rest was found" : text;
}

/// Of the mechanism of `largest`, and those before it.
void take_first(LimitResult& r, LimitMechanisms& mechanisms) {
  const LimitCase::Answer& answer = mechanisms.answer();
  r.largest = value_of(answer);
  r.violation = answer.state.violation;
  r.mechanisms = mechanisms.found;
  if (!mechanisms.motion) return;
  r.mechanism = std::move(mechanisms.motion->mechanism);
  r.moved = std::move(mechanisms.motion->moved);
}

/// Those that begin after it.
void find_later(LimitResult& r, LimitMechanisms& mechanisms, const LimitWatch& watch) {
  constexpr std::size_t most_shown = 3, most_tried = 30;
  std::size_t shown = 0;
  for (std::size_t n = 0; n < most_tried && shown < most_shown; ++n) {
    if (!mechanisms.find_next() || watch.stopped() || mechanisms.found.back().blocks.empty()) break;
    if (!mechanisms.found.back().left_out) ++shown;
  }
  r.mechanisms = mechanisms.found;
  if (!r.mechanisms.empty() && r.mechanisms.back().blocks.empty()) r.mechanisms.pop_back();
}

void find_other_end(LimitResult& r, const Simulation& sim, const Fos& fos, const LimitCase& asked) {
  const LimitCase::Answer answer = asked.at_end(false, StrengthOf::peak);
  r.smallest = value_of(answer);
  if (answer.end == LimitEnd::found)
    r.other_motion = limit_motion(sim, asked.rigid(), answer.state);
  const bool about_zero = changes_gravity(fos.varied) && fos.varied != Varied::gravity;
  constexpr double nearer = 1.0 - 1e-6;  // more than rounded coordinates of a symmetric model make
  const double furthest = std::max(std::abs(answer.lower), std::abs(answer.upper));
  r.other_governs =
      about_zero && answer.end == LimitEnd::found &&
      (r.largest.status == LimitEnd::no_limit ||
       (r.largest.status == LimitEnd::found && furthest < nearer * std::abs(r.largest.lower)));
}

void find_residual(LimitResult& r, const LimitCase& asked) {
  const LimitCase::Answer weak = asked.at_end(true, StrengthOf::residual);
  if (weak.end == LimitEnd::found) r.residual = weak.lower;
  if (weak.end == LimitEnd::no_equilibrium) r.residual = 0.0;
}

/// Bolts that have to be stretched carry no more than before until blocks have moved.
void find_with_bolts_as_now(LimitResult& r, const Simulation& sim, const Fos& fos, bool crushing) {
  const LimitCase::Answer now =
      LimitCase(sim, fos, crushing, nullptr, BoltForces::as_now).at_end(true, StrengthOf::peak);
  if (now.end == LimitEnd::found) r.bolts_as_now = now.lower;
  if (now.end == LimitEnd::no_equilibrium) r.bolts_as_now = 0.0;
}

void run_side_by_side(int threads, const std::vector<std::function<void()>>& works) {
  SideBySide tasks(threads, static_cast<int>(works.size()));
  std::size_t next = 0;
  for (std::size_t ended = 0; ended < works.size(); ++ended) {
    while (next < works.size() && tasks.has_room()) {
      tasks.begin([&works, next](const std::stop_token&) { works[next](); });
      ++next;
    }
    tasks.wait_for_one();
  }
}

/// All but the largest value.
void find_others(LimitResult& r, const Simulation& sim, const Fos& fos, LimitMechanisms& mechanisms,
                 const LimitOptions& options, LimitWatch& watch) {
  constexpr std::size_t most_bodies = 2000;  // of limits without dilation
  const LimitCase asked = mechanisms.at();
  const LimitCase::Answer answer = mechanisms.answer();
  r.forces = thrust(sim, asked.rigid(), asked.strength_of(answer), answer.state);
  r.drawn = sim;
  std::vector<std::function<void()>> works;
  if (r.blocks <= most_bodies) {
    works.emplace_back([&] {
      watch.begin("joints that slide without dilating");
      r.without_dilation = asked.without_dilation(answer);
    });
    works.emplace_back([&] {
      watch.begin("mechanisms that follow");
      find_later(r, mechanisms, watch);
    });
  } else {
    r.warnings.push_back(fmt::format(
        "the limit without dilation and the mechanisms that follow the first are left out: the "
        "model has more than {} bodies",
        most_bodies));
  }
  if (fos.varied != Varied::strength) {
    works.emplace_back([&] {
      watch.begin("the other end");
      find_other_end(r, sim, fos, asked);
    });
  }
  if (asked.is_brittle()) {
    works.emplace_back([&] {
      watch.begin("joints with residual strength");
      find_residual(r, asked);
    });
  }
  if (!sim.attached.bolts.rows.empty()) {
    works.emplace_back([&] {
      watch.begin("bolts as they are");
      find_with_bolts_as_now(r, sim, fos,
                             sim.scene->model.limit && sim.scene->model.limit->crushing);
    });
  }
  run_side_by_side(options.threads, works);
}

void add_warnings(LimitResult& r, const Simulation& sim, const RigidBlocks& rigid) {
  if (sim.scene->model.initial_stress) r.warnings.push_back(initial_stress_left_out);
  if (!sim.attached.bolts.rows.empty()) {
    r.warnings.push_back(
        "bolts count with any force up to their capacity; where blocks slide across a bolt and do "
        "not stretch it, the limit is too high, also without dilation: edda fos finds what the "
        "bolt carries then");
  }
  if (rigid.loose.empty()) return;
  r.warnings.push_back(fmt::format("{} touched by nothing and left out: {}",
                                   rigid.loose.size() == 1 ? "a block is" : "some blocks are",
                                   block_label(sim.scene->blocks, rigid.loose.front())));
}

std::optional<Fault> nothing_to_fail(const Model& model, const RigidBlocks& rigid) {
  if (rigid.bodies() > 0) return {};
  const bool loose = !rigid.loose.empty();
  return fault_at(model, model.solver.where, "block",
                  loose ? "no free block touches anything as drawn, so there are no joints to fail"
                        : "no block is free to move, so nothing can fail",
                  loose ? "draw the blocks so that they touch, close the gaps as drawn by "
                          "contact.close_gaps, or use edda fos"
                        : "leave some blocks that are neither fixed nor excavated");
}

}  // namespace

std::string quantity_varied(const Fos& fos) {
  const bool back = fos.target == backwards;
  switch (fos.varied) {
    case Varied::strength:
      return "factor of safety";
    case Varied::load:
      return "multiplier of the load";
    case Varied::water:
      return "multiplier of the water pressure";
    case Varied::boundary:
      return "multiplier of what the boundary imposes";
    case Varied::tilt:
      return back ? "tilt to the left in degrees" : "tilt in degrees";
    case Varied::kh:
      return back ? "seismic coefficient kh to the left" : "seismic coefficient kh";
    case Varied::kv:
      return back ? "seismic coefficient kv downwards" : "seismic coefficient kv";
    case Varied::shaking:
      return "multiplier of the ground motion";
    default:
      return "multiplier of gravity";
  }
}

const char* const initial_stress_left_out =
    "initial_stress is left out of the limit: rigid blocks take whatever forces suit their "
    "equilibrium best, so the limit is too high where the stress of the ground alone holds blocks; "
    "edda fos takes it in";

Result<LimitResult> limit_analysis(const Model& given, const LimitOptions& options) {
  Model model = given;
  // Rigid blocks need no nodes within their edges.
  model.deformation = BlockDeformation::uniform;
  for (Material& material : model.materials) material.deformation = BlockDeformation::uniform;
  const auto began = std::chrono::steady_clock::now();
  const Fos fos = model.fos.value_or(Fos{});
  if (auto fault = without_limit(model, fos)) return *fault;
  LimitWatch watch(options.stop, options.say);
  watch.begin("the first mechanism");
  Result<PreparedRun> prepared = as_staged(model, fos);
  if (!prepared.ok()) return prepared.faults();
  Simulation& sim = prepared.value().sim;
  // Multipliers refer to the load as given, whatever a ramp has made of it.
  if (SteppedValue* const varied = slow_value(sim.attached.loads.slow, fos.varied, fos.target))
    *varied = {1.0, 1.0};
  const bool crushing = model.limit && model.limit->crushing;
  LimitMechanisms mechanisms(sim, LimitCase(sim, fos, crushing, watch.programs()), fos.least_area);
  const RigidBlocks rigid = mechanisms.at().rigid();
  if (auto fault = nothing_to_fail(model, rigid)) return *fault;
  LimitResult r;
  r.vary = fos.vary;
  r.blocks = rigid.bodies();
  r.joints = rigid.joints.size();
  r.size = rigid.size;
  r.warnings = prepared.value().warnings;
  add_warnings(r, sim, rigid);
  while (mechanisms.find_next() && mechanisms.found.back().left_out && !watch.stopped()) continue;
  take_first(r, mechanisms);
  if (options.extent == LimitExtent::all && !watch.stopped())
    find_others(r, sim, fos, mechanisms, options, watch);
  r.interrupted = watch.stopped();
  r.message = message_of(fos, r);
  r.seconds = since(began);
  return r;
}

std::optional<double> rigid_factor(const Model& model, const Simulation& end) {
  constexpr std::size_t most_blocks = 600;
  const Fos fos;
  if (end.scene->blocks.size() > most_blocks || end.motion.contacts.gluing ||
      without_limit(model, fos))
    return {};
  const Result<PreparedRun> staged = as_staged(model, fos);
  if (!staged.ok()) return {};
  const Simulation& sim = staged.value().sim;
  const bool crushing = model.limit && model.limit->crushing;
  // Joints of which the friction is larger after failure hold more without their bonds.
  const auto largest = [](const LimitCase& asked) -> std::optional<double> {
    const LimitCase::Answer peak = asked.at_end(true, StrengthOf::peak);
    if (peak.end == LimitEnd::no_equilibrium) return 0.0;
    if (peak.end != LimitEnd::found) return {};
    if (peak.upper >= 1.0 || !asked.is_brittle()) return peak.upper;
    const LimitCase::Answer broken = asked.at_end(true, StrengthOf::residual);
    if (broken.end == LimitEnd::no_limit || broken.end == LimitEnd::not_solved) return {};
    return std::max(peak.upper, broken.end == LimitEnd::found ? broken.upper : 0.0);
  };
  const LimitCase all(sim, fos, crushing);
  if (all.rigid().bodies() == 0 || !all.rigid().loose.empty() ||
      !RelativeMotion(sim).sets(end, moved_little, end.relaxation.loose).empty())
    return {};
  return largest(all);
}

}  // namespace edda
