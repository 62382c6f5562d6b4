#include "step/restitution.hpp"
#include "step/step.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "model/contact_springs.hpp"
#include "step/simulation.hpp"

namespace edda {
namespace {

/// Ratio of Young's modulus to the spring of a contact, and the largest LawDashpots::rebound used
/// with it. The softer the spring, the less an impact depends on the strain of the block, and the
/// deeper corners penetrate. With a stronger dashpot the strain of the block determines the
/// rebound. What remains is e where rebound (1 + e) = ln((1 + rebound)/(1 - rebound e)), about
/// 1/rebound at the least.
struct Softness {
  double factor, strongest;
};
constexpr Softness bouncing{60.0, 5.2}, dull{150.0, 40.0};
/// Capped by linear dashpots of the fraction sqrt(rebound): no impact reaches the cap, and it
/// shortens the step little.
LawDashpots dashpots_of(double spring, double rebound) {
  return {std::sqrt(rebound), 0.0, spring, rebound};
}
// The same for Housner's restitution: strong enough that a corner stays where it strikes.
constexpr double housners_factor = 15.0, plastic = 4.0;
constexpr double close_to = 0.05;  // largest difference of attainable and requested part

/// Rock of the free block of lowest Young's modulus, and the size of the free block of median area.
struct Reference {
  Material rock;
  double size = 0.0;  ///< m
};

std::optional<Reference> reference_of(const Model& model, const BlockSet& b) {
  Reference found;
  found.rock.young = std::numeric_limits<double>::infinity();
  std::vector<double> areas;
  for (std::size_t i = 0; i < b.size(); ++i) {
    if (b.fixed[i] != 0 || b.material[i] == none) continue;
    const Material& rock = model.materials[static_cast<std::size_t>(b.material[i])];
    if (rock.young < found.rock.young) found.rock = rock;
    areas.push_back(b.area[i]);
  }
  if (areas.empty()) return std::nullopt;
  const auto middle = areas.begin() + static_cast<std::ptrdiff_t>(areas.size() / 2);
  std::nth_element(areas.begin(), middle, areas.end());
  found.size = std::sqrt(*middle);
  return found;
}

Ring rectangle(Vec2 low, Vec2 high) {
  return {low, {high.x, low.y}, high, {low.x, high.y}};
}

/// A square of the reference rock and size just above a fixed one, moving down.
Model flat_impact(const Model& model, const Reference& reference, const JointLaw& law,
                  const LawDashpots& dashpots, double speed) {
  Model m;
  m.plane = model.plane;
  m.thickness = model.thickness;
  m.gravity = {};
  m.materials = {reference.rock};
  JointLaw joint;
  joint.peak.friction_angle = joint.residual.friction_angle = 30.0;
  joint.kn = law.kn;
  joint.ks = law.ks;
  joint.dashpots = dashpots;
  m.joints = {joint};
  m.contact.normal_stiffness = m.contact.shear_stiffness = dashpots.spring;
  m.contact.joint = 0;
  m.solver.mass = model.solver.mass;
  m.solver.damping.rayleigh = model.solver.damping.rayleigh;
  const double l = reference.size, gap = 1e-6 * l;
  BlockInput ground, block;
  ground.polygon = rectangle({-l, -l}, {2.0 * l, 0.0});
  ground.fixed = true;
  block.polygon = rectangle({0.0, gap}, {l, l + gap});
  block.velocity = {0.0, -speed};
  for (BlockInput* b : {&ground, &block}) b->material = 0;
  m.blocks = {ground, block};
  return m;
}

/// The contact spring of a law where a square of the reference lies flat.
double spring_of(const Reference& reference, const JointLaw& law, double spring) {
  return law.kn ? *law.kn * 0.5 * reference.size : spring;
}

/// Part of its velocity that the square keeps in a flat impact.
double restitution_of(const Model& model, const Reference& reference, const JointLaw& law,
                      const LawDashpots& dashpots) {
  const double mass = reference.rock.density * reference.size * reference.size;
  const double inverse_frequency =
      std::sqrt(mass / (2.0 * spring_of(reference, law, dashpots.spring)));
  const double speed = 1e-4 * reference.size / inverse_frequency;
  constexpr double lasts = 8.0;  // periods over 2 pi, and more where the dashpot slows it
  const double duration = lasts * (1.0 + dashpots.damping) * inverse_frequency;
  Result<Simulation> made = Simulation::create(flat_impact(model, reference, law, dashpots, speed));
  if (!made.ok()) return 0.0;
  Simulation& sim = made.value();
  start(sim, duration);
  while (sim.motion.state.time < duration && !step(sim)) {
  }
  const std::size_t i = sim.scene->blocks.fixed[0] != 0 ? 1 : 0;
  return std::max(centroid(sim.motion.state.velocity, i).y / speed, 0.0);
}

Fault out_of_reach(const JointLaw& law, const Reference& reference, bool more, double reached) {
  Fault fault{law.where, {}, {}};
  fault.where.key += ".restitution";
  fault.problem = fmt::format(
      "is {} than the {:.2g} of its velocity that a flat impact leaves a block {}with {}"
      "materials.{}.damping = {:.3g}",
      more ? "more" : "less", reached, more ? "" : "at the least ",
      law.kn ? fmt::format("kn = {:.3g} Pa/m and ", *law.kn) : std::string(), reference.rock.name,
      reference.rock.damping);
  fault.remedy = law.kn ? "leave out kn, or give another restitution"
                        : "give another damping of the material, or another restitution";
  return fault;
}

/// A corner stays where it strikes only if springs are much softer than its block.
std::optional<Fault> too_stiff(const JointLaw& law, const Reference& reference) {
  constexpr double factor = 10.0;
  const double most = reference.rock.young / factor / (0.5 * reference.size);
  if (!law.kn || *law.kn <= most) return std::nullopt;
  Fault fault{law.where, {}, {}};
  fault.where.key += ".restitution";
  fault.problem = fmt::format(
      "\"housner\" requires springs much softer than the blocks, and kn = {:.3g} Pa/m is not",
      *law.kn);
  fault.remedy = fmt::format("leave out kn, or give at most {:.2g} Pa/m", most);
  return fault;
}

/// Dashpot and spring for a flat impact that leaves the part `wanted` of the velocity, or why there
/// are none.
Result<LawDashpots> fit_part(const Model& model, const Reference& reference, const JointLaw& law,
                             double wanted) {
  double least = 0.0;
  for (const Softness& soft : {bouncing, dull}) {
    const double spring =
        std::min(contact_springs(model).normal, reference.rock.young / soft.factor);
    const auto left = [&](double rebound) {
      return restitution_of(model, reference, law, dashpots_of(spring, rebound));
    };
    const double most = left(0.0);
    if (wanted > most + close_to) return out_of_reach(law, reference, true, most);
    if (wanted >= most) return dashpots_of(spring, 0.0);
    least = left(soft.strongest);
    if (wanted < least - (soft.factor == dull.factor ? close_to : 0.0)) continue;
    double low = 0.0, high = soft.strongest;
    constexpr int rounds = 16;
    for (int round = 0; round < rounds; ++round) {
      const double middle = 0.5 * (low + high);
      (left(middle) > wanted ? low : high) = middle;
    }
    return dashpots_of(spring, 0.5 * (low + high));
  }
  return out_of_reach(law, reference, false, least);
}

}  // namespace

std::vector<Fault> fit_restitution(Model& model, const BlockSet& blocks) {
  std::vector<Fault> faults;
  const bool any = std::any_of(model.joints.begin(), model.joints.end(),
                               [](const JointLaw& law) { return law.restitution.has_value(); });
  const std::optional<Reference> reference =
      any ? reference_of(model, blocks) : std::optional<Reference>{};
  if (!reference) return faults;
  for (JointLaw& law : model.joints) {
    if (!law.restitution) continue;
    if (law.restitution->housner) {
      if (auto fault = too_stiff(law, *reference)) faults.push_back(*fault);
      law.dashpots = LawDashpots{
          plastic, plastic,
          std::min(contact_springs(model).normal, reference->rock.young / housners_factor)};
      continue;
    }
    Result<LawDashpots> found = fit_part(model, *reference, law, law.restitution->part);
    if (found.ok()) {
      law.dashpots = found.value();
    } else {
      faults.insert(faults.end(), found.faults().begin(), found.faults().end());
    }
  }
  return faults;
}

}  // namespace edda
