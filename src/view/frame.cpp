#include "view/frame.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

#include "view/bytes.hpp"

// Layout of a frame (numbers little-endian):
//
//   u32   bits of a number (16 or 32), rows nb, blocks n, datum, contacts m
//   u8    [ceil(nb / 8)] a bit per row of the mesh, lowest first: alive
//   then the columns of the blocks, n values each:
//     d.x d.y | A.xx A.xy A.yx A.yy | velocity.x velocity.y | omega | rotation |
//     stress.xx .yy .zz .xy | overstress
//   d and A: of the displacement since the datum; where the block was at the datum says that
//   then the contacts, sorted by the row of block i:
//     varint [m] row of block i, less that before; varint [m] vertex of it;
//     zigzag [m] row of block j less that of i; u8 [m] state; and the columns
//     normal_force shear_force | direction | opening | slip
//
// A bar separates groups; those of a group share a scale. A column of 16 bits is an f32 scale s (of
// each group, before its first column) and whole numbers q = round(v / s), zigzagged, all low bytes
// before all high bytes. A column of 32 bits is f32, in four planes of bytes alike.

namespace edda {
namespace {

using Columns = std::vector<std::vector<double>>;

void add_planes(Bytes& bytes, const std::string& numbers, std::size_t width) {
  const std::size_t n = numbers.size() / width;
  for (std::size_t plane = 0; plane < width; ++plane) {
    for (std::size_t k = 0; k < n; ++k)
      bytes.u8(static_cast<std::uint8_t>(numbers[width * k + plane]));
  }
}

double finite(double value) {
  return std::isfinite(value) ? value : 0.0;
}

void add_whole(Bytes& bytes, const std::vector<double>& column, double scale) {
  Bytes numbers;
  for (const double v : column) {
    const auto q = static_cast<std::int32_t>(std::lround(finite(v) / scale));
    numbers.u16(static_cast<std::uint16_t>(q < 0 ? -2 * q - 1 : 2 * q));
  }
  add_planes(bytes, numbers.text(), 2);
}

void add_single(Bytes& bytes, const std::vector<double>& column) {
  Bytes numbers;
  for (const double v : column) numbers.f32(finite(v));
  add_planes(bytes, numbers.text(), 4);
}

/// Columns that share a scale.
void add_group(Bytes& bytes, const Columns& columns, ViewPrecision precision) {
  if (precision == ViewPrecision::single) {
    for (const auto& column : columns) add_single(bytes, column);
    return;
  }
  double largest = 0.0;
  for (const auto& column : columns) {
    for (const double v : column) largest = std::max(largest, std::abs(finite(v)));
  }
  // As the page will read it, so that the quotient is rounded with the same number.
  const float scale =
      std::max(static_cast<float>(largest / 32767.0), std::numeric_limits<float>::min());
  bytes.f32(scale);
  for (const auto& column : columns) add_whole(bytes, column, double{scale});
}

/// Component `k` of the cell field at these cells; zeros where there is no such field.
std::vector<double> column(const Grid& g, const char* name, std::size_t k,
                           const std::vector<std::size_t>& cells) {
  const Field* field = g.cell_field(name);
  std::vector<double> values(cells.size(), 0.0);
  if (field == nullptr) return values;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    values[i] = field->values[field->components * cells[i] + k];
  }
  return values;
}

void add_motions(Bytes& bytes, const std::vector<BlockMotion>& motions, ViewPrecision precision) {
  Columns d(2), a(4);
  for (const BlockMotion& m : motions) {
    d[0].push_back(m.d.x);
    d[1].push_back(m.d.y);
    a[0].push_back(m.xx);
    a[1].push_back(m.xy);
    a[2].push_back(m.yx);
    a[3].push_back(m.yy);
  }
  add_group(bytes, d, precision);
  add_group(bytes, a, precision);
}

void add_fields(Bytes& bytes, const Grid& g, const std::vector<std::size_t>& cells,
                ViewPrecision precision) {
  const auto group = [&](const char* name, std::initializer_list<std::size_t> components) {
    Columns columns;
    for (const std::size_t k : components) columns.push_back(column(g, name, k, cells));
    add_group(bytes, columns, precision);
  };
  group("velocity", {0, 1});
  group("omega", {0});
  group("rotation", {0});
  group("stress", {0, 1, 2, 3});
  group("overstress", {0});
}

/// A contact of the frame by rows of the mesh.
struct Touch {
  std::size_t cell = 0, i = 0, j = 0, vertex = 0;
};

/// The vertex of block `row` that lies at the contact's point: contacts are where a vertex is.
std::size_t nearest_vertex(const ViewMesh& mesh, std::size_t row, const std::vector<double>& places,
                           Vec2 at) {
  std::size_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t v = mesh.begin[row]; v < mesh.begin[row + 1]; ++v) {
    const auto p = 3 * static_cast<std::size_t>(mesh.point[v]);
    const double distance = std::hypot(places[p] - at.x, places[p + 1] - at.y);
    if (distance < least) {
      least = distance;
      best = v - mesh.begin[row];
    }
  }
  return best;
}

std::vector<Touch> touches_of(const ViewMesh& mesh, const Grid& blocks, const Grid& contacts) {
  const Field *i = contacts.cell_field("block_i"), *j = contacts.cell_field("block_j");
  std::vector<Touch> touches;
  if (i == nullptr || j == nullptr) return touches;
  for (std::size_t c = 0; c < contacts.cell_count(); ++c) {
    Touch t{c, mesh.row_of(static_cast<std::int32_t>(i->values[c])),
            mesh.row_of(static_cast<std::int32_t>(j->values[c])), 0};
    if (t.i == mesh.size() || t.j == mesh.size()) continue;
    t.vertex = nearest_vertex(mesh, t.i, blocks.points,
                              {contacts.points[3 * c], contacts.points[3 * c + 1]});
    touches.push_back(t);
  }
  std::stable_sort(touches.begin(), touches.end(),
                   [](const Touch& a, const Touch& b) { return a.i < b.i; });
  return touches;
}

void add_contacts(Bytes& bytes, const std::vector<Touch>& touches, const Grid& contacts,
                  ViewPrecision precision) {
  std::size_t before = 0;
  for (const Touch& t : touches) {
    bytes.varint(t.i - before);
    before = t.i;
  }
  for (const Touch& t : touches) bytes.varint(t.vertex);
  for (const Touch& t : touches)
    bytes.zigzag(static_cast<std::int64_t>(t.j) - static_cast<std::int64_t>(t.i));
  std::vector<std::size_t> cells;
  for (const Touch& t : touches) cells.push_back(t.cell);
  for (const double state : column(contacts, "state", 0, cells))
    bytes.u8(static_cast<std::uint8_t>(state));
  const std::vector<double> normal = column(contacts, "normal_force", 0, cells);
  const std::vector<double> x = column(contacts, "force", 0, cells);
  const std::vector<double> y = column(contacts, "force", 1, cells);
  std::vector<double> direction(cells.size());
  for (std::size_t k = 0; k < cells.size(); ++k) direction[k] = std::atan2(y[k], x[k]);
  add_group(bytes, {normal, column(contacts, "shear_force", 0, cells)}, precision);
  add_group(bytes, {direction}, precision);
  add_group(bytes, {column(contacts, "opening", 0, cells)}, precision);
  add_group(bytes, {column(contacts, "slip", 0, cells)}, precision);
}

Vec2 point_value(const std::vector<double>& values, std::int64_t point) {
  const auto at = 3 * static_cast<std::size_t>(point);
  return {values[at], values[at + 1]};
}

/// The displacement since the datum.
BlockMotion displacement_of(const ViewMesh& mesh, std::size_t row, const Grid& g) {
  const Field* u = g.point_field("displacement");
  if (u == nullptr) return {};
  return block_motion(mesh, row,
                      [&](std::size_t v) { return point_value(u->values, mesh.point[v]); });
}

/// From the first frame to the datum.
BlockMotion datum_of(const ViewMesh& mesh, std::size_t row, const Grid& g) {
  const Field* u = g.point_field("displacement");
  return block_motion(mesh, row, [&](std::size_t v) {
    Vec2 start = point_value(g.points, mesh.point[v]);
    if (u != nullptr) start = start - point_value(u->values, mesh.point[v]);
    return (start - mesh.centre[row]) - mesh.vertex[v];
  });
}

/// By how much the vertices of a block lie apart in two motions, m.
double apart(const ViewMesh& mesh, std::size_t row, const BlockMotion& a, const BlockMotion& b) {
  double most = 0.0;
  for (std::size_t v = mesh.begin[row]; v < mesh.begin[row + 1]; ++v) {
    const Vec2 r = mesh.vertex[v], d = a.d - b.d;
    most = std::max(most, std::hypot(d.x + (a.xx - b.xx) * r.x + (a.xy - b.xy) * r.y,
                                     d.y + (a.yx - b.yx) * r.x + (a.yy - b.yy) * r.y));
  }
  return most;
}

}  // namespace

std::string datum_bytes(const ViewDatum& datum) {
  Bytes bytes;
  add_motions(bytes, datum.motion, ViewPrecision::single);
  return bytes.text();
}

Result<ViewBlocks> blocks_in(const ViewMesh& mesh, const Grid& blocks) {
  ViewBlocks in;
  const Field* id = blocks.cell_field("id");
  for (std::size_t c = 0; id != nullptr && c < blocks.cell_count(); ++c) {
    if (c > 0 && id->values[c] == id->values[c - 1]) continue;
    const std::size_t row = mesh.row_of(static_cast<std::int32_t>(id->values[c]));
    if (row == mesh.size() || (!in.row.empty() && row <= in.row.back()))
      return Fault{{}, "its frames are not of one run", "run the model again"};
    in.row.push_back(row);
    in.cell.push_back(c);
  }
  return in;
}

bool find_datum(const ViewMesh& mesh, const Grid& blocks, const ViewBlocks& in,
                const ViewDatum* before, ViewDatum& found) {
  constexpr double rounding = 1e-7;  // of a block's size
  if (before != nullptr) {
    found = *before;
  } else {
    found.motion.assign(mesh.size(), {});
  }
  bool other = before == nullptr;
  for (const std::size_t row : in.row) {
    const BlockMotion m = datum_of(mesh, row, blocks);
    double size = 0.0;
    for (std::size_t v = mesh.begin[row]; v < mesh.begin[row + 1]; ++v)
      size = std::max({size, std::abs(mesh.vertex[v].x), std::abs(mesh.vertex[v].y)});
    if (apart(mesh, row, m, found.motion[row]) <= rounding * size) continue;
    found.motion[row] = m;
    other = true;
  }
  return other;
}

std::string frame_bytes(const ViewMesh& mesh, const ViewBlocks& in, const Grid& blocks,
                        const Grid* contacts, ViewPrecision precision, std::size_t datum) {
  std::vector<Touch> touches;
  if (contacts != nullptr) touches = touches_of(mesh, blocks, *contacts);
  Bytes bytes;
  for (const std::size_t n :
       {static_cast<std::size_t>(precision), mesh.size(), in.row.size(), datum, touches.size()}) {
    bytes.u32(static_cast<std::uint32_t>(n));
  }
  std::vector<std::uint8_t> alive((mesh.size() + 7) / 8, 0);
  for (const std::size_t row : in.row)
    alive[row / 8] = static_cast<std::uint8_t>(alive[row / 8] | 1U << row % 8);
  for (const std::uint8_t bits : alive) bytes.u8(bits);
  std::vector<BlockMotion> motions;
  for (const std::size_t row : in.row) motions.push_back(displacement_of(mesh, row, blocks));
  add_motions(bytes, motions, precision);
  add_fields(bytes, blocks, in.cell, precision);
  if (contacts != nullptr) add_contacts(bytes, touches, *contacts, precision);
  return bytes.text();
}

}  // namespace edda
