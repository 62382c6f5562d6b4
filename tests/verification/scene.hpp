// Helpers of the verification problems: a model from text, run to its end with a look at every row.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "blocks/kinematics.hpp"
#include "contacts/face_reading.hpp"
#include "forces/elastic.hpp"
#include "model/read_model.hpp"
#include "step/simulation.hpp"
#include "step/step.hpp"

namespace edda {

inline Simulation scene(const std::string& toml) {
  Result<Model> model = read_model_text(toml, EDDA_SOURCE_DIR "/scene.toml", {});
  if (!model.ok()) {
    for (const Fault& f : model.faults()) ADD_FAILURE() << to_string(f);
    std::abort();
  }
  Result<Simulation> sim = Simulation::create(std::move(model.value()));
  if (!sim.ok()) {
    for (const Fault& f : sim.faults()) ADD_FAILURE() << to_string(f);
    std::abort();
  }
  return std::move(sim.value());
}

using Look = std::function<void(Simulation&)>;

/// Runs to the model's duration, calling look(sim) at t = 0 and at every history row, and each(sim)
/// after every step.
inline void run(Simulation& sim, const Look& look, const Look& each = {}) {
  const double every = sim.scene->model.output.history_every;
  const auto rows =
      static_cast<std::uint64_t>(std::llround(sim.scene->model.solver.duration / every));
  start(sim, every);
  look(sim);
  for (std::uint64_t row = 1; row <= rows; ++row) {
    const double time = static_cast<double>(row) * every;
    fit_step_to(sim, time);
    while (sim.motion.state.time < time) {
      const auto failure = step(sim);
      if (failure) FAIL() << failure->message << " at " << failure->time;
      if (each) each(sim);
    }
    look(sim);
  }
}

inline Vec2 displacement(const Simulation& sim, std::size_t i) {
  return centroid(sim.motion.state.position, i) -
         Vec2{sim.scene->blocks.centroid_x[i], sim.scene->blocks.centroid_y[i]};
}

/// The largest absolute value so far; NaN is kept.
inline void keep_largest(double& most, double value) {
  if (std::isnan(value) || std::abs(value) > most) most = std::abs(value);
}

inline double radians(double degrees) {
  return degrees * std::numbers::pi / 180.0;
}

/// A point given along and across a slope that rises to the left at `angle` degrees: u down the
/// slope.
inline std::string on_slope(double angle, double u, double v) {
  const double c = std::cos(radians(angle)), s = std::sin(radians(angle));
  char text[96];
  std::snprintf(text, sizeof text, "[%.17g, %.17g]", u * c + v * s, -u * s + v * c);
  return text;
}

inline std::string number(double v) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", v);
  return text;
}

/// A number in short form, for labels.
inline std::string brief(double v) {
  char text[40];
  std::snprintf(text, sizeof text, "%g", v);
  return text;
}

/// A rectangle as TOML, by two corners.
inline std::string rectangle(double x0, double y0, double x1, double y1) {
  return "[[" + number(x0) + "," + number(y0) + "],[" + number(x1) + "," + number(y0) + "],[" +
         number(x1) + "," + number(y1) + "],[" + number(x0) + "," + number(y1) + "]]";
}

/// Faces that still have their peak strength.
inline std::size_t bonded_faces(const Simulation& sim) {
  std::size_t count = 0;
  const FaceSet& faces = sim.motion.contacts;
  for (std::size_t k = 0; k < faces.size(); ++k) count += faces.bonded(k);
  return count;
}

}  // namespace edda
