#include "verification/kirsch.hpp"

namespace edda {
namespace {

TEST(Kirsch, OpeningInAMassOfBlocks) {
  const double size = 0.3, joints = 20.0;
  const kirsch::Mass mass = kirsch::test_mass(size, joints);
  // Softer than the rock by what the joints give.
  const double rock = kirsch::young / (2.0 * (1.0 + kirsch::poisson));
  EXPECT_LT(mass.shear_modulus, rock);
  EXPECT_GT(mass.shear_modulus, 0.5 * rock);
  std::printf("G/G0 %g nu %g\n", mass.shear_modulus/rock, mass.poisson);
  const Simulation sim = kirsch::opening(size, joints);
  const auto e = kirsch::compare(sim, mass, size, "blocks of 0.3 radii");
  std::printf("%zu blocks %lu steps: radial %g hoop %g closure %g\n", sim.blocks.size(), (unsigned long)sim.state.steps, e.radial,e.hoop,e.closure);
}

}  // namespace
}  // namespace edda
