#include "model/table/quantity.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <string>

namespace edda::quantity_test {
namespace {

using D = Dimension;

double value(const std::string& text, D dimension) {
  const Quantity q = parse_quantity(text, dimension);
  EXPECT_TRUE(q.value.has_value()) << q.problem;
  return q.value.value_or(-12345.0);
}

std::string problem(const std::string& text, D dimension) {
  const Quantity q = parse_quantity(text, dimension);
  EXPECT_FALSE(q.value.has_value()) << text << " read as " << q.value.value_or(0.0);
  return q.problem;
}

TEST(Quantity, EveryUnit) {
  EXPECT_EQ(value("20 GPa", D::stress), 20e9);
  EXPECT_EQ(value("20GPa", D::stress), 20e9);
  EXPECT_EQ(value(" 50  kPa ", D::stress), 50e3);
  EXPECT_EQ(value("3 bar", D::stress), 3e5);
  EXPECT_EQ(value("1.5 MN/m2", D::stress), 1.5e6);
  EXPECT_EQ(value("2 N/mm2", D::stress), 2e6);
  EXPECT_EQ(value("2 N/mm\u00b2", D::stress), 2e6);
  EXPECT_EQ(value("26 kN/m3", D::unit_weight), 26e3);
  EXPECT_EQ(value("26 kN/m^3", D::unit_weight), 26e3);
  EXPECT_EQ(value("26 kN m-3", D::unit_weight), 26e3);
  EXPECT_EQ(value("2700 kg/m3", D::density), 2700.0);
  EXPECT_EQ(value("2.7 t/m3", D::density), 2.7e3);
  EXPECT_EQ(value("2.5 g/cm3", D::density), 2500.0);
  EXPECT_EQ(value("5 cm", D::length), 0.05);
  EXPECT_EQ(value("-3 mm", D::length), -0.003);
  EXPECT_EQ(value("+3 km", D::length), 3000.0);
  EXPECT_EQ(value("12 um", D::length), 12e-6);
  EXPECT_EQ(value("12 \u00b5m", D::length), 12e-6);
  EXPECT_EQ(value("8 GPa/m", D::joint_stiffness), 8e9);
  EXPECT_EQ(value("8 GN/m3", D::joint_stiffness), 8e9);
  EXPECT_EQ(value("200 MN/m", D::stiffness), 200e6);
  EXPECT_EQ(value("200 MPa", D::stiffness), 200e6);
  EXPECT_EQ(value("2 ms", D::time), 0.002);
  EXPECT_EQ(value("2 min", D::time), 120.0);
  EXPECT_EQ(value("1.5 h", D::time), 5400.0);
  EXPECT_EQ(value("1e-3 s", D::time), 1e-3);
  EXPECT_EQ(value("0.5 m/s", D::velocity), 0.5);
  EXPECT_EQ(value("36 km/h", D::velocity), 10.0);
  EXPECT_EQ(value("9.81 m/s2", D::acceleration), 9.81);
  EXPECT_EQ(value("9.81 m/s/s", D::acceleration), 9.81);
  EXPECT_EQ(value("5 1/s", D::rate), 5.0);
  EXPECT_EQ(value("5 /s", D::rate), 5.0);
  EXPECT_EQ(value("5 Hz", D::rate), 5.0);
  EXPECT_EQ(value("1 %", D::plain), 0.01);
  EXPECT_EQ(value("3 deg", D::angle), 3.0);
  EXPECT_EQ(value("3\u00b0", D::angle), 3.0);
  EXPECT_DOUBLE_EQ(value("0.5 rad", D::angle), 90.0 / std::numbers::pi);
  EXPECT_EQ(value("2 rad/s", D::angular_velocity), 2.0);
  EXPECT_DOUBLE_EQ(value("180 deg/s", D::angular_velocity), std::numbers::pi);
}

TEST(Quantity, DecimalPrefixesRoundOnce) {
  for (int i = 1; i < 1000; ++i) {
    const std::string text = std::to_string(i);
    EXPECT_EQ(value(text + " cm", D::length), std::stod(text + "e-2"));
    EXPECT_EQ(value(text + " mm", D::length), std::stod(text + "e-3"));
    EXPECT_EQ(value(text + " GPa", D::stress), std::stod(text + "e9"));
  }
}

TEST(Quantity, WhatIsWrong) {
  EXPECT_EQ(problem("20 GPa", D::length), "\"20 GPa\" is not a length");
  EXPECT_EQ(problem("20 m", D::stiffness), "\"20 m\" is not a stiffness");
  EXPECT_EQ(problem("5 kg/s2/m2", D::stiffness), "\"5 kg/s2/m2\" is not a stiffness");
  EXPECT_EQ(problem("3 rad", D::plain), "\"3 rad\" is not a number");
  EXPECT_EQ(problem("stiff", D::stress), "\"stiff\" is not a stress");
  EXPECT_EQ(problem("", D::stress), "\"\" is not a stress");
  EXPECT_EQ(problem("-", D::stress), "\"-\" is not a stress");
  EXPECT_EQ(problem("nan Pa", D::stress), "\"nan Pa\" is not a stress");
  EXPECT_EQ(problem("inf m", D::length), "\"inf m\" is not a length");
  EXPECT_EQ(problem("5", D::length), "\"5\" has no unit");
  EXPECT_EQ(problem("0.5", D::plain), "\"0.5\" is a string, not a number");
  EXPECT_EQ(problem("5 ft", D::length), "\"5 ft\" has an unknown unit, ft");
  EXPECT_EQ(problem("5 mPA", D::stress), "\"5 mPA\" has an unknown unit, mPA");
  EXPECT_EQ(problem("1_000 m", D::length), "\"1_000 m\" has an unknown unit, _000 m");
  EXPECT_EQ(problem("1,5 m", D::length), "\"1,5 m\" has an unknown unit, ,5 m");
  EXPECT_EQ(problem("5 m/", D::length), "\"5 m/\" has an unknown unit, m/");
  EXPECT_EQ(problem("5 m//s", D::velocity), "\"5 m//s\" has an unknown unit, m//s");
  EXPECT_EQ(problem("5 m0", D::length), "\"5 m0\" is not a length");
  EXPECT_EQ(problem("1e999 m", D::length), "\"1e999 m\" is out of range");
  EXPECT_EQ(problem("5 m m m m m m m m m m", D::length).substr(0, 6), "\"5 m m");
  const std::string many(100000, 'm');
  EXPECT_LT(problem("5 " + many, D::length).size(), 200U);
}

}  // namespace
}  // namespace edda::quantity_test
