// Names of other programs, and the keys that they have here.
#include "model/table/synonyms.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "model/base_model.hpp"
#include "model/read_model.hpp"
#include "model/table/keys.hpp"

namespace edda::synonyms_test {
namespace {

using testing::base_model;

/// Whether a model may have a key such as "solver.damping.local" or "boundary".
bool is_known(std::string_view dotted) {
  const std::size_t dot = dotted.find('.');
  const Section* section = find_section(dotted.substr(0, dot));
  if (section == nullptr) {
    return dot == std::string_view::npos && find_key(sections().front().keys, dotted) != nullptr;
  }
  if (dot == std::string_view::npos) return true;
  const std::string_view rest = dotted.substr(dot + 1);
  const std::size_t inner = rest.find('.');
  const Key* key = find_key(section->keys, rest.substr(0, inner));
  if (key == nullptr || inner == std::string_view::npos) return key != nullptr;
  Model model;
  const Slot slot = key->slot(section->add(&model));
  const SubTable* table = std::get_if<SubTable>(&slot);
  return table != nullptr && find_key(table->keys, rest.substr(inner + 1)) != nullptr;
}

TEST(Synonyms, NameKeysThatThereAre) {
  std::set<std::string_view> seen;
  for (const Synonym& s : synonyms()) {
    EXPECT_TRUE(seen.insert(s.word).second) << s.word << " stands twice";
    EXPECT_TRUE(find_section(s.word) == nullptr || s.keys.find('.') != std::string_view::npos)
        << s.word << " is a table";
    EXPECT_FALSE(s.keys.empty() && s.note.empty()) << s.word;
    for (std::string_view keys = s.keys; !keys.empty();) {
      const std::size_t end = std::min(keys.find(' '), keys.size());
      EXPECT_TRUE(is_known(keys.substr(0, end))) << s.word << ": " << keys.substr(0, end);
      keys.remove_prefix(std::min(keys.size(), end + 1));
    }
  }
}

TEST(Synonyms, AreNamedForUnknownKeys) {
  const auto remedy = [](const std::string& text) {
    const Result<Model> model = read_model_text(text, "m.toml");
    EXPECT_FALSE(model.ok()) << text;
    return model.ok() ? std::string{} : model.faults()[0].remedy;
  };
  const auto below = [&](const std::string& text) { return remedy(base_model + text); };
  EXPECT_EQ(below("[[cable]]\nx = 1\n"), "here that is [[bolt]]");
  EXPECT_EQ(below("[insitu]\nx = 1\n"), "here that is [initial_stress]");
  EXPECT_EQ(below("[[hist]]\nx = 1\n"), "here that is [[monitor]] or history_every of [output]");
  EXPECT_EQ(below("[fix]\nx = 1\n"), "here that is fixed of [[block]], [[fixed]] or [[boundary]]");
  EXPECT_EQ(below("[liner]\nx = 1\n"), "here that is [[lining]]");
  EXPECT_EQ(below("[contact]\njoint = \"rough\"\n[joints.a]\nfriction_angle = 3\njkn = 1e9\n"),
            "here that is kn of [joints.NAME]");
  EXPECT_EQ(below("[solver2]\n").substr(0, 12), "did you mean");
  EXPECT_EQ(below("[\"Boundary xvel\"]\n").substr(0, 24), "here that is [[boundary]");
  EXPECT_EQ(remedy("cycle = 1000\n" + base_model).substr(0, 55),
            "here that is duration of [solver] or until of [[stage]]");
  EXPECT_EQ(synonym_hint("qwertyuiop"), "");
  for (const char* word :
       {"support",   "cable",  "liner", "hist",  "insitu", "fix",  "zone",          "block cut",
        "gridpoint", "struct", "range", "cycle", "solve",  "damp", "boundary xvel", "joint_model",
        "jkn",       "jks",    "jfric", "jcoh",  "jtens",  "bulk", "shear"}) {
    EXPECT_NE(synonym_hint(word), "") << word;
  }
}

}  // namespace
}  // namespace edda::synonyms_test
