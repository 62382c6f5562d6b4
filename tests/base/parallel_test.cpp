#include "base/parallel.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include "base/threads.hpp"

namespace edda::parallel_test {
namespace {

/// Every block once, in chunks that fit what loops keep of one, and no more chunks than there is
/// room for where each has fewest_at_once blocks.
TEST(ParallelBlocks, TakesEveryBlockOnce) {
  const SameThreads same;
  for (const int threads : {1, 2, 3}) {
    omp_set_num_threads(threads);
    for (const std::size_t n : {0u, 1u, 63u, 64u, 65u, 2026u, 9000u, 20010u}) {
      std::vector<int> taken(n, 0);
      std::vector<int> chunks(n / fewest_at_once + 1, 0);
      parallel_blocks(n, 1000, [&](std::size_t c, std::size_t begin, std::size_t end) {
        EXPECT_LE(end - begin, blocks_at_once);
        EXPECT_EQ(begin % fewest_at_once, 0u) << "at a cache line";
        ++chunks.at(c);
        for (std::size_t i = begin; i < end; ++i) ++taken[i];
      });
      EXPECT_EQ(taken, std::vector<int>(n, 1)) << n << " blocks, " << threads << " threads";
      EXPECT_LE(*std::max_element(chunks.begin(), chunks.end()), 1);
    }
  }
}

}  // namespace
}  // namespace edda::parallel_test
