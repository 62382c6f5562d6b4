// A block on a slope, and the factor of safety that is found for it.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "model/read_model.hpp"
#include "study/fos.hpp"

namespace edda::testing {

inline std::string number(double v) {
  return std::to_string(v);
}

/// A block from u0 to u1 down a slope of 30 degrees and from v0 to v1 out of it, m.
inline std::string on_ramp(double u0, double u1, double v0, double v1, const std::string& keys) {
  const double c = std::cos(std::numbers::pi / 6.0), s = std::sin(std::numbers::pi / 6.0);
  const auto p = [&](double u, double v) {
    return "[" + number(u * c + v * s) + "," + number(v * c - u * s) + "]";
  };
  return "[[block]]\n" + keys + "\npolygon = [" + p(u0, v0) + "," + p(u1, v0) + "," + p(u1, v1) +
         "," + p(u0, v1) + "]\n";
}

/// A block of 2 x 1 m on a slope of 30 degrees, its joint with `law`.
inline std::string ramp(const std::string& law, const std::string& more = {},
                        const std::string& solver = "[solver]\nduration = 0.5\n") {
  return "[materials.rock]\ndensity = 2500\nyoung = 2e8\npoisson = 0.2\n[joints.j]\n" + law +
         solver + on_ramp(-4, 6, -1, 0, "fixed = true") + on_ramp(0, 2, 0, 1, "name = 'slider'") +
         more;
}

inline Model model_of(const std::string& toml) {
  Result<Model> model = read_model_text(toml, "m.toml", {}, ReadFor::no_run);
  if (!model.ok()) ADD_FAILURE() << to_string(model.faults()[0]);
  return model.value();
}

inline FosResult found(const std::string& toml, int threads = 1,
                       std::vector<std::string>* messages = nullptr) {
  FosOptions options;
  options.threads = threads;
  if (messages != nullptr)
    options.say = [=](const std::string& line) { messages->push_back(line); };
  Result<FosResult> r = find_factor(model_of(toml), options);
  if (!r.ok()) ADD_FAILURE() << to_string(r.faults()[0]);
  return std::move(r.value());
}

/// Its factor of safety with a friction angle of 45 degrees.
inline const double exact = std::tan(std::numbers::pi / 4.0) / std::tan(std::numbers::pi / 6.0);
inline const std::string rough = "friction_angle = 45\n", coarse = "[fos]\ntolerance = 0.05\n";

}  // namespace edda::testing
