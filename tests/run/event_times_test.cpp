#include "run/event_times.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace edda::event_times_test {
namespace {

TEST(EventTimes, RowsFramesAndTheEndInOrder) {
  EventTimes times(0.3, 0.5);
  times.end_at(1.0);
  const struct {
    double time;
    bool row, frame, end;
  } expected[] = {{0.0, true, true, false},  {0.3, true, false, false}, {0.5, false, true, false},
                  {0.6, true, false, false}, {0.9, true, false, false}, {1.0, true, true, true}};
  for (const auto& e : expected) {
    const Event got = times.next();
    EXPECT_DOUBLE_EQ(got.time, e.time);
    EXPECT_EQ(got.row, e.row) << e.time;
    EXPECT_EQ(got.frame, e.frame) << e.time;
    EXPECT_EQ(got.end, e.end) << e.time;
  }
}

TEST(EventTimes, NoRoundingPilesUp) {
  EventTimes times(0.001, 0.01);
  times.end_at(100.0);
  std::uint64_t rows = 0, frames = 0;
  for (Event e = times.next();; e = times.next()) {
    EXPECT_EQ(e.time, static_cast<double>(rows) / 1000.0);
    rows += e.row;
    frames += e.frame;
    EXPECT_TRUE(e.row);
    if (e.end) break;
  }
  EXPECT_EQ(rows, 100001u);
  EXPECT_EQ(frames, 10001u);
}

TEST(EventTimes, IntervalsLongerThanTheRun) {
  EventTimes times(5.0, 7.0);
  times.end_at(0.1);
  EXPECT_EQ(times.next().time, 0.0);
  const Event end = times.next();
  EXPECT_EQ(end.time, 0.1);
  EXPECT_TRUE(end.end && end.row && end.frame);
}

/// A stage may end between multiples, by its duration or in equilibrium; the next multiple is the
/// same.
TEST(EventTimes, GoesOnAfterAStage) {
  EventTimes times(0.3, 0.5);
  times.end_at(0.4);
  EXPECT_EQ(times.next().time, 0.0);
  EXPECT_EQ(times.next().time, 0.3);
  Event e = times.next();
  EXPECT_EQ(e.time, 0.4);
  EXPECT_TRUE(e.end && e.row && e.frame);
  times.end_at(2.0);
  e = times.next();
  EXPECT_EQ(e.time, 0.5);
  EXPECT_TRUE(e.frame && !e.row && !e.end);
  e = times.next();
  EXPECT_EQ(e.time, 0.6);
  times.put_back(e);  // in equilibrium before it
  times.end_at(3.0);
  e = times.next();
  EXPECT_EQ(e.time, 0.6);
  EXPECT_TRUE(e.row && !e.frame);
}

TEST(EventTimes, MultiplesReadAsDecimals) {
  EXPECT_EQ(multiple(3, 0.1), 0.3);
  EXPECT_EQ(multiple(7, 0.01), 0.07);
  EXPECT_EQ(multiple(3, 2.5), 7.5);
  EXPECT_EQ(multiple(3, 0.3), 0.9);
  EXPECT_EQ(multiple(7, 1e-9), 7e-9);
  EXPECT_EQ(multiple(2, 1.0 / 3.0), 2.0 / 3.0);
}

}  // namespace
}  // namespace edda::event_times_test
