#include "results/frames.hpp"

#include <fmt/format.h>

#include <cmath>

namespace edda {
namespace {

void add_cells(const BlockSet& b, Id block, BlockCells& cells) {
  const auto close = [&] { cells.end.push_back(static_cast<Id>(cells.corner.size())); };
  const auto triangles = b.triangles.find(block);
  if (triangles == b.triangles.end()) {
    for (Id v = b.vertex_begin[block]; v < b.vertex_begin[block + 1]; ++v)
      cells.corner.push_back(v);
    close();
    return;
  }
  for (const std::array<Id, 3>& triangle : triangles->second) {
    cells.corner.insert(cells.corner.end(), triangle.begin(), triangle.end());
    close();
  }
}

Field field_of(const char* name, std::size_t components, std::size_t count) {
  Field f{name, components, {}, {}, false};
  f.values.reserve(components * count);
  return f;
}

Field numbers(const char* name, std::size_t count) {
  Field f = field_of(name, 1, count);
  f.whole = true;
  return f;
}

void push(Field& f, std::initializer_list<double> values) {
  f.values.insert(f.values.end(), values);
}

/// Without a copy.
template <class... Fields>
void take(std::vector<Field>& into, Fields&... fields) {
  (into.push_back(std::move(fields)), ...);
}

void push_principal(Field& f, const BlockRecord& b) {
  const double mean = 0.5 * (b.sxx + b.syy);
  const double radius = std::hypot(0.5 * (b.sxx - b.syy), b.sxy);
  push(f, {mean + radius, mean - radius, b.szz});
}

Field point_vectors(const char* name, const std::vector<double>& x, const std::vector<double>& y) {
  Field f = field_of(name, 3, x.size());
  for (std::size_t v = 0; v < x.size(); ++v) push(f, {x[v], y[v], 0.0});
  return f;
}

}  // namespace

BlockCells block_cells(const BlockSet& blocks) {
  BlockCells cells;
  cells.begin.reserve(blocks.size() + 1);
  cells.end.reserve(blocks.size());
  cells.corner.reserve(blocks.vertex_count());
  cells.begin.push_back(0);
  for (Id i = 0; i < blocks.size(); ++i) {
    add_cells(blocks, i, cells);
    cells.begin.push_back(static_cast<Id>(cells.end.size()));
  }
  return cells;
}

Grid block_grid(const BlockCells& cells, const Picture& picture) {
  Grid g;
  g.time = picture.time;
  g.points.reserve(3 * picture.x.size());
  for (std::size_t v = 0; v < picture.x.size(); ++v) {
    g.points.insert(g.points.end(), {picture.x[v], picture.y[v], 0.0});
  }
  const std::size_t n = cells.end.size();
  g.corners.reserve(cells.corner.size());
  g.ends.reserve(n);
  g.types.reserve(n);
  Field id = numbers("id", n), material = numbers("material", n), fixed = numbers("fixed", n);
  Field displacement = field_of("displacement", 3, n), velocity = field_of("velocity", 3, n);
  Field rotation = field_of("rotation", 1, n), stress = field_of("stress", 6, n);
  Field principal = field_of("principal_stress", 3, n);
  Field omega = field_of("omega", 1, n), overstress = field_of("overstress", 1, n);
  stress.component_names = {"XX", "YY", "ZZ", "XY", "YZ", "XZ"};
  principal.component_names = {"major", "minor", "out_of_plane"};
  for (const BlockRecord& b : picture.blocks) {
    const Id first = cells.begin[b.id], end = cells.begin[b.id + 1];
    for (Id c = first; c < end; ++c) {
      for (Id k = c == 0 ? 0 : cells.end[c - 1]; k < cells.end[c]; ++k) {
        g.corners.push_back(cells.corner[k]);
      }
      g.ends.push_back(static_cast<std::int64_t>(g.corners.size()));
      g.types.push_back(end - first == 1 ? cell_type::polygon : cell_type::triangle);
      push(id, {static_cast<double>(b.id)});
      push(material, {static_cast<double>(b.material_index)});
      push(fixed, {b.fixed ? 1.0 : 0.0});
      push(displacement, {b.displacement.x, b.displacement.y, 0.0});
      push(velocity, {b.velocity.x, b.velocity.y, 0.0});
      push(rotation, {b.rotation});
      push(omega, {b.omega});
      push(stress, {b.sxx, b.syy, b.szz, b.sxy, 0.0, 0.0});
      push_principal(principal, b);
      push(overstress, {b.overstress});
    }
  }
  take(g.cell_fields, id, material, fixed, displacement, velocity, rotation, omega, stress,
       principal, overstress);
  g.point_fields.push_back(point_vectors("displacement", picture.ux, picture.uy));
  g.point_fields.push_back(point_vectors("velocity", picture.vx, picture.vy));
  return g;
}

Grid contact_grid(const Picture& picture) {
  Grid g;
  g.time = picture.time;
  const std::size_t n = picture.contacts.size();
  g.points.reserve(3 * n);
  g.corners.reserve(n);
  g.ends.reserve(n);
  g.types.reserve(n);
  Field i = numbers("block_i", n), j = numbers("block_j", n), state = numbers("state", n);
  Field normal = field_of("normal_force", 1, n), shear = field_of("shear_force", 1, n);
  Field opening = field_of("opening", 1, n), slip = field_of("slip", 1, n);
  Field length = field_of("length", 1, n), closed = field_of("closed_length", 1, n);
  Field normal_stress = field_of("normal_stress", 1, n),
        shear_stress = field_of("shear_stress", 1, n);
  Field stress_a = field_of("normal_stress_a", 1, n), stress_b = field_of("normal_stress_b", 1, n);
  Field x_a = field_of("x_a", 1, n), y_a = field_of("y_a", 1, n);
  Field x_b = field_of("x_b", 1, n), y_b = field_of("y_b", 1, n);
  Field force = field_of("force", 3, n), displacement = field_of("displacement", 3, n);
  for (const ContactRecord& c : picture.contacts) {
    g.corners.push_back(static_cast<std::int64_t>(g.point_count()));
    g.points.insert(g.points.end(), {c.position.x, c.position.y, 0.0});
    g.ends.push_back(static_cast<std::int64_t>(g.corners.size()));
    g.types.push_back(cell_type::vertex);
    push(i, {static_cast<double>(c.block_i)});
    push(j, {static_cast<double>(c.block_j)});
    push(normal, {c.normal_force});
    push(shear, {c.shear_force});
    push(opening, {c.opening});
    push(slip, {c.slip});
    push(length, {c.length});
    push(closed, {c.closed_length});
    push(normal_stress, {c.normal_stress});
    push(shear_stress, {c.shear_stress});
    push(stress_a, {c.normal_stress_a});
    push(stress_b, {c.normal_stress_b});
    push(x_a, {c.a.x});
    push(y_a, {c.a.y});
    push(x_b, {c.b.x});
    push(y_b, {c.b.y});
    push(state, {static_cast<double>(c.state)});
    push(force, {c.force.x, c.force.y, 0.0});
    push(displacement, {c.displacement.x, c.displacement.y, 0.0});
  }
  // Both as point and as cell fields: glyphs need points, thresholds and tables cells.
  g.cells_are_points = true;
  take(g.cell_fields, normal, shear, opening, slip, state, i, j, force, displacement, length,
       closed, normal_stress, shear_stress, stress_a, stress_b, x_a, y_a, x_b, y_b);
  return g;
}

std::string contacts_beside(std::string blocks_file) {
  const std::size_t at = blocks_file.find("blocks_");
  if (at != std::string::npos) blocks_file.replace(at, 6, "contacts");
  return blocks_file;
}

FrameSeries::FrameSeries(std::string folder, const BlockSet& blocks)
    : folder_(std::move(folder)), cells_(block_cells(blocks)) {}

std::vector<double> FrameSeries::times() const {
  std::vector<double> times;
  for (const SeriesEntry& e : blocks_) times.push_back(e.time);
  return times;
}

void FrameSeries::go_on_after(const std::vector<double>& times) {
  blocks_.clear();
  contacts_.clear();
  for (const double t : times) enter(t);
}

void FrameSeries::enter(double time) {
  const std::string number = fmt::format("{:06}", blocks_.size());
  blocks_.push_back({time, "frames/blocks_" + number + ".vtu"});
  contacts_.push_back({time, contacts_beside(blocks_.back().file)});
}

Trouble FrameSeries::add(const Picture& picture) {
  enter(picture.time);
  const std::string blocks = folder_ + "/" + blocks_.back().file;
  const std::string contacts = folder_ + "/" + contacts_.back().file;
  Trouble trouble = write_vtu(blocks, block_grid(cells_, picture));
  if (!trouble) trouble = write_vtu(contacts, contact_grid(picture));
  if (trouble) {
    blocks_.pop_back();
    contacts_.pop_back();
    return trouble;
  }
  constexpr std::size_t few = 1000;
  return blocks_.size() > in_series_ + in_series_ / few ? write_series() : Trouble{};
}

Trouble FrameSeries::write_series() {
  if (in_series_ == blocks_.size()) return {};
  if (auto t = write_pvd(folder_ + "/blocks.pvd", blocks_)) return t;
  if (auto t = write_pvd(folder_ + "/contacts.pvd", contacts_)) return t;
  in_series_ = blocks_.size();
  return {};
}

}  // namespace edda
