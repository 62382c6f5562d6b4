#include "results/frames.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <memory>
#include <new>
#include <numeric>
#include <utility>

namespace edda {
namespace {

void add_cells(const BlockSet& b, Id block, BlockCells& cells) {
  const auto close = [&](Id zone = no_id) {
    cells.end.push_back(static_cast<Id>(cells.corner.size()));
    cells.zone.push_back(zone);
  };
  if (b.is_meshed(block)) {
    const Meshes& m = b.meshes;
    const Id first = b.vertex_begin[block], corners = b.vertex_begin[block + 1] - first;
    for (Id z = m.zone_begin[block]; z < m.zone_begin[block + 1]; ++z) {
      for (const std::uint32_t j : m.zone[z]) {
        const Id own = j - m.begin[block];
        cells.corner.push_back(own < corners ? first + own : static_cast<Id>(b.vertex_count()) + j);
      }
      close(z);
    }
    return;
  }
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

/// Adds fields with a value, or several, of every row; row_at(k) is the row of point or cell k.
template <class RowAt>
class Fields {
 public:
  Fields(std::vector<FieldSource>& into, std::size_t count, RowAt row_at)
      : into_(into), count_(count), row_at_(row_at) {}

  /// values(row, v) sets v[0] to v[components - 1].
  template <class Values>
  void add(const char* name, std::size_t components, Values values,
           std::vector<std::string> component_names = {}) {
    const auto fill = [row_at = row_at_, components, values](std::size_t first, std::size_t end,
                                                             double* v) {
      for (std::size_t k = first; k < end; ++k, v += components) values(row_at(k), v);
    };
    into_.push_back({name, components, std::move(component_names), false, count_, fill});
  }
  template <class Value>
  void number(const char* name, Value value) {
    add(name, 1, [value](const auto& row, double* v) { v[0] = value(row); });
  }
  template <class Value>
  void whole(const char* name, Value value) {
    number(name, [value](const auto& row) { return static_cast<double>(value(row)); });
    into_.back().whole = true;
  }
  template <class Value>
  void vector(const char* name, Value value) {
    add(name, 3, [value](const auto& row, double* v) {
      const Vec2 p = value(row);
      v[0] = p.x;
      v[1] = p.y;
      v[2] = 0.0;
    });
  }

 private:
  std::vector<FieldSource>& into_;
  std::size_t count_;
  RowAt row_at_;
};

/// The row of a cell in the picture's blocks, and its zone or no_id with the points of it.
struct CellRow {
  std::uint32_t block, zone;
  std::array<Id, corners_of_zone> points{};
};

/// What a cell has of its zone, or of its block.
struct CellStress {
  double xx, yy, zz, xy;
};
struct CellMotion {
  Vec2 displacement, velocity;
};
CellMotion motion_of(const Picture& p, const CellRow& row) {
  if (row.zone == no_id) return {p.blocks[row.block].displacement, p.blocks[row.block].velocity};
  CellMotion mean;
  for (const Id point : row.points) {
    mean.displacement += Vec2{p.ux[point], p.uy[point]} / corners_of_zone;
    mean.velocity += Vec2{p.vx[point], p.vy[point]} / corners_of_zone;
  }
  return mean;
}

void add_block_fields(std::vector<FieldSource>& into, const Picture& picture,
                      std::vector<CellRow> row_of_cell) {
  using B = BlockRecord;
  const std::size_t n = row_of_cell.size();
  const auto rows = std::make_shared<const std::vector<CellRow>>(std::move(row_of_cell));
  Fields f(into, n, [rows, &picture](std::size_t k) -> const B& {
    return picture.blocks[(*rows)[k].block];
  });
  f.whole("id", [](const B& b) { return b.id; });
  f.whole("material", [](const B& b) { return b.material_index; });
  f.whole("fixed", [](const B& b) { return b.fixed; });
  Fields moved(into, n, [rows, &picture](std::size_t k) { return motion_of(picture, (*rows)[k]); });
  moved.vector("displacement", [](const CellMotion& m) { return m.displacement; });
  moved.vector("velocity", [](const CellMotion& m) { return m.velocity; });
  f.number("rotation", [](const B& b) { return b.rotation; });
  f.number("omega", [](const B& b) { return b.omega; });
  Fields own(into, n, [rows, &picture](std::size_t k) {
    const auto of = [](const auto& r) { return CellStress{r.sxx, r.syy, r.szz, r.sxy}; };
    const CellRow& row = (*rows)[k];
    return row.zone == no_id ? of(picture.blocks[row.block]) : of(picture.zones[row.zone]);
  });
  const auto stress = [](const CellStress& s, double* v) {
    for (const double part : {s.xx, s.yy, s.zz, s.xy, 0.0, 0.0}) *v++ = part;
  };
  own.add("stress", 6, stress, {"XX", "YY", "ZZ", "XY", "YZ", "XZ"});
  const auto principal = [](const CellStress& s, double* v) {
    const double mean = 0.5 * (s.xx + s.yy);
    const double radius = std::hypot(0.5 * (s.xx - s.yy), s.xy);
    v[0] = mean + radius;
    v[1] = mean - radius;
    v[2] = s.zz;
  };
  own.add("principal_stress", 3, principal, {"major", "minor", "out_of_plane"});
  if (!picture.zones.empty()) {
    Fields zone(into, n, [rows, &picture](std::size_t k) {
      const CellRow& row = (*rows)[k];
      return row.zone == no_id ? ZoneRecord{} : picture.zones[row.zone];
    });
    zone.number("plastic_strain", [](const ZoneRecord& z) { return z.plastic_strain; });
    zone.whole("yields", [](const ZoneRecord& z) { return z.yields; });
    zone.number("strength_factor", [](const ZoneRecord& z) { return z.strength_factor; });
    zone.number("pore_pressure", [](const ZoneRecord& z) { return z.pore_pressure; });
  }
  f.number("overstress", [](const B& b) { return b.overstress; });
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

GridSource block_source(const BlockCells& cells, const Picture& picture) {
  GridSource source;
  Grid& g = source.shape;
  g.time = picture.time;
  const std::size_t nv = picture.x.size(), n = cells.end.size();
  g.points.reserve(3 * nv);
  for (std::size_t v = 0; v < nv; ++v) {
    g.points.insert(g.points.end(), {picture.x[v], picture.y[v], 0.0});
  }
  g.corners.reserve(cells.corner.size());
  g.ends.reserve(n);
  g.types.reserve(n);
  std::vector<CellRow> row_of_cell;
  row_of_cell.reserve(n);
  for (std::size_t row = 0; row < picture.blocks.size(); ++row) {
    const Id block = picture.blocks[row].id;
    const Id first = cells.begin[block], end = cells.begin[block + 1];
    for (Id c = first; c < end; ++c) {
      for (Id k = c == 0 ? 0 : cells.end[c - 1]; k < cells.end[c]; ++k) {
        g.corners.push_back(cells.corner[k]);
      }
      g.ends.push_back(static_cast<std::int64_t>(g.corners.size()));
      const bool triangle = end - first > 1 || cells.zone[c] != no_id;
      g.types.push_back(triangle ? cell_type::triangle : cell_type::polygon);
      row_of_cell.push_back({static_cast<std::uint32_t>(row), cells.zone[c]});
      if (cells.zone[c] != no_id)
        std::copy_n(&cells.corner[cells.end[c] - corners_of_zone], corners_of_zone,
                    row_of_cell.back().points.begin());
    }
  }
  add_block_fields(source.cell_fields, picture, std::move(row_of_cell));
  Fields f(source.point_fields, nv, [](std::size_t v) { return v; });
  f.vector("displacement", [&picture](std::size_t v) {
    return Vec2{picture.ux[v], picture.uy[v]};
  });
  f.vector("velocity", [&picture](std::size_t v) { return Vec2{picture.vx[v], picture.vy[v]}; });
  return source;
}

Grid block_grid(const BlockCells& cells, const Picture& picture) {
  return grid_of(block_source(cells, picture));
}

GridSource contact_source(const Picture& picture) {
  using C = ContactRecord;
  GridSource source;
  Grid& g = source.shape;
  g.time = picture.time;
  const std::size_t n = picture.contacts.size();
  g.points.reserve(3 * n);
  for (const C& c : picture.contacts) {
    g.points.insert(g.points.end(), {c.position.x, c.position.y, 0.0});
  }
  g.corners.resize(n);
  std::iota(g.corners.begin(), g.corners.end(), std::int64_t{0});
  g.ends.resize(n);
  std::iota(g.ends.begin(), g.ends.end(), std::int64_t{1});
  g.types.assign(n, cell_type::vertex);
  // Both as point and as cell fields: glyphs need points, thresholds and tables cells.
  g.cells_are_points = true;
  Fields f(source.cell_fields, n,
           [&picture](std::size_t k) -> const C& { return picture.contacts[k]; });
  f.number("normal_force", [](const C& c) { return c.normal_force; });
  f.number("shear_force", [](const C& c) { return c.shear_force; });
  f.number("opening", [](const C& c) { return c.opening; });
  f.number("slip", [](const C& c) { return c.slip; });
  f.whole("state", [](const C& c) { return static_cast<std::int32_t>(c.state); });
  f.whole("block_i", [](const C& c) { return c.block_i; });
  f.whole("block_j", [](const C& c) { return c.block_j; });
  f.vector("force", [](const C& c) { return c.force; });
  f.vector("displacement", [](const C& c) { return c.displacement; });
  f.number("length", [](const C& c) { return c.length; });
  f.number("closed_length", [](const C& c) { return c.closed_length; });
  f.number("normal_stress", [](const C& c) { return c.normal_stress; });
  f.number("shear_stress", [](const C& c) { return c.shear_stress; });
  f.number("normal_stress_a", [](const C& c) { return c.normal_stress_a; });
  f.number("normal_stress_b", [](const C& c) { return c.normal_stress_b; });
  f.number("damage", [](const C& c) { return c.damage; });
  f.whole("broken_by", [](const C& c) { return static_cast<std::int32_t>(c.crack); });
  f.number("x_a", [](const C& c) { return c.a.x; });
  f.number("y_a", [](const C& c) { return c.a.y; });
  f.number("x_b", [](const C& c) { return c.b.x; });
  f.number("y_b", [](const C& c) { return c.b.y; });
  if (std::any_of(picture.contacts.begin(), picture.contacts.end(),
                  [](const C& c) { return c.aperture > 0.0; })) {
    f.number("aperture", [](const C& c) { return c.aperture; });
    f.number("discharge", [](const C& c) { return c.discharge; });
    f.number("water_pressure",
             [](const C& c) { return 0.5 * (c.water_pressure_a + c.water_pressure_b); });
    f.number("head", [](const C& c) { return c.head; });
  }
  return source;
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

namespace {

std::string blocks_file(std::size_t frame) {
  return fmt::format("frames/blocks_{:06}.vtu", frame);
}

Trouble write_frame(const std::string& folder, std::size_t frame, const BlockCells& cells,
                    const Picture& picture) {
  const std::string blocks = folder + "/" + blocks_file(frame);
  try {
    const Trouble trouble = write_vtu(blocks, block_source(cells, picture));
    return trouble ? trouble : write_vtu(contacts_beside(blocks), contact_source(picture));
  } catch (const std::bad_alloc&) {
    Fault fault;
    fault.where.file = blocks;
    fault.problem = "the memory does not suffice to write a frame";
    fault.remedy = "write fewer frames at a time on this machine, or a smaller model";
    return fault;
  }
}

}  // namespace

void FrameSeries::enter(double time) {
  blocks_.push_back({time, blocks_file(blocks_.size())});
  contacts_.push_back({time, contacts_beside(blocks_.back().file)});
}

Trouble FrameSeries::add(Picture picture) {
  if (auto t = finish()) return t;
  time_ = picture.time;
  // Where no thread can be made it is written in finish().
  writes_ = std::async(std::launch::async | std::launch::deferred,
                       [this, frame = blocks_.size(), picture = std::move(picture)] {
                         return write_frame(folder_, frame, cells_, picture);
                       });
  return {};
}

Trouble FrameSeries::collect() {
  const bool written =
      writes_.valid() && writes_.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
  return written ? finish() : trouble_;
}

Trouble FrameSeries::finish() {
  if (!writes_.valid()) return trouble_;
  trouble_ = writes_.get();
  if (trouble_) return trouble_;
  enter(time_);
  constexpr std::size_t few = 1000;
  return blocks_.size() > in_series_ + in_series_ / few ? write_lists() : Trouble{};
}

Trouble FrameSeries::write_series() {
  if (auto t = finish()) return t;
  return in_series_ == blocks_.size() ? Trouble{} : write_lists();
}

Trouble FrameSeries::write_lists() {
  if (auto t = write_pvd(folder_ + "/blocks.pvd", blocks_)) return t;
  if (auto t = write_pvd(folder_ + "/contacts.pvd", contacts_)) return t;
  in_series_ = blocks_.size();
  return {};
}

}  // namespace edda
