// Drawings (DXF) as texts, and what is expected of reading them.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "imports/drawing.hpp"

namespace edda::test {

inline std::string dxf(const std::string& entities, const std::string& before = "") {
  return before + "0\nSECTION\n2\nENTITIES\n" + entities + "0\nENDSEC\n0\nEOF\n";
}

using DxfPairs = std::vector<std::pair<int, std::string>>;

inline std::string groups(const DxfPairs& pairs) {
  std::string text;
  for (const auto& [code, value] : pairs) text += std::to_string(code) + '\n' + value + '\n';
  return text;
}

inline std::string entity(const std::string& name, const DxfPairs& pairs) {
  return "0\n" + name + '\n' + groups(pairs);
}

/// A section of blocks.
inline std::string blocks(const std::string& text) {
  return "0\nSECTION\n2\nBLOCKS\n" + text + "0\nENDSEC\n";
}

inline std::string block(const std::string& name, const std::string& x, const std::string& y,
                         const std::string& entities) {
  return entity("BLOCK", {{8, "0"}, {2, name}, {70, "0"}, {10, x}, {20, y}}) + entities +
         entity("ENDBLK", {});
}

inline Drawing read(const Result<Drawing>& result) {
  EXPECT_TRUE(result.ok()) << to_string(result.faults().front());
  return result.ok() ? result.value() : Drawing{};
}

inline Drawing read_dxf(const std::string& entities, const std::string& before = "") {
  return read(parse_dxf(dxf(entities, before), "a.dxf"));
}

/// The points of the only line of a drawing.
inline std::vector<Vec2> only_line(const Drawing& drawing) {
  EXPECT_EQ(drawing.lines.size(), 1U);
  EXPECT_TRUE(drawing.skipped.empty());
  return drawing.lines.empty() ? std::vector<Vec2>(2) : drawing.lines[0].points;
}

inline void expect_near(Vec2 a, Vec2 b, double tolerance) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
}

inline void expect_fault(const Result<Drawing>& result, int line, const std::string& fragment) {
  ASSERT_FALSE(result.ok()) << fragment;
  ASSERT_EQ(result.faults().size(), 1U);
  const Fault& f = result.faults()[0];
  EXPECT_EQ(f.where.line, line) << to_string(f);
  EXPECT_NE(to_string(f).find(fragment), std::string::npos) << to_string(f);
  EXPECT_FALSE(f.remedy.empty());
  EXPECT_EQ(to_string(f).find('\n'), std::string::npos);
}

/// The drawing is read, but for what has the fault.
inline void expect_left_out(const Result<Drawing>& result, int line, const std::string& fragment) {
  ASSERT_TRUE(result.ok()) << to_string(result.faults().front());
  const Drawing& drawing = result.value();
  ASSERT_TRUE(drawing.fault.has_value()) << fragment;
  expect_fault(*drawing.fault, line, fragment);
  EXPECT_GE(drawing.faulty, 1);
  int counted = 0;
  for (const auto& [kind, count] : drawing.skipped) {
    if (kind.ends_with(" with a fault")) counted += count;
  }
  EXPECT_EQ(counted, drawing.faulty);
}

}  // namespace edda::test
