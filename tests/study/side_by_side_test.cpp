// Tasks that run side by side: how many, on what threads, and what becomes of them when they are
// stopped or fail.
#include "study/side_by_side.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <atomic>
#include <chrono>
#include <limits>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

namespace edda::side_by_side_test {
namespace {

/// Makes no result; ends when asked to.
void wait_for_stop(const std::stop_token& stop) {
  while (!stop.stop_requested()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

TEST(SideBySide, RunsAsManyAtATimeAsThereAreThreads) {
  for (const int threads : {1, 2, 3, 4}) {
    SideBySide tasks(threads, 3);
    EXPECT_EQ(tasks.places(), static_cast<std::size_t>(std::min(threads, 3)));
    std::vector<int> squares(10, -1);
    std::set<std::size_t> over;
    std::size_t begun = 0;
    while (over.size() < squares.size()) {
      while (begun < squares.size() && tasks.has_room()) {
        int& square = squares[begun];
        const int k = static_cast<int>(begun);
        EXPECT_EQ(tasks.begin([&square, k](const std::stop_token&) { square = k * k; }), begun);
        ++begun;
      }
      EXPECT_LE(begun - over.size(), tasks.places());
      over.insert(tasks.wait_for_one());
    }
    for (std::size_t k = 0; k < squares.size(); ++k) EXPECT_EQ(squares[k], static_cast<int>(k * k));
  }
}

/// The threads of what runs beside each other, together, are those that were given.
TEST(SideBySide, SharesTheThreads) {
  const int before = omp_get_max_threads();
  for (const auto& [threads, tasks, share] :
       {std::tuple{4, 4, 1}, {4, 2, 2}, {5, 2, 2}, {2, 4, 1}}) {
    SideBySide both(threads, tasks);
    int inside = 0;
    both.begin([&](const std::stop_token&) { inside = omp_get_max_threads(); });
    both.wait_for_one();
    EXPECT_EQ(inside, share) << threads << " for " << tasks;
    EXPECT_EQ(omp_get_max_threads(), before);
  }
}

/// Where there is room for one alone nothing is different from calling it.
TEST(SideBySide, OneAloneRunsHere) {
  SideBySide tasks(4, 1);
  std::thread::id ran;
  int inside = 0;
  tasks.begin([&](const std::stop_token&) {
    ran = std::this_thread::get_id();
    inside = omp_get_max_threads();
  });
  EXPECT_FALSE(tasks.has_room());
  EXPECT_EQ(ran, std::thread::id());
  tasks.wait_for_one();
  EXPECT_TRUE(tasks.has_room());
  EXPECT_EQ(ran, std::this_thread::get_id());
  EXPECT_EQ(inside, omp_get_max_threads());
}

TEST(SideBySide, StopsTheOneThatIsNamed) {
  for (const int threads : {1, 2, 3}) {
    std::atomic<int> stopped{0};
    SideBySide tasks(threads, threads);
    std::vector<std::size_t> begun;
    while (tasks.has_room()) {
      begun.push_back(tasks.begin([&](const std::stop_token& stop) {
        wait_for_stop(stop);
        ++stopped;
      }));
    }
    tasks.stop(begun.back());
    EXPECT_FALSE(tasks.has_room());
    EXPECT_EQ(tasks.wait_for_one(), begun.back());
    EXPECT_EQ(stopped, 1);
    EXPECT_TRUE(tasks.has_room());
  }
}

TEST(SideBySide, StopsAllAtItsEnd) {
  std::atomic<int> stopped{0};
  {
    SideBySide tasks(3, 3);
    while (tasks.has_room()) {
      tasks.begin([&](const std::stop_token& stop) {
        wait_for_stop(stop);
        ++stopped;
      });
    }
  }
  EXPECT_EQ(stopped, 3);
}

/// What one task throws reaches the caller, and the others are stopped.
TEST(SideBySide, CarriesOverWhatIsThrown) {
  for (const int threads : {1, 2, 4}) {
    std::atomic<int> stopped{0};
    const auto fail = [&] {
      SideBySide tasks(threads, threads);
      tasks.begin([](const std::stop_token&) { throw std::runtime_error("no room"); });
      while (tasks.has_room()) {
        tasks.begin([&](const std::stop_token& stop) {
          wait_for_stop(stop);
          ++stopped;
        });
      }
      tasks.wait_for_one();
    };
    EXPECT_THROW(fail(), std::runtime_error);
    EXPECT_EQ(stopped, threads - 1);
  }
}

TEST(SideBySide, TakesHalfOfTheMemory) {
  constexpr double gigabyte = 1e9;
  EXPECT_EQ(tasks_within(16.0 * gigabyte, 8, 1000), 8);
  EXPECT_EQ(tasks_within(16.0 * gigabyte, 8, 40000), 4);
  EXPECT_EQ(tasks_within(16.0 * gigabyte, 2, 40000), 2);
  EXPECT_EQ(tasks_within(16.0 * gigabyte, 8, 10000000), 1);
  EXPECT_EQ(tasks_within(std::numeric_limits<double>::infinity(), 8, 10000000), 8);
}

}  // namespace
}  // namespace edda::side_by_side_test
