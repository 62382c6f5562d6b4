// validation.md row 38 at its fast size; kirsch_long_test.cpp has the others.
#include "verification/kirsch.hpp"

namespace edda::kirsch_test {
namespace {

TEST(Kirsch, OpeningInAMassOfBlocks) {
  const double size = 0.28;
  const kirsch::Mass mass = kirsch::test_mass(size);
  // Softer than the rock by the compliance of the joints.
  const double rock = kirsch::young / (2.0 * (1.0 + kirsch::poisson));
  EXPECT_LT(mass.shear_modulus, 0.8 * rock);
  EXPECT_GT(mass.shear_modulus, 0.5 * rock);
  kirsch::compare(kirsch::opening(size), mass, size);
}

}  // namespace
}  // namespace edda::kirsch_test
