#include "attachments/loads.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "attachments/drawn_blocks.hpp"
#include "attachments/initial_forces.hpp"

namespace edda::loads_test {
namespace {

/// Blocks as given, with the loads and waters of a model on them.
struct Loaded : test::DrawnBlocks {
  Loads loads;
  Faults faults;

  void attach() {
    build_all();
    Result<Loads> found = attach_loads(model, set, blocks);
    if (found.ok()) {
      loads = std::move(found.value());
    } else {
      faults = found.faults();
    }
  }
  /// Resultant on block i, and its moment about the centroid, with the vertices at x, y.
  struct Resultant {
    Vec2 force;
    double moment;
  };
  Resultant on(std::size_t i, const std::vector<double>& x, const std::vector<double>& y,
               double time = 0.0) const {
    std::array<Vec2, 3> f{};
    add_loads(f, blocks, loads_at(model, loads, time), x, y, i);
    // Nodes move with the vertices: as the block is drawn here it is not deformed.
    Resultant r{f[0] + f[1] + f[2], 0.0};
    for (std::size_t k = 0; k < 3; ++k) {
      r.moment += cross(Vec2{blocks.node_x[k][i] - blocks.centroid_x[i],
                             blocks.node_y[k][i] - blocks.centroid_y[i]},
                        f[k]);
    }
    return r;
  }
  Resultant on(std::size_t i, double time = 0.0) const {
    return on(i, blocks.vertex_x, blocks.vertex_y, time);
  }
};

Water lake(std::vector<Vec2> table) {
  Water w;
  w.table = std::move(table);
  return w;
}

const Ring odd_shape{{0, 0}, {3, 0.5}, {2.5, 2}, {1.2, 0.9}, {0.2, 1.7}};

/// Archimedes: water all round pushes up with its weight, through the centroid.
TEST(Water, LiftsWhatIsUnderIt) {
  Loaded l;
  l.add(odd_shape);
  l.model.waters = {lake({{-9, 7}, {2, 7}, {2.2, 7}, {9, 7}})};
  l.model.thickness = 2.0;
  l.attach();
  ASSERT_TRUE(l.faults.empty());
  const auto r = l.on(0);
  const double up = 9810.0 * 2.0 * l.blocks.area[0];
  EXPECT_NEAR(r.force.y / up, 1.0, 1e-12);
  EXPECT_NEAR(r.force.x, 0.0, 1e-9 * up);
  EXPECT_NEAR(r.moment, 0.0, 1e-9 * up);
}

/// Half in: the weight of the water that it takes the place of, through that part's centroid; the
/// table falls and rises with time.
TEST(Water, LiftsWhatReachesIntoIt) {
  Loaded l;
  l.add({{0, 0}, {2, 0}, {2, 2}, {0, 2}});
  l.model.waters = {lake({{-9, 0}, {9, 0}})};
  l.model.waters[0].rise = {{0.0, 1.0, 3.0}, {-1.0, 0.5, 1.5}};
  l.attach();
  EXPECT_EQ(l.on(0, 0.0).force, (Vec2{0.0, 0.0}));
  EXPECT_NEAR(l.on(0, 1.0).force.y, 9810.0 * 2.0 * 0.5, 1e-8);
  EXPECT_NEAR(l.on(0, 2.0).force.y, 9810.0 * 2.0 * 1.0, 1e-8);
  EXPECT_NEAR(l.on(0, 9.0).force.y, 9810.0 * 2.0 * 1.5, 1e-8);
  EXPECT_NEAR(l.on(0, 9.0).force.x, 0.0, 1e-8);
}

/// A table with a kink over a turned block, against brute force: many short pieces of every edge.
TEST(Water, IntegratesUnderAnyTable) {
  Loaded l;
  l.add(odd_shape);
  const std::vector<Vec2> table{{-5, 0.2}, {0.9, 1.4}, {1.1, 0.6}, {2.6, 1.9}};
  l.model.waters = {lake(table)};
  l.attach();
  const auto level = [&](double x) {
    std::size_t k = 1;
    while (k + 1 < table.size() && table[k].x < x) ++k;
    const double part = (x - table[k - 1].x) / (table[k].x - table[k - 1].x);
    return table[k - 1].y + part * (table[k].y - table[k - 1].y);
  };
  // The block has turned a little and moved: the table stays with the faces it was over.
  std::vector<double> x = l.blocks.vertex_x, y = l.blocks.vertex_y;
  for (std::size_t v = 0; v < x.size(); ++v) {
    const Vec2 p = rotated({x[v], y[v]}, 0.2) + Vec2{0.3, -0.1};
    x[v] = p.x;
    y[v] = p.y;
  }
  Vec2 force;
  for (Id v = 0; v < x.size(); ++v) {
    const Id end = l.blocks.next[v];
    const Vec2 u{x[end] - x[v], y[end] - y[v]};
    constexpr int pieces = 200000;
    for (int k = 0; k < pieces; ++k) {
      const double s = (k + 0.5) / pieces;
      const double x0 = (1 - s) * l.blocks.vertex_x[v] + s * l.blocks.vertex_x[end];
      if (x0 > 2.6) continue;
      const double depth = level(x0) - (y[v] + s * u.y);
      if (depth > 0.0) force -= 9810.0 * depth / pieces * outward_normal(u);
    }
  }
  const auto r = l.on(0, x, y);
  EXPECT_NEAR(r.force.x, force.x, 1e-5 * norm(force));
  EXPECT_NEAR(r.force.y, force.y, 1e-5 * norm(force));
}

/// Of two blocks side by side the joint is pushed apart; faces of an opening stay dry unless it is
/// flooded.
TEST(Water, FillsJointsAndLeavesOpeningsDry) {
  for (const bool flooded : {false, true}) {
    Loaded l;
    l.add({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
    l.add({{1, 0}, {2, 0}, {2, 1}, {1, 1}});
    Opening opening;
    opening.name = "pit";
    opening.polygon = {{2, 0}, {3, 0}, {3, 1}, {2, 1}};
    l.model.openings = {opening};
    l.model.waters = {lake({{0.5, 3}, {2.5, 3}})};
    if (flooded) l.model.waters[0].flooded = {"pit"};
    l.attach();
    const double push = 9810.0 * 2.5;
    EXPECT_NEAR(l.on(0).force.x, -push, 1e-8);
    EXPECT_NEAR(l.on(1).force.x, flooded ? 0.0 : push, 1e-8);
    EXPECT_NEAR(l.on(1).force.y, 9810.0, 1e-8);
  }
}

/// A face that runs on past an opening, or along two of them, is dry just where they are.
TEST(Water, IsDryOnlyAlongTheOpening) {
  auto with = [](std::vector<Ring> openings) {
    Loaded l;
    l.add({{0, 0}, {10, 0}, {10, 4}, {0, 4}});
    for (const Ring& ring : openings) {
      Opening o;
      o.polygon = ring;
      l.model.openings.push_back(o);
    }
    l.model.waters = {lake({{-1, 10}, {11, 10}})};
    l.attach();
    return l.on(0).force.y / 9810.0;
  };
  const Ring pit{{4, 4}, {6, 4}, {6, 6}, {4, 6}}, shaft{{6, 4}, {7, 4}, {7, 9}, {6, 9}};
  EXPECT_NEAR(with({}), 40.0, 1e-9);
  EXPECT_NEAR(with({pit}), 40.0 + 2.0 * 6.0, 1e-9);
  EXPECT_NEAR(with({pit, shaft}), 40.0 + 3.0 * 6.0, 1e-9);
}

TEST(Load, ActsAtItsPoint) {
  Loaded l;
  l.add({{0, 0}, {2, 0}, {2, 2}, {0, 2}});
  Load load;
  load.point = Vec2{1.5, 2.0};
  load.force = Vec2{10.0, -30.0};
  load.factor = {{1.0, 2.0}, {0.0, 1.0}};
  l.model.loads = {load};
  l.attach();
  ASSERT_TRUE(l.faults.empty());
  EXPECT_EQ(l.on(0, 0.5).force, (Vec2{0.0, 0.0}));
  const auto r = l.on(0, 1.5);
  EXPECT_NEAR(r.force.x, 5.0, 1e-12);
  EXPECT_NEAR(r.force.y, -15.0, 1e-12);
  EXPECT_NEAR(r.moment, 0.5 * -15.0 - 1.0 * 5.0, 1e-12);
}

/// A traction keeps its direction and the length it was given for; a pressure turns with the face.
/// Both act where the line lies on the face and nowhere else.
TEST(Load, ActsAlongALine) {
  Loaded l;
  l.add({{0, 0}, {2, 0}, {2, 2}, {0, 2}});
  l.add({{2, 0}, {4, 0}, {4, 2}, {2, 2}});
  Load traction, pressure;
  traction.along = {{0.5, 2}, {3, 2}, {3, 9}};
  traction.force = Vec2{0.0, -100.0};
  pressure.along = {{0, -1}, {0, 3}};
  pressure.pressure = 40.0;
  l.model.loads = {traction, pressure};
  l.attach();
  ASSERT_TRUE(l.faults.empty());
  const auto left = l.on(0), right = l.on(1);
  EXPECT_NEAR(left.force.x, 80.0, 1e-12);
  EXPECT_NEAR(left.force.y, -150.0, 1e-12);
  EXPECT_NEAR(left.moment, -150.0 * 0.25, 1e-12);
  EXPECT_NEAR(right.force.y, -100.0, 1e-12);
  EXPECT_NEAR(right.moment, 100.0 * 0.5, 1e-12);
  // Turned by a quarter: the pressure acts downwards, the traction as before.
  std::vector<double> x, y;
  for (std::size_t v = 0; v < l.blocks.vertex_count(); ++v) {
    x.push_back(-l.blocks.vertex_y[v]);
    y.push_back(l.blocks.vertex_x[v]);
  }
  const auto turned = l.on(0, x, y);
  EXPECT_NEAR(turned.force.x, 0.0, 1e-12);
  EXPECT_NEAR(turned.force.y, -150.0 + 80.0, 1e-12);
}

/// A traction acts where the face is free: what a neighbour covers, at either end, in the middle or
/// from a lower block, is left out.
TEST(Load, LeavesOutWhatANeighbourCovers) {
  struct Case {
    Ring neighbour;
    double left;  ///< of the ten metres
  };
  for (const Case& c :
       {Case{{{0, 1}, {2, 1}, {2, 2}, {0, 2}}, 8.0}, Case{{{4, 1}, {7, 1}, {7, 2}, {4, 2}}, 7.0},
        Case{{{8, 1}, {10, 1}, {10, 2}, {8, 2}}, 8.0},
        Case{{{-3, 1}, {6, 1}, {6, 2}, {-3, 2}}, 4.0}}) {
    for (const bool held : {false, true}) {
      Loaded l;
      l.add({{0, 0}, {10, 0}, {10, 1}, {0, 1}});
      l.add(c.neighbour, held);
      Load load;
      load.along = {{-1, 1}, {11, 1}};
      load.force = Vec2{0.0, -100.0};
      l.model.loads = {load};
      l.attach();
      ASSERT_TRUE(l.faults.empty());
      EXPECT_NEAR(l.on(0).force.y, -100.0 * c.left, 1e-9);
    }
  }
}

/// A line that turns back loads no face twice.
TEST(Load, CountsAFaceOnce) {
  Loaded l;
  l.add({{0, 0}, {2, 0}, {2, 2}, {0, 2}});
  Load load;
  load.along = {{0, 2}, {2, 2}, {1, 2}, {3, 2}};
  load.pressure = 10.0;
  l.model.loads = {load};
  l.attach();
  ASSERT_TRUE(l.faults.empty());
  EXPECT_NEAR(l.on(0).force.y, -20.0, 1e-12);
}

/// Far from the origin, along a face that no axis is parallel to.
TEST(Load, FindsFacesFarAway) {
  Loaded l;
  const Vec2 far{5e6, 3e6};
  Ring ring;
  for (const Vec2 p : {Vec2{0, 0}, Vec2{0.05, 0}, Vec2{0.05, 0.05}, Vec2{0, 0.05}})
    ring.push_back(rotated(p, 0.7));
  l.add(ring);
  l.set.origin = far;
  Load load;
  load.along = {far + ring[2], far + ring[3]};
  load.pressure = 100.0;
  l.model.loads = {load};
  l.attach();
  ASSERT_TRUE(l.faults.empty());
  EXPECT_NEAR(norm(l.on(0).force), 5.0, 1e-6);
}

/// Where a free and a held block meet, the load is the free one's.
TEST(Load, PrefersTheFreeBlock) {
  Loaded l;
  l.add({{0, 0}, {2, 0}, {2, 2}, {0, 2}}, true);
  l.add({{2, 0}, {4, 0}, {4, 2}, {2, 2}});
  Load load;
  load.point = Vec2{2.0, 1.0};
  load.force = Vec2{3.0, 0.0};
  l.model.loads = {load};
  l.attach();
  ASSERT_TRUE(l.faults.empty());
  EXPECT_NEAR(l.on(1).force.x, 3.0, 1e-12);
}

TEST(Load, PressureInAJointActsOnBothFaces) {
  Loaded l;
  l.add({{0, 0}, {2, 0}, {2, 2}, {0, 2}});
  l.add({{2, 0}, {4, 0}, {4, 2}, {2, 2}});
  Load jack;
  jack.along = {{2, 0.5}, {2, 1.0}};
  jack.pressure = 10.0;
  l.model.loads = {jack};
  l.attach();
  ASSERT_TRUE(l.faults.empty());
  EXPECT_NEAR(l.on(0).force.x, -5.0, 1e-12);
  EXPECT_NEAR(l.on(1).force.x, 5.0, 1e-12);
}

/// What a load that acts on nothing says.
TEST(Load, RefusesWhatItCannotActOn) {
  struct Case {
    Load load;
    std::string key, problem;
  };
  Load nowhere, held, joint, outside;
  nowhere.point = Vec2{1, 9};
  nowhere.force = Vec2{1, 0};
  held.point = Vec2{5, 1};
  held.force = Vec2{1, 0};
  joint.along = {{2, 0}, {2, 2}};
  joint.force = Vec2{1, 0};
  outside.along = {{0, 7}, {2, 7}};
  outside.pressure = 1.0;
  for (const Case& c :
       {Case{nowhere, "load.0.point", "lies in no block"}, Case{held, "load.0.point", "held"},
        Case{joint, "load.0.along", "along a joint"},
        Case{outside, "load.0.along", "no face of a free block"}}) {
    Loaded l;
    l.add({{0, 0}, {2, 0}, {2, 2}, {0, 2}});
    l.add({{2, 0}, {4, 0}, {4, 2}, {2, 2}});
    l.add({{4, 0}, {6, 0}, {6, 2}, {4, 2}}, true);
    l.model.loads = {c.load};
    l.model.loads[0].where.key = "load.0";
    l.attach();
    ASSERT_EQ(l.faults.size(), 1u) << c.problem;
    EXPECT_EQ(l.faults[0].where.key, c.key);
    EXPECT_NE(l.faults[0].problem.find(c.problem), std::string::npos) << l.faults[0].problem;
  }
}

/// Under the stress of water at rest nothing is left for a face to bear: the water bears it all.
TEST(InitialForces, WaterBearsItsShare) {
  Loaded l;
  l.add(odd_shape);
  Water water = lake({{-10, 5}, {10, 5}});
  l.model.waters = {water};
  InitialStress stress;
  const double rise = water.unit_weight;
  stress.stress = Triple{-5.0 * rise, -5.0 * rise, 0.0};
  stress.gradient = Triple{rise, rise, 0.0};
  l.model.initial_stress = stress;
  l.attach();
  ASSERT_TRUE(l.faults.empty());
  const StressField field(l.model, l.blocks.origin);
  const LoadsNow now = loads_at(l.model, l.loads, 0.0);
  const FaceForces faces(l.blocks, field, now);
  for (Id e = 0; e < l.blocks.vertex_count(); ++e) {
    for (const Part part : {Part{0.0, 1.0}, Part{0.2, 0.7}}) {
      const EndForces on = faces.on(e, part);
      EXPECT_NEAR(norm(on.at_from) + norm(on.at_to), 0.0, 1e-6 * rise);
    }
  }
  // Without water it is all there.
  const LoadsNow none;
  EXPECT_GT(norm(FaceForces(l.blocks, field, none).on(0, {0.0, 1.0}).at_from), rise);
}

/// Of a model 2 m thick.
TEST(Load, GrowsWithTheThickness) {
  Loaded l;
  l.model.thickness = 2.0;
  l.add({{0, 0}, {3, 0}, {3, 1}, {0, 1}});
  Load pressure;
  pressure.along = {{0, 1}, {3, 1}};
  pressure.pressure = 1e4;
  l.model.loads = {pressure};
  l.attach();
  ASSERT_TRUE(l.faults.empty());
  EXPECT_NEAR(l.on(0).force.y, -2.0 * 3.0 * 1e4, 1e-6);
}

/// Of a stress that grows downwards, a boundary holds the resultant and the moment.
TEST(InitialForces, BoundariesHoldWhatFacesBear) {
  Loaded l;
  l.add({{0, 0}, {1, 0}, {1, 2}, {0, 2}});
  Boundary held;
  held.name = "b";
  held.along = {{1, 0}, {1, 2}};
  held.stiffness = 1e6;
  l.model.boundaries = {held};
  InitialStress stress;
  stress.stress = Triple{-3e5, 0.0, 0.0};
  stress.gradient = Triple{1e5, 0.0, 0.0};
  l.model.initial_stress = stress;
  l.attach();
  const StressField field(l.model, l.blocks.origin);
  const LoadsNow none;
  double force = 0.0, moment = 0.0;
  for (const KeptForce& f :
       held_initial_stress(l.model, l.blocks, l.loads.spells, FaceForces(l.blocks, field, none))) {
    force += f.force.x;
    moment += f.force.x * (l.blocks.vertex_y[f.vertex] + l.blocks.origin.y);
  }
  // Int (-3e5 + 1e5 y) dy and Int (-3e5 + 1e5 y) y dy from 0 to 2.
  EXPECT_NEAR(force, -4e5, 1e-3);
  EXPECT_NEAR(moment, -6e5 + 8e5 / 3.0, 1e-3);
}

}  // namespace
}  // namespace edda::loads_test
