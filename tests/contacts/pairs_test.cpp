// [[contact_pair]]: the law where two joints or two materials meet.
#include <gtest/gtest.h>

#include "contacts/laws.hpp"
#include "model/read_model.hpp"

namespace edda::pairs_test {
namespace {

const std::string start = R"(
[materials.rock]
density = 2700
young = 1e9
poisson = 0.2
[materials.talus]
density = 1900
young = 1e8
poisson = 0.3
[joints.rough]
friction_angle = 40
[joints.smooth]
friction_angle = 20
[joints.seam]
friction_angle = 10
[joints.talus]
friction_angle = 33
[contact]
joint = "rough"
[[block]]
polygon = [[0, 0], [1, 0], [1, 1]]
material = "rock"
[solver]
duration = 1.0
)";
constexpr Index rough = 0, smooth = 1, seam = 2, talus = 3;
constexpr Index rock = 0, loose = 1;

LawTable table_of(const std::string& pairs) {
  const Result<Model> model = read_model_text(start + pairs, "m.toml");
  EXPECT_TRUE(model.ok()) << to_string(model.faults().front());
  return build_laws(model.value());
}

TEST(ContactPairs, WithoutThemTheJointsDecide) {
  const LawTable t = table_of("");
  EXPECT_EQ(t.resolve(rough, smooth, rock, loose), smooth);
  EXPECT_EQ(t.resolve(none, none, rock, loose), rough);
}

TEST(ContactPairs, MaterialsHaveTheirLawWhateverTheEdgesName) {
  const LawTable t =
      table_of("[[contact_pair]]\nbetween = [\"talus\", \"rock\"]\njoint = \"talus\"\n");
  for (const Index a : {none, rough, seam}) {
    for (const Index b : {none, smooth, seam}) {
      EXPECT_EQ(t.resolve(a, b, rock, loose), talus);
      EXPECT_EQ(t.resolve(a, b, loose, rock), talus);
      EXPECT_EQ(t.resolve(a, b, rock, rock), t.resolve(a, b));
    }
  }
}

TEST(ContactPairs, JointsHaveTheirLawAndComeBeforeMaterials) {
  const LawTable t = table_of(
      "[[contact_pair]]\nbetween = [\"rough\", \"smooth\"]\njoint = \"seam\"\n"
      "[[contact_pair]]\nbetween = [\"rock\", \"talus\"]\njoint = \"talus\"\n");
  EXPECT_EQ(t.resolve(rough, smooth, rock, rock), seam);
  EXPECT_EQ(t.resolve(smooth, rough, rock, rock), seam);
  EXPECT_EQ(t.resolve(smooth, none, rock, loose), seam);  // none counts as contact.joint, rough
  EXPECT_EQ(t.resolve(smooth, smooth, rock, rock), smooth);
  EXPECT_EQ(t.resolve(smooth, seam, rock, loose), talus);
}

}  // namespace
}  // namespace edda::pairs_test
