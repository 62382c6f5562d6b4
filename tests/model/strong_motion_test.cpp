// Records of strong-motion networks, each written here as its network writes them.
#include "model/files/strong_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <string>

#include "model/files/accelerogram.hpp"
#include "scratch_folder.hpp"

namespace edda::strong_motion_test {
namespace {

std::string number(double x, const char* form) {
  char text[40];
  std::snprintf(text, sizeof text, form, x);
  return text;
}

std::string columns(const std::vector<double>& values, const char* form, std::size_t in_row) {
  std::string text;
  for (std::size_t i = 0; i < values.size(); ++i) {
    text += number(values[i], form);
    if ((i + 1) % in_row == 0 || i + 1 == values.size()) text += '\n';
  }
  return text;
}

std::string k_net(const std::string& data, const std::string& largest) {
  return "Origin Time       2011/03/11 14:46:00\nLat.              38.103\nLong.             "
         "142.860\n"
         "Depth. (km)       24\nMag.              9.0\nStation Code      MYG004\nStation Lat.      "
         "38.7292\nStation Long.     141.0217\nStation Height(m) 40\nRecord Time       2011/03/11 "
         "14:46:36\nSampling Freq(Hz) 100Hz\nDuration Time(s)  300\nDir.              N-S\n"
         "Scale Factor      2000(gal)/8000000\nMax. Acc. (gal)   " +
         largest + "\nLast Correction   2011/03/11 14:46:21\nMemo.             \n" + data;
}

std::string esm(const std::string& unit) {
  return "EVENT_NAME: NONE\nEVENT_ID: X\nSTREAM: HNE\nDATE_TIME_FIRST_SAMPLE_YYYYMMDD_HHMMSS: "
         "20161030_064012.000\nSAMPLING_INTERVAL_S: 0.005000\nNDATA: 4\nDURATION_S: 0.015\n"
         "PGA_CM/S^2: -50.0\nUNITS: " +
         unit + "\nDATA_TYPE: ACCELERATION\nUSER1: \nUSER5:\n0.0\n10.0\n-50.0\n1.0e1\n";
}

/// Three components of GeoNet, the k-th with k as its second value.
std::string geonet(bool raw) {
  std::string text;
  for (int k = 1; k <= 3; ++k) {
    text += raw ? "Uncorrected accelerogram 2016 GNS Science\n"
                : "Corrected accelerogram GNS Science\n";
    for (int i = 1; i < 16; ++i) text += "text of line " + std::to_string(i) + "\n";
    std::vector<double> head(100, 0.0);
    head[raw ? 30 : 33] = 12;
    head[34] = raw ? 0 : 12;
    head[35] = raw ? 0 : 12;
    head[40] = raw ? 200.0 : 25.0;
    head[65] = 0.02;
    text += columns({head.begin(), head.begin() + 40}, "%8.0f", 10);
    text += columns({head.begin() + 40, head.end()}, "%8.3f", 10);
    std::vector<double> values(12, -10000.0);
    values[0] = 0.0;
    values[1] = k;
    for (int block = 0; block < (raw ? 1 : 3); ++block) text += columns(values, "%8.1f", 10);
  }
  return text;
}

std::string cosmos(int component, const std::string& unit = "cm/sec2") {
  std::vector<double> head(100, -999.0);
  head[61] = 5.0;  // ms
  std::vector<double> values = {0.0, 10.0 * component, -123.45, 12.0, 0.0, 0.0, 0.0, 1000.0, -20.0};
  return "Corrected acceleration   (Format v01.20 with 13 text lines) Src: 052x0000.smc\n" +
         std::string("Earthquake\n|text\n") +
         " 100 Integer-header values follow on 10 lines, Format= (10I8)\n" +
         columns(std::vector<double>(100, 1.0), "%8.0f", 10) +
         " 100 Real-header values follow on 17 lines, Format= (6F13.6)\n" +
         columns(head, "%13.6f", 6) +
         "   1 Comment line(s) follow, each starting with a \"|\":\n|\n" +
         "       9 acceleration pts, approx    0 secs, units=" + unit + " (04),Format=(8F10.5)\n" +
         columns(values, "%10.5f", 8) + "End-of-data for Chan  1 acceleration\n";
}

std::string csmip() {
  return "Corrected accelerogram\nx\n" +
         std::string(
             "   5 points of accel data equally spaced at  .020 sec, in cm/sec2. (8f10.3)\n") +
         columns({0.0, 5.0, -100.0, -2000.5, 1.0}, "%10.3f", 8) +
         "   5 points of veloc data equally spaced at  .020 sec, in cm/sec.  (8f10.3)\n" +
         columns({9, 9, 9, 9, 9}, "%10.3f", 8);
}

StrongMotion motion(const std::string& text, int component = 1) {
  const auto read = read_strong_motion(text, component, "r", "shaking.0.acceleration");
  EXPECT_TRUE(read.has_value());
  if (!read) return {};
  EXPECT_TRUE(read->ok()) << to_string(read->faults().front());
  return read->ok() ? read->value() : StrongMotion{};
}

void expect_values(const StrongMotion& m, double step, const std::vector<double>& values) {
  EXPECT_NEAR(m.step, step, 1e-12);
  ASSERT_EQ(m.acceleration.size(), values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    EXPECT_NEAR(m.unit * m.acceleration[i], values[i], 1e-9) << i;
  }
}

/// 2000 gal over 8 million counts: 4000 counts are 1 gal. Their mean is an offset, unless the
/// head's largest acceleration is one with it.
TEST(StrongMotion, KNet) {
  const std::string data =
      "    4000     8000    -8000     4000     4000     4000     4000     4000\n"
      "    4000     4000\n";
  expect_values(motion(k_net(data, "2.0")), 0.01,
                {0.01, 0.02, -0.02, 0.01, 0.01, 0.01, 0.01, 0.01, 0.01, 0.01});
  const double mean = 0.008;
  expect_values(motion(k_net(data, "2.8")), 0.01,
                {0.01 - mean, 0.02 - mean, -0.02 - mean, 0.01 - mean, 0.01 - mean, 0.01 - mean,
                 0.01 - mean, 0.01 - mean, 0.01 - mean, 0.01 - mean});
}

TEST(StrongMotion, Esm) {
  expect_values(motion(esm("cm/s^2")), 0.005, {0.0, 0.1, -0.5, 0.1});
  expect_values(motion(esm("g")), 0.005, {0.0, 98.0665, -490.3325, 98.0665});
}

TEST(StrongMotion, GeoNetByComponents) {
  for (int k = 1; k <= 3; ++k) {
    std::vector<double> expected(12, -10.0);
    expected[0] = 0.0;
    expected[1] = 1e-3 * k;
    expect_values(motion(geonet(true), k), 0.005, expected);
    expect_values(motion(geonet(false), k), 0.02, expected);
  }
}

TEST(StrongMotion, CosmosAndCsmip) {
  const std::vector<double> expected = {0.0, 0.1, -1.2345, 0.12, 0.0, 0.0, 0.0, 10.0, -0.2};
  expect_values(motion(cosmos(1)), 0.005, expected);
  const StrongMotion second = motion(cosmos(1) + cosmos(2), 2);
  EXPECT_NEAR(second.acceleration.at(1), 20.0, 1e-12);
  expect_values(motion(csmip()), 0.02, {0.0, 0.05, -1.0, -20.005, 0.01});
}

TEST(StrongMotion, UnitsInAllSpellings) {
  for (const char* gal :
       {"cm/s^2", "cm/sec2", "CM/SEC/SEC", "cm/s/s", "gal", "cm/s**2", " cm/s2 "}) {
    EXPECT_EQ(acceleration_unit(gal), 0.01) << gal;
  }
  EXPECT_EQ(acceleration_unit("g"), 9.80665);
  EXPECT_EQ(acceleration_unit("m/sec^2"), 1.0);
  EXPECT_EQ(acceleration_unit("mm/s/s"), 1e-3);
  EXPECT_FALSE(acceleration_unit("V").has_value());
}

TEST(StrongMotion, WhatIsWrongIsNamed) {
  const auto expect = [](const std::string& text, int component, const std::string& problem) {
    const auto read = read_strong_motion(text, component, "r", "key");
    ASSERT_TRUE(read.has_value()) << problem;
    ASSERT_FALSE(read->ok()) << problem;
    EXPECT_NE(read->faults().front().problem.find(problem), std::string::npos)
        << read->faults().front().problem;
    EXPECT_FALSE(read->faults().front().remedy.empty());
  };
  const auto without = [](std::string text, const std::string& part, const std::string& by) {
    return text.replace(text.find(part), part.size(), by);
  };
  expect(geonet(true), 4, "has 3 components, and number 4 is asked for");
  expect(cosmos(1), 2, "has 1 component, and number 2");
  expect(cosmos(1, "furlongs"), 1, "which is no known unit");
  expect(esm(""), 1, "does not state the unit");
  expect(without(esm("g"), "NDATA: 4", "NDATA: 5"), 1,
         "holds 4 accelerations where its head says 5");
  expect(without(esm("g"), "DATA_TYPE: ACC", "DATA_TYPE: VEL"), 1, "no record of accelerations");
  expect(without(esm("g"), "10.0\n", "ten\n"), 1, "\"ten\" in place of a number");
  expect(without(k_net("1 2\n", "1"), "Memo.", "Mem"), 1, "no line Memo.");
  expect(without(k_net("1 2\n", "1"), "100Hz", "-"), 1, "step between");
  expect(without(k_net("1 2\n", "1"), "/8000000", ""), 1, "no Scale Factor");
  EXPECT_FALSE(read_strong_motion("time,ax,ay\n0,1,2\n", 1, "r", "key").has_value());
  EXPECT_FALSE(read_strong_motion("", 1, "r", "key").has_value());
}

std::string written(const ScratchFolder& folder, const std::string& name, const std::string& text) {
  std::ofstream(folder.at(name)) << text;
  return folder.at(name);
}

/// One component beside the time: the unit stands in the file or in the model.
TEST(Accelerogram, TimeAndOneComponent) {
  const ScratchFolder folder;
  constexpr double g = 9.80665;
  const auto read = [&](const std::string& text, const RecordReading& how) {
    return read_accelerogram(written(folder, "r.csv", text), how, "shaking.0.acceleration");
  };
  for (const char* text : {"# one component\n# Time (s),Acceleration (g)\n0.0,0.0\n0.01,0.5\n",
                           "time,g\n0.0,0.0\n0.01,0.5\n", "time [s];acc [g]\n0.0;0.0\n0.01;0.5\n",
                           "t\ta (g)\n0.0\t0.0\n0.01\t0.5\n"}) {
    const auto record = read(text, {{0.0, 2.0}, 1, {}});
    ASSERT_TRUE(record.ok()) << to_string(record.faults().front());
    EXPECT_EQ(record.value().time, (std::vector<double>{0.0, 0.01}));
    EXPECT_NEAR(record.value().acceleration[1].y, 0.5 * g, 1e-12) << text;
    EXPECT_EQ(record.value().acceleration[1].x, 0.0);
  }
  const auto bare = read("time,acceleration\n0,0\n0.01,0.5\n", {});
  ASSERT_FALSE(bare.ok());
  EXPECT_NE(bare.faults().front().problem.find("two columns"), std::string::npos);
  EXPECT_NE(bare.faults().front().remedy.find("shaking.units"), std::string::npos);
  const auto blanks = read("0.00 0.0\n0.01 0.5\n", {{1.0, 0.0}, 1, 0.01});
  ASSERT_TRUE(blanks.ok());
  EXPECT_NEAR(blanks.value().acceleration[1].x, 0.005, 1e-15);
  const auto three = read("time,ax (g),ay (g)\n0,0,0\n1,1,2\n", {});
  EXPECT_NEAR(three.value().acceleration[1].y, 2.0 * g, 1e-12);
}

/// Whatever the name of the file, its head says what it is; a text that is none is told what is
/// read.
TEST(Accelerogram, RecordsGoByTheirHeads) {
  const ScratchFolder folder;
  const auto read = [&](const std::string& name, const std::string& text, RecordReading how = {}) {
    return read_accelerogram(written(folder, name, text), how, "shaking.0.acceleration");
  };
  EXPECT_NEAR(read("a.asc", esm("cm/s^2")).value().acceleration[2].x, -0.5, 1e-12);
  EXPECT_EQ(read("a.asc", esm("cm/s^2")).value().read_as, "ESM record in cm/s^2");
  EXPECT_EQ(read("a.csv", "0,1\n1,2\n", {{1, 0}, 1, 0.01}).value().read_as,
            "time and one component in cm/s2");
  EXPECT_NEAR(read("a.NS", k_net("4000 8000\n", "2.0")).value().acceleration[1].x, 0.02, 1e-12);
  const RecordReading third{{0.0, 1.0}, 3, {}};
  EXPECT_NEAR(read("a.V1A", geonet(true), third).value().acceleration[1].y, 3e-3, 1e-12);
  EXPECT_NEAR(read("a.txt", "x\nNPTS= 2, DT= .01 SEC\n0.1 0.2\n").value().acceleration[1].x,
              0.2 * 9.80665, 1e-12);
  EXPECT_NEAR(
      read("a.AT2", "x\nIN UNITS OF CM/S/S\nNPTS= 2, DT= .01\n1 2\n").value().acceleration[1].x,
      0.02, 1e-12);
  const auto other = read("a.dat", "some text\nand more\n");
  ASSERT_FALSE(other.ok());
  for (const char* name : {"PEER", "K-NET", "COSMOS", "ESM", "GeoNet", "time"}) {
    EXPECT_NE(other.faults().front().remedy.find(name), std::string::npos) << name;
  }
}

}  // namespace
}  // namespace edda::strong_motion_test
