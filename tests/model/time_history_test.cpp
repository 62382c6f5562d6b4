#include "model/files/time_history.hpp"

#include <gtest/gtest.h>

namespace edda::time_history_test {
namespace {

TEST(TimeHistory, IsLinearBetweenRowsAndConstantBeyond) {
  const auto read = parse_time_history("# a comment\n\ntime , factor\r\n0.5, 1\n1.5,3e0\n+2,-1",
                                       "f.csv", "load.0.history");
  ASSERT_TRUE(read.ok());
  const TimeHistory& h = read.value();
  EXPECT_EQ(h.at(0.0, 9.0), 1.0);
  EXPECT_EQ(h.at(0.5, 9.0), 1.0);
  EXPECT_EQ(h.at(1.0, 9.0), 2.0);
  EXPECT_EQ(h.at(1.75, 9.0), 1.0);
  EXPECT_EQ(h.at(5.0, 9.0), -1.0);
  EXPECT_EQ(TimeHistory{}.at(5.0, 9.0), 9.0);
}

/// Spreadsheets begin a CSV file in UTF-8 with a byte order mark.
TEST(TimeHistory, SkipsAByteOrderMark) {
  for (const std::string names : {"", "time,factor\n"}) {
    const auto read = parse_time_history("\xEF\xBB\xBF" + names + "0,1\n1,3\n", "f.csv", "k");
    ASSERT_TRUE(read.ok()) << to_string(read.faults()[0]);
    EXPECT_EQ(read.value().at(0.5, 9.0), 2.0);
  }
}

TEST(TimeHistory, ReportsWhatIsWrongAndWhere) {
  struct Case {
    std::string text;
    int line;
    std::string problem;
  };
  for (const Case& c :
       {Case{"", 0, "has no rows"}, Case{"time,x\n", 0, "has no rows"},
        Case{"0,1\n1\n", 2, "is not two numbers"}, Case{"0,1\n1,two\n", 2, "is not two numbers"},
        Case{"0,1\n1,2,3\n", 2, "is not two numbers"},
        Case{"0,1\n1,inf\n", 2, "is not two numbers"},
        Case{"time,x\nname,y\n", 2, "is not two numbers"},
        Case{"0,1\n0,2\n", 2, "does not come after"},
        Case{"# push\nfactor,time\n0,1\n", 2, "in another order: factor,time"},
        Case{"0,1\n2,1\n1,1\n", 3, "does not come after"}}) {
    const auto read = parse_time_history(c.text, "f.csv", "load.0.history");
    ASSERT_FALSE(read.ok()) << c.text;
    const Fault& f = read.faults().front();
    EXPECT_EQ(f.where.file, "f.csv");
    EXPECT_EQ(f.where.key, "load.0.history");
    EXPECT_EQ(f.where.line, c.line) << c.text;
    EXPECT_NE(f.problem.find(c.problem), std::string::npos) << f.problem;
    EXPECT_FALSE(f.remedy.empty());
  }
}

}  // namespace
}  // namespace edda::time_history_test
