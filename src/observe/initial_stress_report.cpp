#include "observe/initial_stress_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "attachments/edges_on_line.hpp"
#include "attachments/initial_forces.hpp"
#include "model/stage_names.hpp"
#include "observe/observe.hpp"
#include "step/faces_now.hpp"
#include "step/labels.hpp"

namespace edda {
namespace {

constexpr double most_off = 0.05;         // of the gradient, and of the stress at the top
constexpr double most_unbalanced = 1e-3;  // of the mean contact force

/// Violation of equilibrium: d(sxy)/dy + rho g_x and d(syy)/dy + rho g_y, over rho |g|; without
/// gravity, the change of stress by the gradient over the height of the model, over the stress.
double missed(const Simulation& sim, double density) {
  const InitialStress& s = *sim.scene->model.initial_stress;
  const Vec2 g = sim.scene->model.gravity,
             off{(*s.gradient)[2] + density * g.x, (*s.gradient)[1] + density * g.y};
  if (norm(g) > 0.0) return norm(off) / (density * norm(g));
  const auto [low, high] =
      std::minmax_element(sim.scene->blocks.vertex_y.begin(), sim.scene->blocks.vertex_y.end());
  const double made = norm(off) * (*high - *low);
  double size = 0.0;
  for (const double c : *s.stress) size = std::max(size, std::abs(c));
  return made > 0.0 ? made / std::max(size, made) : 0.0;
}

void judge_gradient(const Simulation& sim, InitialBalance& balance) {
  if (!sim.scene->model.initial_stress->stress) return;
  for (std::size_t i = 0; i < sim.scene->blocks.size(); ++i) {
    const Index m = sim.scene->blocks.material[i];
    if (sim.scene->blocks.fixed[i] || m == none || m == balance.material) continue;
    const double off = missed(sim, sim.scene->model.materials[static_cast<std::size_t>(m)].density);
    if (balance.material != none && off <= balance.gradient) continue;
    balance.gradient = off;
    balance.material = m;
  }
}

/// Resultant of weight, contacts, boundary springs and loads on every block, N.
std::vector<Vec2> resultants(const Simulation& sim) {
  const BlockSet& b = sim.scene->blocks;
  const FaceSet& c = sim.motion.contacts;
  std::vector<Vec2> sum(b.size());
  const LoadsNow now = loads_at(sim.scene->model, sim.attached.loads, 0.0);
  for (std::size_t i = 0; i < b.size(); ++i) {
    sum[i] = b.mass[i] * sim.scene->model.gravity + load_on(b, now, sim.motion.pose, i);
    for (Id q = sim.attached.springs.block_begin[i]; q < sim.attached.springs.block_begin[i + 1];
         ++q) {
      sum[i] += spring_force(sim.attached.springs, q, sim.motion.pose.x, sim.motion.pose.y);
    }
  }
  for (std::size_t k = 0; k < c.size(); ++k) {
    if (!is_closed_now(sim, k)) continue;
    const Vec2 on = force_on_facing(face_row(sim, k));
    sum[block_of_facing(b, c, k)] += on;
    sum[block_of_edge(b, c, k)] -= on;
  }
  return sum;
}

/// [nb] 1: a free block whose faces are all joints that carry the stress of the ground.
std::vector<std::uint8_t> enclosed_blocks(const Simulation& sim) {
  const BlockSet& b = sim.scene->blocks;
  const FaceSet& c = sim.motion.contacts;
  std::vector<double> bare(b.size(), 0.0), whole(b.size(), 0.0);
  for (std::size_t v = 0; v < b.vertex_count(); ++v) whole[b.vertex_block[v]] += b.edge_length[v];
  bare = whole;
  for (std::size_t k = 0; k < c.size(); ++k) {
    if (!is_closed_now(sim, k)) continue;
    const FaceFields m = face_row(sim, k).state;
    bare[block_of_edge(b, c, k)] -= std::abs(m.xi_b - m.xi_a) * b.edge_length[c.edge[k]];
    bare[block_of_facing(b, c, k)] -= std::abs(m.eta_b - m.eta_a) * b.edge_length[c.facing[k]];
  }
  std::vector<std::uint8_t> enclosed(b.size(), 0);
  for (std::size_t i = 0; i < b.size(); ++i) {
    enclosed[i] = is_free(b, sim.motion.state, i) && bare[i] < 1e-3 * whole[i];
  }
  return enclosed;
}

/// Sum of the tractions of the ground on all faces of block i and of its weight, N: what the field
/// of k0 lacks to equilibrium under an uneven surface.
Vec2 missed_by_field(const Simulation& sim, const FaceForces& faces, std::size_t i) {
  const BlockSet& b = sim.scene->blocks;
  Vec2 sum = b.mass[i] * sim.scene->model.gravity;
  for (Id v = b.vertex_begin[i]; v < b.vertex_begin[i + 1]; ++v) {
    const EndForces on = faces.on(v, {0.0, 1.0});
    sum += on.at_from + on.at_to;
  }
  return sum;
}

/// Normal stress of the ground on free faces along the top of the model whose lack lifts their
/// block, over the mean stress: the ground above them is missing. lifts: resultants(), of which
/// each face takes its part.
double missing_above(const Simulation& sim, const FaceForces& faces, std::vector<Vec2> lifts) {
  const BlockSet& b = sim.scene->blocks;
  Boundary top;
  top.sides = {"top"};
  bool in_joints = false;
  double lost = 0.0, along = 0.0, mean = 0.0, area = 0.0;
  for (const Piece& p : pieces_on(b, boundary_lines(sim.scene->model, b, top), WhichFaces::open,
                                  boundary_snap(sim.scene->model, b), in_joints)) {
    const EndForces ground = faces.on(p.edge, p.part);
    const double needed = ground.at_from.y + ground.at_to.y, sign = needed > 0.0 ? 1.0 : -1.0;
    double& lift = lifts[b.vertex_block[p.edge]].y;
    const double missing = std::clamp(-sign * lift, 0.0, sign * needed);
    lift += sign * missing;
    lost += missing;
    along += (p.part.to - p.part.from) * b.edge_length[p.edge] * b.thickness;
  }
  for (std::size_t i = 0; i < b.size(); ++i) {
    const Tensor s = initial_stress(b, i);
    mean += b.area[i] * std::max(std::abs(s.xx), std::abs(s.yy));
    area += b.area[i];
  }
  return along > 0.0 && mean > 0.0 ? lost / along / (mean / area) : 0.0;
}

void judge_balance(const Simulation& sim, InitialBalance& balance) {
  const BlockSet& b = sim.scene->blocks;
  std::vector<Id> free_blocks;
  double sum = 0.0, within = 0.0;
  const std::vector<Vec2> on = resultants(sim);
  const std::vector<std::uint8_t> enclosed = enclosed_blocks(sim);
  const StressField field(sim.scene->model, b.origin);
  const LoadsNow now = loads_at(sim.scene->model, sim.attached.loads, 0.0);
  const FaceForces faces(b, field, now);
  std::size_t inside = 0;
  for (std::size_t i = 0; i < on.size(); ++i) {
    if (!is_free(b, sim.motion.state, i)) continue;
    free_blocks.push_back(static_cast<Id>(i));
    sum += norm(on[i]);
    if (enclosed[i]) {
      ++inside;
      const bool k0 = !sim.scene->model.initial_stress->stress;
      within += norm(on[i] - (k0 ? missed_by_field(sim, faces, i) : Vec2{}));
    }
    if (balance.block != no_id && norm(on[i]) <= balance.largest) continue;
    balance.largest = norm(on[i]);
    balance.block = static_cast<Id>(i);
  }
  balance.top = missing_above(sim, faces, on);
  const double scale = force_scale(sim, free_blocks);
  if (sum == 0.0) return;
  const auto count = static_cast<double>(free_blocks.size());
  balance.unbalanced = scale > 0.0 ? sum / count / scale : 1.0;
  balance.within = scale > 0.0 && inside > 0 ? within / static_cast<double>(inside) / scale : 0.0;
  balance.largest = scale > 0.0 ? balance.largest / scale : 1.0;
}

struct NamedJoint {
  std::string name;
  const JointStress& stress;
};

/// Coulomb laws that contacts have.
std::vector<NamedJoint> joints_of(const Simulation& sim) {
  std::vector<NamedJoint> named;
  const std::vector<JointStress>& joints = sim.accounts.initial->joints;
  for (std::size_t q = 0; q < joints.size() && q < sim.scene->model.joints.size(); ++q) {
    if (joints[q].length > 0.0 && !sim.motion.laws.rows[q].glued) {
      named.push_back({sim.scene->model.joints[q].name, joints[q]});
    }
  }
  return named;
}

double part(double length, const JointStress& joint) {
  return length / joint.length;
}

/// How much of a joint is beyond its strength.
std::string exceeded(const JointStress& joint) {
  if (joint.over == 0.0 && joint.torn == 0.0) {
    return fmt::format("no part of its {:.4g} m exceeds its shear or tensile strength",
                       joint.length);
  }
  return fmt::format(
      "{:.3g} % of its {:.4g} m exceeds its shear strength, {:.3g} % its tensile "
      "strength",
      100.0 * part(joint.over, joint), joint.length, 100.0 * part(joint.torn, joint));
}

std::string weight_line(const Simulation& sim) {
  const InitialStress& s = *sim.scene->model.initial_stress;
  if (!s.stress) {
    return fmt::format("weight of the rock above, k0 = {:.4g}, out of the plane {:.4g}", *s.k0,
                       *s.k0_out);
  }
  const double syy = (*s.gradient)[1];
  std::string line = fmt::format("syy increases by {:.5g} Pa per metre upwards", syy);
  if (sim.accounts.initial->material == none) return line;
  const Material& m =
      sim.scene->model.materials[static_cast<std::size_t>(sim.accounts.initial->material)];
  return line + fmt::format("; density times gravity of {} is {:.5g}: a difference of {:.2g} %",
                            m.name, -m.density * sim.scene->model.gravity.y,
                            100.0 * sim.accounts.initial->gradient);
}

}  // namespace

void judge_initial_stress(Simulation& sim) {
  if (!sim.accounts.initial) return;
  judge_gradient(sim, *sim.accounts.initial);
  judge_balance(sim, *sim.accounts.initial);
}

std::vector<std::string> initial_stress_report(const Simulation& sim) {
  if (!sim.accounts.initial) return {};
  std::vector<std::string> lines{weight_line(sim)};
  for (const auto& [name, joint] : joints_of(sim)) {
    lines.push_back(
        fmt::format("joint {}: largest tau/sigma_n {:.3g}; highest shear mobilisation {:.3g} %; {}",
                    name, joint.ratio, 100.0 * joint.mobilised, exceeded(joint)));
  }
  lines.push_back(fmt::format(
      "the mean unbalanced force is {0:.2g} of the mean contact force, the largest {2:.2g} at {1}; "
      "within the ground, away from free faces, it is {3:.2g}",
      sim.accounts.initial->unbalanced,
      sim.accounts.initial->block == no_id
          ? "no block"
          : block_label(sim.scene->blocks, sim.accounts.initial->block),
      sim.accounts.initial->largest, sim.accounts.initial->within));
  return lines;
}

void warn_of_initial_stress(const Simulation& sim, std::vector<std::string>& warnings) {
  if (!sim.accounts.initial) return;
  const InitialBalance& balance = *sim.accounts.initial;
  if (balance.gradient > most_off) {
    const Vec2 g = sim.scene->model.gravity;
    const double density =
        sim.scene->model.materials[static_cast<std::size_t>(balance.material)].density;
    warnings.push_back(
        fmt::format("initial_stress: its gradient and the weight of {} differ by {:.2g} %, so that "
                    "the model is not in equilibrium: give syy a gradient of {:.6g} and sxy one of "
                    "{:.6g}, or change the density or gravity",
                    sim.scene->model.materials[static_cast<std::size_t>(balance.material)].name,
                    100.0 * balance.gradient, -density * g.y + 0.0, -density * g.x + 0.0));
  }
  for (const auto& [name, joint] : joints_of(sim)) {
    if (joint.over > 0.0) {
      warnings.push_back(fmt::format(
          "initial_stress: the shear stress exceeds the strength of joint {} on {:.3g} % of its "
          "{:.4g} m (up to {:.3g} times, tau/sigma_n {:.3g}) and was reduced to it: give a stress "
          "within the strength of the joints, stronger joints, or a stage until equilibrium, which "
          "redistributes it",
          name, 100.0 * part(joint.over, joint), joint.length, joint.mobilised, joint.ratio));
    }
    if (joint.torn > 0.0) {
      warnings.push_back(fmt::format(
          "initial_stress: joint {} is in more tension than its strength on {:.3g} % of its {:.4g} "
          "m, which start open: give a stress that compresses it, or a tensile_strength",
          name, 100.0 * part(joint.torn, joint), joint.length));
    }
  }
  if (balance.top > most_off) {
    warnings.push_back(fmt::format(
        "initial_stress: the top of the model is free, and the ground has {:.2g} of its mean "
        "stress there, which nothing carries: give a [[boundary]] of sides = [\"top\"] and type = "
        "\"stress\", or a surface of the ground (surface_y, at_y) at the top of the model",
        balance.top));
  }
  const bool settles = stages_of(sim.scene->model).front().to_equilibrium();
  if (balance.unbalanced > most_unbalanced && (!settles || balance.within > most_unbalanced)) {
    warnings.push_back(fmt::format(
        "initial_stress: forces are unbalanced at the start by {:.2g} of the mean contact force "
        "({:.2g} within the ground), most on {} at {}: the rock moves there until it is in "
        "equilibrium; behind free faces (a slope, an opening) this is to be expected, within the "
        "ground it comes from a stress that does not balance the weight, or from joints that "
        "cannot "
        "carry it; begin with a stage until equilibrium",
        balance.unbalanced, balance.within, block_label(sim.scene->blocks, balance.block),
        place_label(centroid(sim.motion.state.position, balance.block) +
                    sim.scene->blocks.origin)));
  }
}

void add_initial_checks(const Simulation& sim, std::vector<Check>& checks) {
  if (!sim.accounts.initial) return;
  const InitialBalance& balance = *sim.accounts.initial;
  const auto add = [&](std::string name, double value, double limit) {
    checks.push_back({std::move(name), value, limit, value <= limit});
  };
  if (sim.scene->model.initial_stress->stress) {
    add("initial stress: gradient against density times gravity", balance.gradient, most_off);
  }
  // Behind free faces forces are unbalanced by what these have lost, which is no mistake.
  checks.push_back(
      {"initial stress: unbalanced forces at the start", balance.unbalanced, {}, true});
  add("initial stress: unbalanced forces within the ground", balance.within, most_unbalanced);
  add("initial stress: stress that is missing at the free top", balance.top, most_off);
  for (const auto& [name, joint] : joints_of(sim)) {
    constexpr double most = 1e9;  // stands for infinity, where a joint has no strength
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
