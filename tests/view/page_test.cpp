#include "view/page.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "results/vtu.hpp"
#include "view/frames_of.hpp"

namespace edda {
namespace {

const std::vector<TestBlock> two{{0, {{0, 0}, {2, 0}, {2, 1}, {0, 1}}, false},
                                 {1, {{0, -1}, {2, -1}, {2, 0}, {0, 0}}, true}};

/// A results folder of its own, with `frames` frames of blocks that sink by 1 mm each.
class ViewPage : public testing::Test {
 protected:
  ViewPage()
      : folder_(testing::TempDir() + "view_page_" +
                testing::UnitTest::GetInstance()->current_test_info()->name()) {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_ + "/frames");
  }
  ~ViewPage() override { std::filesystem::remove_all(folder_); }

  void write_frames(std::size_t frames) {
    for (std::size_t k = series_.size(); k < frames; ++k) {
      const auto sink = [&](const TestBlock& b, Vec2) {
        return b.fixed ? Vec2{0.0, -9.0} : Vec2{0.0, -1e-3 * static_cast<double>(k)};
      };
      const auto place = [&](const TestBlock& b, Vec2 p) { return p + sink(b, p); };
      Grid g = frame_of(two, place, sink);
      Field u{"displacement", 3, {}, {}, false};
      for (const TestBlock& b : two) {
        const Vec2 d = sink(b, {});
        u.values.insert(u.values.end(), {d.x, d.y, 0.0});
      }
      g.cell_fields.push_back(u);
      const std::string file = fmt::format("frames/blocks_{:06}.vtu", k);
      ASSERT_FALSE(write_vtu(folder_ + "/" + file, g));
      series_.push_back({0.1 * static_cast<double>(k), file});
    }
    ASSERT_FALSE(write_pvd(folder_ + "/blocks.pvd", series_));
  }
  /// The frames that have come since.
  static void take_new(ViewRun& run) {
    const Result<std::vector<SeriesEntry>> series = run.series();
    ASSERT_TRUE(series.ok());
    for (std::size_t k = run.frames(); k < series.value().size(); ++k)
      ASSERT_TRUE(run.take(series.value()[k], ViewPrecision::single).ok());
  }
  std::string page() const { return read_file(folder_ + "/page.html").value(); }
  static std::size_t count(const std::string& text, const std::string& part) {
    std::size_t n = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
      ++n;
    return n;
  }

  std::string folder_;
  std::vector<SeriesEntry> series_;
};

TEST_F(ViewPage, HoldsAllFramesAndStandsAlone) {
  write_frames(5);
  Result<ViewRun> run = ViewRun::open(folder_, {});
  ASSERT_TRUE(run.ok());
  const Result<PageReport> report = write_page(run.value(), folder_ + "/page.html", 1 << 20);
  ASSERT_TRUE(report.ok());
  EXPECT_EQ(report.value().frames, 5u);
  EXPECT_EQ(report.value().precision, ViewPrecision::single);
  const std::string html = page();
  EXPECT_EQ(report.value().bytes, html.size());
  EXPECT_EQ(count(html, "id=\"edda-frame-"), 5u);
  EXPECT_EQ(count(html, "id=\"edda-datum-"), 1u);
  for (const char* outside : {"src=\"http", "href=\"http", "url(http", "@import"})
    EXPECT_EQ(count(html, outside), 0u) << outside;
}

TEST_F(ViewPage, LeavesOutFramesEvenlyButNeverTheEnds) {
  write_frames(50);
  Result<ViewRun> run = ViewRun::open(folder_, {});
  ASSERT_TRUE(run.ok());
  const Result<PageReport> report = write_page(run.value(), folder_ + "/page.html", 3000);
  ASSERT_TRUE(report.ok());
  const std::size_t kept = report.value().frames;
  EXPECT_GE(kept, 2u);
  EXPECT_LT(kept, 40u);
  const std::string header = run.value().header(false);
  const std::size_t at = header.find("\"frames\"");
  const std::string times = header.substr(at, header.find(']', at) - at);
  EXPECT_NE(times.find(" 0,"), std::string::npos) << times;
  EXPECT_NE(times.find("4.9"), std::string::npos) << times;
}

TEST_F(ViewPage, RangesLeaveOutHeldBlocks) {
  write_frames(3);
  Result<ViewRun> run = ViewRun::open(folder_, {});
  ASSERT_TRUE(run.ok());
  take_new(run.value());
  std::string header = run.value().header(false);
  std::erase_if(header, [](char c) { return c == ' ' || c == '\n'; });
  EXPECT_NE(
      header.find("\"name\":\"displacement.y\",\"label\":\"displacementupwards\",\"unit\":\"m\","
                  "\"kind\":\"numbers\",\"of\":\"blocks\",\"range\":[-0.002,0]"),
      std::string::npos)
      << header;
}

// A title may not end the script that it stands in.
TEST_F(ViewPage, NamesCannotBreakOutOfThePage) {
  write_frames(2);
  ViewNames names;
  names.title = "</script><script>alert(1)</script> & \"quotes\"";
  Result<ViewRun> run = ViewRun::open(folder_, names);
  ASSERT_TRUE(run.ok());
  ASSERT_TRUE(write_page(run.value(), folder_ + "/page.html", 1 << 20).ok());
  EXPECT_EQ(count(page(), "<script>alert"), 0u);
}

TEST_F(ViewPage, LongTablesLoseRowsEvenly) {
  write_frames(2);
  std::string csv = "time,a\n";
  for (int k = 0; k <= 1000; ++k) csv += fmt::format("{},{}\n", k, k * k);
  ASSERT_FALSE(write_file(folder_ + "/history.csv", csv));
  const Result<ViewRun> run = ViewRun::open(folder_, {});
  ASSERT_TRUE(run.ok());
  EXPECT_EQ(run.value().table("history.csv", 2000), csv);
  const std::string thin = run.value().table("history.csv", 100);
  EXPECT_LE(count(thin, "\n"), 102u);
  EXPECT_GE(count(thin, "\n"), 90u);
  EXPECT_TRUE(thin.starts_with("time,a\n0,0\n"));
  EXPECT_TRUE(thin.ends_with("1000,1000000\n"));
  EXPECT_EQ(run.value().table("bolts.csv", 100), "");
}

TEST_F(ViewPage, FoldersWithoutARunAreFaults) {
  EXPECT_FALSE(ViewRun::open(folder_, {}).ok());
  ASSERT_FALSE(write_pvd(folder_ + "/blocks.pvd", {}));
  EXPECT_FALSE(ViewRun::open(folder_, {}).ok());
  write_frames(2);
  ASSERT_FALSE(write_file(folder_ + "/frames/blocks_000001.vtu", "no frame"));
  Result<ViewRun> run = ViewRun::open(folder_, {});
  ASSERT_TRUE(run.ok());
  EXPECT_FALSE(write_page(run.value(), folder_ + "/page.html", 1 << 20).ok());
  EXPECT_FALSE(std::filesystem::exists(folder_ + "/page.html"));
}

// A run that goes on: what was taken up stays, what is new follows.
TEST_F(ViewPage, TakesUpFramesAsTheyCome) {
  write_frames(2);
  Result<ViewRun> run = ViewRun::open(folder_, {});
  ASSERT_TRUE(run.ok());
  take_new(run.value());
  const std::string before = run.value().again(1, ViewPrecision::single).value();
  write_frames(4);
  take_new(run.value());
  EXPECT_EQ(run.value().frames(), 4u);
  EXPECT_EQ(run.value().again(1, ViewPrecision::single).value(), before);
  EXPECT_NE(run.value().again(3, ViewPrecision::single).value(), before);
}

}  // namespace
}  // namespace edda
