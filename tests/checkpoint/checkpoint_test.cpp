#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <random>

#include "checkpoint/archive.hpp"
#include "checkpoint/envelope.hpp"
#include "checkpoint/hdf5_image.hpp"
#include "scratch_folder.hpp"

namespace edda::checkpoint_test {
namespace {

enum class Colour : std::uint8_t { red, green };

struct Thing {
  std::vector<double> numbers{1.0, -0.0, std::numeric_limits<double>::infinity(), 5e-324};
  std::vector<Colour> colours{Colour::green, Colour::red};
  std::vector<bool> flags{true, false, true};
  std::array<std::vector<double>, 3> nodes{{{1.0}, {}, {2.0, 3.0}}};
  std::vector<std::uint32_t> none;
  std::optional<double> given = 2.5, missing;
  std::uint64_t count = 1ull << 60;
  bool yes = true;
  std::string text = std::string("line\nwith \0 inside", 18);
  bool operator==(const Thing&) const = default;
};

template <class Archive>
void list(Archive& a, Thing& t) {
  a("numbers", t.numbers);
  a("colours", t.colours);
  a("flags", t.flags);
  a("nodes", t.nodes);
  a("none", t.none);
  a("given", t.given);
  a("missing", t.missing);
  a("count", t.count);
  a("yes", t.yes);
  a("text", t.text);
}

Record record_of(Thing thing) {
  Record record;
  Saver saver(record);
  list(saver, thing);
  return record;
}

TEST(Archive, BringsBackWhatWasSaved) {
  Thing blank{{}, {}, {}, {}, {7}, {}, 1.0, 0, false, {}};
  const Record record = record_of(Thing{});
  Loader loader(record);
  list(loader, blank);
  EXPECT_EQ(loader.flaw(), "");
  EXPECT_EQ(blank, Thing{});
}

TEST(Archive, NamesWhatIsMissingOrOfAnotherKind) {
  Record record = record_of(Thing{});
  record.erase("given");
  Thing thing;
  Loader first(record);
  list(first, thing);
  EXPECT_EQ(first.flaw(), "given is missing");
  record = record_of(Thing{});
  record["count"] = std::vector<double>{1.0};
  Loader second(record);
  list(second, thing);
  EXPECT_EQ(second.flaw(), "count is of another kind");
  record["count"] = std::vector<std::uint64_t>{1, 2};
  Loader third(record);
  list(third, thing);
  EXPECT_EQ(third.flaw(), "count is no single number");
}

TEST(Hdf5Image, BringsBackEveryKindToTheBit) {
  Record record = record_of(Thing{});
  record["signed"] = std::vector<std::int32_t>{-5, 7};
  record["short"] = std::vector<std::uint16_t>{65535};
  record["empty_text"] = std::string();
  const std::string image = to_hdf5(record);
  const Result<Record> back = from_hdf5(image);
  ASSERT_TRUE(back.ok());
  EXPECT_EQ(back.value(), record);
  EXPECT_EQ(to_hdf5(back.value()).size(), image.size());
}

TEST(Hdf5Image, RefusesWhatIsNoFile) {
  EXPECT_FALSE(from_hdf5("").ok());
  EXPECT_FALSE(from_hdf5("nonsense").ok());
}

TEST(Envelope, OpensWhatItSealed) {
  for (const std::string& image : {std::string(), std::string("x"), std::string(100000, 'q')}) {
    const std::string file = seal(image) + image;
    const auto opened = open_sealed(file);
    ASSERT_TRUE(opened.ok());
    EXPECT_EQ(opened.value(), image);
  }
}

/// Every single flipped bit and every shorter file is found out.
TEST(Envelope, FindsEveryFlippedBitAndEveryLostByte) {
  const std::string image = to_hdf5({{"a", std::vector<double>{1.0, 2.0}}});
  const std::string file = seal(image) + image;
  for (std::size_t k = 0; k < file.size(); ++k) {
    std::string bad = file;
    bad[k] = static_cast<char>(bad[k] ^ (1 << (k % 8)));
    EXPECT_FALSE(open_sealed(bad).ok()) << k;
    EXPECT_FALSE(open_sealed(std::string_view(file).substr(0, k)).ok()) << k;
  }
  EXPECT_FALSE(open_sealed(file + "x").ok());
}

TEST(Envelope, KeepsTheOneBefore) {
  const ScratchFolder scratch;
  const std::string folder = scratch.path().string();
  std::string warning;
  EXPECT_FALSE(read_checkpoint(folder, warning).ok());
  for (const char* image : {"first", "second", "third"}) {
    ASSERT_FALSE(write_checkpoint(folder, image));
    EXPECT_EQ(read_checkpoint(folder, warning).value(), image);
    EXPECT_EQ(warning, "");
  }
  std::filesystem::remove(folder + "/checkpoint.h5");
  EXPECT_EQ(read_checkpoint(folder, warning).value(), "second");
  EXPECT_NE(warning.find("is missing"), std::string::npos);
  std::ofstream(folder + "/checkpoint.h5") << "rubbish";
  EXPECT_EQ(read_checkpoint(folder, warning).value(), "second");
  EXPECT_NE(warning.find("is damaged"), std::string::npos);
  EXPECT_TRUE(write_checkpoint(folder + "/not/there", "x"));
}

}  // namespace
}  // namespace edda::checkpoint_test
