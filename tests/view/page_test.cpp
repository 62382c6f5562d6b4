#include "view/page.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <random>

#include "report/face_grid.hpp"
#include "results/vtu.hpp"
#include "scratch_folder.hpp"
#include "view/frames_of.hpp"

namespace edda::page_test {
namespace {

const std::vector<TestBlock> two{{0, {{0, 0}, {2, 0}, {2, 1}, {0, 1}}, false},
                                 {1, {{0, -1}, {2, -1}, {2, 0}, {0, 0}}, true}};

/// A results folder of its own, with `frames` frames of blocks that sink by 1 mm each.
class ViewPage : public testing::Test {
 protected:
  ViewPage() { std::filesystem::create_directories(folder_ + "/frames"); }

  /// With `more` blocks beside them, which move at random in frames that are `restless`.
  void write_frames(
      std::size_t frames, int more = 0,
      const std::function<bool(std::size_t)>& restless = [](std::size_t) { return true; }) {
    std::vector<TestBlock> blocks = two;
    for (int i = 0; i < more; ++i) {
      const double x = 3.0 + 2.0 * i;
      blocks.push_back({2 + i, {{x, 0}, {x + 1, 0}, {x + 1, 1}, {x, 1}}, false});
    }
    std::mt19937 random(7);
    for (std::size_t k = series_.size(); k < frames; ++k) {
      std::vector<double> noise(blocks.size());
      for (double& n : noise) n = restless(k) ? 1e-12 * static_cast<double>(random()) : 0.0;
      const auto sink = [&](const TestBlock& b, Vec2) {
        if (b.id > 1) return Vec2{noise[static_cast<std::size_t>(b.id)], 0.0};
        return b.fixed ? Vec2{0.0, -9.0} : Vec2{0.0, -1e-3 * static_cast<double>(k)};
      };
      const auto place = [&](const TestBlock& b, Vec2 p) { return p + sink(b, p); };
      Grid g = frame_of(blocks, place, sink);
      Field u{"displacement", 3, {}, {}, false};
      for (const TestBlock& b : blocks) {
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

  const ScratchFolder scratch_;
  const std::string folder_ = scratch_.path().string();
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
  const auto written = [&](std::size_t most, std::string& header) {
    Result<ViewRun> run = ViewRun::open(folder_, {});
    EXPECT_TRUE(run.ok());
    const Result<PageReport> report = write_page(run.value(), folder_ + "/page.html", most);
    EXPECT_TRUE(report.ok());
    header = run.value().header();
    EXPECT_EQ(report.value().bytes, page().size());
    EXPECT_EQ(report.value().of, 50u);
    return report.value();
  };
  std::string header;
  const PageReport all = written(1 << 20, header);
  EXPECT_EQ(all.frames, 50u);
  // The page itself is not counted as frames.
  const PageReport some = written(all.bytes - 6000, header);
  EXPECT_LE(some.bytes, all.bytes - 6000);
  EXPECT_GT(some.frames, 10u);
  EXPECT_LT(some.frames, 50u);
  const std::size_t at = header.find("\"frames\"");
  const std::string times = header.substr(at, header.find(']', at) - at);
  EXPECT_NE(times.find(" 0,"), std::string::npos) << times;
  EXPECT_NE(times.find("4.9"), std::string::npos) << times;
  EXPECT_EQ(written(1000, header).frames, 2u);
}

// Seven digits are for pages with room to spare.
TEST_F(ViewPage, NumbersAreRoundedBeforeFramesAreLeftOut) {
  write_frames(50, 200);
  Result<ViewRun> run = ViewRun::open(folder_, {});
  ASSERT_TRUE(run.ok());
  ViewRun other = run.value();
  const PageReport all = write_page(run.value(), folder_ + "/page.html", 10 << 20).value();
  EXPECT_EQ(all.precision, ViewPrecision::single);
  const PageReport tight = write_page(other, folder_ + "/page.html", all.bytes - 20000).value();
  EXPECT_EQ(tight.precision, ViewPrecision::whole16);
  EXPECT_EQ(tight.frames, 50u);
  EXPECT_LE(tight.bytes, all.bytes - 20000);
}

// Frames that are larger than those looked at first.
TEST_F(ViewPage, KeepsToItsSizeWhereFramesDiffer) {
  write_frames(40, 400, [](std::size_t k) { return k > 4 && k < 18; });
  Result<ViewRun> run = ViewRun::open(folder_, {});
  ASSERT_TRUE(run.ok());
  ViewRun other = run.value();
  const PageReport all = write_page(run.value(), folder_ + "/page.html", 10 << 20).value();
  const std::size_t most =
      all.bytes - (all.bytes - page_template().head.size() - page_template().tail.size()) * 3 / 4;
  const PageReport some = write_page(other, folder_ + "/page.html", most).value();
  EXPECT_LE(some.bytes, most);
  EXPECT_GE(some.frames, 3u);
}

TEST_F(ViewPage, RangesLeaveOutHeldBlocks) {
  write_frames(3);
  Result<ViewRun> run = ViewRun::open(folder_, {});
  ASSERT_TRUE(run.ok());
  take_new(run.value());
  std::string header = run.value().header();
  std::erase_if(header, [](char c) { return c == ' ' || c == '\n'; });
  EXPECT_NE(
      header.find("\"name\":\"displacement.y\",\"label\":\"displacementupwards\",\"unit\":\"m\","
                  "\"kind\":\"numbers\",\"of\":\"blocks\",\"range\":[-0.002,0]"),
      std::string::npos)
      << header;
}

TEST_F(ViewPage, WhatFewBlocksReachIsNotDrawnBy) {
  std::vector<TestBlock> blocks;
  for (int i = 0; i < 300; ++i) {
    const double x = 2.0 * i;
    blocks.push_back({i, {{x, 0}, {x + 1, 0}, {x + 1, 1}, {x, 1}}, false});
  }
  const auto sink = [](const TestBlock& b, Vec2) { return Vec2{0.0, b.id == 7 ? -0.5 : -2e-3}; };
  Grid g = frame_of(
      blocks, [&](const TestBlock& b, Vec2 p) { return p + sink(b, p); }, sink);
  Field u{"displacement", 3, {}, {}, false};
  for (const TestBlock& b : blocks) u.values.insert(u.values.end(), {0.0, sink(b, {}).y, 0.0});
  g.cell_fields.push_back(u);
  ASSERT_FALSE(write_vtu(folder_ + "/frames/blocks_000000.vtu", g));
  ASSERT_FALSE(write_pvd(folder_ + "/blocks.pvd", {{0.0, "frames/blocks_000000.vtu"}}));
  Result<ViewRun> run = ViewRun::open(folder_, {});
  ASSERT_TRUE(run.ok());
  take_new(run.value());
  std::string header = run.value().header();
  std::erase_if(header, [](char c) { return c == ' ' || c == '\n'; });
  EXPECT_NE(header.find("\"range\":[0.002,0.5],\"drawn\":[0.002,0.003]"), std::string::npos)
      << header;
}

TEST_F(ViewPage, TellsUsualStrokesAndWhatFramesHaveNot) {
  write_frames(2);
  Result<ViewRun> run = ViewRun::open(folder_, {});
  ASSERT_TRUE(run.ok());
  take_new(run.value());
  std::string header = run.value().header("1");
  std::erase_if(header, [](char c) { return c == ' ' || c == '\n'; });
  EXPECT_NE(header.find("\"served\":true,\"run\":\"1\","), std::string::npos) << header;
  EXPECT_NE(header.find("\"absent\":[\"overstress\",\"plastic_strain\",\"yields\","
                        "\"strength_factor\",\"pore_pressure\",\"water_pressure\",\"head\","
                        "\"discharge\",\"aperture\"],"),
            std::string::npos)
      << header;
  // Of block 0 alone: (-1 + 2)/2 MPa in the middle, a circle of hypot(1.5, 0.4) MPa.
  const std::size_t at = header.find("\"usual\":{\"force\":0,\"stress\":");
  ASSERT_NE(at, std::string::npos) << header;
  EXPECT_NEAR(
      std::stod(header.substr(at + std::string("\"usual\":{\"force\":0,\"stress\":").size())),
      1e6 * (0.5 + std::hypot(1.5, 0.4)), 1.0);
  EXPECT_NE(header.find("\"largest\":{\"force\":0,\"stress\":2052"), std::string::npos) << header;
}

/// The largest pressures on closed faces, and the largest that are none.
TEST_F(ViewPage, TellsOfFacesInTension) {
  write_frames(1);
  const auto largest = [&](const std::vector<TestFace>& faces) {
    EXPECT_FALSE(write_vtu(folder_ + "/" + contacts_beside(series_[0].file), face_grid(faces)));
    Result<ViewRun> run = ViewRun::open(folder_, {});
    EXPECT_TRUE(run.ok());
    take_new(run.value());
    std::string header = run.value().header();
    std::erase_if(header, [](char c) { return c == ' ' || c == '\n'; });
    const std::size_t at = header.find("\"pressure\":", header.find("\"largest\":"));
    return header.substr(at, header.find('}', at) - at);
  };
  EXPECT_EQ(largest({{{0, 0}, {1, 0}, 1e6, 2e6, 1.0, 1.0, 0, 1}}),
            "\"pressure\":2000000,\"tension\":0");
  EXPECT_EQ(largest({{{0, 0}, {1, 0}, 1e6, -3e6, 1.0, 1.0, 0, 1},
                     {{1, 0}, {2, 0}, -9e6, -9e6, 1.0, 0.0, 0, 1}}),
            "\"pressure\":1000000,\"tension\":3000000");
}

TEST_F(ViewPage, SaysWhatIsNoFolder) {
  const auto problem = [](const std::string& folder) {
    const Result<ViewRun> run = ViewRun::open(folder, {});
    return run.ok() ? std::string() : run.faults().front().problem;
  };
  EXPECT_EQ(problem(folder_), "holds no blocks.pvd");
  EXPECT_EQ(problem(folder_ + "/nowhere"), "there is no such folder");
  std::ofstream(folder_ + "/file") << "text";
  EXPECT_EQ(problem(folder_ + "/file"), "is no folder");
}

TEST_F(ViewPage, StressesThatAreRoundingAreNotDrawn) {
  write_frames(2);
  ViewNames names;
  names.least_stress = 1e7;
  Result<ViewRun> run = ViewRun::open(folder_, names);
  ASSERT_TRUE(run.ok());
  take_new(run.value());
  std::string header = run.value().header();
  std::erase_if(header, [](char c) { return c == ' ' || c == '\n'; });
  EXPECT_NE(header.find("\"usual\":{\"force\":0,\"stress\":0,"), std::string::npos) << header;
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

TEST_F(ViewPage, LongHistoriesKeepTheirPeaks) {
  write_frames(2);
  std::string csv = "time,a,b\n";
  for (int k = 0; k <= 1000; ++k)
    csv += fmt::format("{},{},{}\n", k, k == 333 ? 9 : k % 2, k == 666 ? -9 : 0.001 * k);
  ASSERT_FALSE(write_file(folder_ + "/history.csv", csv + "1001,0"));  // still being written
  const Result<ViewRun> run = ViewRun::open(folder_, {});
  ASSERT_TRUE(run.ok());
  EXPECT_EQ(run.value().table("history.csv", 2000), csv);
  const std::string thin = run.value().table("history.csv", 100);
  EXPECT_LE(count(thin, "\n"), 101u);
  EXPECT_GE(count(thin, "\n"), 30u);
  EXPECT_TRUE(thin.starts_with("time,a,b\n0,0,0\n"));
  EXPECT_TRUE(thin.ends_with("\n1000,0,1\n"));
  EXPECT_EQ(count(thin, "\n333,9,0.333\n"), 1u);
  EXPECT_EQ(count(thin, "\n666,0,-9\n"), 1u);
  EXPECT_EQ(run.value().table("bolts.csv", 100), "");
}

// A bolt without some of its nodes would be another one.
TEST_F(ViewPage, BoltsStayWholeAtTheFramesOfThePage) {
  write_frames(4);
  const auto rows = [](double time) {
    std::string text;
    for (int node = 0; node < 50; ++node) text += fmt::format("{},\"B\n1\",{}\n", time, node);
    return text;
  };
  const std::string head = "time,bolt,distance\n";
  ASSERT_FALSE(write_file(folder_ + "/bolts.csv", head + rows(0.0) + rows(0.1) + rows(0.15) +
                                                      rows(0.1 + 0.1 + 1e-13) + "0.3,\"B\n"));
  Result<ViewRun> run = ViewRun::open(folder_, {});
  ASSERT_TRUE(run.ok());
  for (const std::size_t k : {0U, 2U, 3U})
    ASSERT_TRUE(run.value().take(series_[k], ViewPrecision::single).ok());
  EXPECT_EQ(run.value().table("bolts.csv", 10), head + rows(0.0) + rows(0.1 + 0.1 + 1e-13));
}

TEST_F(ViewPage, StagesAreTakenAlongWhole) {
  write_frames(2);
  const std::string csv = "name,end\n\"a, b\",1\n,2\n";
  ASSERT_FALSE(write_file(folder_ + "/stages.csv", csv + "\"c"));
  const Result<ViewRun> run = ViewRun::open(folder_, {});
  ASSERT_TRUE(run.ok());
  EXPECT_EQ(run.value().table("stages.csv", 1), csv);
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

// The model run again in the same folder is another run, whatever its frames.
TEST_F(ViewPage, KnowsWhenTheFolderHoldsAnotherRun) {
  write_frames(4);
  ASSERT_FALSE(write_file(folder_ + "/model.toml", "title = \"1\""));
  Result<ViewRun> run = ViewRun::open(folder_, {});
  ASSERT_TRUE(run.ok());
  take_new(run.value());
  write_frames(5);
  EXPECT_TRUE(run.value().is_still_there());
  const std::vector<SeriesEntry> all = series_;
  ASSERT_FALSE(write_pvd(folder_ + "/blocks.pvd", {all[0], all[1]}));
  EXPECT_FALSE(run.value().is_still_there()) << "shorter";
  series_[2].time = 0.25;
  ASSERT_FALSE(write_pvd(folder_ + "/blocks.pvd", series_));
  EXPECT_FALSE(run.value().is_still_there()) << "other times";
  ASSERT_FALSE(write_pvd(folder_ + "/blocks.pvd", all));
  EXPECT_TRUE(run.value().is_still_there());
  for (const char* file : {"/model.toml", "/frames/blocks_000000.vtu"}) {
    const auto written = std::filesystem::last_write_time(folder_ + file);
    std::filesystem::last_write_time(folder_ + file, written + std::chrono::seconds(3));
    EXPECT_FALSE(run.value().is_still_there()) << file;
    std::filesystem::last_write_time(folder_ + file, written);
  }
}

}  // namespace
}  // namespace edda::page_test
