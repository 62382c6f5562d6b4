#include "view/bytes.hpp"

#include <gtest/gtest.h>

#include <string>

namespace edda::bytes_test {
namespace {

TEST(Bytes, NumbersLieLittleEnd) {
  Bytes b;
  b.u8(1);
  b.u16(0x0203);
  b.u32(0x04050607);
  EXPECT_EQ(b.text(), std::string("\x01\x03\x02\x07\x06\x05\x04", 7));
}

TEST(Bytes, VarintsAreAsShortAsTheirValue) {
  Bytes b;
  for (const std::uint64_t v : {0ULL, 127ULL, 128ULL, 300ULL}) b.varint(v);
  EXPECT_EQ(b.text(), std::string("\x00\x7f\x80\x01\xac\x02", 6));
}

TEST(Bytes, ZigzagAlternates) {
  Bytes b;
  for (const std::int64_t v : {0, -1, 1, -2, 2, -64, 64}) b.zigzag(v);
  EXPECT_EQ(b.text(), std::string("\x00\x01\x02\x03\x04\x7f\x80\x01", 8));
}

// RFC 4648, section 10.
TEST(Bytes, Base64HasTheVectorsOfItsStandard) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64("\xff\xfe\xfd"), "//79");
}

}  // namespace
}  // namespace edda::bytes_test
