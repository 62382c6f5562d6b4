// The list of faces against brute force, while blocks move.
#include <gtest/gtest.h>

#include "contacts/drifting_heap.hpp"

namespace edda::oracle_test {
namespace {

/// Sizes up to 1 : 10,000, needles, slivers, stars; tools/contact-oracle runs thousands of these.
TEST(ListOfFaces, MissesNothingWhileBlocksMove) {
  std::size_t wanted = 0;
  for (unsigned seed = 0; seed < 150; ++seed) {
    const ListFaults faults = drifting_heap(seed, 30, 2, 3);
    ASSERT_EQ(faults.missed, 0u) << "seed " << seed;
    ASSERT_EQ(faults.repeated, 0u) << "seed " << seed;
    wanted += faults.wanted;
  }
  EXPECT_GT(wanted, 10000u);
}

/// Plates, needles of 2 degrees, stars, blocks with holes, which overlap each other.
TEST(ListOfFaces, ActWhereTheyPressInBothBlocks) {
  ActingFaults sum;
  for (unsigned seed = 0; seed < 300; ++seed) {
    const ActingFaults faults = acting_heap(seed, 30, 3, 4);
    EXPECT_EQ(faults.apart, 0u) << "seed " << seed;
    sum.add(faults);
  }
  EXPECT_GT(sum.decided, 50000u);
  EXPECT_GT(sum.inactive, 20000u);
}

}  // namespace
}  // namespace edda::oracle_test
