#include "results/deflate.hpp"

#include <gtest/gtest.h>

#include <string>

namespace edda::deflate_test {
namespace {

TEST(Deflate, InflatesToTheSame) {
  std::string text;
  for (unsigned k = 0; k < 100000; ++k) text += static_cast<char>(k * k % 251);
  for (const bool fastest : {false, true}) {
    const std::string packed = deflated(text, fastest);
    EXPECT_LT(packed.size(), text.size() / 2);
    EXPECT_EQ(inflated(packed, text.size()), text);
    EXPECT_FALSE(inflated(packed, text.size() - 1));
    EXPECT_FALSE(inflated(packed.substr(0, packed.size() - 1), text.size()));
  }
}

// RFC 1950: a stream begins with 0x78, and both of its first bytes are a multiple of 31.
TEST(Deflate, HasTheHeaderOfZlib) {
  const std::string packed = deflated("edda");
  EXPECT_EQ(packed[0], '\x78');
  EXPECT_EQ(
      (static_cast<unsigned char>(packed[0]) * 256 + static_cast<unsigned char>(packed[1])) % 31,
      0);
}

}  // namespace
}  // namespace edda::deflate_test
