// Queries of a Simulation.
#include <algorithm>
#include <type_traits>

#include "blocks/kinematics.hpp"
#include "blocks/locate.hpp"
#include "blocks/pose.hpp"
#include "library/impl.hpp"
#include "step/energy_balance.hpp"
#include "step/labels.hpp"

namespace edda::api {
namespace {

static_assert(std::is_same_v<Index, std::int32_t> && std::is_same_v<Id, std::uint32_t>,
              "BlockViews shows the arrays as they are");
static_assert(std::tuple_size_v<Nodes> == nodes_per_block, "Nodes shows the arrays as they are");

template <class Views, class Values>
Views views_of(Values& n) {
  Views views;
  std::copy(n.begin(), n.end(), views.begin());
  return views;
}

void check_size(const char* function, std::size_t given, std::size_t needed) {
  if (given == needed) return;
  raise(function, "room for " + std::to_string(given) + " numbers",
        "give room for " + std::to_string(needed));
}

void put(Field field, const BlockRecord& r, double* out) {
  const auto set = [&](std::initializer_list<double> values) {
    std::copy(values.begin(), values.end(), out);
  };
  switch (field) {
    case Field::centroid:
      return set({r.position.x, r.position.y});
    case Field::displacement:
      return set({r.displacement.x, r.displacement.y});
    case Field::rotation:
      return set({r.rotation});
    case Field::velocity:
      return set({r.velocity.x, r.velocity.y});
    case Field::omega:
      return set({r.omega});
    case Field::stress:
      return set({r.sxx, r.syy, r.szz, r.sxy});
    case Field::overstress:
      return set({r.overstress});
  }
}

/// The blocks as drawn, for block_at().
PolygonSet drawn_polygons(const BlockSet& b) {
  PolygonSet polygons;
  polygons.origin = b.origin;
  polygons.blocks.resize(b.size());
  for (std::size_t i = 0; i < b.size(); ++i) {
    std::vector<Ring>& rings = polygons.blocks[i].rings;
    bool new_ring = true;
    for (Id v = b.vertex_begin[i]; v < b.vertex_begin[i + 1]; ++v) {
      if (new_ring) rings.emplace_back();
      rings.back().push_back(b.vertex(v));
      new_ring = b.next[v] <= v;
    }
  }
  return polygons;
}

bool fits_a_column(const std::string& name) {
  return !name.empty() && name.find_first_of(",\"\r\n") == std::string::npos;
}

}  // namespace

std::size_t components_of(Field field) {
  switch (field) {
    case Field::centroid:
    case Field::displacement:
    case Field::velocity:
      return 2;
    case Field::stress:
      return 4;
    case Field::rotation:
    case Field::omega:
    case Field::overstress:
      return 1;
  }
  raise("field", "is none that blocks have", "give a value of Field");
}

const Model& Simulation::model() const {
  return impl_->model;
}

double Simulation::time() const {
  return impl_->sim().motion.state.time;
}

std::uint64_t Simulation::steps() const {
  return impl_->sim().motion.state.steps;
}

double Simulation::time_step() const {
  return impl_->sim().motion.state.step;
}

double Simulation::critical_step() const {
  return impl_->sim().control.bound.critical_step;
}

std::string Simulation::governed_by() const {
  return impl_->prepared.governed_by;
}

std::vector<std::string> Simulation::warnings() const {
  return impl_->prepared.warnings;
}

std::size_t Simulation::stage() const {
  return 1 + (impl_->driver ? impl_->driver->stage_row() : impl_->last_stage);
}

Ledger Simulation::ledger() const {
  impl_->look();
  const edda::Simulation& sim = impl_->sim();
  const edda::EnergyBalance l = energy_balance(sim);
  const double start = sim.accounts.start_energy.value_or(l.balance());
  const double drift = (l.balance() - start) / energy_scale(sim, l);
  return {l.kinetic,  l.strain,   l.contact,     l.gravity, l.friction, l.damping,
          l.fracture, l.external, l.step_change, drift,     l.transfer};
}

double Simulation::unbalanced() const {
  return unbalanced_ratio(impl_->sim(), impl_->look());
}

std::size_t Simulation::block_count() const {
  return impl_->sim().scene->blocks.size();
}

std::size_t Simulation::vertex_count() const {
  return impl_->sim().scene->blocks.vertex_count();
}

BlockViews Simulation::blocks() const {
  const BlockSet& b = impl_->sim().scene->blocks;
  return {b.area, b.mass, b.material, b.fixed, b.vertex_begin, b.next};
}

std::span<const std::uint8_t> Simulation::alive() const {
  return impl_->sim().motion.state.alive;
}

Point Simulation::origin() const {
  return {impl_->sim().scene->blocks.origin.x, impl_->sim().scene->blocks.origin.y};
}

Nodes Simulation::node_x() const {
  return views_of<Nodes>(impl_->sim().motion.state.position.x);
}

Nodes Simulation::node_y() const {
  return views_of<Nodes>(impl_->sim().motion.state.position.y);
}

MutableNodes Simulation::node_vx() {
  impl_->lend_velocities();
  return views_of<MutableNodes>(impl_->sim().motion.state.velocity.x);
}

MutableNodes Simulation::node_vy() {
  impl_->lend_velocities();
  return views_of<MutableNodes>(impl_->sim().motion.state.velocity.y);
}

std::string Simulation::name(std::size_t block) const {
  if (block >= block_count()) {
    raise("name", "there is no block " + std::to_string(block),
          "give a number below " + std::to_string(block_count()));
  }
  return std::string(impl_->sim().scene->blocks.name(block));
}

std::optional<std::size_t> Simulation::block_called(std::string_view name) const {
  for (const auto& [id, called] : impl_->sim().scene->blocks.names) {
    if (called == name) return id;
  }
  return {};
}

void Simulation::field(Field field, std::span<double> out) const {
  const std::size_t width = components_of(field), nb = block_count();
  check_size("field", out.size(), nb * width);
  const State& state = impl_->look().state;
  for (std::size_t i = 0; i < nb; ++i) {
    put(field, block_record(impl_->sim(), state, i), out.data() + i * width);
  }
}

std::vector<double> Simulation::field(Field field) const {
  std::vector<double> values(block_count() * components_of(field));
  this->field(field, values);
  return values;
}

void Simulation::vertices(std::span<double> out) const {
  const BlockSet& b = impl_->sim().scene->blocks;
  const State& s = impl_->sim().motion.state;
  check_size("vertices", out.size(), 2 * b.vertex_count());
  for (std::size_t v = 0; v < b.vertex_count(); ++v) {
    const Vec2 p = corner_at(b, s.position, v) + b.origin;
    out[2 * v] = p.x;
    out[2 * v + 1] = p.y;
  }
}

std::vector<Contact> Simulation::contacts() const {
  const edda::Simulation& sim = impl_->sim();
  const Picture picture = picture_of(sim, impl_->look());
  const std::vector<JointLaw>& joints = sim.scene->model.joints;
  const auto row_of = [&](std::string_view name) {
    const auto found = std::find_if(joints.begin(), joints.end(),
                                    [&](const JointLaw& law) { return law.name == name; });
    return found == joints.end() ? -1 : static_cast<std::int32_t>(found - joints.begin());
  };
  std::vector<Contact> contacts;
  contacts.reserve(picture.contacts.size());
  for (const ContactRecord& r : picture.contacts) {
    contacts.push_back({static_cast<std::int32_t>(r.block_i),
                        static_cast<std::int32_t>(r.block_j),
                        row_of(r.joint),
                        static_cast<ContactState>(r.state),
                        r.position.x,
                        r.position.y,
                        r.normal_force,
                        r.shear_force,
                        r.opening,
                        r.slip,
                        r.mobilised,
                        r.ever_slipped,
                        r.ever_opened,
                        r.length,
                        r.closed_length,
                        r.a.x,
                        r.a.y,
                        r.b.x,
                        r.b.y,
                        r.normal_stress,
                        r.normal_stress_a,
                        r.normal_stress_b,
                        r.shear_stress});
  }
  return contacts;
}

void Simulation::add_monitor(const std::string& name, Point point) {
  edda::Simulation& sim = impl_->sim();
  if (impl_->begun && !impl_->options.results.empty()) {
    raise("add_monitor", "the run has begun, and history.csv with it",
          "add monitors before the first step");
  }
  if (!fits_a_column(name)) {
    raise("add_monitor", '"' + name + "\" cannot head a column", "give a name without , and \"");
  }
  const std::vector<std::string> known = monitors();
  if (std::find(known.begin(), known.end(), name) != known.end()) {
    raise("add_monitor", "there is a monitor \"" + name + "\" already", "give another name");
  }
  const Vec2 p = Vec2{point.x, point.y} - sim.scene->blocks.origin;
  const auto block =
      block_at(sim.scene->model, drawn_polygons(sim.scene->blocks), sim.scene->blocks, p);
  if (!block) {
    raise("add_monitor", place_label({point.x, point.y}) + " lies in no block",
          "move it into one (edda cut draws them)");
  }
  sim.scene.edit().model.monitors.push_back({name, {point.x, point.y}, {}});
  impl_->prepared.gauges.monitors.push_back(point_of_block(name, sim.scene->blocks, *block, p));
}

std::vector<std::string> Simulation::monitors() const {
  std::vector<std::string> names;
  for (const MonitorPoint& m : impl_->prepared.gauges.monitors) names.push_back(m.name);
  return names;
}

MonitorReading Simulation::read(const std::string& monitor) const {
  for (const MonitorPoint& m : impl_->prepared.gauges.monitors) {
    if (m.name != monitor) continue;
    const edda::MonitorReading r = read_monitor(impl_->sim(), impl_->look(), m);
    return {r.displacement.x, r.displacement.y, r.velocity.x, r.velocity.y,
            r.stress.xx,      r.stress.yy,      r.stress.xy};
  }
  raise("read", "there is no monitor \"" + monitor + '"', "add_monitor() it, or see monitors()");
}

}  // namespace edda::api
