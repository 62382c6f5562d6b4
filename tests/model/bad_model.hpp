// Bad models, each with exactly the faults that it must give.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "model/base_model.hpp"
#include "model/read_model.hpp"

namespace edda::testing {

struct ExpectedFault {
  int line;
  std::string key;
  std::string fragment;
};

struct BadModel {
  std::string name;
  std::string text;
  std::vector<ExpectedFault> faults;
};

inline std::string as_lines(const Faults& faults) {
  std::string lines;
  for (const Fault& fault : faults) lines += to_string(fault) + '\n';
  return lines;
}

inline void expect_faults(const BadModel& bad) {
  SCOPED_TRACE(bad.name);
  const Result<Model> result = read_model_text(bad.text, "m.toml");
  ASSERT_FALSE(result.ok()) << "no fault was found";
  const Faults& faults = result.faults();
  ASSERT_EQ(faults.size(), bad.faults.size()) << as_lines(faults);
  for (std::size_t i = 0; i < faults.size(); ++i) {
    EXPECT_EQ(faults[i].where.line, bad.faults[i].line) << to_string(faults[i]);
    EXPECT_EQ(faults[i].where.key, bad.faults[i].key) << to_string(faults[i]);
    EXPECT_EQ(faults[i].where.file, "m.toml");
    EXPECT_NE(to_string(faults[i]).find(bad.faults[i].fragment), std::string::npos)
        << to_string(faults[i]) << "\n lacks: " << bad.faults[i].fragment;
    EXPECT_FALSE(faults[i].problem.empty());
    EXPECT_FALSE(faults[i].remedy.empty());
    EXPECT_EQ(to_string(faults[i]).find('\n'), std::string::npos);
  }
}

/// base_model with one replacement and the one fault that it must give.
inline BadModel broken(const std::string& name, const std::string& from, const std::string& to,
                       int line, const std::string& key, const std::string& fragment) {
  return {name, base_with(from, to), {{line, key, fragment}}};
}

inline void expect_all(const std::vector<BadModel>& models) {
  for (const BadModel& bad : models) expect_faults(bad);
}

}  // namespace edda::testing
