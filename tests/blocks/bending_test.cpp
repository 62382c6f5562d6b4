// The modes of blocks that bend: what their shapes leave to the nodes, and what they store.
#include "blocks/bending.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "attachments/drawn_blocks.hpp"
#include "base/polygon.hpp"
#include "blocks/bent_state.hpp"
#include "blocks/block_point.hpp"
#include "blocks/edge_forces.hpp"

namespace edda::bending_test {
namespace {

using test::DrawnBlocks;

struct Shape {
  const char* name;
  Ring ring;
};

const std::vector<Shape>& shapes() {
  static const std::vector<Shape> all{
      {"square", {{0, 0}, {1, 0}, {1, 1}, {0, 1}}},
      {"4 to 1", {{0, 0}, {4, 0}, {4, 1}, {0, 1}}},
      {"rhomb", {{0, 0}, {1, 0.2}, {1.6, 1.1}, {0.6, 0.9}}},
      {"trapezoid", {{0, 0}, {2, 0}, {1.5, 1}, {0.4, 1}}},
      {"pentagon", {{0, 0}, {1.2, -0.1}, {1.7, 0.8}, {0.6, 1.5}, {-0.3, 0.7}}},
      {"brick with nodes", {{0, 0}, {1, 0}, {2, 0}, {2, 1}, {1, 1}, {0, 1}}},
      {"reentrant", {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}},
  };
  return all;
}

struct OneBlock : DrawnBlocks {
  State state;
  Moments m;
  explicit OneBlock(const Ring& ring) {
    model.deformation = BlockDeformation::corners;
    add(ring);
    build_all();
    state = initial_state(blocks, set);
    m = moments(set.blocks[0].rings);
  }
  std::size_t corners() const { return blocks.vertex_count(); }
  BlockModes modes() const { return blocks.modes(0); }
  Vec2 arm(std::size_t v) const { return blocks.vertex(v) - m.centroid; }
  /// E' t of the rock, and nu'.
  double modulus() const { return 1e9 / (1.0 - 0.2 * 0.2); }
  static constexpr double ratio = 0.2 / (1.0 - 0.2);
  /// mu_v by its definition.
  double part(std::size_t v) const {
    const auto along = [&](std::size_t w) {
      return 0.5 * (blocks.edge_length[w] + blocks.edge_length[blocks.previous[w]]);
    };
    double perimeter = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;
    Vec2 centre;
    for (std::size_t w = 0; w < corners(); ++w) {
      perimeter += along(w);
      centre += along(w) * arm(w);
    }
    centre = centre / perimeter;
    for (std::size_t w = 0; w < corners(); ++w) {
      const Vec2 d = arm(w) - centre;
      xx += along(w) * d.x * d.x / perimeter;
      xy += along(w) * d.x * d.y / perimeter;
      yy += along(w) * d.y * d.y / perimeter;
    }
    const double det = xx * yy - xy * xy;
    const Vec2 slope{(xy * centre.y - yy * centre.x) / det, (xy * centre.x - xx * centre.y) / det};
    return static_cast<double>(corners()) * along(v) / perimeter *
           (1.0 + dot(slope, arm(v) - centre));
  }
  /// The modes of a displacement of the corners that is given in the block's frame.
  void bend(const std::vector<Vec2>& u) {
    for (std::size_t a = 0; a < modes().count; ++a) {
      Vec2 sum;
      for (std::size_t v = 0; v < corners(); ++v) sum += (part(v) * modes().of(a, v)) * u[v];
      state.position.modes.set(modes()[a], sum);
    }
  }
  double stored() const {
    const BentState q = bent_state(blocks, state.position.modes,
                                   rotation(deformation(blocks, state.position, 0)), 0);
    const ModesOfBlock g = elastic_stress(blocks, q, 0);
    double twice = 0.0;
    for (std::size_t a = 0; a < q.modes.count; ++a) twice += dot(q.s[a], g[a]);
    return 0.5 * twice;
  }
};

TEST(Bending, BlocksHaveThreeModesFewerThanCorners) {
  EXPECT_EQ(OneBlock({{0, 0}, {1, 0}, {0, 1}}).modes().count, 0u);
  EXPECT_EQ(OneBlock({{0, 0}, {1, 0}, {1, 1}, {0, 1}}).modes().count, 1u);
  for (const Shape& s : shapes()) {
    const OneBlock o(s.ring);
    EXPECT_EQ(o.modes().count, o.corners() - 3) << s.name;
  }
}

TEST(Bending, FixedAndUniformBlocksHaveNone) {
  DrawnBlocks blocks;
  blocks.model.deformation = BlockDeformation::corners;
  blocks.add({{0, 0}, {1, 0}, {1, 1}, {0, 1}}, true);
  blocks.build_all();
  EXPECT_FALSE(blocks.blocks.bending.any());
  for (auto change : {+[](Model& m) { m.deformation = BlockDeformation::uniform; },
                      +[](Model& m) { m.contact.model = ContactModel::points; }}) {
    DrawnBlocks uniform;
    uniform.model.deformation = BlockDeformation::corners;
    change(uniform.model);
    uniform.add({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
    uniform.build_all();
    EXPECT_FALSE(uniform.blocks.bending.any());
  }
}

/// No mode moves the centre, strains the mean, or is another in disguise.
TEST(Bending, ShapesContainNoAffineMotion) {
  for (const Shape& s : shapes()) {
    const OneBlock o(s.ring);
    for (std::size_t a = 0; a < o.modes().count; ++a) {
      double sum = 0.0;
      Vec2 gradient;
      for (std::size_t v = 0; v < o.corners(); ++v) {
        const double h = o.modes().of(a, v);
        const Vec2 after = o.blocks.vertex(o.blocks.next[v]),
                   before = o.blocks.vertex(o.blocks.previous[v]);
        sum += o.part(v) * h;
        gradient += h * Vec2{after.y - before.y, before.x - after.x};
      }
      EXPECT_NEAR(sum, 0.0, 1e-13) << s.name;
      EXPECT_NEAR(norm(gradient), 0.0, 1e-13) << s.name;
      for (std::size_t b = 0; b < o.modes().count; ++b) {
        double product = 0.0;
        for (std::size_t v = 0; v < o.corners(); ++v)
          product += o.part(v) * o.modes().of(a, v) * o.modes().of(b, v);
        EXPECT_NEAR(product, a == b ? 1.0 : 0.0, 1e-12) << s.name;
      }
    }
  }
}

/// The masses of the corners have the centroid of the block: its weight, on any supports, bends it
/// no more than these do.
TEST(Bending, MassesHaveTheCentroid) {
  std::vector<Shape> all = shapes();
  all.push_back({"nodes on one side",
                 {{0, 0}, {10, 0}, {10, 5}, {5.2, 5}, {5, 5}, {4.8, 5}, {4.6, 5}, {0, 5}}});
  for (const Shape& s : all) {
    const OneBlock o(s.ring);
    Vec2 centre;
    double sum = 0.0;
    for (std::size_t v = 0; v < o.corners(); ++v) {
      EXPECT_GT(o.part(v), 0.0) << s.name;
      sum += o.part(v);
      centre += o.part(v) * o.arm(v);
    }
    EXPECT_NEAR(sum, static_cast<double>(o.corners()), 1e-12) << s.name;
    EXPECT_NEAR(norm(centre), 0.0, 1e-12) << s.name;
  }
}

/// A uniform traction on all edges bends nothing.
TEST(Bending, UniformStressDoesNotBend) {
  for (const Shape& s : shapes()) {
    const OneBlock o(s.ring);
    BlockForces on{o.blocks, 0};
    for (Id v = 0; v < o.corners(); ++v) {
      const Vec2 u = o.blocks.vertex(o.blocks.next[v]) - o.blocks.vertex(v);
      const Vec2 n = outward_normal(u), f = 0.5 * Vec2{3.0 * n.x + 2.0 * n.y, 2.0 * n.x - n.y};
      on.at_corner(v, f);
      on.at_corner(o.blocks.next[v], f);
    }
    for (std::size_t a = 0; a < o.modes().count; ++a)
      EXPECT_NEAR(norm(on.sum.modes[a]), 0.0, 1e-12) << s.name;
  }
}

/// The modes of pure bending with the curvatures c about the axes across and along `axis`: stress
/// along the axis that is linear across it, and the other way round.
void bend_purely(OneBlock& o, Vec2 axis, Vec2 c) {
  const Vec2 across = perp(axis);
  std::vector<Vec2> u;
  for (std::size_t v = 0; v < o.corners(); ++v) {
    const double xi = dot(o.arm(v), axis), eta = dot(o.arm(v), across), nu = OneBlock::ratio;
    u.push_back((-c.x * xi * eta + 0.5 * c.y * (eta * eta + nu * xi * xi)) * axis +
                (0.5 * c.x * (xi * xi + nu * eta * eta) - c.y * xi * eta) * across);
  }
  // Their affine part is the nodes'.
  Vec2 by_x, by_y, mean;
  for (std::size_t v = 0; v < o.corners(); ++v) {
    const Vec2 n = o.blocks.vertex(o.blocks.next[v]) - o.blocks.vertex(o.blocks.previous[v]);
    by_x += (0.5 * n.y / o.m.area) * u[v];
    by_y += (-0.5 * n.x / o.m.area) * u[v];
  }
  for (std::size_t v = 0; v < o.corners(); ++v) {
    u[v] -= o.arm(v).x * by_x + o.arm(v).y * by_y;
    mean += (o.part(v) / static_cast<double>(o.corners())) * u[v];
  }
  for (Vec2& at : u) at -= mean;
  o.bend(u);
}

/// A beam bends with E' Int y^2 dA.
TEST(Bending, OfABeamIsExact) {
  for (const double length : {1.0, 2.0, 4.0, 10.0}) {
    for (const bool with_nodes : {false, true}) {
      Ring ring{{0, 0}, {length, 0}, {length, 1}, {0, 1}};
      if (with_nodes) ring = {{0, 0}, {0.4 * length, 0}, {length, 0}, {length, 1}, {0, 1}};
      OneBlock o(ring);
      bend_purely(o, {1, 0}, {1e-3, 0.0});
      const double exact = 0.5 * o.modulus() * 1e-6 * length / 12.0;
      EXPECT_NEAR(o.stored(), exact, (with_nodes ? 0.05 : 1e-9) * exact) << length;
    }
  }
}

/// Of all stresses that move the corners alike the modes store what the one of least energy does:
/// no more than pure bending.
TEST(Bending, StoresNoMoreThanPureBending) {
  for (const Shape& s : shapes()) {
    OneBlock o(s.ring);
    for (int k = 0; k < 12; ++k) {
      const double angle = std::numbers::pi * k / 12.0;
      const Vec2 axis{std::cos(angle), std::sin(angle)}, across = perp(axis);
      const auto moment = [&](Vec2 d, Vec2 e) {
        return d.x * e.x * o.m.sxx + (d.x * e.y + d.y * e.x) * o.m.sxy + d.y * e.y * o.m.syy;
      };
      bend_purely(o, axis, {1e-3, 0.0});
      const double exact = 0.5 * o.modulus() * 1e-6 * moment(across, across);
      EXPECT_LT(o.stored(), exact * (1.0 + 1e-9)) << s.name;
    }
  }
}

/// The one mode of a square has the stiffness E'/3 in both directions.
TEST(Bending, OfASquareIsAThirdOfTheModulus) {
  OneBlock o({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  for (const Vec2 q : {Vec2{1, 0}, Vec2{0, 1}, Vec2{0.6, -0.8}}) {
    o.state.position.modes.set(o.modes()[0], 1e-3 * q);
    EXPECT_NEAR(o.stored(), 0.5e-6 * o.modulus() / 3.0, 1e-9 * o.modulus());
  }
}

/// No motion of the corners stores less than nothing, nor more than a boundary that moves by
/// itself.
TEST(Bending, StiffnessIsPositive) {
  for (const Shape& s : shapes()) {
    OneBlock o(s.ring);
    const BlockModes modes = o.modes();
    for (int k = 0; k < 40; ++k) {
      double most = 0.0;
      for (std::size_t a = 0; a < modes.count; ++a) {
        const Vec2 q{std::sin(3.0 * k + static_cast<double>(a)), std::cos(5.0 * k * k)};
        o.state.position.modes.set(modes[a], q);
        most += 0.5 * o.blocks.bending.stiffness[modes[a]] * dot(q, q);
      }
      EXPECT_GT(o.stored(), 0.0) << s.name;
      EXPECT_LE(o.stored(), most * (1.0 + 1e-12)) << s.name;
    }
  }
}

/// What a bent block stores does not depend on how it is turned or drawn.
TEST(Bending, IsTheSameForATurnedAndForAMirroredBlock) {
  for (const Shape& s : shapes()) {
    OneBlock o(s.ring);
    std::vector<Vec2> u;
    for (std::size_t v = 0; v < o.corners(); ++v)
      u.push_back({1e-3 * std::sin(3.0 * static_cast<double>(v)),
                   1e-3 * std::cos(5.0 * static_cast<double>(v))});
    o.bend(u);
    const double c = std::cos(0.7), w = std::sin(0.7);
    Ring turned, mirrored;
    std::vector<Vec2> by_turn, by_mirror;
    const auto turn = [&](Vec2 p) { return Vec2{c * p.x - w * p.y, w * p.x + c * p.y}; };
    for (std::size_t v = 0; v < o.corners(); ++v) {
      turned.push_back(turn(s.ring[v]));
      by_turn.push_back(turn(u[v]));
      const std::size_t back = o.corners() - 1 - v;
      mirrored.push_back({-s.ring[back].x, s.ring[back].y});
      by_mirror.push_back({-u[back].x, u[back].y});
    }
    OneBlock a(turned), b(mirrored);
    a.bend(by_turn);
    b.bend(by_mirror);
    EXPECT_NEAR(a.stored(), o.stored(), 1e-9 * o.stored()) << s.name;
    EXPECT_NEAR(b.stored(), o.stored(), 1e-9 * o.stored()) << s.name;
  }
}

/// A side that bends by itself stores about what a half-plane of the same wave does: E' k/8 of the
/// square of its amplitude per length, k its wave number; less where few corners draw the wave.
TEST(Bending, ACorrugatedBoundaryIsAsStiffAsAHalfPlane) {
  Ring ring;
  constexpr int n = 24;
  for (int v = 0; v < n; ++v)
    ring.push_back(
        {std::cos(2.0 * std::numbers::pi * v / n), std::sin(2.0 * std::numbers::pi * v / n)});
  OneBlock o(ring);
  for (const int waves : {4, 6, 8}) {
    std::vector<Vec2> u;
    for (int v = 0; v < n; ++v)
      u.push_back({1e-3 * std::cos(2.0 * std::numbers::pi * waves * v / n), 0.0});
    o.bend(u);
    const double exact = 0.125 * o.modulus() * waves * 2.0 * std::numbers::pi * 1e-6;
    EXPECT_GT(o.stored(), (waves == 4 ? 0.8 : 0.6) * exact) << waves;
    EXPECT_LT(o.stored(), exact) << waves;
  }
}

/// A point within a block follows its corners: all of them alike, each of them at its place, and
/// the points of an edge as the edge does.
TEST(ModeWeights, PointsFollowTheCorners) {
  for (const Shape& s : shapes()) {
    const OneBlock o(s.ring);
    const BlockModes modes = o.modes();
    for (Id v = 0; v < o.corners(); ++v) {
      const Id next = o.blocks.next[v];
      for (const double part : {0.0, 0.3, 0.5, 1.0}) {
        const Vec2 p = (1.0 - part) * o.blocks.vertex(v) + part * o.blocks.vertex(next);
        const auto weights = block_point(o.blocks, 0, p).modes;
        for (std::size_t a = 0; a < modes.count; ++a)
          EXPECT_NEAR(weights[a].second, (1.0 - part) * modes.of(a, v) + part * modes.of(a, next),
                      1e-9)
              << s.name << ' ' << v << ' ' << part;
      }
      // A little within: no jump at the edge.
      const Vec2 middle = 0.5 * (o.blocks.vertex(v) + o.blocks.vertex(next));
      const Vec2 inward = perp(unit(o.blocks.vertex(next) - o.blocks.vertex(v)));
      const auto weights = block_point(o.blocks, 0, middle + 1e-5 * inward).modes;
      for (std::size_t a = 0; a < modes.count; ++a)
        EXPECT_NEAR(weights[a].second, 0.5 * (modes.of(a, v) + modes.of(a, next)), 1e-4) << s.name;
    }
  }
}

/// Forces on both ends of all edges do the work on nodes and modes that they do on the corners.
TEST(Bending, ForcesOnEdgesDoTheirWork) {
  std::mt19937 rng(4);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  for (const Shape& s : shapes()) {
    const OneBlock o(s.ring);
    BodyVector u(o.modes().count);
    for (Vec2& of_node : u.nodes) of_node = {any(rng), any(rng)};
    for (std::size_t a = 0; a < u.count; ++a) u.modes.set(a, {any(rng), any(rng)});
    BodyVectors forces = zero_vectors(o.blocks);
    const EdgeForcesView view = edge_forces_view(o.blocks, forces);
    EdgeForces on(view, 0);
    BlockForces at_corners{o.blocks, 0};
    double work = 0.0;
    for (Id e = 0; e < o.corners(); ++e) {
      const Four f{any(rng), any(rng), any(rng), any(rng)};
      on.set(e, f);
      const Vec2 from{f[0], f[1]}, to{f[2], f[3]};
      at_corners.at_corner(e, from);
      at_corners.at_corner(o.blocks.next[e], to);
      work +=
          dot(from, corner_at(o.blocks, u, e)) + dot(to, corner_at(o.blocks, u, o.blocks.next[e]));
    }
    on.store();
    EXPECT_NEAR(dot(vector_of(o.blocks, forces, 0), u), work, 1e-11) << s.name;
    EXPECT_NEAR(dot(at_corners.sum, u), work, 1e-11) << s.name;
  }
}

/// A bent block that turns as a whole keeps its shape.
TEST(Bending, RigidMotionsTakeTheCornersAlong) {
  for (const Shape& s : shapes()) {
    OneBlock o(s.ring);
    for (std::size_t a = 0; a < o.modes().count; ++a)
      o.state.position.modes.set(o.modes()[a], {0.02, -0.01 * static_cast<double>(a)});
    const BodyVector at = vector_of(o.blocks, o.state.position, 0);
    const Vec2 centre{0.3, -0.2}, by{2.0, 1.0};
    const BodyVector there = rigid_positions(at, centre, by, 0.7),
                     speeds = rigid_velocities(at, centre, by, 0.7);
    for (Id v = 0; v < o.corners(); ++v) {
      const Vec2 arm = corner_at(o.blocks, at, v) - centre;
      EXPECT_NEAR(norm(corner_at(o.blocks, there, v) - (centre + by + rotated(arm, 0.7))), 0.0,
                  1e-12);
      EXPECT_NEAR(norm(corner_at(o.blocks, speeds, v) - (by + 0.7 * perp(arm))), 0.0, 1e-12);
    }
  }
}

}  // namespace
}  // namespace edda::bending_test
