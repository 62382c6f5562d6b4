// Numbers, CSV, JSON and hashes as text.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <random>

#include "results/csv.hpp"
#include "results/json.hpp"
#include "results/sha256.hpp"

namespace edda::text_test {
namespace {

TEST(Numbers, ReadBackToTheSameBits) {
  std::mt19937_64 random(7);
  for (int k = 0; k < 100000; ++k) {
    const std::uint64_t bits = random();
    double value;
    static_assert(sizeof value == sizeof bits);
    std::memcpy(&value, &bits, sizeof value);
    if (!std::isfinite(value)) continue;
    EXPECT_EQ(std::strtod(shortest(value).c_str(), nullptr), value);
  }
  EXPECT_EQ(shortest(0.1), "0.1");
  EXPECT_EQ(shortest(-0.0), "0");
  EXPECT_EQ(shortest(std::numeric_limits<double>::denorm_min()), "5e-324");
}

TEST(Csv, QuotesOnlyWhatNeedsIt) {
  Csv csv;
  csv.add("a").add("b").end().add(1.5).add("plain").end().add(2).add("a,\"b\"").end();
  EXPECT_EQ(csv.text(), "a,b\n1.5,plain\n2,\"a,\"\"b\"\"\"\n");
}

TEST(Json, EscapesTextAndKeepsItsForm) {
  Json json;
  json.open_object().pair("text", "a\"b\\c\n\x01").pair("none", std::nan("")).pair("yes", true);
  json.key("list").open_list().value(1).value(0.5).close().key("empty").open_list().close().close();
  EXPECT_EQ(json.text(),
            "{\n  \"text\": \"a\\\"b\\\\c\\n\\u0001\",\n  \"none\": null,\n  \"yes\": true,\n"
            "  \"list\": [\n    1,\n    0.5\n  ],\n  \"empty\": []\n}\n");
}

TEST(Json, OneLineKeepsTextsAsTheyAre) {
  Json json;
  json.open_object().pair("a", "x,\n  y").key("b").open_list().value(1).value(2).close().close();
  EXPECT_EQ(json.line(), R"({"a": "x,\n  y", "b": [1, 2]})");
}

TEST(Json, ReplacesBytesThatAreNoUtf8) {
  Json json;
  json.open_list().value("\xc3\xa9\xff\xc3").close();
  EXPECT_EQ(json.text(), "[\n  \"\xc3\xa9\xef\xbf\xbd\xef\xbf\xbd\"\n]\n");
}

TEST(Sha256, KnowsTheStandardsVectors) {
  EXPECT_EQ(sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(sha256(std::string(1000000, 'a')),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

}  // namespace
}  // namespace edda::text_test
