// The results folder's rule, files whole or not at all, frames there and back.
#include "results/files.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "results/frames.hpp"
#include "results/vtu.hpp"
#include "scratch_folder.hpp"

namespace edda::files_test {
namespace {

namespace fs = std::filesystem;

class Folder : public testing::Test {
 protected:
  std::string at(const std::string& name) const { return root.at(name); }
  void touch(const std::string& name) const {
    fs::create_directories(fs::path(at(name)).parent_path());
    std::ofstream(at(name)) << "x";
  }
  ScratchFolder root;
};

TEST_F(Folder, TakesAnEarlierRunsFilesAndNothingElse) {
  EXPECT_FALSE(check_folder(at("new"), at("m.toml")));
  touch("old/summary.json");
  touch("old/frames/blocks_000001.vtu");
  touch("old/history.csv.part");
  touch("old/columns.csv");
  touch("old/joints_12.csv");
  EXPECT_FALSE(check_folder(at("old"), at("m.toml")));
  touch("old/notes.txt");
  ASSERT_TRUE(check_folder(at("old"), at("m.toml")));
  EXPECT_NE(check_folder(at("old"), at("m.toml"))->problem.find("notes.txt"), std::string::npos);
  touch("mine/frames/holiday.jpg");
  EXPECT_TRUE(check_folder(at("mine"), at("m.toml")));
  touch("file");
  EXPECT_TRUE(check_folder(at("file"), at("m.toml")));
}

TEST_F(Folder, NeverTakesTheOneThatHoldsTheModel) {
  touch("model.toml");
  EXPECT_TRUE(check_folder(root.path().string(), at("model.toml")));
}

TEST_F(Folder, ClearingLeavesAnEmptyFrames) {
  touch("run/summary.json");
  touch("run/frames/contacts_000000.vtu");
  ASSERT_FALSE(clear_folder(at("run")));
  EXPECT_TRUE(fs::is_empty(at("run/frames")));
  EXPECT_FALSE(fs::exists(at("run/summary.json")));
}

TEST_F(Folder, ClearingRefusesWhatItDoesNotKnow) {
  touch("run/notes.txt");
  EXPECT_TRUE(clear_folder(at("run")));
  EXPECT_TRUE(fs::exists(at("run/notes.txt")));
}

TEST_F(Folder, FailedWritesKeepWhatWasThere) {
  ASSERT_FALSE(write_file(at("a"), "first"));
  EXPECT_TRUE(write_file(at("none/a"), "x"));
  fs::create_directories(at("a.part"));  // stands where the new file would grow
  EXPECT_TRUE(write_file(at("a"), "second"));
  EXPECT_EQ(read_file(at("a")).value(), "first");
}

TEST(RowFile, ReportsAFullDisk) {
  ASSERT_TRUE(fs::exists("/dev/full"));
  RowFile file;
  ASSERT_FALSE(file.open("/dev/full"));
  const Trouble trouble = file.add("1,2,3\n");
  ASSERT_TRUE(trouble);
  EXPECT_NE(trouble->problem.find("No space"), std::string::npos);
}

Grid small_grid() {
  Grid g;
  g.time = 0.25;
  g.points = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
  g.corners = {0, 1, 2, 0, 2, 3};
  g.ends = {3, 6};
  g.types = {cell_type::triangle, cell_type::triangle};
  g.cell_fields = {{"id", 1, {7, 8}, {}, true}, {"velocity", 3, {1, 2, 3, 4, 5, 6.5}, {}, false}};
  g.point_fields = {{"displacement", 3, std::vector<double>(12, 0.1), {}, false}};
  return g;
}

TEST_F(Folder, FramesComeBackAsTheyWere) {
  const Grid g = small_grid();
  ASSERT_FALSE(write_vtu(at("g.vtu"), g));
  const Result<Grid> back = read_vtu(at("g.vtu"));
  ASSERT_TRUE(back.ok());
  EXPECT_EQ(back.value().time, g.time);
  EXPECT_EQ(back.value().points, g.points);
  EXPECT_EQ(back.value().corners, g.corners);
  EXPECT_EQ(back.value().types, g.types);
  EXPECT_EQ(back.value().cell_field("id")->values, g.cell_fields[0].values);
  EXPECT_EQ(back.value().cell_field("velocity")->values, g.cell_fields[1].values);
  EXPECT_EQ(back.value().point_field("displacement")->values, g.point_fields[0].values);
}

/// n points, each a cell, with fields that are made when they are written.
GridSource source_of_points(std::size_t n) {
  GridSource source;
  source.shape.time = 0.5;
  for (std::size_t k = 0; k < n; ++k) {
    const auto at = static_cast<std::int64_t>(k);
    source.shape.points.insert(source.shape.points.end(), {static_cast<double>(k), 0.5, 0.0});
    source.shape.corners.push_back(at);
    source.shape.ends.push_back(at + 1);
    source.shape.types.push_back(cell_type::vertex);
  }
  const auto fill = [](std::size_t first, std::size_t end, double* into) {
    for (std::size_t k = first; k < end; ++k) {
      *into++ = 0.1 * static_cast<double>(k);
      *into++ = -static_cast<double>(k);
    }
  };
  const auto count = [](std::size_t first, std::size_t end, double* into) {
    for (std::size_t k = first; k < end; ++k) *into++ = static_cast<double>(k);
  };
  source.cell_fields = {{"pair", 2, {"first", "second"}, false, n, fill},
                        {"id", 1, {}, true, n, count}};
  source.point_fields = {{"moved", 2, {}, false, n, fill}};
  return source;
}

/// A frame that is written without being in memory has the bytes of one that is, over more rows
/// than are made at once, and over blocks that are deflated one by one: none, a whole one, several.
TEST_F(Folder, FramesOfASourceAreThoseOfItsGrid) {
  for (const std::size_t n : {std::size_t{0}, std::size_t{32768}, std::size_t{40000}}) {
    GridSource source = source_of_points(n);
    for (const bool cells_are_points : {false, true}) {
      source.shape.cells_are_points = cells_are_points;
      const Grid grid = grid_of(source);
      ASSERT_FALSE(write_vtu(at("source.vtu"), source));
      ASSERT_FALSE(write_vtu(at("grid.vtu"), grid));
      EXPECT_EQ(read_file(at("source.vtu")).value(), read_file(at("grid.vtu")).value());
      const Result<Grid> back = read_vtu(at("source.vtu"));
      ASSERT_TRUE(back.ok()) << n;
      EXPECT_EQ(back.value().points, grid.points);
      EXPECT_EQ(back.value().cell_field("pair")->values, grid.cell_field("pair")->values);
      EXPECT_EQ(back.value().cell_field("id")->values, grid.cell_field("id")->values);
      const Field& points = cells_are_points ? grid.cell_fields[0] : grid.point_fields[0];
      EXPECT_EQ(back.value().point_field(points.name)->values, points.values);
    }
  }
}

/// Whatever the header of an array says.
TEST_F(Folder, FramesWithDamagedHeadersAreFaults) {
  ASSERT_FALSE(write_vtu(at("g.vtu"), small_grid()));
  const std::string whole = read_file(at("g.vtu")).value();
  const std::string mark = "<AppendedData encoding=\"raw\">\n_";
  const std::size_t first = whole.find(mark) + mark.size();  // of the time: 1 block
  for (const std::size_t word : {0u, 1u, 2u, 3u}) {
    for (const char byte : {'\x00', '\x7f'}) {
      std::string damaged = whole;
      damaged.replace(first + 8 * word, 7, 7, byte);
      ASSERT_FALSE(write_file(at("bad.vtu"), damaged));
      EXPECT_FALSE(read_vtu(at("bad.vtu")).ok()) << word;
    }
  }
  const std::string compressor = " compressor=\"vtkZLibDataCompressor\"";
  std::string old = whole;
  old.erase(old.find(compressor), compressor.size());
  ASSERT_FALSE(write_file(at("old.vtu"), old));
  const Result<Grid> earlier = read_vtu(at("old.vtu"));
  ASSERT_FALSE(earlier.ok());
  EXPECT_EQ(earlier.faults().front().problem, "is of an earlier version of edda");
}

TEST_F(Folder, FramesTellTheirSignsInACommentThatReadersSkip) {
  const Grid g = small_grid();
  ASSERT_FALSE(write_vtu(at("g.vtu"), g));
  std::string text = read_file(at("g.vtu")).value();
  const std::string declaration = "<?xml version=\"1.0\"?>\n";
  EXPECT_TRUE(text.starts_with(declaration + "<!-- Stresses of blocks are positive in tension, "));
  // Whatever stands in one.
  text.insert(declaration.size(),
              "<!-- <CellData> <DataArray type=\"Int32\" Name=\"id\" offset=\"99\"/> > -->\n");
  ASSERT_FALSE(write_file(at("g.vtu"), text));
  const Result<Grid> back = read_vtu(at("g.vtu"));
  ASSERT_TRUE(back.ok());
  EXPECT_EQ(back.value().points, g.points);
  EXPECT_EQ(back.value().cell_fields.size(), 2u);
  EXPECT_EQ(back.value().cell_field("id")->values, g.cell_fields[0].values);
}

TEST_F(Folder, FramesCutShortAreFaultsAndNeverCrash) {
  ASSERT_FALSE(write_vtu(at("g.vtu"), small_grid()));
  const std::string whole = read_file(at("g.vtu")).value();
  const std::size_t needed = whole.rfind("\n</AppendedData>");
  for (std::size_t n = 0; n < needed; n += 3) {
    ASSERT_FALSE(write_file(at("cut.vtu"), whole.substr(0, n)));
    EXPECT_FALSE(read_vtu(at("cut.vtu")).ok()) << n;
  }
  for (std::size_t n = 0; n < needed; n += 5) {
    std::string damaged = whole;
    damaged[n] = '9';
    ASSERT_FALSE(write_file(at("bad.vtu"), damaged));
    (void)read_vtu(at("bad.vtu")).ok();
  }
}

// Readers index by what they know of a field.
TEST_F(Folder, FramesWithOtherFieldsThanReadersKnowAreFaults) {
  const auto is_read = [&](const auto& change) {
    Grid g = small_grid();
    change(g);
    EXPECT_FALSE(write_vtu(at("g.vtu"), g));
    return read_vtu(at("g.vtu")).ok();
  };
  EXPECT_TRUE(is_read([](Grid&) {}));
  EXPECT_FALSE(is_read([](Grid& g) { g.cell_fields[1] = {"velocity", 1, {1, 2}, {}, false}; }));
  EXPECT_FALSE(is_read([](Grid& g) { g.cell_fields[1] = {"stress", 1, {1, 2}, {}, false}; }));
  EXPECT_TRUE(is_read([](Grid& g) { g.cell_fields[1] = {"mine", 1, {1, 2}, {}, false}; }));
  EXPECT_FALSE(is_read([](Grid& g) { g.cell_fields[0].whole = false; }));
  EXPECT_FALSE(is_read([](Grid& g) { g.cell_fields[1].components = 0; }));
  EXPECT_FALSE(is_read([](Grid& g) { g.ends = {6, 6}; }));
  EXPECT_FALSE(is_read([](Grid& g) {
    g.point_fields[0] = {"displacement", 1, {1, 2, 3, 4}, {}, false};
  }));
}

TEST_F(Folder, FramesHaveNumbers) {
  for (const char* name : {"blocks_.vtu", "blocks_1a.vtu", "blocks_99999999999999999999999.vtu"}) {
    touch(std::string("old/frames/") + name);
    EXPECT_TRUE(check_folder(at("old"), at("m.toml"))) << name;
    fs::remove_all(at("old"));
  }
}

TEST_F(Folder, OneThatCannotBeMadeIsAFault) {
  touch("file");
  EXPECT_TRUE(check_folder(at("file/below/it"), at("m.toml")));
  EXPECT_FALSE(check_folder(at("new/below/it"), at("m.toml")));
}

TEST_F(Folder, ManyFramesAreInTheSeriesInTheEnd) {
  fs::create_directories(at("run/frames"));
  FrameSeries frames(at("run"), BlockSet{});
  frames.go_on_after(std::vector<double>(5000, 0.0));
  const auto named = [&] { return read_pvd(at("run/blocks.pvd")).value().size(); };
  std::size_t before = 0, written = 0;
  for (std::size_t n = 5001; n <= 5016; ++n) {
    ASSERT_FALSE(frames.add({}));
    ASSERT_FALSE(frames.finish());
    written += named() != before;
    before = named();
    EXPECT_GE(before + 5, n);
  }
  EXPECT_EQ(written, 3u);  // of 5001, 5007 and 5013
  ASSERT_FALSE(frames.write_series());
  EXPECT_EQ(named(), 5016u);
}

/// After a frame that could not be written there are no others, and no series names it.
TEST_F(Folder, AFrameThatFailsEndsTheSeries) {
  fs::create_directories(at("run/frames"));
  FrameSeries frames(at("run"), BlockSet{});
  ASSERT_FALSE(frames.add({}));
  ASSERT_FALSE(frames.finish());
  fs::remove_all(at("run/frames"));
  ASSERT_FALSE(frames.add({}));
  EXPECT_TRUE(frames.write_series());
  fs::create_directories(at("run/frames"));
  EXPECT_TRUE(frames.finish());
  EXPECT_TRUE(frames.collect());
  EXPECT_TRUE(frames.add({}));
  EXPECT_TRUE(frames.write_series());
  EXPECT_EQ(read_pvd(at("run/blocks.pvd")).value().size(), 1u);
  EXPECT_EQ(frames.times().size(), 1u);
}

TEST_F(Folder, SeriesComeBackAsTheyWere) {
  ASSERT_FALSE(write_pvd(at("s.pvd"), {{0.0, "frames/a.vtu"}, {0.1, "frames/b.vtu"}}));
  const auto back = read_pvd(at("s.pvd"));
  ASSERT_TRUE(back.ok());
  ASSERT_EQ(back.value().size(), 2u);
  EXPECT_EQ(back.value()[1].time, 0.1);
  EXPECT_EQ(back.value()[1].file, "frames/b.vtu");
}

}  // namespace
}  // namespace edda::files_test
