// Linings beside other parts of a model: joints, water, loads, boundaries, stages, numbering.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "blocks/build_blocks.hpp"
#include "run/prepared.hpp"
#include "step/changes.hpp"

namespace edda::linings_test {
namespace {

using testing::prepared;
using testing::ran;
using testing::Ran;

const std::string rock =
    "[materials.rock]\ndensity = 2500\nyoung = 5e9\npoisson = 0.2\n"
    "[materials.concrete]\ndensity = 2400\nyoung = 2e10\npoisson = 0.2\n";

/// The laws between a lining and rock, and between rock and rock, by name.
struct Laws {
  std::vector<std::string> of_lining, of_rock;
};
Laws laws_of(const Simulation& sim) {
  const BlockSet& b = sim.scene->blocks;
  const FaceSet& f = sim.motion.contacts;
  Laws laws;
  for (std::size_t k = 0; k < f.size(); ++k) {
    const bool lining =
        b.is_lining(b.vertex_block[f.edge[k]]) || b.is_lining(b.vertex_block[f.facing[k]]);
    std::vector<std::string>& of = lining ? laws.of_lining : laws.of_rock;
    of.push_back(sim.scene->model.joints[f.law[k]].name);
  }
  return laws;
}
bool all_are(const std::vector<std::string>& names, const std::string& name) {
  return !names.empty() &&
         std::all_of(names.begin(), names.end(), [&](const std::string& n) { return n == name; });
}

void change_joints(Simulation& sim, Index from, Index to) {
  PropertyChange change;
  change.joints = from;
  change.row = to;
  change.laws = {{from, to}};
  change_properties(sim, change);
}

/// A lining on a block of weak joints, and two blocks one of which names the law of its interface.
std::string slab(const std::string& more) {
  return rock + R"([joints.low]
friction_angle = 10
[joints.bond]
friction_angle = 40
cohesion = 1e6
tensile_strength = 1e6
[joints.aged]
friction_angle = 45
cohesion = 3e6
[contact]
joint = 'low'
[[block]]
fixed = true
polygon = [[0, 0], [4, 0], [4, 1], [0, 1]]
joint = 'low'
material = 'rock'
[[block]]
fixed = true
polygon = [[10, 0], [14, 0], [14, 1], [10, 1]]
joint = 'low'
material = 'rock'
[[block]]
polygon = [[11, 1], [12, 1], [12, 2], [11, 2]]
joint = 'bond'
material = 'rock'
[[lining]]
name = 'slab'
along = [[0.5, 1], [3.5, 1]]
material = 'concrete'
thickness = 0.2
interface = 'bond'
)" + more;
}

/// What a lining names holds for its own faces, and for no others, also once it has changed.
TEST(Linings, TheInterfaceIsThatOfTheLiningAlone) {
  PreparedRun ready = prepared(slab("[solver]\nduration = 0.01\n"));
  Simulation& sim = ready.sim;
  EXPECT_TRUE(all_are(laws_of(sim).of_lining, "bond"));
  EXPECT_TRUE(all_are(laws_of(sim).of_rock, "low"));
  change_joints(sim, 1, 2);
  EXPECT_TRUE(all_are(laws_of(sim).of_lining, "aged"));
  EXPECT_TRUE(all_are(laws_of(sim).of_rock, "low"));
}

/// Edges that name no joint go on giving way to those that do, when their law changes.
TEST(Linings, UnnamedJointsThatChangeGiveWayToNamedOnes) {
  for (const bool named : {true, false}) {
    PreparedRun ready = prepared(rock + R"([joints.base]
friction_angle = 30
[joints.strong]
friction_angle = 45
[joints.weak]
friction_angle = 5
[contact]
joint = 'base'
[[block]]
fixed = true
polygon = [[0, 0], [4, 0], [4, 1], [0, 1]]
material = 'rock'
)" + std::string(named ? "joint = 'strong'\n" : "") +
                                 R"([[block]]
polygon = [[1, 1], [2, 1], [2, 2], [1, 2]]
material = 'rock'
[solver]
duration = 0.01
)");
    change_joints(ready.sim, 0, 2);
    EXPECT_TRUE(all_are(laws_of(ready.sim).of_rock, named ? "strong" : "weak"));
  }
}

std::string lined_hole(const std::string& more) {
  return rock + R"([joints.j]
friction_angle = 40
[domain]
outline = [[0, 0], [10, 0], [10, 10], [0, 10]]
material = 'rock'
[[trace]]
points = [[5, 0], [5, 10]]
[[opening]]
name = 'hole'
polygon = [[4, 4], [6, 4], [6, 6], [4, 6]]
[[boundary]]
sides = ['bottom', 'left', 'right']
type = 'fixed'
[[lining]]
name = 'shell'
opening = 'hole'
material = 'concrete'
thickness = 0.2
[[lining]]
name = 'second'
on = 'shell'
material = 'concrete'
thickness = 0.1
[solver]
duration = 0.01
)" + more;
}

/// In an opening that is drained no water presses on linings, as none does on the wall.
TEST(Linings, OfDrainedOpeningsAreDry) {
  for (const bool flooded : {false, true}) {
    const PreparedRun ready =
        prepared(lined_hole("[[water]]\ntable = [[-1, 9], [11, 9]]\n" +
                            std::string(flooded ? "flooded = ['hole']\n" : "")));
    const BlockSet& b = ready.sim.scene->blocks;
    std::size_t wet = 0;
    for (const WetEdge& e : ready.sim.attached.loads.wet)
      wet += b.is_lining(b.vertex_block[e.edge]);
    EXPECT_EQ(wet > 0, flooded);
  }
}

/// A pressure on the wall acts on the rock behind a lining.
TEST(Linings, LoadsOnTheWallDoNotPushTheirBacks) {
  const PreparedRun ready =
      prepared(lined_hole("[[load]]\nalong = [[4, 4], [4, 6]]\npressure = 1e4\n"));
  const BlockSet& b = ready.sim.scene->blocks;
  const auto& edges = ready.sim.attached.loads.edges;
  ASSERT_FALSE(edges.empty());
  for (const EdgeLoad& e : edges) EXPECT_FALSE(b.is_lining(b.vertex_block[e.edge]));
}

/// The sides of a model of single blocks are those of its rock.
TEST(Linings, DoNotMoveTheSides) {
  const Ran r = ran(
      slab("[[boundary]]\nname = 'top'\nsides = ['top']\ntype = 'stress'\ntraction = [0, -1e5]\n"
           "[[stage]]\nduration = 0.001\n[[stage]]\nduration = 0.001\ninstall = ['slab']\n"));
  const BlockSet& b = r.ready.sim.scene->blocks;
  ASSERT_FALSE(r.ready.sim.attached.loads.edges.empty());
  for (const EdgeLoad& e : r.ready.sim.attached.loads.edges)
    EXPECT_EQ(b.vertex(e.edge).y + b.origin.y, 2.0);
}

std::string first_fault(const std::string& text) {
  Result<Model> model = read_model_text(text, "m.toml", {});
  if (!model.ok()) return to_string(model.faults()[0]);
  const Result<PreparedRun> run = prepare_run(std::move(model.value()));
  return run.ok() ? std::string() : to_string(run.faults()[0]);
}

TEST(Linings, AreRefusedWhereTheyCannotBe) {
  std::string turned = slab("[solver]\nduration = 0.01\n");
  const std::string line = "[[0.5, 1], [3.5, 1]]";
  turned.replace(turned.find(line), line.size(), "[[3.5, 1], [0.5, 1]]");
  EXPECT_NE(first_fault(turned).find("the other way round"), std::string::npos);
  const auto staged = [](const std::string& first, const std::string& then) {
    return first_fault(lined_hole("[[stage]]\nduration = 0.005\ninstall = [" + first +
                                  "]\n[[stage]]\nduration = 0.005\ninstall = [" + then + "]\n"));
  };
  EXPECT_EQ(staged("'shell'", "'second'"), "");
  EXPECT_NE(staged("'second'", "'shell'").find("is not there yet"), std::string::npos);
  EXPECT_NE(first_fault(lined_hole("[[stage]]\nduration = 0.01\ninstall = ['shell']\n"))
                .find("is not there at the start"),
            std::string::npos);
  std::string yields = lined_hole("");
  yields.insert(yields.find("[joints.j]"),
                "yield = { friction_angle = 30, cohesion = 1e6, tensile_strength = 1e5 }\n");
  EXPECT_NE(first_fault(yields).find("which beams do not have"), std::string::npos);
}

/// Concrete of one material that hardens in stages: what is not there yet stays young.
TEST(Linings, ThatAreNotThereYetDoNotHarden) {
  const std::string hard =
      "[materials.hard]\ndensity = 2400\nyoung = 3e10\npoisson = 0.2\n"
      "strength = { ucs = 20e6, tension = 2e6 }\n";
  const auto stages = [](const std::string& change) {
    return "[[stage]]\nduration = 0.005\ninstall = ['shell']\n[[stage]]\nduration = 0.005\n" +
           std::string("change = [") + change + "]\ninstall = ['second']\n";
  };
  const Ran r = ran(hard + lined_hole(stages("{ material = 'concrete', to = 'hard' }")));
  const Scene& scene = *r.ready.sim.scene;
  std::size_t seen = 0;
  for (std::size_t i = 0; i < scene.blocks.size(); ++i) {
    if (!scene.blocks.is_lining(i)) continue;
    const bool first = scene.blocks.lining[i] == 0;
    const LiningPiece& piece =
        scene.zones.piece[scene.zones.piece_of_pair[scene.zones.pair_begin[i]]];
    EXPECT_EQ(scene.model.materials[static_cast<std::size_t>(scene.blocks.material[i])].name,
              first ? "hard" : "concrete");
    EXPECT_EQ(scene.zones.strength[piece.strength].empty(), !first);
    EXPECT_NEAR(piece.shape.axial, first ? 0.2 * 3e10 / 0.96 : 0.1 * 2e10 / 0.96, 1.0);
    ++seen;
  }
  EXPECT_EQ(seen, 2u);
  // Another density, another kind of strength, and the rock's own material.
  const auto refused = [&](const std::string& material, const std::string& change) {
    return first_fault("[materials.x]\npoisson = 0.2\n" + material + lined_hole(stages(change)));
  };
  EXPECT_NE(refused("density = 2500\nyoung = 3e10\n", "{ material = 'concrete', to = 'x' }")
                .find("another density"),
            std::string::npos);
  EXPECT_NE(
      refused("density = 2400\nyoung = 3e10\nyield = { friction_angle = 30, cohesion = 1e6 }\n",
              "{ material = 'concrete', to = 'x' }")
          .find("which beams do not have"),
      std::string::npos);
  std::string shared = lined_hole(stages("{ material = 'rock', to = 'x' }"));
  for (std::size_t at; (at = shared.find("material = 'concrete'")) != std::string::npos;)
    shared.replace(at, 21, "material = 'rock'");
  EXPECT_NE(first_fault("[materials.x]\npoisson = 0.2\ndensity = 2500\nyoung = 3e10\n" + shared)
                .find("give the lining a material of its own"),
            std::string::npos);
}

/// Monitors are where they were when the blocks are numbered the other way round.
TEST(Linings, ReversedNumbersAreOtherNumbersAlone) {
  const std::string text = lined_hole("[[monitor]]\nname = 'm'\npoint = [2, 7]\n");
  const PreparedRun one = prepared(text);
  Result<Model> model = read_model_text(text, "m.toml", {});
  ASSERT_TRUE(model.ok());
  const Result<PreparedRun> other = prepare_run(std::move(model.value()), BlockOrder::reversed);
  ASSERT_TRUE(other.ok());
  const BlockSet &a = one.sim.scene->blocks, &b = other.value().sim.scene->blocks;
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a.centroid_x[i], b.centroid_x[b.size() - 1 - i]);
    EXPECT_EQ(a.is_lining(i), b.is_lining(b.size() - 1 - i));
  }
}

/// What the wall has moved before a lining came is no motion of the lining.
TEST(Linings, HaveNotMovedWithTheWallBeforeThem) {
  const Ran r = ran(rock + R"([joints.j]
friction_angle = 40
[joints.bond]
type = 'glued'
[contact]
joint = 'j'
[[block]]
polygon = [[0, 0], [4, 0], [4, 1], [0, 1]]
material = 'rock'
[[boundary]]
name = 'lift'
type = 'displacement'
along = [[0, 0], [4, 0]]
displacement = [0, 0.3]
[[lining]]
name = 'slab'
along = [[0.5, 1], [3.5, 1]]
material = 'concrete'
thickness = 0.2
interface = 'bond'
[[stage]]
until = 'equilibrium'
[[stage]]
until = 'equilibrium'
install = ['slab']
)");
  EXPECT_EQ(r.outcome.status, Status::equilibrium) << r.outcome.message;
  EXPECT_EQ(r.outcome.loose, 0u) << r.outcome.message;
}

/// Two that meet in a corner still do when they come on walls that have moved.
TEST(Linings, MeetInACornerWhereItIsByThen) {
  std::string text = lined_hole(
      "[[stage]]\nduration = 0.0099\n[[stage]]\nduration = 1e-4\ninstall = ['shell', 'second']\n");
  const auto replace = [&](const std::string& from, const std::string& to) {
    text.replace(text.find(from), from.size(), to);
  };
  replace("opening = 'hole'", "along = [[6, 4], [6, 6]]");
  replace("on = 'shell'", "along = [[6, 6], [4, 6]]");
  const Ran r = ran(text);
  const Scene& scene = *r.ready.sim.scene;
  std::vector<Vec2> corner;
  for (std::size_t i = 0; i < scene.blocks.size(); ++i) {
    if (!scene.blocks.is_lining(i)) continue;
    const StripSections s = sections_of(scene.blocks, i);
    const bool wall = scene.blocks.lining[i] == 0;
    const Id v = scene.blocks.vertex_begin[i] + s.inner(wall ? s.count - 1 : 0);
    corner.push_back({r.ready.sim.motion.pose.x[v], r.ready.sim.motion.pose.y[v]});
  }
  ASSERT_EQ(corner.size(), 2u);
  EXPECT_NEAR(corner[1].x - corner[0].x, 0.1, 1e-3);
  EXPECT_NEAR(corner[1].y - corner[0].y, 0.1, 1e-3);
}

/// A foot that leans into the floor, once the rock above that is gone, and two that cross.
TEST(Linings, DrawnIntoWhatIsThereAreNamed) {
  const auto warned = [](const std::string& shell, const std::string& second) {
    std::string text = lined_hole(
        "[[stage]]\nduration = 0.005\nexcavate = ['hole']\n"
        "[[stage]]\nduration = 0.005\ninstall = ['shell', 'second']\n");
    const auto replace = [&](const std::string& from, const std::string& to) {
      text.replace(text.find(from), from.size(), to);
    };
    replace("polygon = [[4, 4], [6, 4], [6, 6], [4, 6]]",
            "polygon = [[4, 4], [6, 4], [5.8, 6], [4, 6]]");
    replace("opening = 'hole'", shell);
    replace("on = 'shell'", second);
    std::string all;
    for (const std::string& warning : prepared(text).warnings) all += warning + "\n";
    return all;
  };
  const std::string left = "along = [[4, 6], [4, 4]]";
  EXPECT_EQ(warned(left, "on = 'shell'").find("is drawn"), std::string::npos);
  EXPECT_NE(
      warned("along = [[6, 4], [5.8, 6]]", left).find("lining.shell is drawn 0.02 m into block"),
      std::string::npos);
  EXPECT_NE(warned(left, "along = [[5.5, 6], [4.05, 6]]\nsize = 2")
                .find("lining.second is drawn 0.05 m into lining.shell"),
            std::string::npos);
}

}  // namespace
}  // namespace edda::linings_test
