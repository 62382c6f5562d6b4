// The ends of faces in records, for the models of examples/ after some steps.
#include <gtest/gtest.h>

#include <filesystem>

#include "contacts/face_reading.hpp"
#include "model/read_model.hpp"
#include "observe/observe.hpp"
#include "run/prepared.hpp"
#include "step/faces_now.hpp"
#include "step/step.hpp"

namespace edda::face_ends_test {
namespace {

Simulation after_steps(const std::filesystem::path& file, int steps) {
  Result<Model> model = read_model(file.string(), {}, ReadFor::no_run);
  EXPECT_TRUE(model.ok()) << file;
  Result<Simulation> made = Simulation::create(std::move(model.value()));
  EXPECT_TRUE(made.ok()) << file;
  Simulation sim = std::move(made.value());
  start(sim, 1e-9 + 1e3 * sim.control.limit);
  for (int n = 0; n < steps; ++n) EXPECT_FALSE(step(sim)) << file;
  return sim;
}

/// Both ends lie on the edge of block j, and their distance along the frame is the length of the
/// face.
TEST(FaceEnds, AreAsFarApartAsTheFaceIsLong) {
  std::size_t faces = 0, tilted = 0, passed = 0;
  for (const auto& entry : std::filesystem::directory_iterator(EDDA_SOURCE_DIR "/examples")) {
    if (entry.path().extension() != ".toml") continue;
    const Simulation sim = after_steps(entry.path(), 200);
    const FaceSet& f = sim.motion.contacts;
    for (std::size_t k = 0; k < f.size(); ++k) {
      const FaceSpan span = span_of(face_row(sim, k), sim.motion.pose);
      const FacePoints at = face_points(f, sim.motion.pose.x, sim.motion.pose.y, k);
      const Vec2 t = frame_of(at, f.inverse_e[k], f.inverse_f[k]), edge = unit(at.p2 - at.p1);
      const double length = face_row(sim, k).state.length, apart = norm(span.b - span.a);
      if (!(norm(t) > 0.0)) continue;
      ++faces;
      const std::string face = entry.path().filename().string() + ", face " + std::to_string(k);
      if (length == 0.0) {
        ASSERT_EQ(apart, 0.0) << face;
        ++passed;
        continue;
      }
      const double rounding = 1e-6 * length + 1e-12;
      ASSERT_NEAR(dot(span.b - span.a, t), length, rounding) << face;
      ASSERT_NEAR(cross(span.a - at.p1, edge), 0.0, rounding) << face;
      ASSERT_NEAR(cross(span.b - at.p1, edge), 0.0, rounding) << face;
      ASSERT_NEAR(apart * dot(edge, t), length, rounding) << face;
      if (dot(edge, t) < 0.9) ++tilted;
    }
  }
  EXPECT_GT(faces, 5000u);
  EXPECT_GT(tilted, 100u);
  EXPECT_GT(passed, 100u);
}

}  // namespace
}  // namespace edda::face_ends_test
