// How often each place belongs to a key block.
#include "sampling/place_map.hpp"

#include <gtest/gtest.h>

namespace edda {
namespace {

TEST(PlaceMap, TextComesBackAsItWasWritten) {
  constexpr AtPlace n = AtPlace::no_rock, r = AtPlace::rock, k = AtPlace::key_block;
  const std::vector<AtPlace> places{n, n, r, k, k, k, n};
  EXPECT_EQ(places_text(places), "2n1r3k1n");
  EXPECT_EQ(places_in("2n1r3k1n", 7), places);
  EXPECT_EQ(places_text(std::vector<AtPlace>(1000, r)), "1000r");
  for (const char* wrong : {"", "2n1r3k", "2n1r3k2n", "2n1x3k1n", "2n1r3k1", "n", "-2n9r"})
    EXPECT_TRUE(places_in(wrong, 7).empty()) << wrong;
}

TEST(PlaceMap, KeyBlocksOfLaterGenerationsAreRock) {
  EXPECT_EQ(what_is_at({}, 1), AtPlace::no_rock);
  EXPECT_EQ(what_is_at(0, 1), AtPlace::rock);
  EXPECT_EQ(what_is_at(1, 1), AtPlace::key_block);
  EXPECT_EQ(what_is_at(2, 1), AtPlace::rock);
  EXPECT_EQ(what_is_at(2, 2), AtPlace::key_block);
}

TEST(PlaceMap, CountsTheSamplesThatHaveAnAnswer) {
  StudyPlan plan;
  plan.ask.resize(1);
  plan.map = StudyMap{1.0, {{0, 0}, {3, 0}, {3, 1}, {0, 1}}, 1, {}};
  StudyRun run;
  run.samples = 4;
  run.rows[0] = {{"1", "1n2k"}, ""};
  run.rows[1] = {{"1", "2r1k"}, ""};
  run.rows[2] = {{"", ""}, "no answer"};
  run.rows[3] = {{"1", "1n2r"}, ""};
  run.rows[4] = {{"1", "3k"}, ""};  // beyond those that count
  const KeyBlockMap map = key_block_map(plan, run);
  EXPECT_EQ(map.samples, 3u);
  EXPECT_EQ(map.rock, (std::vector<std::size_t>{1, 3, 3}));
  EXPECT_EQ(map.key, (std::vector<std::size_t>{0, 1, 2}));
  EXPECT_EQ(map.most(), 2u);
  EXPECT_EQ(map.part(2), 2.0 / 3.0);
}

}  // namespace
}  // namespace edda
