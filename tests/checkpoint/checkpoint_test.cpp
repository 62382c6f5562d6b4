#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <new>
#include <numeric>
#include <span>
#include <thread>
#include <type_traits>

#include "checkpoint/archive.hpp"
#include "checkpoint/envelope.hpp"
#include "checkpoint/hdf5_image.hpp"
#include "results/sha256.hpp"
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
  RecordKeeper keeper(record);
  Saver saver(keeper);
  list(saver, thing);
  return record;
}

/// An image in memory, of which no more than so many bytes can be written.
class InMemory : public ImageBytes {
 public:
  explicit InMemory(std::uint64_t most = std::uint64_t{1} << 40) : most_(most) {}
  const std::string& bytes() const { return bytes_; }
  bool good() const noexcept override { return good_; }
  std::uint64_t size() const noexcept override { return bytes_.size(); }
  bool read(std::uint64_t from, std::span<char> into) const noexcept override {
    if (!good_ || from + into.size() > bytes_.size()) return false;
    std::copy_n(bytes_.begin() + static_cast<std::ptrdiff_t>(from), into.size(), into.begin());
    return true;
  }
  void write(std::uint64_t from, std::string_view bytes) noexcept override {
    good_ = good_ && from + bytes.size() <= most_;
    if (!good_) return;
    resize(std::max<std::uint64_t>(bytes_.size(), from + bytes.size()));
    bytes_.replace(from, bytes.size(), bytes);
  }
  void resize(std::uint64_t size) noexcept override { bytes_.resize(size); }

 private:
  std::uint64_t most_;
  std::string bytes_;
  bool good_ = true;
};

void put_all(const Record& record, RecordSink& sink) {
  for (const auto& [name, value] : record) {
    std::visit(
        [&sink, &name = name](const auto& v) {
          using Values = std::decay_t<decltype(v)>;
          if constexpr (std::is_same_v<Values, std::string>) {
            sink.put(name, std::string_view(v));
          } else {
            sink.put(name, std::span<const typename Values::value_type>(v));
          }
        },
        value);
  }
}

void write_record(ImageBytes& image, const Record& record) {
  write_hdf5(image, [&](RecordSink& sink) { put_all(record, sink); });
}

std::string image_of(const Record& record) {
  InMemory image;
  write_record(image, record);
  return image.bytes();
}

/// Writes these bytes as an image, in two pieces, the second first.
WriteImage image_from(const std::string& bytes) {
  return [bytes](ImageBytes& image) {
    const std::size_t half = bytes.size() / 2;
    image.write(half, std::string_view(bytes).substr(half));
    image.write(0, std::string_view(bytes).substr(0, half));
  };
}

std::string sealed(const std::string& image) {
  return seal(image.size(), sha256(image)) + image;
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
  const std::string image = image_of(record);
  const Result<Record> back = from_hdf5(image);
  ASSERT_TRUE(back.ok());
  EXPECT_EQ(back.value(), record);
  EXPECT_EQ(image_of(back.value()).size(), image.size());
}

TEST(Hdf5Image, RefusesWhatIsNoFile) {
  EXPECT_FALSE(from_hdf5("").ok());
  EXPECT_FALSE(from_hdf5("nonsense").ok());
}

TEST(Envelope, OpensWhatItSealed) {
  for (const std::string& image : {std::string(), std::string("x"), std::string(100000, 'q')}) {
    const std::string file = sealed(image);
    const auto opened = open_sealed(file);
    ASSERT_TRUE(opened.ok());
    EXPECT_EQ(opened.value(), image);
  }
}

/// Every single flipped bit and every shorter file is found out.
TEST(Envelope, FindsEveryFlippedBitAndEveryLostByte) {
  const std::string image = image_of({{"a", std::vector<double>{1.0, 2.0}}});
  const std::string file = sealed(image);
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
    ASSERT_FALSE(write_checkpoint(folder, image_from(image)));
    EXPECT_EQ(read_checkpoint(folder, warning).value(), image);
    EXPECT_EQ(warning, "");
  }
  std::filesystem::remove(folder + "/checkpoint.h5");
  EXPECT_EQ(read_checkpoint(folder, warning).value(), "second");
  EXPECT_NE(warning.find("is missing"), std::string::npos);
  std::ofstream(folder + "/checkpoint.h5") << "rubbish";
  EXPECT_EQ(read_checkpoint(folder, warning).value(), "second");
  EXPECT_NE(warning.find("is damaged"), std::string::npos);
  EXPECT_TRUE(write_checkpoint(folder + "/not/there", image_from("x")));
}

/// What is written straight into the file is what is made in memory, and is read back.
TEST(Envelope, TakesAnImageWithoutKeepingIt) {
  const ScratchFolder scratch;
  const std::string folder = scratch.path().string();
  Record record = record_of(Thing{});
  std::vector<double> many(300000);
  std::iota(many.begin(), many.end(), 0.5);
  record["many"] = many;
  ASSERT_FALSE(write_checkpoint(folder, [&](ImageBytes& image) { write_record(image, record); }));
  std::string warning;
  const Result<std::string> image = read_checkpoint(folder, warning);
  ASSERT_TRUE(image.ok());
  EXPECT_EQ(image.value(), image_of(record));
  const Result<Record> back = from_hdf5(image.value());
  ASSERT_TRUE(back.ok());
  EXPECT_EQ(back.value(), record);
  EXPECT_FALSE(std::filesystem::exists(folder + "/checkpoint.h5.part"));
}

/// An image that throws leaves everything as it was.
TEST(Envelope, KeepsTheLastOneWhereMemoryEnds) {
  const ScratchFolder scratch;
  const std::string folder = scratch.path().string();
  ASSERT_FALSE(write_checkpoint(folder, image_from("first")));
  const auto no_memory = [](ImageBytes& image) {
    image.write(0, "half of the sec");
    throw std::bad_alloc();
  };
  EXPECT_THROW((void)write_checkpoint(folder, no_memory), std::bad_alloc);
  std::string warning;
  EXPECT_EQ(read_checkpoint(folder, warning).value(), "first");
  EXPECT_EQ(warning, "");
  const auto files = std::filesystem::directory_iterator(folder);
  EXPECT_EQ(std::distance(begin(files), end(files)), 1);
}

/// Wherever a disk is full: HDF5 closes its file, and the next image is written as if nothing had
/// happened.
TEST(Hdf5Image, GoesOnAfterAFullDisk) {
  const Record record = record_of(Thing{});
  const std::string whole = image_of(record);
  for (std::uint64_t most = 0; most < whole.size(); most += 97) {
    InMemory full(most);
    write_record(full, record);
    EXPECT_FALSE(full.good()) << most;
  }
  EXPECT_EQ(image_of(record), whole);
}

TEST(Hdf5Image, HasTheSameBytesASecondLater) {
  const Record record = record_of(Thing{});
  const std::string image = image_of(record);
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));
  EXPECT_EQ(image_of(record), image);
}

TEST(Sha256, IsThatOfThePieces) {
  const std::string text = "abc";
  EXPECT_EQ(sha256(text), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  Sha256 hash;
  for (const char letter : text) hash.add({&letter, 1});
  EXPECT_EQ(hash.digits(), sha256(text));
}

}  // namespace
}  // namespace edda::checkpoint_test
