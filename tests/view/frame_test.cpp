#include "view/frame.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "report/face_grid.hpp"
#include "view/frames_of.hpp"

namespace edda::frame_test {
namespace {

/// Reads a frame as the page does (page/src/data/frame.ts), written from the layout alone.
class Unpacked {
 public:
  explicit Unpacked(const std::string& bytes, std::size_t nodes = 0, std::size_t cells = 0)
      : bytes_(bytes) {
    for (std::uint32_t* n : {&bits, &rows, &count, &datum, &touching}) *n = number<std::uint32_t>();
    for (std::uint32_t r = 0; r < rows; ++r)
      alive.push_back(static_cast<unsigned char>(bytes[20 + r / 8]) >> r % 8 & 1);
    at_ += (rows + 7) / 8;
    for (const std::size_t columns : {2UL, 4UL, 2UL, 1UL, 1UL, 4UL, 1UL})
      group(columns, count, blocks);
    if (nodes > 0) {
      for (int n = 0; n < 2; ++n) group(2, nodes, of_nodes);
      for (const std::size_t columns : {4UL, 1UL, 1UL, 1UL}) group(columns, cells, of_zones);
      for (std::size_t z = 0; z < cells; ++z)
        yields.push_back(static_cast<unsigned char>(bytes_[at_++]));
    }
    std::uint64_t i = 0;
    for (std::uint32_t k = 0; k < touching; ++k) contact_i.push_back(i += varint());
    for (std::uint32_t k = 0; k < touching; ++k) {
      const std::uint64_t twice = varint();
      const auto by = static_cast<std::int64_t>(twice >> 1);
      contact_j.push_back(static_cast<std::int64_t>(contact_i[k]) + (twice & 1 ? -by - 1 : by));
    }
    for (std::uint32_t k = 0; k < touching; ++k) contact_edge.push_back(varint());
    for (std::uint32_t k = 0; k < touching; ++k)
      state.push_back(static_cast<unsigned char>(bytes_[at_++]));
    for (std::uint32_t k = 0; k < touching; ++k)
      broken.push_back(static_cast<unsigned char>(bytes_[at_++]));
    if (at_ < bytes.size()) {
      for (const std::size_t columns : {3UL, 2UL, 1UL, 1UL, 2UL, 1UL, 1UL, 1UL})
        group(columns, touching, contacts);
    }
    EXPECT_EQ(at_, bytes.size());
  }
  std::uint32_t bits = 0, rows = 0, count = 0, datum = 0, touching = 0;
  std::vector<int> alive, state, broken, yields;
  std::vector<std::uint64_t> contact_i, contact_edge;
  std::vector<std::int64_t> contact_j;
  std::vector<std::vector<double>> blocks, contacts, of_nodes, of_zones;  ///< columns

 private:
  template <class T>
  T number() {
    T value;
    std::memcpy(&value, bytes_.data() + at_, sizeof value);
    at_ += sizeof value;
    return value;
  }
  std::uint64_t varint() {
    std::uint64_t value = 0;
    for (int shift = 0;; shift += 7) {
      const auto byte = static_cast<unsigned char>(bytes_[at_++]);
      value |= std::uint64_t{byte & 127U} << shift;
      if (byte < 128) return value;
    }
  }
  void group(std::size_t columns, std::size_t n, std::vector<std::vector<double>>& out) {
    const double scale = bits == 16 ? double{number<float>()} : 1.0;
    const std::size_t width = bits / 8;
    for (std::size_t c = 0; c < columns; ++c) {
      out.emplace_back();
      for (std::size_t k = 0; k < n; ++k) {
        std::uint32_t raw = 0;
        for (std::size_t plane = 0; plane < width; ++plane)
          raw |= std::uint32_t{static_cast<unsigned char>(bytes_[at_ + plane * n + k])}
                 << 8 * plane;
        float single = 0.0F;
        std::memcpy(&single, &raw, sizeof single);
        const int whole = raw & 1 ? -static_cast<int>((raw + 1) / 2) : static_cast<int>(raw / 2);
        out.back().push_back(bits == 16 ? scale * whole : double{single});
      }
      at_ += width * n;
    }
  }
  std::string bytes_;
  std::size_t at_ = 0;
};

const std::vector<TestBlock> three{{0, {{0, 0}, {2, 0}, {2, 1}, {0, 1}}, false},
                                   {1, {{2, 0}, {4, 0}, {4, 1}, {2, 1}}, false},
                                   {2, {{0, 1}, {2, 1}, {1, 3}}, true}};

/// A turn and a shift that differ from block to block.
Vec2 turned(const TestBlock& b, Vec2 p) {
  const double angle = 0.3 * (b.id + 1);
  return {p.x * std::cos(angle) - p.y * std::sin(angle) + 5.0,
          p.x * std::sin(angle) + p.y * std::cos(angle) - 1.0};
}
Vec2 by_turn(const TestBlock& b, Vec2 p) {
  return turned(b, p) - p;
}

/// What edge k of a block (from corner k on) does to the other with these forces.
Vec2 force_across(const TestBlock& b, std::size_t k, double normal, double shear) {
  const Vec2 from = turned(b, b.corners[k]), to = turned(b, b.corners[(k + 1) % b.corners.size()]);
  const Vec2 t = (to - from) / std::hypot(to.x - from.x, to.y - from.y);
  return normal * outward_normal(t) + shear * t;
}

/// As older versions wrote them: a corner of block 2 on edge 2 of block 0, and one of block 0 on
/// edge 3 of block 1, both at a corner of the latter, where two edges are equally near.
Grid two_points() {
  Grid g;
  const auto field = [&](const char* name, std::size_t components, std::vector<double> values) {
    g.cell_fields.push_back({name, components, std::move(values), {}, false});
  };
  const Vec2 p = turned(three[2], {2, 1}), q = turned(three[0], {2, 0});
  const Vec2 f = force_across(three[0], 2, 1e5, -3e4), h = force_across(three[1], 3, 4e3, 0.0);
  g.points = {p.x, p.y, 0.0, q.x, q.y, 0.0};
  g.corners = {0, 1};
  g.ends = {1, 2};
  g.types = {cell_type::vertex, cell_type::vertex};
  field("block_i", 1, {2, 0});
  field("block_j", 1, {0, 1});
  field("state", 1, {2, 1});
  field("normal_force", 1, {1e5, 4e3});
  field("shear_force", 1, {-3e4, 0.0});
  field("force", 3, {f.x, f.y, 0.0, h.x, h.y, 0.0});
  field("opening", 1, {-1e-5, -2e-6});
  field("slip", 1, {0.5, -0.25});
  return g;
}

Unpacked unpacked(const Grid& g, const Grid* contacts, ViewPrecision precision) {
  const ViewMesh mesh = view_mesh(frame_of(three, stays, nothing));
  const Result<ViewBlocks> in = blocks_in(mesh, g);
  EXPECT_TRUE(in.ok());
  return Unpacked(frame_bytes(mesh, in.value(), g, contacts, precision, 3));
}

/// `x` from what the page makes of the motion of block k, whose A is times `reach`.
Vec2 placed(const Unpacked& u, std::size_t k, Vec2 r, double reach = 1.0) {
  r = r / reach;
  return {u.blocks[0][k] + u.blocks[2][k] * r.x + u.blocks[3][k] * r.y,
          u.blocks[1][k] + u.blocks[4][k] * r.x + u.blocks[5][k] * r.y};
}

TEST(ViewFrame, SingleNumbersComeBackToSevenDigits) {
  const Unpacked u = unpacked(frame_of(three, turned, by_turn), nullptr, ViewPrecision::single);
  EXPECT_EQ(u.bits, 32u);
  EXPECT_EQ(u.datum, 3u);
  ASSERT_EQ(u.count, 3u);
  const ViewMesh mesh = view_mesh(frame_of(three, stays, nothing));
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t v = mesh.begin[row]; v < mesh.begin[row + 1]; ++v) {
      const Vec2 expected = by_turn(three[row], mesh.centre[row] + mesh.vertex[v]);
      EXPECT_NEAR(placed(u, row, mesh.vertex[v]).x, expected.x, 2e-6);
      EXPECT_NEAR(placed(u, row, mesh.vertex[v]).y, expected.y, 2e-6);
    }
    const double n = static_cast<double>(row) + 1.0;
    EXPECT_FLOAT_EQ(static_cast<float>(u.blocks[6][row]), static_cast<float>(0.1 * n));
    EXPECT_FLOAT_EQ(static_cast<float>(u.blocks[8][row]), static_cast<float>(-7.0 * n));
    EXPECT_FLOAT_EQ(static_cast<float>(u.blocks[9][row]), static_cast<float>(0.01 * n));
    EXPECT_FLOAT_EQ(static_cast<float>(u.blocks[13][row]), static_cast<float>(4e5 * n));
  }
}

double largest_in(const Unpacked& u, std::size_t first, std::size_t end) {
  double largest = 0.0;
  for (std::size_t c = first; c < end; ++c)
    for (const double v : u.blocks[c]) largest = std::max(largest, std::abs(v));
  return largest;
}

TEST(ViewFrame, WholeNumbersAreRightToHalfAStep) {
  const Grid g = frame_of(three, turned, by_turn);
  const Unpacked exact = unpacked(g, nullptr, ViewPrecision::single);
  const Unpacked u = unpacked(g, nullptr, ViewPrecision::whole16);
  EXPECT_EQ(u.bits, 16u);
  struct Group {
    std::size_t first, end;
    double steps;
  };
  for (const Group& group :
       {Group{0, 2, 32767}, {6, 8, 2047}, {8, 9, 2047}, {9, 10, 2047}, {10, 14, 2047}}) {
    const double half = 0.501 * largest_in(exact, group.first, group.end) / group.steps;
    double most = 0.0;
    for (std::size_t c = group.first; c < group.end; ++c) {
      for (std::size_t k = 0; k < 3; ++k)
        most = std::max(most, std::abs(u.blocks[c][k] - exact.blocks[c][k]));
    }
    EXPECT_LE(most, half) << "columns from " << group.first;
  }
}

/// How far 16 bits put a corner from its place, over the largest displacement of any.
double worst_corner(const std::vector<TestBlock>& blocks, const Moved& move) {
  const ViewMesh mesh = view_mesh(frame_of(blocks, stays, nothing));
  const Grid g = frame_of(
      blocks, [&](const TestBlock& b, Vec2 p) { return p + move(b, p); }, move);
  const Unpacked u(
      frame_bytes(mesh, blocks_in(mesh, g).value(), g, nullptr, ViewPrecision::whole16, 0));
  double most = 0.0, largest = 0.0;
  for (std::size_t row = 0; row < mesh.size(); ++row) {
    for (std::size_t v = mesh.begin[row]; v < mesh.begin[row + 1]; ++v) {
      const Vec2 moved = move(blocks[row], mesh.centre[row] + mesh.vertex[v]);
      largest = std::max(largest, norm(moved));
      most = std::max(most, norm(placed(u, row, mesh.vertex[v], mesh.reach(row)) - moved));
    }
  }
  return most / largest;
}

/// What turns a block about its centre.
Moved turning(const std::function<double(const TestBlock&)>& angle) {
  return [angle](const TestBlock& b, Vec2 p) {
    Vec2 centre;
    for (const Vec2 c : b.corners) centre += c / static_cast<double>(b.corners.size());
    const double a = angle(b);
    const Vec2 r = p - centre;
    return Vec2{std::cos(a) * r.x - std::sin(a) * r.y, std::sin(a) * r.x + std::cos(a) * r.y} - r;
  };
}

TEST(ViewFrame, CornersAreRightToATenThousandthOfTheLargestDisplacement) {
  const std::vector<TestBlock> unlike{{0, {{0, 0}, {0.1, 0}, {0.1, 0.1}, {0, 0.1}}, false},
                                      {1, {{1, 0}, {41, 0}, {41, 30}, {1, 30}}, false},
                                      {2, {{50, 0}, {60, 0.3}, {53, 9}}, false}};
  for (const double angle : {0.001, 0.3, 1.5, 3.1}) {
    EXPECT_LT(worst_corner(unlike, turning([&](const TestBlock&) { return angle; })), 1e-4);
    // A small block that turns far among large ones that hardly do.
    const auto one = [&](const TestBlock& b) { return b.id == 0 ? angle : 1.37e-5 * angle * b.id; };
    EXPECT_LT(worst_corner(unlike, turning(one)), 1e-4) << angle;
    // Far away, where the displacement says little of the turn.
    const Moved turn = turning([&](const TestBlock& b) { return angle / (b.id + 1.0); });
    const auto both = [&](const TestBlock& b, Vec2 p) { return turn(b, p) + Vec2{7.3, -100.1}; };
    EXPECT_LT(worst_corner(unlike, both), 1e-4) << angle;
  }
}

TEST(ViewFrame, BlocksTakenOutLeaveTheirRowEmpty) {
  std::vector<TestBlock> two = three;
  two[1].gone = true;
  const Unpacked u = unpacked(frame_of(two, stays, nothing), nullptr, ViewPrecision::single);
  EXPECT_EQ(u.rows, 3u);
  EXPECT_EQ(u.count, 2u);
  EXPECT_EQ(u.alive, (std::vector<int>{1, 0, 1}));
  EXPECT_FLOAT_EQ(static_cast<float>(u.blocks[8][1]), -21.0F);  // of block 2
}

TEST(ViewFrame, ABlockThatTheFirstFrameHasNotIsAFault) {
  std::vector<TestBlock> two = three;
  two[1].gone = true;
  const Grid all = frame_of(three, stays, nothing);
  EXPECT_FALSE(blocks_in(view_mesh(frame_of(two, stays, nothing)), all).ok());
  two.erase(two.begin() + 1);
  EXPECT_FALSE(blocks_in(view_mesh(frame_of(two, stays, nothing)), all).ok());
}

/// Half of the upper edge of block 0, and the left side of block 1, at their places.
Grid two_faces() {
  const auto at = [&](std::size_t block, Vec2 p) { return turned(three[block], p); };
  Grid g = face_grid({{at(0, {1.5, 1}), at(0, {0.5, 1}), 4e5, 0.0, 0.5, 2.0, 2, 0, {}, 2.0},
                      {at(1, {2, 1}), at(1, {2, 0}), 1e5, 3e5, 1.0, 1.0, 0, 1}});
  for (Field& field : g.cell_fields) {
    if (field.name == "opening") field.values = {-1e-5, -2e-6};
    if (field.name == "slip") field.values = {0.5, -0.25};
  }
  return g;
}

void expect_column(const std::vector<double>& column, double first, double second) {
  ASSERT_EQ(column.size(), 2u);
  EXPECT_NEAR(column[0], first, 1e-6 * (1.0 + std::abs(first)));
  EXPECT_NEAR(column[1], second, 1e-6 * (1.0 + std::abs(second)));
}

TEST(ViewFrame, ContactsNameTheEdgeThatTheyLieAlongAndTheirEndsOnIt) {
  const Grid contacts = two_faces();
  const Unpacked u = unpacked(frame_of(three, turned, by_turn), &contacts, ViewPrecision::single);
  ASSERT_EQ(u.touching, 2u);
  EXPECT_EQ(u.contact_i, (std::vector<std::uint64_t>{0, 2}));  // sorted by block
  EXPECT_EQ(u.contact_j, (std::vector<std::int64_t>{1, 0}));
  EXPECT_EQ(u.contact_edge, (std::vector<std::uint64_t>{3, 2}));
  EXPECT_EQ(u.state, (std::vector<int>{1, 2}));
  expect_column(u.contacts[0], 0.0, 0.25);
  expect_column(u.contacts[1], 1.0, 0.75);
  expect_column(u.contacts[2], 1.0, 0.5);
}

TEST(ViewFrame, ContactsHaveTheirForcesAndStresses) {
  const Grid contacts = two_faces();
  const Unpacked u = unpacked(frame_of(three, turned, by_turn), &contacts, ViewPrecision::single);
  ASSERT_EQ(u.contacts.size(), 12u);
  expect_column(u.contacts[3], 2e5, 1e5);
  expect_column(u.contacts[4], 4e4, 2e4);
  expect_column(u.contacts[5], -2e-6, -1e-5);
  expect_column(u.contacts[6], -0.25, 0.5);
  expect_column(u.contacts[7], 1e5, 4e5);
  expect_column(u.contacts[8], 3e5, 0.0);
  expect_column(u.contacts[9], 2e5, 1e5);
  expect_column(u.contacts[10], 4e4, 2e4);
  expect_column(u.contacts[11], 0.25, 1.0);
  EXPECT_EQ(u.broken, (std::vector<int>{0, 2}));
}

TEST(ViewFrame, ContactsOfOlderFramesArePointsOnTheEdgeThatTheirForceCrosses) {
  const Grid contacts = two_points();
  const Unpacked u = unpacked(frame_of(three, turned, by_turn), &contacts, ViewPrecision::single);
  ASSERT_EQ(u.touching, 2u);
  // Both forces were made to come across a certain edge.
  EXPECT_EQ(u.contact_edge, (std::vector<std::uint64_t>{3, 2}));
  EXPECT_EQ(u.contacts[0], u.contacts[1]);
  expect_column(u.contacts[7], 0.0, 0.0);
}

TEST(ViewFrame, OverlapsOfClosedContactsAreLeftOutOfSixteenBits) {
  const Grid contacts = two_faces();
  const Unpacked u = unpacked(frame_of(three, turned, by_turn), &contacts, ViewPrecision::whole16);
  EXPECT_EQ(u.contacts[5], (std::vector<double>{0.0, 0.0}));
  EXPECT_NEAR(u.contacts[1][1], 0.75, 0.501 / 127.0);
  EXPECT_NEAR(u.contacts[3][0], 2e5, 0.501 * 2e5 / 127.0);
  EXPECT_NEAR(u.contacts[6][0], -0.25, 0.501 * 0.5 / 127.0);
  EXPECT_NEAR(u.contacts[7][0], 1e5, 0.501 * 4e5 / 127.0);
}

TEST(ViewFrame, TheDatumChangesWhereDisplacementsAreReset) {
  const Grid first = frame_of(three, stays, nothing);
  const ViewMesh mesh = view_mesh(first);
  ViewDatum start, other;
  ASSERT_TRUE(find_datum(mesh, first, blocks_in(mesh, first).value(), nullptr, start));
  EXPECT_EQ(start.motion[1].d, (Vec2{}));
  const Grid moved = frame_of(three, turned, by_turn);
  EXPECT_FALSE(find_datum(mesh, moved, blocks_in(mesh, moved).value(), &start, other));
  // The same places, counted from there on.
  const Grid reset = frame_of(three, turned, nothing);
  ASSERT_TRUE(find_datum(mesh, reset, blocks_in(mesh, reset).value(), &start, other));
  const Vec2 expected = by_turn(three[1], mesh.centre[1]);
  EXPECT_NEAR(other.motion[1].d.x, expected.x, 1e-13);
  EXPECT_NEAR(other.motion[1].d.y, expected.y, 1e-13);
  EXPECT_NEAR(other.motion[1].yx, std::sin(0.6), 1e-13);
}

/// Block 1 of `three` divided by a diagonal, with values of its own in each triangle.
Grid with_zones(const Moved& place, const Moved& displacement) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  Grid g = frame_of(three, place, displacement);
  const std::int64_t first = g.corners[4];
  g.corners.erase(g.corners.begin() + 4, g.corners.begin() + 8);
  for (const std::int64_t k : {3, 2, 0, 2, 1, 0})
    g.corners.insert(g.corners.begin() + 4, first + k);
  g.ends = {4, 7, 10, 13};
  g.types = {cell_type::polygon, cell_type::triangle, cell_type::triangle, cell_type::polygon};
  for (Field& f : g.cell_fields) {
    const auto one = f.values.begin() + static_cast<std::ptrdiff_t>(f.components);
    const std::vector<double> again(one, one + static_cast<std::ptrdiff_t>(f.components));
    f.values.insert(one, again.begin(), again.end());
    if (f.name == "stress") f.values[6] = -5e6;
  }
  g.cell_fields.push_back({"plastic_strain", 1, {0.0, 0.01, 0.03, 0.0}, {}, false});
  g.cell_fields.push_back({"yields", 1, {0.0, 2.0, 1.0, 0.0}, {}, true});
  g.cell_fields.push_back({"strength_factor", 1, {nan, 1.5, nan, nan}, {}, false});
  g.cell_fields.push_back({"pore_pressure", 1, {0.0, 2e5, 1e5, 0.0}, {}, false});
  Field velocity = *g.point_field("displacement");
  velocity.name = "velocity";
  for (double& v : velocity.values) v *= 2.0;
  g.point_fields.push_back(velocity);
  return g;
}

/// No affine motion: one of the corners of block 1 moves alone.
Vec2 one_corner(const TestBlock& b, Vec2 p) {
  return b.id == 1 && p == Vec2{4, 1} ? Vec2{0.2, -0.1} : Vec2{0.01, 0.0};
}

TEST(ViewFrame, ZonesHaveTheirNodesAndValues) {
  const ViewMesh mesh = view_mesh(with_zones(stays, nothing));
  EXPECT_EQ(mesh.zoned, (std::vector<std::uint8_t>{0, 1, 0}));
  const Grid g =
      with_zones([](const TestBlock& b, Vec2 p) { return p + one_corner(b, p); }, one_corner);
  const ViewBlocks in = blocks_in(mesh, g).value();
  EXPECT_EQ(valued_cells(mesh, in), (std::vector<std::size_t>{0, 1, 2, 3}));
  for (const ViewPrecision precision : {ViewPrecision::single, ViewPrecision::whole16}) {
    const Unpacked u(frame_bytes(mesh, in, g, nullptr, precision, 0), 4, 2);
    for (std::size_t k = 0; k < 4; ++k) {
      const std::size_t v = mesh.begin[1] + k;
      const Vec2 expected = one_corner(three[1], mesh.centre[1] + mesh.vertex[v]);
      EXPECT_NEAR(u.of_nodes[0][k], expected.x, 1e-5);
      EXPECT_NEAR(u.of_nodes[1][k], expected.y, 1e-5);
      EXPECT_NEAR(u.of_nodes[2][k], 2.0 * expected.x, 2e-4);
      EXPECT_NEAR(u.of_nodes[3][k], 2.0 * expected.y, 2e-4);
    }
    EXPECT_NEAR(u.of_zones[0][0], -5e6, 2e3);
    EXPECT_NEAR(u.of_zones[0][1], -2e6, 2e3);
    EXPECT_NEAR(u.of_zones[3][1], 8e5, 2e3);
    EXPECT_NEAR(u.of_zones[4][0], 0.01, 1e-5);
    EXPECT_NEAR(u.of_zones[5][0], 1.5, 1e-3);
    EXPECT_NEAR(u.of_zones[5][1], -1.0, 1e-3);
    EXPECT_NEAR(u.of_zones[6][1], 1e5, 200.0);
    EXPECT_EQ(u.yields, (std::vector<int>{2, 1}));
    // The block has their mean by area.
    const std::vector<double> areas = cell_areas(g);
    EXPECT_NEAR(u.blocks[10][1], -(5e6 * areas[1] + 2e6 * areas[2]) / (areas[1] + areas[2]), 2e3);
    EXPECT_GT(std::abs(areas[1] / areas[2] - 1.0), 0.02);
  }
}

/// After a reset of displacements a node that has moved by itself stays where it is.
TEST(ViewFrame, ADatumKeepsWhereNodesAre) {
  const ViewMesh mesh = view_mesh(with_zones(stays, nothing));
  const auto place = [](const TestBlock& b, Vec2 p) { return p + one_corner(b, p); };
  const Grid before = with_zones(place, one_corner), reset = with_zones(place, nothing);
  ViewDatum first, second, third;
  ASSERT_TRUE(find_datum(mesh, before, blocks_in(mesh, before).value(), nullptr, first));
  EXPECT_FALSE(find_datum(mesh, before, blocks_in(mesh, before).value(), &first, third));
  ASSERT_TRUE(find_datum(mesh, reset, blocks_in(mesh, reset).value(), &first, second));
  for (std::size_t v = mesh.begin[1]; v < mesh.begin[2]; ++v) {
    EXPECT_LT(norm(first.moved[v]), 1e-12);
    EXPECT_LT(norm(second.moved[v] - one_corner(three[1], mesh.centre[1] + mesh.vertex[v])), 1e-12);
  }
  EXPECT_EQ(datum_bytes(mesh, second).size(), 4 * (6 * 3 + 2 * 4));
}

}  // namespace
}  // namespace edda::frame_test
