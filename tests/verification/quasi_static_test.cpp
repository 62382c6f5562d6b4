// Loads that grow slowly, without inertia (row 65).
#include <gtest/gtest.h>

#include <string>

#include "model/read_model.hpp"
#include "study/fos.hpp"
#include "study/masonry_panel.hpp"
#include "verification/record.hpp"

namespace edda::quasi_static_test {
namespace {

TEST(QuasiStatic, APanelFailsAtTheLimitOfRigidBlocksHoweverStiff) {
  for (const char* young : {"50", "5", "0.5"}) {
    const std::string text = testing::masonry_panel(std::stod(young) * 1e9) +
                             "[fos]\nvary = \"kh\"\nbracket = [0.63, 0.65]\ntolerance = 0.006\n";
    const Result<Model> model = read_model_text(text, "m.toml", {}, ReadFor::no_run);
    ASSERT_TRUE(model.ok()) << to_string(model.faults()[0]);
    const Result<FosResult> r = find_factor(model.value(), {});
    ASSERT_TRUE(r.ok()) << to_string(r.faults()[0]);
    ASSERT_TRUE(r.value().factor) << r.value().message;
    // Without dilation the limit is a little lower, 0.6398 (Ferris and Tin-Loi 2001).
    expect_relative({65, std::string("E = ") + young + " GPa", "seismic coefficient", ""},
                    *r.value().factor, 0.6428590, -8e-3, 5e-3);
    ASSERT_TRUE(r.value().rigid);
    EXPECT_TRUE(r.value().rigid->below_most);
    EXPECT_NEAR(r.value().rigid->most, 0.6428590, 1e-6);
  }
}

}  // namespace
}  // namespace edda::quasi_static_test
