// The table of columns: every header follows from it, and every column of it has a unit and a
// meaning.
#include "results/columns.hpp"

#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <set>

#include "results/cut_table.hpp"
#include "results/read_table.hpp"
#include "results/tables.hpp"
#include "scratch_folder.hpp"

namespace edda::columns_test {
namespace {

namespace fs = std::filesystem;

const ColumnOwners owners{{"crown", "a,b"}, {"span"}, {"base", "1"}};

std::string header_of(ResultFile file) {
  return begin_table(file, owners).text();
}

std::string first_line(const std::string& path) {
  const std::string text = read_file(path).value();
  return text.substr(0, text.find('\n') + 1);
}

TEST(Columns, HaveAUnitAndAMeaning) {
  const std::set<std::string_view> units{"text", "1",         "s",        "m",     "m2",   "rad",
                                         "m/s",  "N/m",       "Pa",       "rad/s", "m/s2", "N",
                                         "J",    "as varied", "as asked", "N m",   "m2/s"};
  std::set<std::string_view> files;
  for (const ResultTable& table : result_tables()) {
    EXPECT_TRUE(files.insert(table.file).second) << table.file;
    EXPECT_TRUE(table.rows.ends_with('.')) << table.file;
    EXPECT_FALSE(table.columns.empty()) << table.file;
    std::set<std::pair<std::string_view, ColumnOf>> names;
    for (const ResultColumn& c : table.columns) {
      EXPECT_TRUE(names.insert({c.name, c.of}).second) << table.file << ' ' << c.name;
      EXPECT_TRUE(units.contains(c.unit)) << table.file << ' ' << c.name << ": " << c.unit;
      EXPECT_TRUE(c.meaning.size() > 10 && c.meaning.ends_with('.')) << table.file << ' ' << c.name;
      EXPECT_EQ(c.meaning.find_first_of("|`\n"), std::string_view::npos) << table.file << c.name;
      EXPECT_EQ(c.name.starts_with("NAME"), c.of != ColumnOf::file) << table.file << ' ' << c.name;
    }
  }
  EXPECT_EQ(result_table(ResultFile::cut).file, "F.csv");  // the last of them
}

/// Whoever reads a column has to know its sign.
TEST(Columns, OfStressesAndNormalForcesTellTheirSign) {
  for (const ResultTable& table : result_tables()) {
    for (const ResultColumn& c : table.columns) {
      const auto says = [&](std::string_view what) {
        return c.meaning.find(what) != std::string_view::npos;
      };
      const std::string where = std::string(table.file) + ' ' + std::string(c.name);
      const bool is_normal = c.name.starts_with("normal_") || c.name == "thrust";
      const bool is_rock =
          c.name.ends_with("sxx") || c.name.ends_with("syy") || c.name.ends_with("szz");
      EXPECT_EQ(says("positive in compression"), is_normal) << where;
      EXPECT_EQ(says("positive in tension"),
                is_rock || c.name == "axial_force" || c.name == "largest_force")
          << where;
    }
  }
}

/// The names are a promise: scripts of users read them.
TEST(Columns, KeepTheirNames) {
  EXPECT_EQ(
      header_of(ResultFile::history),
      "time,crown.ux,crown.uy,crown.vx,crown.vy,crown.ax,crown.ay,crown.sxx,crown.syy,crown.sxy,"
      "\"a,b.ux\",\"a,b.uy\",\"a,b.vx\",\"a,b.vy\",\"a,b.ax\",\"a,b.ay\",\"a,b.sxx\",\"a,b.syy\","
      "\"a,b.sxy\","
      "span.convergence,kinetic,strain,contact,gravity,friction,damping,fracture,external,"
      "step_change,drift,unbalanced,transfer,cracks_tension,cracks_shear\n");
  EXPECT_EQ(header_of(ResultFile::reactions), "time,base.fx,base.fy,1.fx,1.fy\n");
  EXPECT_EQ(header_of(ResultFile::bolts),
            "time,bolt,distance,x,y,axial_force,bond_force,dowel_force,utilisation,yielded,"
            "ruptured,dowel_utilisation,dowel_angle\n");
  EXPECT_EQ(header_of(ResultFile::linings),
            "time,lining,piece,distance,x,y,thrust,moment,shear,utilisation,hinge_rotation,"
            "material,yielded\n");
  EXPECT_EQ(header_of(ResultFile::flow), "time,water,inflow\n");
  EXPECT_EQ(header_of(ResultFile::stages),
            "stage,name,until,reached,start,end,steps,ratio,largest_ratio,largest_block,kinetic,"
            "strain,contact,gravity,friction,damping,fracture,external,drift,contacts,sliding,"
            "bonded,detached,open,broken,yielded_bolts,loose,transfer,span.convergence\n");
  EXPECT_EQ(header_of(ResultFile::bolt_summary),
            "bolt,largest_force,time,distance,x,y,axial_force,bond_force,dowel_force,utilisation,"
            "bond_slipped,yielded,ruptured,largest_dowel_force,dowel_utilisation\n");
  const std::string joints =
      "block_i,block_j,joint,x,y,normal_force,shear_force,opening,slip,state,ever_slipped,"
      "ever_opened,mobilised,length,closed_length,x_a,y_a,x_b,y_b,normal_stress,normal_stress_a,"
      "normal_stress_b,shear_stress,table,damage,broken_by,aperture,discharge,water_pressure_a,"
      "water_pressure_b\n";
  EXPECT_EQ(header_of(ResultFile::stage_joints), joints);
  EXPECT_EQ(header_of(ResultFile::joints), joints);
  EXPECT_EQ(header_of(ResultFile::blocks),
            "id,name,material,x,y,area,ux,uy,rotation,vx,vy,omega,sxx,syy,szz,sxy,overstress\n");
  EXPECT_EQ(header_of(ResultFile::fos),
            "factor,outcome,displacement,block,time,velocity,unbalanced,steps,reason\n");
  EXPECT_EQ(header_of(ResultFile::mechanism),
            "id,name,x,y,ux,uy,displacement,rotation,turning_part,motion\n");
  EXPECT_EQ(header_of(ResultFile::mechanism_joints),
            "block_i,block_j,joint,x,y,slip,opening,turning,motion,table\n");
  EXPECT_EQ(header_of(ResultFile::motions),
            "monitor,direction,stage,start,end,peak_acceleration,peak_velocity,peak_displacement,"
            "permanent_displacement,arias,arias_duration\n");
  EXPECT_EQ(header_of(ResultFile::spectra),
            "monitor,direction,stage,period,pseudo_acceleration,relative_velocity,"
            "relative_displacement\n");
  EXPECT_EQ(header_of(ResultFile::amplification), "direction,stage,period,amplification\n");
  EXPECT_EQ(header_of(ResultFile::relative), "stage,time,ux,uy\n");
  EXPECT_EQ(header_of(ResultFile::columns), "file,column,unit,meaning\n");
  EXPECT_EQ(header_of(ResultFile::cut), "block,material,ring,x,y,joint,table\n");
}

TEST(Columns, HeadTheTablesThatAreWritten) {
  const ScratchFolder folder;
  ASSERT_FALSE(write_blocks_csv(folder.at("blocks.csv"), {}));
  EXPECT_EQ(first_line(folder.at("blocks.csv")), header_of(ResultFile::blocks));
  ASSERT_FALSE(write_joints_csv(folder.at("joints.csv"), {}));
  EXPECT_EQ(first_line(folder.at("joints.csv")), header_of(ResultFile::joints));
  ASSERT_FALSE(write_cut_csv(folder.at("cut.csv"), {}, {}));
  EXPECT_EQ(first_line(folder.at("cut.csv")), header_of(ResultFile::cut));
}

/// A row has a cell for each of its columns.
TEST(Columns, FitTheRows) {
  const ScratchFolder folder;
  const std::array<BlockRecord, 2> blocks{};
  ASSERT_FALSE(write_blocks_csv(folder.at("blocks.csv"), blocks));
  EXPECT_TRUE(read_table(folder.at("blocks.csv")).ok());
  const std::array<ContactRecord, 2> contacts{};
  ASSERT_FALSE(write_joints_csv(folder.at("joints.csv"), contacts));
  EXPECT_TRUE(read_table(folder.at("joints.csv")).ok());
}

class ColumnsFile : public testing::Test {
 protected:
  void touch(const std::string& name) const { ASSERT_FALSE(write_file(folder.at(name), "x\n")); }
  /// The files and columns that columns.csv names, a line each.
  std::string written() const {
    EXPECT_FALSE(write_columns_csv(folder.path().string(), owners));
    const Result<Table> table = read_table(folder.at("columns.csv"));
    EXPECT_TRUE(table.ok());
    std::string lines;
    for (std::size_t row = 0; row < table.value().rows(); ++row) {
      const auto cell = [&](const char* name) { return table.value().column(name)->text(row); };
      lines += cell("file") + ' ' + cell("column") + '\n';
      EXPECT_FALSE(cell("unit").empty() || cell("meaning").empty()) << lines;
    }
    return lines;
  }
  ScratchFolder folder;
};

TEST_F(ColumnsFile, ListsTheFilesThatAreThere) {
  const std::string own =
      "columns.csv file\ncolumns.csv column\ncolumns.csv unit\ncolumns.csv meaning\n";
  EXPECT_EQ(written(), own);
  touch("reactions.csv");
  const std::string reactions =
      "reactions.csv time\nreactions.csv base.fx\nreactions.csv base.fy\nreactions.csv 1.fx\n"
      "reactions.csv 1.fy\n";
  EXPECT_EQ(written(), reactions + own);
  touch("F.csv");  // is the file of a cut, wherever it lies
  touch("frames.csv");
  EXPECT_EQ(written(), reactions + own);
}

TEST_F(ColumnsFile, ListsTheJointsOfEachStageByTheirNumbers) {
  for (const char* name : {"joints_1.csv", "joints_2.csv", "joints_10.csv", "joints_x.csv",
                           "joints_03.csv", "joints_-4.csv", "joints_.csv"})
    touch(name);
  const std::string lines = written();
  EXPECT_EQ(lines.find("joints_1.csv block_i\n"), 0u);
  const std::size_t second = lines.find("joints_2.csv block_i\n"),
                    tenth = lines.find("joints_10.csv shear_stress\n");
  EXPECT_NE(second, std::string::npos);
  EXPECT_NE(tenth, std::string::npos);
  EXPECT_LT(second, tenth);
  for (const char* other :
       {"joints_x", "joints_N", "joints_3", "joints_03", "joints_-4", "joints_."})
    EXPECT_EQ(lines.find(other), std::string::npos) << other;
}

TEST_F(ColumnsFile, AndEveryTableBelongToAnEarlierRun) {
  for (const ResultTable& table : result_tables()) {
    const bool by_stage = table.in == TableIn::folder_by_stage;
    const std::string file = by_stage ? "joints_0.csv" : std::string(table.file);
    touch(file);
    const bool refused = check_folder(folder.path().string(), {}).has_value();
    EXPECT_EQ(refused, table.in == TableIn::file_of_user) << table.file;
    fs::remove(folder.at(file));
  }
}

TEST(ColumnReference, HasASectionForEachFile) {
  const std::string all = column_reference();
  for (const ResultTable& table : result_tables()) {
    EXPECT_NE(all.find("`" + std::string(table.file)), std::string::npos) << table.file;
    for (const ResultColumn& c : table.columns) {
      EXPECT_NE(all.find("| `" + std::string(c.name) + "` | " + std::string(c.unit) + " | " +
                         std::string(c.meaning) + " |\n"),
                std::string::npos)
          << table.file << ' ' << c.name;
    }
  }
  const std::string one = column_reference("joints_3.csv");
  EXPECT_TRUE(one.starts_with("## `joints_N.csv`\n"));
  EXPECT_EQ(one.find("##", 2), std::string::npos);
  EXPECT_EQ(column_reference("history"), column_reference("history.csv"));
  EXPECT_TRUE(column_reference("summary.json").empty());
}

}  // namespace
}  // namespace edda::columns_test
