#include "results/frames.hpp"

#include <fmt/format.h>

#include <cmath>

#include "results/triangulate.hpp"

namespace edda {
namespace {

std::vector<Ring> rings_of(const BlockSet& b, std::size_t i) {
  std::vector<Ring> rings;
  for (Id r = b.block_ring[i]; r < b.block_ring[i + 1]; ++r) {
    Ring& ring = rings.emplace_back();
    for (Id v = b.ring_begin[r]; v < b.ring_begin[r + 1]; ++v) {
      ring.push_back({b.vertex_x[v], b.vertex_y[v]});
    }
  }
  return rings;
}

void add_cells(const BlockSet& b, std::size_t i, std::vector<std::vector<std::int64_t>>& cells) {
  const std::vector<Ring> rings = rings_of(b, i);
  const auto first = static_cast<std::int64_t>(b.vertex_begin[i]);
  if (rings.size() == 1 && is_convex(rings[0])) {
    auto& cell = cells.emplace_back();
    for (std::size_t k = 0; k < rings[0].size(); ++k) {
      cell.push_back(first + static_cast<std::int64_t>(k));
    }
    return;
  }
  for (const Triangle& t : triangulate(rings)) {
    auto& cell = cells.emplace_back();
    for (const std::size_t k : t) cell.push_back(first + static_cast<std::int64_t>(k));
  }
}

Field vectors(std::string name, std::size_t count) {
  Field f{std::move(name), 3, {}, {}, false};
  f.values.reserve(3 * count);
  return f;
}

void push(Field& f, std::initializer_list<double> values) {
  f.values.insert(f.values.end(), values);
}

void push_principal(Field& f, const BlockRecord& b) {
  const double mean = 0.5 * (b.sxx + b.syy);
  const double radius = std::hypot(0.5 * (b.sxx - b.syy), b.sxy);
  push(f, {mean + radius, mean - radius, b.szz});
}

Field point_vectors(const char* name, const std::vector<double>& x, const std::vector<double>& y) {
  Field f = vectors(name, x.size());
  for (std::size_t v = 0; v < x.size(); ++v) push(f, {x[v], y[v], 0.0});
  return f;
}

}  // namespace

BlockCells block_cells(const BlockSet& blocks) {
  BlockCells cells;
  cells.begin.push_back(0);
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    add_cells(blocks, i, cells.cell);
    cells.begin.push_back(cells.cell.size());
  }
  return cells;
}

Grid block_grid(const BlockCells& cells, const Picture& picture) {
  Grid g;
  g.time = picture.time;
  for (std::size_t v = 0; v < picture.x.size(); ++v) {
    g.points.insert(g.points.end(), {picture.x[v], picture.y[v], 0.0});
  }
  const std::size_t n = cells.cell.size();
  Field id{"id", 1, {}, {}, true}, material{"material", 1, {}, {}, true},
      fixed{"fixed", 1, {}, {}, true};
  Field displacement = vectors("displacement", n), velocity = vectors("velocity", n);
  Field rotation{"rotation", 1, {}, {}, false};
  Field stress{"stress", 6, {}, {"XX", "YY", "ZZ", "XY", "YZ", "XZ"}, false};
  Field principal{"principal_stress", 3, {}, {"major", "minor", "out_of_plane"}, false};
  for (const BlockRecord& b : picture.blocks) {
    for (std::size_t c = cells.begin[b.id]; c < cells.begin[b.id + 1]; ++c) {
      g.corners.insert(g.corners.end(), cells.cell[c].begin(), cells.cell[c].end());
      g.ends.push_back(static_cast<std::int64_t>(g.corners.size()));
      g.types.push_back(cells.begin[b.id + 1] - cells.begin[b.id] == 1 ? cell_type::polygon
                                                                       : cell_type::triangle);
      push(id, {static_cast<double>(b.id)});
      push(material, {static_cast<double>(b.material_index)});
      push(fixed, {b.fixed ? 1.0 : 0.0});
      push(displacement, {b.displacement.x, b.displacement.y, 0.0});
      push(velocity, {b.velocity.x, b.velocity.y, 0.0});
      push(rotation, {b.rotation});
      push(stress, {b.sxx, b.syy, b.szz, b.sxy, 0.0, 0.0});
      push_principal(principal, b);
    }
  }
  g.cell_fields = {id, material, fixed, displacement, velocity, rotation, stress, principal};
  g.point_fields = {point_vectors("displacement", picture.ux, picture.uy),
                    point_vectors("velocity", picture.vx, picture.vy)};
  return g;
}

Grid contact_grid(const Picture& picture) {
  Grid g;
  g.time = picture.time;
  Field i{"block_i", 1, {}, {}, true}, j{"block_j", 1, {}, {}, true},
      state{"state", 1, {}, {}, true};
  Field normal{"normal_force", 1, {}, {}, false}, shear{"shear_force", 1, {}, {}, false};
  Field opening{"opening", 1, {}, {}, false}, slip{"slip", 1, {}, {}, false};
  Field force = vectors("force", picture.contacts.size());
  Field displacement = vectors("displacement", picture.contacts.size());
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
    push(state, {static_cast<double>(c.state)});
    push(force, {c.force.x, c.force.y, 0.0});
    push(displacement, {c.displacement.x, c.displacement.y, 0.0});
  }
  // Both as point and as cell fields: glyphs want points, thresholds and tables cells.
  g.cell_fields = {normal, shear, opening, slip, state, i, j, force, displacement};
  g.point_fields = g.cell_fields;
  return g;
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
  contacts_.push_back({time, "frames/contacts_" + number + ".vtu"});
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
  if (auto t = write_pvd(folder_ + "/blocks.pvd", blocks_)) return t;
  return write_pvd(folder_ + "/contacts.pvd", contacts_);
}

}  // namespace edda
