// Random damage to a good model: either it is still a model, and then survives being written and
// read, or it has faults that state place and remedy.
#include <gtest/gtest.h>

#include <array>
#include <random>
#include <string>
#include <string_view>

#include "model/base_model.hpp"
#include "model/read_model.hpp"
#include "model/write_model.hpp"

namespace edda::mutation_test {
namespace {

constexpr std::array<std::string_view, 24> tokens{
    "nan", "-inf", "-1",   "0",    "1e300", "1e-320", "\"x\"", "[",
    "]",   "{",    "}",    "=",    ".",     "\n",     "\"\"",  "'''",
    "#",   "[[",   "true", "\xff", "block", "joint",  "[1]",   "\"1 %\""};

std::string damaged(std::string text, std::mt19937& random) {
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random()) % n; };
  const std::string_view token = tokens[below(tokens.size())];
  const std::size_t at = below(text.size());
  const std::size_t line_end = text.find('\n', at);
  const std::size_t value = text.find("= ", at);
  switch (below(4)) {
    case 0:
      return text.insert(at, token);
    case 1:
      return text.erase(at, 1 + below(5));
    case 2:
      return line_end != std::string::npos && line_end + 1 < text.size()
                 ? text.erase(line_end, text.find('\n', line_end + 1) - line_end)
                 : text;
    default:
      return value == std::string::npos
                 ? text
                 : text.replace(value + 2, text.find('\n', value) - value - 2, token);
  }
}

TEST(Mutation, GivesAModelOrFaultsWithAPlace) {
  std::mt19937 random(20180601);
  int good = 0;
  for (int i = 0; i < 4000; ++i) {
    std::string text = testing::base_model;
    for (int k = 0; k <= i % 3; ++k) text = damaged(text, random);
    SCOPED_TRACE(text);
    const Result<Model> first = read_model_text(text, "m.toml");
    if (first.ok()) {
      ++good;
      const std::string written = to_toml(first.value());
      const Result<Model> second = read_model_text(written, "m.toml");
      ASSERT_TRUE(second.ok()) << written << to_string(second.faults()[0]);
      ASSERT_EQ(to_toml(second.value()), written);
      continue;
    }
    ASSERT_FALSE(first.faults().empty());
    for (const Fault& fault : first.faults()) {
      ASSERT_GT(fault.where.line, 0) << to_string(fault);
      ASSERT_FALSE(fault.problem.empty() || fault.remedy.empty()) << to_string(fault);
      ASSERT_EQ(to_string(fault).find('\n'), std::string::npos) << to_string(fault);
    }
  }
  EXPECT_GT(good, 50) << "the damage should leave some models whole";
}

}  // namespace
}  // namespace edda::mutation_test
