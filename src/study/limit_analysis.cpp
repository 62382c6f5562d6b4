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
  if (fos.varied == Varied::shaking) {
    return fault_at(model, fos.where, "fos.vary",
                    "a ground motion has no limit load: limit analysis is statics",
                    "vary \"kh\", the seismic coefficient");
  }
  if (model.contact.model == ContactModel::points) {
    return fault_at(model, model.contact.where, "contact.model",
                    "\"points\" is the paper's contact model, without joints that have a length",
                    "use contact.model = \"faces\"");
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

/// [nb] 1: a free block whose size (square root of the area) is less than a tenth of the mean of
/// all free blocks.
std::vector<std::uint8_t> negligible_blocks(const Simulation& sim) {
  constexpr double small = 0.1;  // of the mean size
  std::vector<std::uint8_t> are(sim.scene->blocks.size(), 0);
  double size = 0.0, count = 0.0;
  for (std::size_t i = 0; i < are.size(); ++i) {
    if (!is_free(sim.scene->blocks, sim.motion.state, i)) continue;
    size += std::sqrt(sim.scene->blocks.area[i]);
    count += 1.0;
  }
  for (std::size_t i = 0; i < are.size(); ++i) {
    are[i] = is_free(sim.scene->blocks, sim.motion.state, i) &&
             std::sqrt(sim.scene->blocks.area[i]) * count < small * size;
  }
  return are;
}

LimitValue value_of(const LimitCase::Answer& answer) {
  return {answer.end, answer.lower, answer.upper};
}

/// The blocks moved by the mechanism, its largest velocity `far` (m).
Simulation moved_by(const Simulation& drawn, const RigidBlocks& rigid,
                    const std::vector<RigidMotion>& motion, double far) {
  Simulation moved = drawn;
  State& state = moved.motion.state;
  for (std::size_t r = 0; r < motion.size(); ++r) {
    for (const Id i : rigid.blocks[r]) {
      NodeVectors x = vectors_of(state.x, state.y, i);
      // A rotation, not its first order, so that blocks keep their shape.
      const double c = std::cos(far * motion[r].spin), s = std::sin(far * motion[r].spin);
      for (Vec2& of_node : x) {
        const Vec2 arm = of_node - rigid.centroid[r];
        of_node = rigid.centroid[r] + far * motion[r].velocity + c * arm + s * perp(arm);
      }
      store(x, state.x, state.y, i);
      place_vertices(moved.scene->blocks, state.x, state.y, i, moved.motion.pose.x,
                     moved.motion.pose.y);
    }
  }
  return moved;
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

const char* quantity(Varied varied) {
  switch (varied) {
    case Varied::strength:
      return "factor of safety";
    case Varied::load:
      return "multiplier of the load";
    case Varied::water:
      return "multiplier of the water pressure";
    case Varied::boundary:
      return "multiplier of the traction at the boundary";
    case Varied::tilt:
      return "tilt in degrees";
    case Varied::kh:
      return "seismic coefficient kh";
    case Varied::kv:
      return "seismic coefficient kv";
    default:
      return "multiplier of gravity";
  }
}

std::string message_of(const Fos& fos, const LimitResult& r) {
  const std::string what = quantity(fos.varied);
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
  if (r.without_pebbles && r.without_pebbles->status == LimitEnd::found)
    text += fmt::format(", {:.5g} without pebbles", r.without_pebbles->lower);
  if (r.smallest && r.smallest->status == LimitEnd::found)
    text += fmt::format("; at the other end {:.5g}", r.smallest->lower);
  return text;
}

void add_mechanism(LimitResult& r, const Simulation& drawn, const RigidBlocks& rigid,
                   const std::vector<RigidMotion>& motion) {
  constexpr double far = 0.01;     // of the blocks' size
  constexpr double moving = 0.01;  // nothing moves but the mechanism
  if (motion.empty()) return;
  r.moved = moved_by(drawn, rigid, motion, far * rigid.size);
  Simulation before = drawn;  // whose joints carry what they carry at the limit
  FaceSet& faces = before.motion.contacts;
  for (const RigidJoint& joint : rigid.joints) faces.now.energy[joint.face] = 1.0;
  r.mechanism = mechanism_of(before, *r.moved, moving);
  const std::vector<std::uint8_t> pebbles = negligible_blocks(drawn);
  const std::vector<MovingBlock>& moves = r.mechanism->blocks;
  r.of_pebbles =
      !moves.empty() && std::all_of(moves.begin(), moves.end(),
                                    [&](const MovingBlock& m) { return pebbles[m.id] != 0; });
  if (!r.of_pebbles) return;
  const Id i = moves.front().id;
  const std::string others =
      moves.size() > 1 ? fmt::format(" and {} as small", counted(moves.size() - 1, "other")) : "";
  r.warnings.push_back(fmt::format(
      "the mechanism moves {} ({:.3g} m in size, less than a tenth of the mean of all blocks){} "
      "alone: the limit is that of a pebble, which edda fos does not count; that of larger blocks "
      "is the limit with nothing acting on pebbles",
      block_label(drawn.scene->blocks, i), std::sqrt(drawn.scene->blocks.area[i]), others));
}

/// All but the largest value.
void add_others(LimitResult& r, const Simulation& sim, const Fos& fos, bool crushing,
                const LimitCase& asked, const LimitCase::Answer& answer) {
  constexpr std::size_t most_bodies = 2000;  // up to sixty limits more, of seconds each
  if (r.blocks <= most_bodies) {
    r.without_dilation = asked.without_dilation(answer);
  } else {
    r.warnings.push_back(fmt::format(
        "the limit without dilation is left out: the model has more than {} bodies", most_bodies));
  }
  if (fos.varied != Varied::strength) r.smallest = value_of(asked.at_end(false, StrengthOf::peak));
  if (asked.is_brittle()) {
    const LimitCase::Answer weak = asked.at_end(true, StrengthOf::residual);
    if (weak.end == LimitEnd::found) r.residual = weak.lower;
    if (weak.end == LimitEnd::no_equilibrium) r.residual = 0.0;
  }
  r.forces = thrust(sim, asked.rigid(), asked.strength_of(answer), answer.state);
  r.drawn = sim;
  // Without a limit nothing moves: what the last program left is no mechanism.
  if (answer.end == LimitEnd::found || answer.end == LimitEnd::no_equilibrium)
    add_mechanism(r, sim, asked.rigid(), answer.state.motion);
  if (!r.of_pebbles) return;
  const LimitCase others(sim, fos, crushing, negligible_blocks(sim));
  r.without_pebbles = value_of(others.at_end(true, StrengthOf::peak));
}

}  // namespace

Result<LimitResult> limit_analysis(const Model& model, LimitExtent extent) {
  const auto began = std::chrono::steady_clock::now();
  const Fos fos = model.fos.value_or(Fos{});
  if (auto fault = without_limit(model, fos)) return *fault;
  Result<PreparedRun> prepared = as_staged(model, fos);
  if (!prepared.ok()) return prepared.faults();
  Simulation& sim = prepared.value().sim;
  // Multipliers refer to the load as given, whatever a ramp has made of it.
  if (SteppedValue* const varied = slow_value(sim.attached.loads.slow, fos.varied, fos.target))
    *varied = {1.0, 1.0};
  const bool crushing = model.limit && model.limit->crushing;
  const LimitCase asked(sim, fos, crushing);
  LimitResult r;
  r.vary = fos.vary;
  r.blocks = asked.rigid().bodies();
  r.joints = asked.rigid().joints.size();
  r.size = asked.rigid().size;
  r.warnings = prepared.value().warnings;
  if (!sim.attached.bolts.rows.empty()) {
    r.warnings.push_back(
        "bolts count with any force up to their capacity; where blocks slide across a bolt and do "
        "not stretch it, the limit is too high, also without dilation: edda fos finds what the "
        "bolt carries then");
  }
  if (!asked.rigid().loose.empty()) {
    r.warnings.push_back(
        fmt::format("{} touched by nothing and left out: {}",
                    asked.rigid().loose.size() == 1 ? "a block is" : "some blocks are",
                    block_label(sim.scene->blocks, asked.rigid().loose.front())));
  }
  if (r.blocks == 0) {
    const bool loose = !asked.rigid().loose.empty();
    return fault_at(model, model.solver.where, "block",
                    loose
                        ? "no free block touches anything as drawn, so there are no joints to fail"
                        : "no block is free to move, so nothing can fail",
                    loose ? "draw the blocks so that they touch, or use edda fos"
                          : "leave some blocks that are neither fixed nor excavated");
  }
  const LimitCase::Answer answer = asked.at_end(true, StrengthOf::peak);
  r.largest = value_of(answer);
  r.violation = answer.state.violation;
  if (extent == LimitExtent::all) add_others(r, sim, fos, crushing, asked, answer);
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
  const std::optional<double> factor = largest(all);
  if (!factor || *factor >= 1.0) return factor;
  return largest(LimitCase(sim, fos, crushing, negligible_blocks(sim)));
}

}  // namespace edda
