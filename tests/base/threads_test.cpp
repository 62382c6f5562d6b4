#include "base/threads.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <functional>
#include <thread>

namespace edda::threads_test {
namespace {

/// Steps for `seconds` of time that `cost` makes; the part of it that was spent with `threads`.
double part_with(ThreadChoice& choice, int threads, double seconds,
                 const std::function<double(int)>& cost) {
  double all = 0.0, with = 0.0;
  while (all < seconds) {
    const int n = choice.now();
    const double step = cost(n);
    choice.stepped(step);
    all += step;
    if (n == threads) with += step;
  }
  return with / all;
}

double one_is_quicker(int n) {
  return n == 1 ? 1e-4 : 16e-3;
}
double more_are_quicker(int n) {
  return 1e-3 / n;
}

TEST(ThreadChoice, TakesTheQuickest) {
  ThreadChoice alone(1), two(2), eight(8);
  EXPECT_EQ(part_with(alone, 1, 10.0, one_is_quicker), 1.0);
  EXPECT_GT(part_with(two, 1, 100.0, one_is_quicker), 0.95);
  EXPECT_GT(part_with(eight, 8, 100.0, more_are_quicker), 0.95);
  ThreadChoice middle(8);
  EXPECT_GT(part_with(middle, 4, 100.0, [](int n) { return n == 4 ? 1e-3 : 2e-3; }), 0.95);
}

TEST(ThreadChoice, FollowsWhatOthersDo) {
  ThreadChoice choice(2);
  part_with(choice, 2, 20.0, more_are_quicker);
  part_with(choice, 1, 3.0, one_is_quicker);
  EXPECT_GT(part_with(choice, 1, 20.0, one_is_quicker), 0.95);
  part_with(choice, 2, 5.0, more_are_quicker);
  EXPECT_GT(part_with(choice, 2, 20.0, more_are_quicker), 0.95);
}

// A step of a very large model takes longer than a trial of others.
TEST(ThreadChoice, LargeStepsAreTriedTwice) {
  ThreadChoice choice(2);
  for (const int threads : {2, 2, 1, 1, 2}) {
    EXPECT_EQ(choice.now(), threads);
    choice.stepped(threads == 2 ? 0.3 : 0.5);
  }
}

/// A thread beside which others compute keeps to its share; the others do not notice.
TEST(KeepToThreads, IsForOneThread) {
  const int before = omp_get_max_threads(), most = most_threads();
  EXPECT_EQ(most, omp_get_num_procs());
  int loops = 0, chosen = 0;
  std::thread([&] {
    keep_to_threads(3);
    loops = omp_get_max_threads();
    chosen = most_threads();
  }).join();
  EXPECT_EQ(loops, 3);
  EXPECT_EQ(chosen, 3);
  EXPECT_EQ(omp_get_max_threads(), before);
  EXPECT_EQ(most_threads(), most);
}

}  // namespace
}  // namespace edda::threads_test
