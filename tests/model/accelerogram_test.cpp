#include "model/files/accelerogram.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace edda::accelerogram_test {
namespace {

constexpr double g = 9.80665;

Shaking of_record(Accelerogram record) {
  Shaking s;
  s.acceleration.file = "f.csv";
  s.record = std::move(record);
  return s;
}

TEST(Accelerogram, RowsAreLinearBetweenAndZeroBeyond) {
  const auto read =
      parse_acceleration_rows("time,ax,ay\n0.5,0,1\n1.5,2,1\n2,0,0\n", {}, "f.csv", "k");
  ASSERT_TRUE(read.ok());
  const Shaking s = of_record(read.value());
  EXPECT_EQ(acceleration_at(s, 0.4), (Vec2{0.0, 0.0}));
  EXPECT_EQ(acceleration_at(s, 0.5), (Vec2{0.0, 1.0}));
  EXPECT_EQ(acceleration_at(s, 1.0), (Vec2{1.0, 1.0}));
  EXPECT_EQ(acceleration_at(s, 1.75), (Vec2{1.0, 0.5}));
  EXPECT_EQ(acceleration_at(s, 2.5), (Vec2{0.0, 0.0}));
  EXPECT_EQ(velocity_at(s, 0.1), (Vec2{0.0, 0.0}));
  EXPECT_EQ(velocity_at(s, 1.0), (Vec2{0.25, 0.5}));
  EXPECT_EQ(velocity_at(s, 2.0), (Vec2{1.5, 1.25}));
  EXPECT_EQ(velocity_at(s, 9.0), (Vec2{1.5, 1.25}));
}

/// The velocity is the integral of the acceleration, between the rows, too.
TEST(Accelerogram, VelocityIsTheIntegral) {
  Shaking sine;
  sine.scale = 1.5;
  sine.acceleration.amplitude = 2.0;
  sine.acceleration.frequency = 3.0;
  sine.acceleration.direction = {3.0, -4.0};
  const auto read =
      parse_acceleration_rows("0,1,-1\n0.1,2,0.5\n0.3,-4,0.25\n0.35,0,1\n", {}, "f.csv", "k");
  ASSERT_TRUE(read.ok());
  for (const Shaking& s : {sine, of_record(read.value())}) {
    Vec2 v;
    const double dt = 1e-5;
    for (int n = 0; n < 50000; ++n) v += dt * acceleration_at(s, (n + 0.5) * dt);
    EXPECT_NEAR(v.x, velocity_at(s, 0.5).x, 1e-4);
    EXPECT_NEAR(v.y, velocity_at(s, 0.5).y, 1e-4);
  }
  const double peak = 3.0 / (6.0 * std::numbers::pi) * 2.0;
  EXPECT_NEAR(velocity_at(sine, 1.0 / 6.0).x, 0.6 * peak, 1e-12);
  EXPECT_NEAR(acceleration_at(sine, 1.0 / 12.0).y, -0.8 * 3.0, 1e-12);
}

TEST(Accelerogram, NamesThatAreNotKnownGoByPosition) {
  for (const char* names : {"time,east,up\n", "t,ax (m/s2),vertical\n", "Time (s), X, Y\n"}) {
    const auto read =
        parse_acceleration_rows(std::string(names) + "0,1,2\n1,3,4\n", {}, "f.csv", "k");
    ASSERT_TRUE(read.ok()) << to_string(read.faults().front());
    EXPECT_EQ(read.value().acceleration[1], (Vec2{3.0, 4.0})) << names;
  }
}

TEST(Accelerogram, ReadsBothHeadsOfPeer) {
  const std::string body = "  .1  -.2\n 3.0E-01\n";
  for (const std::string head :
       {"a\nb\nACCELERATION TIME SERIES IN UNITS OF G\nNPTS=  3, DT= .0050 SEC,\n",
        "a\nb\nACCELERATION TIME HISTORY IN UNITS OF G\n   3   0.0050   NPTS, DT\r\n"}) {
    const auto read = parse_at2(head + body, {{0.0, 2.0}, 1, {}}, "f.AT2", "k");
    ASSERT_TRUE(read.ok()) << to_string(read.faults().front());
    EXPECT_EQ(read.value().time, (std::vector<double>{0.0, 0.005, 0.01}));
    EXPECT_EQ(read.value().acceleration[2], (Vec2{0.0, 0.3 * g}));
  }
}

TEST(Accelerogram, ReportsWhatIsWrongAndWhere) {
  struct Case {
    bool peer;
    std::string text;
    int line;
    std::string problem;
  };
  const std::string head = "a\nb\nIN UNITS OF G\nNPTS= 2, DT= .01 SEC\n";
  for (const Case& c :
       {Case{true, "", 0, "no line with NPTS and DT"},
        Case{true, "1 2 3\n", 0, "no line with NPTS"},
        Case{true, "a\nb\nIN UNITS OF VOLTS\nNPTS= 2, DT= .01\n", 3, "not in units of g"},
        Case{true, "a\nb\nc\nNPTS= two, DT= .01\n", 4, "no NPTS and DT"},
        Case{true, "a\nb\nc\nNPTS= 2, DT= 0\n", 4, "no NPTS and DT"},
        Case{true, head + "0.1 x\n", 5, "no number"}, Case{true, head + "0.1\n", 0, "holds 1"},
        Case{true, head + "0.1 0.2\n0.3", 0, "holds 3"}, Case{false, "0,1\n", 1, "has two columns"},
        Case{false, "0,1,x\n", 1, "is not three numbers"}, Case{false, "", 0, "has no rows"},
        Case{false, "0,1,2\n0,1,2\n", 2, "does not come after"},
        Case{false, "time,ay,ax\n0,1,2\n", 1, "in another order: time,ay,ax"},
        Case{false, "T (s), Ay (m/s2), east\n0,1,2\n", 1, "in another order"},
        Case{false, "-1,1,2\n0,1,2\n", 0, "begins before time 0"}}) {
    const auto read = c.peer ? parse_at2(c.text, {}, "f", "shaking.q.acceleration")
                             : parse_acceleration_rows(c.text, {}, "f", "shaking.q.acceleration");
    ASSERT_FALSE(read.ok()) << c.text;
    const Fault& f = read.faults().front();
    EXPECT_EQ(f.where.line, c.line) << c.text;
    EXPECT_EQ(f.where.key, "shaking.q.acceleration");
    EXPECT_NE(f.problem.find(c.problem), std::string::npos) << f.problem;
    EXPECT_FALSE(f.remedy.empty());
  }
}

}  // namespace
}  // namespace edda::accelerogram_test
