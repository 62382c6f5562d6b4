// validation.md row 38: closer with smaller blocks.
#include "verification/kirsch.hpp"

namespace edda::kirsch_long_test {
namespace {

TEST(KirschLong, CloserWithSmallerBlocks) {
  const kirsch::Mass mass = kirsch::test_mass(0.28);
  kirsch::Errors before;
  before.profile = 1.0;
  // Blocks of 0.2 radii continue this trend and take two minutes more.
  for (const double size : {0.4, 0.28}) {
    const kirsch::Errors e = kirsch::compare(kirsch::opening(size), mass, size);
    EXPECT_LT(e.convergence, 0.1) << size;
    EXPECT_LT(e.profile, before.profile) << size;
    before = e;
  }
}

}  // namespace
}  // namespace edda::kirsch_long_test
