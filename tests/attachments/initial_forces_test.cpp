#include "attachments/initial_forces.hpp"

#include <gtest/gtest.h>

#include "attachments/loaded_blocks.hpp"

namespace edda::initial_forces_test {
namespace {

using test::lake;
using test::Loaded;
using test::odd_shape;

/// Under the stress of water at rest nothing is left for a face to carry: the water carries it all.
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

/// Of a stress that grows downwards, a boundary carries the resultant and the moment.
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
  for (const WallForce& f : supported_initial_stress(l.model, l.blocks, l.loads.intervals,
                                                     FaceForces(l.blocks, field, none))) {
    force += f.force.x;
    moment += f.force.x * (l.blocks.vertex_y[f.vertex] + l.blocks.origin.y);
  }
  // Int (-3e5 + 1e5 y) dy and Int (-3e5 + 1e5 y) y dy from 0 to 2.
  EXPECT_NEAR(force, -4e5, 1e-3);
  EXPECT_NEAR(moment, -6e5 + 8e5 / 3.0, 1e-3);
}

}  // namespace
}  // namespace edda::initial_forces_test
