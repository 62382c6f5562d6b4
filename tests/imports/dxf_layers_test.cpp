// What a drawing hides: layers that are off or frozen, clipped blocks; and names in any code page.
#include <gtest/gtest.h>

#include "imports/code_page.hpp"
#include "imports/dxf_text.hpp"

namespace edda::dxf_layers_test {
namespace {

using namespace test;

std::string line_on(const std::string& layer, const std::string& x = "1") {
  return entity("LINE", {{8, layer}, {10, "0"}, {20, "0"}, {11, x}, {21, "0"}});
}

struct Layer {
  std::string name, colour, flags;
};

std::string layers(const std::vector<Layer>& all) {
  std::string text = "0\nSECTION\n2\nTABLES\n0\nTABLE\n2\nLAYER\n";
  for (const Layer& l : all) {
    text += entity("LAYER", {{2, l.name}, {70, l.flags}, {62, l.colour}, {6, "CONTINUOUS"}});
  }
  return text + "0\nENDTAB\n0\nENDSEC\n";
}

std::string insert_on(const std::string& layer, const std::string& more = "") {
  return entity("INSERT", {{8, layer}}) + more + groups({{2, "A"}, {10, "0"}, {20, "0"}});
}

const std::string table = layers({{"0", "7", "0"},
                                  {"ON", "3", "4"},
                                  {"OFF", "-3", "0"},
                                  {"Frozen", "3", "65"},
                                  {"NEW", "1", "2"}});

TEST(DxfLayers, HiddenOnesAreLeftOutAndCounted) {
  const Drawing d = read_dxf(line_on("ON") + line_on("off") + line_on("FROZEN") + line_on("OFF") +
                                 line_on("NEW") + line_on("unlisted"),
                             table);
  ASSERT_EQ(d.lines.size(), 3U);
  EXPECT_EQ(d.lines[0].layer, "ON");
  EXPECT_EQ(d.lines[1].layer, "NEW");
  EXPECT_EQ(d.lines[2].layer, "unlisted");
  EXPECT_EQ(d.skipped.at("on hidden layer \"off\""), 1);
  EXPECT_EQ(d.skipped.at("on hidden layer \"OFF\""), 1);
  EXPECT_EQ(d.skipped.at("on hidden layer \"FROZEN\""), 1);
}

TEST(DxfLayers, ThoseThatAreNamedAreRead) {
  const Result<Drawing> d =
      parse_dxf(dxf(line_on("OFF") + line_on("Frozen"), table), "a.dxf", {"OFF"});
  ASSERT_TRUE(d.ok());
  ASSERT_EQ(d.value().lines.size(), 1U);
  EXPECT_EQ(d.value().lines[0].layer, "OFF");
}

/// A block on a layer that is off keeps what is on other layers; on a frozen one it is hidden
/// whole.
TEST(DxfLayers, HideBlocks) {
  const std::string all =
      table + blocks(block("A", "0", "0", line_on("0") + line_on("ON") + line_on("OFF")));
  EXPECT_EQ(read_dxf(insert_on("ON"), all).lines.size(), 2U);
  const Drawing off = read_dxf(insert_on("OFF"), all);
  ASSERT_EQ(off.lines.size(), 1U);
  EXPECT_EQ(off.lines[0].layer, "ON");
  const Drawing frozen = read_dxf(insert_on("Frozen"), all);
  EXPECT_TRUE(frozen.lines.empty());
  EXPECT_EQ(frozen.skipped.at("INSERT on frozen layer \"Frozen\""), 1);
}

/// The filter that clips an INSERT is in a dictionary in its own dictionary.
std::string objects(const std::string& on) {
  return "0\nSECTION\n2\nOBJECTS\n" +
         entity("DICTIONARY", {{5, "2A"}, {3, "ACAD_FILTER"}, {360, "02b"}}) +
         entity("DICTIONARY", {{5, "2B"}, {3, "SPATIAL"}, {360, "2C"}}) +
         entity("SPATIAL_FILTER", {{5, "2C"}, {70, "2"}, {71, on}}) + "0\nENDSEC\n";
}

TEST(DxfLayers, ClippedBlocksAreLeftOut) {
  const std::string dictionary = groups({{102, "{ACAD_XDICTIONARY"}, {360, "2a"}, {102, "}"}});
  const auto drawing = [&](const std::string& on) {
    const std::string entities =
        "0\nSECTION\n2\nENTITIES\n" + insert_on("0", dictionary) + insert_on("0") + "0\nENDSEC\n";
    return read(parse_dxf(
        blocks(block("A", "0", "0", line_on("0"))) + entities + objects(on) + "0\nEOF\n", "a.dxf"));
  };
  const Drawing clipped = drawing("1");
  EXPECT_EQ(clipped.lines.size(), 1U);
  EXPECT_EQ(clipped.skipped.at("INSERT that is clipped (XCLIP)"), 1);
  EXPECT_EQ(drawing("0").lines.size(), 2U);
}

std::string header(const std::string& page) {
  return "0\nSECTION\n2\nHEADER\n9\n$DWGCODEPAGE\n3\n" + page + "\n0\nENDSEC\n";
}

TEST(DxfLayers, NamesAreInTheCodePageOfTheDrawing) {
  const auto name = [](const std::string& bytes, const std::string& page) {
    const Drawing d = read_dxf(line_on(bytes), page.empty() ? "" : header(page));
    return d.lines.empty() ? std::string{} : d.lines[0].layer;
  };
  EXPECT_EQ(name("Kl\xFC"
                 "fte",
                 "ANSI_1252"),
            "Klüfte");
  EXPECT_EQ(name("Kl\xFC"
                 "fte",
                 ""),
            "Klüfte");
  EXPECT_EQ(name("\xF2\xF0\xE5\xF9", "ANSI_1251"), "трещ");
  EXPECT_EQ(name("Klüfte", "ANSI_1252"), "Klüfte");
  EXPECT_EQ(name("Kl\\U+00FCfte", "ANSI_1252"), "Klüfte");
  EXPECT_EQ(name("Kl\xFC", "no such page"), "Klü");
  EXPECT_EQ(name("a\\U+12", ""), "a\\U+12");
}

}  // namespace
}  // namespace edda::dxf_layers_test
