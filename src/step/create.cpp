#include <algorithm>
#include <limits>

#include "base/polygon.hpp"
#include "blocks/build_blocks.hpp"
#include "blocks/initial_stress.hpp"
#include "contacts/face_bonds.hpp"
#include "contacts/find_faces.hpp"
#include "contacts/strength.hpp"
#include "cutting/build_polygons.hpp"
#include "cutting/cut_domain.hpp"
#include "cutting/fills.hpp"
#include "cutting/linings.hpp"
#include "cutting/t_nodes.hpp"
#include "cutting/zone_size.hpp"
#include "step/changes.hpp"
#include "step/contact_search.hpp"
#include "step/restitution.hpp"
#include "step/simulation.hpp"

namespace edda {
namespace {

double median_edge(const BlockSet& b) {
  std::vector<double> edges;
  for (std::size_t i = 0; i < b.size(); ++i) {
    if (!b.fixed[i]) edges.push_back(b.smallest_edge[i]);
  }
  if (edges.empty()) edges = b.smallest_edge;
  const auto middle = edges.begin() + static_cast<std::ptrdiff_t>(edges.size() / 2);
  std::nth_element(edges.begin(), middle, edges.end());
  return *middle;
}

/// The displacement limit (theory, section 7.3): a part of the model's half-width where it is
/// narrowest (of a slope, its half-height), in whatever direction; at most a tenth of the smallest
/// edge.
double largest_displacement(const BlockSet& b, double ratio) {
  std::vector<Vec2> points;
  points.reserve(b.vertex_count());
  for (std::size_t v = 0; v < b.vertex_count(); ++v) points.push_back(b.vertex(v));
  const double edge = *std::min_element(b.smallest_edge.begin(), b.smallest_edge.end());
  return std::min(ratio * 0.5 * least_width(points), 0.1 * edge);
}

/// How far from an edge a corner of a neighbour may lie to be on it, m: by what the cut moves
/// lines, and by rounding.
double t_node_tolerance(const Model& model, const PolygonSet& polygons) {
  constexpr double rounding = 1e-7;  // of the size of a block
  double area = 0.0;
  for (const BlockPolygon& block : polygons.blocks) area += moments(block.rings).area;
  const double size = std::sqrt(area / static_cast<double>(polygons.blocks.size()));
  return std::max(model.domain ? snap_of(model) : 0.0, rounding * size);
}

/// T-nodes, then the corners of zones on the edges of meshed blocks.
void divide_edges(const Model& model, PolygonSet& polygons) {
  add_t_nodes(polygons, t_node_tolerance(model, polygons), [&](std::size_t i) {
    const BlockPolygon& block = polygons.blocks[i];
    if (may_be_meshed(model, block)) return TNodes{no_id, false};
    return may_bend(model, block) ? TNodes{most_corners_that_bend, true} : TNodes{};
  });
  const ZoneSizes sizes(model, polygons);
  for (BlockPolygon& block : polygons.blocks) {
    if (!may_be_meshed(model, block)) continue;
    const MeshSize size = sizes.of(block);
    divide_edges(block, [&](Vec2 from, Vec2 to) { return divisions(from, to, size); });
  }
}

Result<Scene> build_scene(Model given, BlockOrder order, const Stepper& stepper) {
  Scene scene;
  scene.model = std::move(given);
  Result<PolygonSet> cut = build_polygons(scene.model);
  if (!cut.ok()) return cut.faults();
  scene.polygons = std::move(cut.value());
  const Solver& solver = scene.model.solver;
  if (Faults faults = add_fills(scene.model, scene.polygons); !faults.empty()) return faults;
  divide_edges(scene.model, scene.polygons);
  if (Faults faults = add_linings(scene.model, scene.polygons); !faults.empty()) return faults;
  if (Faults faults = misplaced_fills(scene.model, scene.polygons); !faults.empty()) return faults;
  if (order == BlockOrder::reversed) {
    std::reverse(scene.polygons.blocks.begin(), scene.polygons.blocks.end());
    scene.polygons.reversed = true;
  }
  BlockSet& blocks = scene.blocks;
  blocks = build_blocks(scene.model, scene.polygons);
  if (std::vector<Fault> faults = fit_restitution(scene.model, blocks); !faults.empty()) {
    return faults;
  }
  if (scene.model.initial_stress) {
    set_initial_stress(blocks, scene.model, StressField(scene.model, blocks.origin));
  }
  scene.displacement_limit = largest_displacement(blocks, solver.max_displacement_ratio);
  scene.zones = make_zones(scene.model, blocks);
  scene.base_reach =
      std::max(0.04 * median_edge(blocks), stepper.least_reach * scene.displacement_limit);
  scene.smallest_half_width = *std::min_element(blocks.inradius.begin(), blocks.inradius.end());
  return scene;
}

/// Attaches everything but bolts and free-field columns, which need the positions of the blocks and
/// the step.
std::vector<Fault> attach(const Scene& scene, Attached& attached) {
  const Model& model = scene.model;
  const BlockSet& blocks = scene.blocks;
  Result<BoundarySprings> springs = attach_boundaries(model, blocks);
  if (!springs.ok()) return springs.faults();
  attached.springs = std::move(springs.value());
  Result<Loads> loads = attach_loads(model, scene.polygons, blocks);
  if (!loads.ok()) return loads.faults();
  attached.loads = std::move(loads.value());
  Result<Dashpots> dashpots = attach_dashpots(model, blocks);
  if (!dashpots.ok()) return dashpots.faults();
  attached.dashpots = std::move(dashpots.value());
  const std::vector<ActiveInterval>& acting = attached.loads.intervals.boundaries;
  for (std::size_t q = 0; q < model.boundaries.size(); ++q) {
    if (!acting[q].acts()) attached.springs.release(static_cast<Index>(q));
  }
  attached.dashpots.set_acting(acting);
  attached.ground = find_ground(model, blocks);
  if (model.flow) begin_flow(model, blocks, attached);
  return {};
}

/// The laws with the strength of the first stage, which applies to the state at the start.
LawTable first_laws(const Model& model) {
  const double factor = model.stages.empty() ? 1.0 : model.stages.front().strength_factor;
  return divided_laws(model, std::vector<double>(build_laws(model).rows.size(), factor));
}

/// Places the blocks where they were cut, at rest unless the model gives velocities.
void place_blocks(Simulation& sim) {
  const BlockSet& blocks = sim.scene->blocks;
  Motion& motion = sim.motion;
  const std::size_t nb = blocks.size(), nv = blocks.vertex_count();
  motion.state = initial_state(blocks, sim.scene->polygons);
  motion.forces = motion.on_contacts = zero_vectors(blocks);
  motion.zones = zones_at_start(sim.scene->zones, sim.scene->model, blocks, motion.state,
                                water_in_pores(sim), motion.laws.rock_divided_by());
  motion.on_dashpots.assign(sim.attached.dashpots.points.size(), Vec2{});
  sim.accounts.damping_work.joules.assign(nb, 0.0);
  Pose& pose = motion.pose;
  pose.x.resize(nv);
  pose.y.resize(nv);
  place_all(sim);
  pose.x2 = pose.x1 = pose.x;
  pose.y2 = pose.y1 = pose.y;
  // Those that a stage installs or places are not there yet.
  for (std::size_t i = 0; i < nb; ++i) {
    if (blocks.is_fill(i)) motion.state.alive[i] = 0;
    if (!blocks.is_lining(i)) continue;
    const std::string& name =
        sim.scene->model.linings[static_cast<std::size_t>(blocks.lining[i])].name;
    motion.state.alive[i] = name.empty() || installed_at_first(sim.scene->model, name) ? 1 : 0;
  }
}

const Stepper& stepper_of(const Model& model) {
  if (model.solver.method == Method::dda) return newmark_stepper;
  return model.contact.model == ContactModel::points ? paper_stepper : leapfrog_stepper;
}

}  // namespace

Result<Simulation> Simulation::create(Model given, BlockOrder order) {
  Simulation sim;
  sim.stepper = &stepper_of(given);
  Result<Scene> scene = build_scene(std::move(given), order, *sim.stepper);
  if (!scene.ok()) return scene.faults();
  sim.scene = CopyOnWrite<Scene>(std::move(scene.value()));
  if (std::vector<Fault> faults = attach(*sim.scene, sim.attached); !faults.empty()) return faults;
  const Model& model = sim.scene->model;
  const BlockSet& blocks = sim.scene->blocks;
  Motion& motion = sim.motion;
  motion.damping = model.solver.damping;
  motion.dynamic = model.solver.dynamic;
  motion.laws = first_laws(model);
  motion.masses = given_masses(blocks);
  set_viscosity(sim);
  place_blocks(sim);
  Result<Bolts> bolts = attach_bolts(model, blocks, motion.state, motion.pose.x, motion.pose.y);
  if (!bolts.ok()) return bolts.faults();
  sim.attached.bolts = std::move(bolts.value());
  sim.control.limit = std::numeric_limits<double>::infinity();
  search(sim, next_reach(sim));
  start_flow(sim);
  if (model.initial_stress) load_boundaries_with_initial_stress(sim);
  sim.stepper->begin_contacts(sim);
  plan_slivers(sim);
  set_limit(sim);
  sim.attached.free_field =
      attach_free_field(model, blocks, sim.attached.dashpots, sim.control.limit);
  return sim;
}

}  // namespace edda
