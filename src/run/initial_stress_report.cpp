#include "run/initial_stress_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "contacts/face_reading.hpp"
#include "run/labels.hpp"
#include "run/observe.hpp"

namespace edda {
namespace {

constexpr double most_off = 0.05;         // of the gradient
constexpr double most_unbalanced = 1e-3;  // of the mean contact force

/// d(sxy)/dy + rho g_x and d(syy)/dy + rho g_y, over rho |g|; where there is no gravity, what the
/// gradient makes over the height of the model, over the stress.
double missed(const Simulation& sim, double density) {
  const InitialStress& s = *sim.model.initial_stress;
  const Vec2 g = sim.model.gravity,
             off{(*s.gradient)[2] + density * g.x, (*s.gradient)[1] + density * g.y};
  if (norm(g) > 0.0) return norm(off) / (density * norm(g));
  const auto [low, high] =
      std::minmax_element(sim.blocks.vertex_y.begin(), sim.blocks.vertex_y.end());
  const double made = norm(off) * (*high - *low);
  double size = 0.0;
  for (const double c : *s.stress) size = std::max(size, std::abs(c));
  return made > 0.0 ? made / std::max(size, made) : 0.0;
}

void judge_gradient(const Simulation& sim, InitialBalance& balance) {
  if (!sim.model.initial_stress->stress) return;
  for (std::size_t i = 0; i < sim.blocks.size(); ++i) {
    const Index m = sim.blocks.material[i];
    if (sim.blocks.fixed[i] || m == none || m == balance.material) continue;
    const double off = missed(sim, sim.model.materials[static_cast<std::size_t>(m)].density);
    if (balance.material != none && off <= balance.gradient) continue;
    balance.gradient = off;
    balance.material = m;
  }
}

/// Resultant of weight, contacts, boundary springs and loads on every block, N.
std::vector<Vec2> resultants(const Simulation& sim) {
  const BlockSet& b = sim.blocks;
  const FaceSet& c = sim.contacts;
  std::vector<Vec2> sum(b.size());
  const LoadsNow now = loads_at(sim.model, sim.loads, 0.0);
  for (std::size_t i = 0; i < b.size(); ++i) {
    sum[i] = b.mass[i] * sim.model.gravity + load_on(b, now, sim.pose, i);
    for (Id q = sim.springs.block_begin[i]; q < sim.springs.block_begin[i + 1]; ++q) {
      sum[i] += spring_force(sim.springs, q, sim.pose.x, sim.pose.y);
    }
  }
  for (std::size_t k = 0; k < c.size(); ++k) {
    if (!is_closed(c, k)) continue;
    const Vec2 on = force_on_facing(c, k);
    sum[block_of_facing(b, c, k)] += on;
    sum[block_of_edge(b, c, k)] -= on;
  }
  return sum;
}

void judge_balance(const Simulation& sim, InitialBalance& balance) {
  std::vector<Id> free_blocks;
  double sum = 0.0;
  const std::vector<Vec2> on = resultants(sim);
  for (std::size_t i = 0; i < on.size(); ++i) {
    if (!is_free(sim.blocks, sim.state, i)) continue;
    free_blocks.push_back(static_cast<Id>(i));
    sum += norm(on[i]);
    if (balance.block != no_id && norm(on[i]) <= balance.largest) continue;
    balance.largest = norm(on[i]);
    balance.block = static_cast<Id>(i);
  }
  const double scale = force_scale(sim, sim.contacts, free_blocks);
  if (sum == 0.0) return;
  balance.unbalanced = scale > 0.0 ? sum / static_cast<double>(free_blocks.size()) / scale : 1.0;
  balance.largest = scale > 0.0 ? balance.largest / scale : 1.0;
}

struct NamedJoint {
  std::string name;
  const JointStress& stress;
};

/// Laws of Coulomb's that contacts have.
std::vector<NamedJoint> joints_of(const Simulation& sim) {
  std::vector<NamedJoint> named;
  const std::vector<JointStress>& joints = sim.initial->joints;
  for (std::size_t q = 0; q < joints.size() && q < sim.model.joints.size(); ++q) {
    if (joints[q].length > 0.0 && !sim.laws.rows[q].glued) {
      named.push_back({sim.model.joints[q].name, joints[q]});
    }
  }
  return named;
}

double part(double length, const JointStress& joint) {
  return length / joint.length;
}

std::string weight_line(const Simulation& sim) {
  const InitialStress& s = *sim.model.initial_stress;
  if (!s.stress) {
    return fmt::format("weight of the rock above, k0 = {:.4g}, out of the plane {:.4g}", *s.k0,
                       *s.k0_out);
  }
  const double syy = (*s.gradient)[1];
  std::string line = fmt::format("syy grows by {:.5g} Pa per metre upwards", syy);
  if (sim.initial->material == none) return line;
  const Material& m = sim.model.materials[static_cast<std::size_t>(sim.initial->material)];
  return line + fmt::format("; density times gravity of {} is {:.5g}: {:.2g} % apart", m.name,
                            -m.density * sim.model.gravity.y, 100.0 * sim.initial->gradient);
}

}  // namespace

void judge_initial_stress(Simulation& sim) {
  if (!sim.initial) return;
  judge_gradient(sim, *sim.initial);
  judge_balance(sim, *sim.initial);
}

std::vector<std::string> initial_stress_report(const Simulation& sim) {
  if (!sim.initial) return {};
  std::vector<std::string> lines{weight_line(sim)};
  for (const auto& [name, joint] : joints_of(sim)) {
    lines.push_back(
        fmt::format("joint {}: tau/sigma_n up to {:.3g}, tau up to {:.3g} of the strength; {:.3g} "
                    "% of {:.4g} m "
                    "over it, {:.3g} % in more tension than it bears",
                    name, joint.ratio, joint.mobilised, 100.0 * part(joint.over, joint),
                    joint.length, 100.0 * part(joint.torn, joint)));
  }
  lines.push_back(fmt::format(
      "forces balance to {:.2g} of the mean contact force, of {} to {:.2g}",
      sim.initial->unbalanced,
      sim.initial->block == no_id ? "no block" : block_label(sim.blocks, sim.initial->block),
      sim.initial->largest));
  return lines;
}

void warn_of_initial_stress(const Simulation& sim, std::vector<std::string>& warnings) {
  if (!sim.initial) return;
  const InitialBalance& balance = *sim.initial;
  if (balance.gradient > most_off) {
    const Vec2 g = sim.model.gravity;
    const double density = sim.model.materials[static_cast<std::size_t>(balance.material)].density;
    warnings.push_back(fmt::format(
        "initial_stress: its gradient and the weight of {} are {:.2g} % apart, so that the model "
        "is "
        "not in equilibrium: give syy a gradient of {:.6g} and sxy one of {:.6g}, or change the "
        "density or gravity",
        sim.model.materials[static_cast<std::size_t>(balance.material)].name,
        100.0 * balance.gradient, -density * g.y + 0.0, -density * g.x + 0.0));
  }
  for (const auto& [name, joint] : joints_of(sim)) {
    if (joint.over > 0.0) {
      warnings.push_back(fmt::format(
          "initial_stress: shear is above the strength of joint {} on {:.3g} % of its {:.4g} m (up "
          "to {:.3g} times, tau/sigma_n {:.3g}) and was cut to it: give a stress that the joints "
          "can "
          "bear, stronger joints, or let a stage until equilibrium sort it out",
          name, 100.0 * part(joint.over, joint), joint.length, joint.mobilised, joint.ratio));
    }
    if (joint.torn > 0.0) {
      warnings.push_back(fmt::format(
          "initial_stress: joint {} is in more tension than it bears on {:.3g} % of its {:.4g} m, "
          "which starts open: give a stress that presses on it, or tensile_strength",
          name, 100.0 * part(joint.torn, joint), joint.length));
    }
  }
  if (balance.unbalanced > most_unbalanced) {
    warnings.push_back(fmt::format(
        "initial_stress: forces are out of balance at the start by {:.2g} of the mean contact "
        "force, "
        "most on {} at {}: outer faces and openings that nothing holds, or what the lines above "
        "say, "
        "set the rock in motion; begin with a stage until equilibrium",
        balance.unbalanced, block_label(sim.blocks, balance.block),
        place_label(centroid(sim.state.x, sim.state.y, balance.block) + sim.blocks.origin)));
  }
}

void add_initial_checks(const Simulation& sim, std::vector<Check>& checks) {
  if (!sim.initial) return;
  const InitialBalance& balance = *sim.initial;
  const auto add = [&](std::string name, double value, double limit) {
    checks.push_back({std::move(name), value, limit, value <= limit});
  };
  if (sim.model.initial_stress->stress) {
    add("initial stress: gradient against density times gravity", balance.gradient, most_off);
  }
  add("initial stress: unbalanced forces at the start", balance.unbalanced, most_unbalanced);
  for (const auto& [name, joint] : joints_of(sim)) {
    constexpr double most = 1e9;  // a joint without strength
    add(fmt::format("initial stress: largest tau over strength of joint {}", name),
        std::min(joint.mobilised, most), 1.0);
    add(fmt::format("initial stress: part of joint {} over its strength", name),
        part(joint.over, joint), 0.0);
    add(fmt::format("initial stress: part of joint {} in too much tension", name),
        part(joint.torn, joint), 0.0);
    checks.push_back({fmt::format("initial stress: largest tau over sigma_n of joint {}", name),
                      joint.ratio,
                      {},
                      true});
  }
}

}  // namespace edda
