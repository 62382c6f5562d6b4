#include "observe/unused_names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "model/files/accelerogram.hpp"
#include "model/stage_names.hpp"
#include "observe/resting.hpp"
#include "step/labels.hpp"

namespace edda {
namespace {

std::vector<bool> used_joints(const Simulation& sim) {
  const Model& model = sim.scene->model;
  std::vector<bool> used(model.joints.size(), false);
  const auto use = [&](Index law) {
    if (law != none) used[static_cast<std::size_t>(law)] = true;
  };
  bool unnamed = false;
  for (const Index law : sim.scene->blocks.edge_joint) {
    unnamed = unnamed || law == none;
    use(law);
  }
  if (unnamed) use(model.contact.joint);
  for (const ContactPair& pair : model.pairs) use(pair.joint);
  for (const Stage& stage : model.stages) {
    for (const PropertyChange& change : stage.change) {
      if (change.joints != none) use(change.row);
    }
  }
  return used;
}

std::vector<bool> used_materials(const Simulation& sim) {
  std::vector<bool> used(sim.scene->model.materials.size(), false);
  for (const Index m : sim.scene->blocks.material) {
    if (m != none) used[static_cast<std::size_t>(m)] = true;
  }
  for (const Stage& stage : sim.scene->model.stages) {
    for (const PropertyChange& change : stage.change) {
      if (change.material != none) used[static_cast<std::size_t>(change.row)] = true;
    }
  }
  return used;
}

template <class Item>
void warn_of_idle(const std::vector<Item>& items, const std::vector<bool>& used, const char* what,
                  const char* who, std::vector<std::string>& warnings) {
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (used[i] || items[i].where.line == 0) continue;  // line 0: built in, not from the model file
    warnings.push_back(
        fmt::format("{}: {} \"{}\" is not used: {}; name it where it belongs, or leave it out",
                    items[i].where.key, what, items[i].name, who));
  }
}

/// Bolts hold nothing where their bars begin and end in one block that is not meshed.
void warn_of_bolts_in_one_block(const Simulation& sim, std::vector<std::string>& warnings) {
  const Scene& scene = *sim.scene;
  if (!has_bolts(scene.model)) return;
  const std::vector<Bolt> all = all_bolts(scene.model);
  std::vector<Index> rows(all.size());
  std::iota(rows.begin(), rows.end(), Index{0});
  const Result<Bolts> placed = attach_bolts(scene.model, scene.blocks, sim.motion.state,
                                            sim.motion.pose.x, sim.motion.pose.y, rows, 0.0);
  if (!placed.ok()) return;
  const Bolts& b = placed.value();
  std::vector<std::string> idle;
  for (std::size_t q = 0; q < b.rows.size(); ++q) {
    const auto first = b.host.begin() + b.begin[q], last = b.host.begin() + b.begin[q + 1];
    if (std::all_of(first, last, [&](Id host) { return host == *first; }) &&
        !scene.blocks.is_meshed(*first)) {
      idle.push_back(b.rows[q].name);
    }
  }
  if (idle.empty()) return;
  warnings.push_back(fmt::format("{} a single block and {} no joint: {}; {} nothing there",
                                 idle.size() == 1 ? "a bolt lies within" : "bolts lie within",
                                 idle.size() == 1 ? "crosses" : "cross", fmt::join(idle, ", "),
                                 idle.size() == 1 ? "it holds" : "they hold"));
}

/// Joints that lose strength with time in a model in which none passes for them.
void warn_of_no_time(const Model& model, std::vector<std::string>& warnings) {
  for (const Stage& stage : stages_of(model)) {
    if (stage.ramp && stage.ramp->varied == Varied::time) return;
    if (!stage.to_equilibrium() && stage.duration > 0.0) return;
  }
  for (const JointLaw& law : model.given_joints()) {
    if (!law.decay_time) continue;
    warnings.push_back(fmt::format(
        "{}.decay_time has no effect: no time passes for joints in stages until equilibrium; give "
        "a stage ramp = {{ time = [\"0 d\", \"100 d\"] }}, or a duration with until = \"time\"",
        law.where.key));
  }
}

/// Water whose table lies below all faces of free blocks, as these are drawn, and never rises.
void warn_of_dry_waters(const Simulation& sim, std::vector<std::string>& warnings) {
  const Model& model = sim.scene->model;
  const BlockSet& b = sim.scene->blocks;
  std::vector<bool> wets(model.waters.size(), false);
  for (const WetEdge& e : sim.attached.loads.wet) {
    const double y = b.vertex(e.edge).y, rise = b.vertex(b.next[e.edge]).y - y;
    const bool under = y + e.from * rise < e.level_from || y + e.to * rise < e.level_to;
    const auto row = static_cast<std::size_t>(e.water);
    if (under && row < wets.size()) wets[row] = true;
  }
  for (const WetZone& z : sim.attached.loads.wet_zones) {
    const double y = b.centroid_y[z.block] + centre_of_zone(b.meshes, z.zone).y;
    if (y < z.level) wets[z.water] = true;
  }
  for (std::size_t q = 0; q < wets.size(); ++q) {
    const Water& water = model.waters[q];
    const bool in_rock = !water.sides.empty() || !water.along.empty();
    if (wets[q] || in_rock || water.rain || water.injection || !water.history.empty()) continue;
    warnings.push_back(fmt::format(
        "{}: the table lies below all faces of free blocks: it has no effect; check its level",
        water.where.key));
  }
}

/// Waters whose lines in the rock meet no joint that conducts, and flow without any joint.
void warn_of_idle_flow(const Simulation& sim, std::vector<std::string>& warnings) {
  const Model& model = sim.scene->model;
  const JointWater& joints = sim.attached.joint_water;
  if (!model.flow) return;
  if (joints.rows.empty()) {
    warnings.push_back("flow: no joint conducts water at the start; check the apertures");
    return;
  }
  const BlockSet& b = sim.scene->blocks;
  for (std::size_t q = 0; q < model.waters.size(); ++q) {
    const Water& water = model.waters[q];
    if (const Id corner = joints.injected[q]; corner != no_id) {
      const Vec2 into = b.vertex(corner) + b.origin;
      const double far = norm(into - *water.at);
      if (far > 2.0 * b.radius[b.vertex_block[corner]])
        warnings.push_back(fmt::format(
            "{}.at: the water goes into the joints {:.3g} m from there, at {}, the "
            "nearest crossing inside the rock: give a point near joints that conduct water",
            water.where.key, far, place_label(into)));
    }
    const bool in_rock = !water.sides.empty() || !water.along.empty();
    if (!in_rock || joints.heads[q] > 0 || !sim.attached.loads.intervals.waters[q].acts()) continue;
    warnings.push_back(fmt::format(
        "{}: its line in the rock meets no joint that conducts water: it has no effect there",
        water.where.key));
  }
}

/// A symmetric matrix: the force of what moves with the ground per displacement, or velocity.
struct Grip {
  double xx = 0.0, yy = 0.0, xy = 0.0;
  /// Adds another in proportion to its largest entry: springs and dashpots have different units.
  void add(double axx, double ayy, double axy) {
    const double size = axx + ayy;
    if (size > 0.0) xx += axx / size, yy += ayy / size, xy += axy / size;
  }
  Vec2 of(Vec2 a) const { return {xx * a.x + xy * a.y, xy * a.x + yy * a.y}; }
  bool holds(Vec2 direction) const { return norm(of(direction)) > 1e-6 * std::max(xx + yy, 1.0); }
};

/// How fixed blocks and boundaries that act together with a ground motion take blocks along.
Grip grip_of(const Simulation& sim, const std::vector<bool>& shaken) {
  const Scene& scene = *sim.scene;
  std::vector<std::uint8_t> together;
  for (const Boundary& boundary : scene.model.boundaries) {
    const std::vector<bool> in = acts_in_stages(scene.model, boundary.name);
    bool any = false;
    for (std::size_t q = 0; q < in.size(); ++q) any = any || (in[q] && shaken[q]);
    together.push_back(any);
  }
  Grip grip;
  if (!sim.attached.ground.fixed_blocks.empty()) grip.add(1.0, 1.0, 0.0);
  const BoundarySprings& s = sim.attached.springs;
  for (std::size_t q = 0; q < s.size(); ++q) {
    const auto& [kxx, kyy, kxy] = s.acting_k[q];
    if (together[static_cast<std::size_t>(s.boundary[q])]) grip.add(kxx, kyy, kxy);
  }
  for (const Dashpot& p : sim.attached.dashpots.points) {
    if (together[static_cast<std::size_t>(p.boundary)]) grip.add(p.cxx, p.cyy, p.cxy);
  }
  return grip;
}

/// Ground motions of fixed blocks and boundaries that no block feels, or not the whole of them.
void warn_of_idle_shakings(const Simulation& sim, std::vector<std::string>& warnings) {
  const Model& model = sim.scene->model;
  for (const Shaking& shaking : model.shakings) {
    if (shaking.apply != ShakingKind::base || shaking.scale == 0.0) continue;
    std::vector<Vec2> motion = shaking.record.acceleration;
    if (shaking.acceleration.file.empty()) motion = {shaking.acceleration.direction};
    const Grip grip = grip_of(sim, acts_in_stages(model, shaking.name));
    Vec2 lost;
    bool any = false;
    for (const Vec2 a : motion) {
      if (a == Vec2{}) continue;
      any = any || grip.holds(unit(a));
      for (const Vec2 part : {Vec2{a.x, 0.0}, Vec2{0.0, a.y}}) {
        if (norm(part) > 1e-6 * norm(a) && !grip.holds(unit(part)) && norm(part) > norm(lost))
          lost = part;
      }
    }
    if (lost == Vec2{}) continue;
    warnings.push_back(fmt::format(
        "{}: the ground motion{} reaches no block: there is no fixed block, and no boundary that "
        "moves blocks {} (a roller moves them across its line only, and a stress not at all): give "
        "a [[boundary]] of type = \"fixed\", fixed = true of the blocks that it moves, or apply = "
        "\"inertia\"",
        shaking.where.key, any ? lost.x != 0.0 ? " along x" : " along y" : "",
        lost.x != 0.0 ? "along x" : "along y"));
  }
}

/// Per boundary, whether its springs carry force along gravity.
std::vector<bool> carries_weight(const Simulation& sim) {
  const Model& model = sim.scene->model;
  const Vec2 down = unit(model.gravity);
  std::vector<bool> carries(model.boundaries.size(), false);
  const BoundarySprings& s = sim.attached.springs;
  for (std::size_t q = 0; q < s.size(); ++q) {
    const auto& [kxx, kyy, kxy] = s.acting_k[q];
    if (carries_along(kxx, kyy, kxy, down)) carries[static_cast<std::size_t>(s.boundary[q])] = true;
  }
  return carries;
}

/// Stages after the first that leave the weight of the model to dashpots which have not taken it
/// over from a boundary that they replace. (resting.hpp looks at the start.)
void warn_of_lost_support(const Simulation& sim, std::vector<std::string>& warnings) {
  const Model& model = sim.scene->model;
  if (model.gravity == Vec2{} || model.initial_stress || !sim.attached.ground.fixed_blocks.empty())
    return;
  const std::vector<bool> carries = carries_weight(sim);
  std::vector<bool> inherits(model.boundaries.size(), false);
  for (std::size_t stage = 1; stage < model.stages.size(); ++stage) {
    const Stage& now = model.stages[stage];
    const bool replaces = !rows_called(model, now.deactivate).boundaries.empty();
    for (const Index q : rows_called(model, now.activate).boundaries)
      inherits[static_cast<std::size_t>(q)] = replaces;
    bool dashpots = false, carried = false;
    for (std::size_t q = 0; q < model.boundaries.size(); ++q) {
      if (!acts_in_stages(model, model.boundaries[q].name)[stage]) continue;
      dashpots = dashpots || has_dashpots(model.boundaries[q].type);
      carried = carried || carries[q] || inherits[q];
    }
    if (carried || !dashpots) continue;
    warnings.push_back(fmt::format(
        "in {} nothing but a viscous boundary supports the model, whose dashpots carry no static "
        "load: under gravity it sinks without end; activate the viscous boundary in the stage that "
        "deactivates its support, so that it takes over the forces",
        stage_label(model, stage)));
    return;
  }
}

}  // namespace

std::vector<std::string> unused_names(const Simulation& sim) {
  std::vector<std::string> warnings;
  warn_of_idle(sim.scene->model.joints, used_joints(sim), "joint",
               "no edge of a block has it, and no contact_pair gives it", warnings);
  warn_of_idle(sim.scene->model.materials, used_materials(sim), "material",
               "no block is made of it", warnings);
  warn_of_bolts_in_one_block(sim, warnings);
  warn_of_no_time(sim.scene->model, warnings);
  warn_of_dry_waters(sim, warnings);
  warn_of_idle_flow(sim, warnings);
  warn_of_idle_shakings(sim, warnings);
  warn_of_lost_support(sim, warnings);
  return warnings;
}

}  // namespace edda
