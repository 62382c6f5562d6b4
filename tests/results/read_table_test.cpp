#include "results/read_table.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "results/csv.hpp"
#include "results/files.hpp"
#include "scratch_folder.hpp"

namespace edda::read_table_test {
namespace {

Result<Table> read(const std::string& text) {
  const ScratchFolder folder;
  EXPECT_FALSE(write_file(folder.at("table.csv"), text));
  return read_table(folder.at("table.csv"));
}

TEST(ReadTable, ReadsBackWhatCsvWrites) {
  Csv csv;
  csv.add("t").add("name").end();
  csv.add(0.1).add("a, \"b\"\nc").end();
  csv.add(1e300).add("7").end();
  const Result<Table> table = read(csv.text());
  ASSERT_TRUE(table.ok());
  ASSERT_EQ(table.value().rows(), 2u);
  EXPECT_EQ(table.value().column("t")->values, (std::vector<double>{0.1, 1e300}));
  EXPECT_EQ(table.value().column("name")->texts, (std::vector<std::string>{"a, \"b\"\nc", "7"}));
  EXPECT_TRUE(table.value().column("t")->texts.empty());
  EXPECT_EQ(table.value().column("x"), nullptr);
}

// Bolts without a name are written as 0, 1, ...
TEST(ReadTable, NamesThatLookLikeNumbersAreTextsToo) {
  const Result<Table> numbers = read("n\n1\n2\n10\n");
  EXPECT_EQ(numbers.value().column("n")->text(2), "10");
  const Result<Table> mixed = read("n\n1\n2\na\n3\n");
  const Result<Table> zeros = read("n\n7\n07\n1\n");
  const auto texts = [](const Result<Table>& table) {
    std::vector<std::string> all;
    for (std::size_t r = 0; r < table.value().rows(); ++r)
      all.push_back(table.value().column("n")->text(r));
    return all;
  };
  EXPECT_EQ(texts(mixed), (std::vector<std::string>{"1", "2", "a", "3"}));
  EXPECT_EQ(texts(zeros), (std::vector<std::string>{"7", "07", "1"}));
}

TEST(ReadTable, LeavesOutARowThatIsNotComplete) {
  const Result<Table> table = read("a,b\n1,2\n3,");
  ASSERT_TRUE(table.ok());
  EXPECT_EQ(table.value().rows(), 1u);
  EXPECT_EQ(read("").value().rows(), 0u);
}

TEST(ReadTable, RefusesRowsOfOtherLengths) {
  const Result<Table> table = read("a,b\n1,2\n3\n");
  ASSERT_FALSE(table.ok());
  EXPECT_EQ(table.faults()[0].where.line, 3);
  EXPECT_FALSE(read_table(ScratchFolder().at("none.csv")).ok());
}

}  // namespace
}  // namespace edda::read_table_test
