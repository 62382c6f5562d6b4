#include "view/frame.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

#include "report/faces.hpp"
#include "view/bytes.hpp"

// Layout of a frame (numbers little-endian):
//
//   u32   bits of a number (16 or 32), rows nb, blocks n, datum, contacts m
//   u8    [ceil(nb / 8)] a bit per row of the mesh, lowest first: alive
//   then the columns of the blocks, n values each:
//     d.x d.y | A.xx A.xy A.yx A.yy | velocity.x velocity.y | omega | rotation |
//     stress.xx .yy .zz .xy | overstress
//   where any block is zoned, then of zoned blocks alive
//     of their vertices: displacement.x .y since the datum | velocity.x .y
//     of their cells: stress.xx .yy .zz .xy | plastic_strain | strength_factor, -1 where
//     the rock has none | pore_pressure, and u8 yields
//   d and A: of the displacement since the datum; where the block was at the datum says that. With
//   16 bits A is times the block's reach, m, so that the rotation of small blocks does not cost
//   large ones precision then the contacts, sorted by the row of block i:
//     varint [m] row of block i, less that before; zigzag [m] row of block j less that of i;
//     varint [m] edge of it; u8 [m] state; u8 [m] broken_by; and the columns
//     along_a along_b closed | normal_force shear_force | opening | slip |
//     normal_stress_a normal_stress_b | normal_stress | shear_stress | damage
//   and, where water flows through joints, water_pressure | head | discharge | aperture
//   along: where on the edge the ends of the overlap lie, 0 to 1; closed: fraction of it that
//   carries
//
// A bar separates groups; those of a group share a scale. A column of 16 bits is an f32 scale s (of
// each group, before its first column) and whole numbers q = round(v / s), zigzagged, all low bytes
// before all high bytes. A column of 32 bits is f32, in four planes of bytes alike.
//
// With 16 bits the scale gives each value only the precision it needs, since further digits are
// noise that cannot be compressed: motion_steps for a displacement (and for A what moves no vertex
// by more), value_steps for what is shown as a number or a colour, contact_steps for contacts; and
// the overlap of closed contacts is left out: their opening is 0.

namespace edda {
namespace {

using Columns = std::vector<std::vector<double>>;

// Largest whole numbers.
constexpr double motion_steps = 32767.0, value_steps = 2047.0, contact_steps = 127.0;

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

double largest_of(const Columns& columns) {
  double largest = 0.0;
  for (const auto& column : columns) {
    for (const double v : column) largest = std::max(largest, std::abs(finite(v)));
  }
  return largest;
}

/// Columns that share a scale: their largest magnitude over `steps`, or `coarse` where that is
/// more.
void add_group(Bytes& bytes, const Columns& columns, ViewPrecision precision, double steps,
               double coarse = 0.0) {
  if (precision == ViewPrecision::single) {
    for (const auto& column : columns) add_single(bytes, column);
    return;
  }
  // The scale as the page will read it, so that the quotient is rounded with the same number.
  const auto scale = static_cast<float>(
      std::max({largest_of(columns) / steps, coarse, double{std::numeric_limits<float>::min()}}));
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

bool any_zoned(const ViewMesh& mesh) {
  return std::any_of(mesh.zoned.begin(), mesh.zoned.end(), [](auto zoned) { return zoned != 0; });
}

/// The same of blocks: the mean over the area of zoned ones.
std::vector<double> block_column(const ViewMesh& mesh, const ViewBlocks& in, const Grid& g,
                                 const char* name, std::size_t k,
                                 const std::vector<double>& areas) {
  std::vector<double> values = column(g, name, k, in.cell);
  const Field* field = g.cell_field(name);
  for (std::size_t i = 0; field != nullptr && i < values.size(); ++i) {
    if (mesh.zoned[in.row[i]] == 0) continue;
    double sum = 0.0, area = 0.0;
    for (std::size_t c = in.cell[i]; c < in.end[i]; ++c) {
      sum += areas[c] * field->values[field->components * c + k];
      area += areas[c];
    }
    if (area > 0.0) values[i] = sum / area;
  }
  return values;
}

/// Rounding to steps q of A times the reach moves a vertex by up to q/2 for each of x and y: with
/// half the step of d it is right to a whole one.
void add_motions(Bytes& bytes, const std::vector<BlockMotion>& motions, ViewPrecision precision,
                 const std::vector<double>& reaches) {
  Columns d(2), a(4);
  for (std::size_t k = 0; k < motions.size(); ++k) {
    const BlockMotion& m = motions[k];
    const double reach = precision == ViewPrecision::single ? 1.0 : reaches[k];
    d[0].push_back(m.d.x);
    d[1].push_back(m.d.y);
    a[0].push_back(reach * m.xx);
    a[1].push_back(reach * m.xy);
    a[2].push_back(reach * m.yx);
    a[3].push_back(reach * m.yy);
  }
  add_group(bytes, d, precision, motion_steps);
  add_group(bytes, a, precision, motion_steps, 0.5 * largest_of(d) / motion_steps);
}

void add_fields(Bytes& bytes, const ViewMesh& mesh, const ViewBlocks& in, const Grid& g,
                ViewPrecision precision) {
  const std::vector<double> areas = any_zoned(mesh) ? cell_areas(g) : std::vector<double>();
  const auto group = [&](const char* name, std::initializer_list<std::size_t> components) {
    Columns columns;
    for (const std::size_t k : components)
      columns.push_back(block_column(mesh, in, g, name, k, areas));
    add_group(bytes, columns, precision, value_steps);
  };
  group("velocity", {0, 1});
  group("omega", {0});
  group("rotation", {0});
  group("stress", {0, 1, 2, 3});
  group("overstress", {0});
}

Vec2 point_value(const std::vector<double>& values, std::int64_t point) {
  const auto at = 3 * static_cast<std::size_t>(point);
  return {values[at], values[at + 1]};
}

/// Values of a point field at the vertices of zoned blocks, x and y.
Columns vertex_columns(const ViewMesh& mesh, const ViewBlocks& in, const Grid& g,
                       const char* name) {
  const Field* field = g.point_field(name);
  Columns columns(2);
  for (const std::size_t row : in.row) {
    if (mesh.zoned[row] == 0) continue;
    for (std::size_t v = mesh.begin[row]; v < mesh.begin[row + 1]; ++v) {
      const Vec2 value = field == nullptr ? Vec2{} : point_value(field->values, mesh.point[v]);
      columns[0].push_back(value.x);
      columns[1].push_back(value.y);
    }
  }
  return columns;
}

void add_zones(Bytes& bytes, const ViewMesh& mesh, const ViewBlocks& in, const Grid& g,
               ViewPrecision precision) {
  add_group(bytes, vertex_columns(mesh, in, g, "displacement"), precision, motion_steps);
  add_group(bytes, vertex_columns(mesh, in, g, "velocity"), precision, value_steps);
  std::vector<std::size_t> cells;
  for (std::size_t i = 0; i < in.row.size(); ++i) {
    for (std::size_t c = in.cell[i]; mesh.zoned[in.row[i]] != 0 && c < in.end[i]; ++c)
      cells.push_back(c);
  }
  Columns stress;
  for (std::size_t k = 0; k < 4; ++k) stress.push_back(column(g, "stress", k, cells));
  add_group(bytes, stress, precision, value_steps);
  add_group(bytes, {column(g, "plastic_strain", 0, cells)}, precision, value_steps);
  std::vector<double> factor = column(g, "strength_factor", 0, cells);
  for (double& v : factor) v = std::isnan(v) ? -1.0 : v;
  add_group(bytes, {factor}, precision, value_steps);
  add_group(bytes, {column(g, "pore_pressure", 0, cells)}, precision, value_steps);
  for (const double yields : column(g, "yields", 0, cells))
    bytes.u8(static_cast<std::uint8_t>(yields));
}

/// A contact of the frame by rows of the mesh, and the ends of its overlap on an edge of block j.
struct Touch {
  std::size_t cell = 0, i = 0, j = 0, edge = 0;
  double along_a = 0.0, along_b = 0.0;
  double closed = 1.0;  ///< fraction of it that carries
};

/// Assigns the face to the nearest edge of its block j; of equally near ones to the one with its
/// direction.
void put_on_edge(const ViewMesh& mesh, const std::vector<double>& places, Vec2 a, Vec2 b,
                 Vec2 along, Touch& touch) {
  const auto place = [&](std::uint32_t v) { return point_value(places, mesh.point[v]); };
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t e = mesh.edge_begin[touch.j]; e < mesh.edge_begin[touch.j + 1]; ++e) {
    const Vec2 p = place(mesh.edges[e][0]), q = place(mesh.edges[e][1]);
    const double length = norm(q - p);
    if (!(length > 0.0)) continue;
    const double off = distance_to_segment(a, p, q) + distance_to_segment(b, p, q);
    const double misfit = off / length + norm((q - p) / length - along);
    if (misfit >= least) continue;
    least = misfit;
    touch.edge = e - mesh.edge_begin[touch.j];
    touch.along_a = dot(a - p, q - p) / (length * length);
    touch.along_b = dot(b - p, q - p) / (length * length);
  }
}

/// From a to b by the force on block i: -N n + S t with n on the left of t. Nothing without one.
Vec2 direction_by_force(Vec2 force, double normal, double shear) {
  const double size = dot(force, force);
  if (!(size > 0.0)) return {};
  return Vec2{shear * force.x - normal * force.y, shear * force.y + normal * force.x} / size;
}

std::vector<Touch> touches_of(const ViewMesh& mesh, const Grid& blocks, const Grid& contacts) {
  const Field *i = contacts.cell_field("block_i"), *j = contacts.cell_field("block_j"),
              *force = contacts.cell_field("force"), *normal = contacts.cell_field("normal_force"),
              *shear = contacts.cell_field("shear_force");
  std::vector<Touch> touches;
  for (const Field* field : {i, j, force, normal, shear}) {
    if (field == nullptr) return touches;
  }
  const std::vector<DrawnFace> faces = drawn_faces(contacts);
  for (std::size_t c = 0; c < contacts.cell_count(); ++c) {
    Touch t{c, mesh.row_of(static_cast<std::int32_t>(i->values[c])),
            mesh.row_of(static_cast<std::int32_t>(j->values[c]))};
    if (t.i == mesh.size() || t.j == mesh.size()) continue;
    const Vec2 at = point_value(contacts.points, contacts.corners[contacts.begin(c)]);
    const Vec2 a = faces.empty() ? at : faces[c].a, b = faces.empty() ? at : faces[c].b;
    // Frames of older versions have points.
    const Vec2 along = a == b ? direction_by_force({force->values[3 * c], force->values[3 * c + 1]},
                                                   normal->values[c], shear->values[c])
                              : unit(b - a);
    put_on_edge(mesh, blocks.points, a, b, along, t);
    if (!faces.empty()) t.closed = faces[c].closed;
    touches.push_back(t);
  }
  std::stable_sort(touches.begin(), touches.end(),
                   [](const Touch& a, const Touch& b) { return a.i < b.i; });
  return touches;
}

/// The positions of the faces on their edges, and the fraction of each that carries.
Columns columns_along(const std::vector<Touch>& touches) {
  Columns columns(3);
  for (const Touch& t : touches) {
    columns[0].push_back(t.along_a);
    columns[1].push_back(t.along_b);
    columns[2].push_back(t.closed);
  }
  return columns;
}

void add_contacts(Bytes& bytes, const std::vector<Touch>& touches, const Grid& contacts,
                  ViewPrecision precision) {
  std::size_t before = 0;
  for (const Touch& t : touches) {
    bytes.varint(t.i - before);
    before = t.i;
  }
  for (const Touch& t : touches)
    bytes.zigzag(static_cast<std::int64_t>(t.j) - static_cast<std::int64_t>(t.i));
  for (const Touch& t : touches) bytes.varint(t.edge);
  std::vector<std::size_t> cells;
  cells.reserve(touches.size());
  for (const Touch& t : touches) cells.push_back(t.cell);
  const std::vector<double> state = column(contacts, "state", 0, cells);
  for (const double s : state) bytes.u8(static_cast<std::uint8_t>(s));
  for (const double mode : column(contacts, "broken_by", 0, cells))
    bytes.u8(static_cast<std::uint8_t>(mode));
  std::vector<double> opening = column(contacts, "opening", 0, cells);
  for (std::size_t k = 0; k < opening.size(); ++k) {
    if (precision == ViewPrecision::whole16 && state[k] != 0.0) opening[k] = 0.0;
  }
  const auto group = [&](std::initializer_list<const char*> names) {
    Columns columns;
    for (const char* name : names) columns.push_back(column(contacts, name, 0, cells));
    add_group(bytes, columns, precision, contact_steps);
  };
  add_group(bytes, columns_along(touches), precision, contact_steps);
  group({"normal_force", "shear_force"});
  add_group(bytes, {opening}, precision, contact_steps);
  group({"slip"});
  group({"normal_stress_a", "normal_stress_b"});
  group({"normal_stress"});
  group({"shear_stress"});
  group({"damage"});
  if (contacts.cell_field(water_fields.front()) == nullptr) return;
  for (const char* name : water_fields) group({name});
}

/// The displacement since the datum.
BlockMotion displacement_of(const ViewMesh& mesh, std::size_t row, const Grid& g) {
  const Field* u = g.point_field("displacement");
  if (u == nullptr) return {};
  return block_motion(mesh, row,
                      [&](std::size_t v) { return point_value(u->values, mesh.point[v]); });
}

/// Of a vertex of block `row` from the first frame to the datum.
Vec2 moved_to_datum(const ViewMesh& mesh, std::size_t row, const Grid& g, std::size_t v) {
  const Field* u = g.point_field("displacement");
  Vec2 start = point_value(g.points, mesh.point[v]);
  if (u != nullptr) start = start - point_value(u->values, mesh.point[v]);
  return (start - mesh.centre[row]) - mesh.vertex[v];
}
BlockMotion datum_of(const ViewMesh& mesh, std::size_t row, const Grid& g) {
  return block_motion(mesh, row, [&](std::size_t v) { return moved_to_datum(mesh, row, g, v); });
}

/// Takes over the vertices of a zoned block; whether any has another datum than before.
bool move_vertices(const ViewMesh& mesh, std::size_t row, const Grid& g, double rounding,
                   ViewDatum& datum) {
  bool other = false;
  for (std::size_t v = mesh.begin[row]; v < mesh.begin[row + 1]; ++v) {
    const Vec2 moved = moved_to_datum(mesh, row, g, v);
    if (norm(moved - datum.moved[v]) <= rounding) continue;
    datum.moved[v] = moved;
    other = true;
  }
  return other;
}

/// Largest distance of the vertices of a block between two motions, m.
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

std::string datum_bytes(const ViewMesh& mesh, const ViewDatum& datum) {
  Bytes bytes;
  add_motions(bytes, datum.motion, ViewPrecision::single, {});
  Columns moved(2);
  for (std::size_t row = 0; !datum.moved.empty() && row < mesh.size(); ++row) {
    for (std::size_t v = mesh.begin[row]; mesh.zoned[row] != 0 && v < mesh.begin[row + 1]; ++v) {
      moved[0].push_back(datum.moved[v].x);
      moved[1].push_back(datum.moved[v].y);
    }
  }
  add_group(bytes, moved, ViewPrecision::single, motion_steps);
  return bytes.text();
}

std::vector<std::size_t> valued_cells(const ViewMesh& mesh, const ViewBlocks& in) {
  std::vector<std::size_t> cells;
  for (std::size_t i = 0; i < in.row.size(); ++i) {
    const std::size_t end = mesh.zoned[in.row[i]] != 0 ? in.end[i] : in.cell[i] + 1;
    for (std::size_t c = in.cell[i]; c < end; ++c) cells.push_back(c);
  }
  return cells;
}

Result<ViewBlocks> blocks_in(const ViewMesh& mesh, const Grid& blocks) {
  const Fault other{{}, "its frames are not of one run", "run the model again"};
  if (blocks.point_count() != mesh.points) return other;
  ViewBlocks in;
  const Field* id = blocks.cell_field("id");
  for (std::size_t c = 0; id != nullptr && c < blocks.cell_count(); ++c) {
    if (c > 0 && id->values[c] == id->values[c - 1]) {
      ++in.end.back();
      continue;
    }
    const std::size_t row = mesh.row_of(static_cast<std::int32_t>(id->values[c]));
    if (row == mesh.size() || (!in.row.empty() && row <= in.row.back())) return other;
    in.row.push_back(row);
    in.cell.push_back(c);
    in.end.push_back(c + 1);
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
    if (any_zoned(mesh)) found.moved.assign(mesh.vertex.size(), {});
  }
  bool other = before == nullptr;
  for (const std::size_t row : in.row) {
    if (mesh.zoned[row] != 0 && move_vertices(mesh, row, blocks, rounding * mesh.reach(row), found))
      other = true;
    const BlockMotion m = datum_of(mesh, row, blocks);
    if (apart(mesh, row, m, found.motion[row]) <= rounding * mesh.reach(row)) continue;
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
  std::vector<double> reaches;
  for (const std::size_t row : in.row) {
    motions.push_back(displacement_of(mesh, row, blocks));
    reaches.push_back(mesh.reach(row));
  }
  add_motions(bytes, motions, precision, reaches);
  add_fields(bytes, mesh, in, blocks, precision);
  if (any_zoned(mesh)) add_zones(bytes, mesh, in, blocks, precision);
  if (contacts != nullptr) add_contacts(bytes, touches, *contacts, precision);
  return bytes.text();
}

}  // namespace edda
