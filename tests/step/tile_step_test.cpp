// Steps of the faces in tiles leave each of them as it follows from its own past.
#include "step/tile_step.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <string>

#include "contacts/evaluate_face.hpp"
#include "contacts/face_energy.hpp"
#include "contacts/tile_rows.hpp"
#include "run/prepared.hpp"
#include "step/changes.hpp"
#include "step/contact_search.hpp"
#include "step/energy_balance.hpp"
#include "step/faces_now.hpp"
#include "step/step.hpp"

namespace edda::tile_step_test {
namespace {

/// A number of a face as a step must leave it, to the bit; it says nothing where no edge faces the
/// other, nor of the length of springs that are not there.
void expect_field(const FaceField& field, const FaceFields& is, const FaceFields& expected,
                  std::size_t k) {
  const bool of_no_spring = field.value == &FaceFields::overlap && expected.spring == 0.0;
  if (expected.gate == 0.0 || of_no_spring) return;
  EXPECT_EQ(is.*field.value, expected.*field.value) << field.name << " of face " << k;
}

/// What a row of results needs of all faces is what each of them says.
void expect_measures(const Simulation& sim) {
  const FaceSet& c = sim.motion.contacts;
  const FaceTiles& t = sim.motion.tiled.tiles;
  const BlockSet& b = sim.scene->blocks;
  const Pose& pose = sim.motion.pose;
  const FaceMeasures measures = measure_faces(sim);
  for (std::size_t k = 0; k < c.size(); ++k) {
    if (t.place[k][0] == no_id) continue;
    const FaceFields before = remembered(t, k);
    const FaceEnds moved =
        slip_of(c, face_at(c, b, pose.x, pose.y, k), face_points(c, pose.x, pose.y, k),
                face_points(c, pose.x1, pose.y1, k), k);
    const SpringsOfFace springs{
        before.spring, {before.slip_a, before.slip_b}, t.remembers(lane_bits::stored, k)};
    EXPECT_EQ(measures.energy[k],
              face_energy(normal_energy(c, b, pose, k), springs, moved, c.carries_tension(k)))
        << k;
    EXPECT_EQ(measures.normal[k], normal_force_now(sim, k)) << k;
  }
}

/// The state of every face follows from its state at n and the positions alone, whatever lies in
/// tiles, sleeps, or has been corrected; nothing more is to be decided of it; and blocks carry the
/// sum of its forces.
void expect_faces_follow(const Simulation& sim) {
  const Motion& motion = sim.motion;
  const FaceTiles& tiles = motion.tiled.tiles;
  const BlockSet& b = sim.scene->blocks;
  expect_measures(sim);
  FaceSet faces = motion.contacts;
  for (std::size_t k = 0; k < faces.size(); ++k) {
    if (tiles.place[k][0] == no_id) continue;
    const FaceRow row = face_row(sim, k);
    const FaceFields before = remembered(tiles, k);
    const bool acts = faces.acts(k), leans = faces.leans(k);
    if (!faces.is(FaceFlag::fails, k))
      decide_face(faces, face_scene(sim), motion.state.step, before, k);
    EXPECT_EQ(faces.acts(k), acts) << k;
    EXPECT_EQ(faces.leans(k), leans) << k;
    const EvaluatedFace face = evaluate_face(faces, face_scene(sim), motion.state.step, before, k);
    const bool listed_since = face.state.gate > 0.0 && row.state.gate == 0.0;
    if (listed_since) continue;
    for (const FaceField& field : face_fields) expect_field(field, row.state, face.state, k);
  }
  BodyVectors on;
  sum_faces(on, b, faces, corner_forces(faces, tiles, b, motion.pose));
  for (const Id i : tiles.blocks) {
    const BodyVector here = vector_of(b, motion.on_contacts, i), there = vector_of(b, on, i);
    EXPECT_EQ(here.nodes, there.nodes) << "block " << i;
    for (std::size_t a = 0; a < here.count; ++a)
      EXPECT_EQ(here.modes[a], there.modes[a]) << "block " << i;
  }
}

using Before = std::function<void(Simulation&, int)>;  // before each step

/// Makes so many steps, looks at every seventh, and returns how many faces have opened and closed.
std::uint64_t follow(
    const std::string& text, int steps, const Before& before = [](Simulation&, int) {}) {
  Simulation sim = testing::prepared(text).sim;
  sim.motion.tiled.most_blocks = 7;
  start(sim, 100.0);
  for (int n = 0; n < steps && !::testing::Test::HasFailure(); ++n) {
    before(sim, n);
    const std::uint64_t list = sim.motion.contacts.rebuilds;
    EXPECT_FALSE(step(sim));
    if (n % 7 != 0 || sim.motion.contacts.rebuilds != list) continue;
    expect_faces_follow(sim);
    if (::testing::Test::HasFailure()) ADD_FAILURE() << "step " << sim.motion.state.steps;
  }
  return sim.accounts.open_close.switched;
}

const std::string rock =
    "[materials.rock]\ndensity = 2600\nyoung = 20e9\npoisson = 0.2\ndamping = 0\n[joints.j]\n"
    "friction_angle = 20\n[solver]\nduration = 1\n";

TEST(TileStep, Corners) {
  for (const char* damping : {"0", "50"}) {
    follow(rock + "damping = { mass = " + damping +
               " }\n[contact]\nnormal_stiffness = 2e9\n[[block]]\nfixed = true\n"
               "polygon = [[-3,-1],[3,-1],[3,0],[-3,0]]\n[[block]]\nvelocity = [1, -2]\n"
               "polygon = [[0,0.01],[1,0.06],[0.95,1.06],[-0.05,1.01]]\n[[block]]\n"
               "velocity = [0, -3]\n"
               "polygon = [[-0.2,1.2],[0.8,1.1],[0.9,2.1],[-0.1,2.2]]\n",
           2000);
  }
}

const std::string hit_wall =
    rock +
    "[solver.damping]\ncontact = 0.1\n[contact]\njoint = \"j\"\n[[block]]\nname = \"floor\"\n"
    "fixed = true\npolygon = [[-4, -1], [8, -1], [8, 0], [-4, 0]]\n[[brick_wall]]\ncolumns = 2\n"
    "rows = 2\nbrick = [1.0, 0.5]\njoint = \"j\"\n[[block]]\nname = \"ball\"\n"
    "velocity = [-12.0, 3.0]\nangular_velocity = 4.0\n"
    "polygon = [[3.0, 0.2], [3.6, 0.2], [3.6, 0.9], [3.0, 0.9]]\n";

/// Nothing depends on when faces are read, or taken out of their tiles and put back.
TEST(TileStep, FacesThatAreTakenOutAndPutBackAreTheSame) {
  Simulation ahead = testing::prepared(hit_wall).sim, asked = testing::prepared(hit_wall).sim;
  for (Simulation* sim : {&ahead, &asked}) {
    sim->motion.tiled.most_blocks = 16;
    start(*sim, 1.0);
  }
  for (int n = 0; n < 20000; ++n) {
    ASSERT_FALSE(step(ahead));
    ASSERT_FALSE(step(asked));
    if (n % 3 == 0) take_faces(asked);
    if (n % 5 == 0) put_faces(asked, take_faces(asked));
    ASSERT_EQ(ahead.motion.state.position.x, asked.motion.state.position.x) << n;
    ASSERT_EQ(ahead.motion.on_contacts.y, asked.motion.on_contacts.y) << n;
  }
  EXPECT_GT(ahead.accounts.open_close.switched, 20u);
}

/// Polygons of 3 to 6 corners that fall onto a floor and each other.
std::string falling_heap() {
  std::mt19937 rng(11);
  std::uniform_real_distribution<double> u(0.0, 1.0);
  std::string text = rock +
                     "[solver.damping]\ncontact = 0.1\n[contact]\njoint = \"j\"\n[[block]]\n"
                     "fixed = true\npolygon = [[-9,-1],[9,-1],[9,0],[-9,0]]\n";
  for (int n = 0; n < 40; ++n) {
    const int corners = 3 + n % 4;
    const double phase = 6.3 * u(rng), x = 1.0 * (n % 8) - 4.0 + 0.15 * u(rng),
                 y = 0.5 + 0.9 * (n / 8);
    text += "[[block]]\nvelocity = [0, -3]\nangular_velocity = " + std::to_string(2.0 * u(rng)) +
            "\npolygon = [";
    for (int k = 0; k < corners; ++k) {
      const double angle = phase + (k + 0.3 * u(rng)) * 6.283 / corners;
      text += "[" + std::to_string(x + 0.42 * std::cos(angle)) + "," +
              std::to_string(y + 0.42 * std::sin(angle)) + "],";
    }
    text += "]\n";
  }
  return text;
}

/// Which faces sleep changes no bit, nor how they lie in their tile.
void compare_asleep_and_awake(const std::string& text, int steps) {
  Simulation sleeping = testing::prepared(text).sim, awake = testing::prepared(text).sim;
  awake.motion.tiled.sleep_part = 0.0;
  for (Simulation* sim : {&sleeping, &awake}) {
    sim->motion.tiled.most_blocks = 16;
    start(*sim, 1.0);
  }
  std::size_t asleep = 0;
  for (int n = 0; n < steps; ++n) {
    ASSERT_FALSE(step(sleeping));
    ASSERT_FALSE(step(awake));
    ASSERT_EQ(sleeping.motion.state.position.x, awake.motion.state.position.x) << n;
    ASSERT_EQ(sleeping.motion.on_contacts.y, awake.motion.on_contacts.y) << n;
    ASSERT_EQ(sleeping.accounts.penetration, awake.accounts.penetration) << n;
    for (const double rest : sleeping.motion.tiled.tiles.rest) asleep += rest > 0.0 ? 1 : 0;
  }
  EXPECT_GT(asleep, 1000u);
}

/// Rock above an opening, from which blocks fall.
const std::string loose_roof =
    rock +
    "[domain]\noutline = [[-6,-5],[6,-5],[6,5],[-6,5]]\n[[joint_set]]\nangle = 65\n"
    "spacing = 1.1\norigin = [0.3, 0]\n[[joint_set]]\nangle = -15\nspacing = 1\n"
    "origin = [0, 0.2]\n[[opening]]\npolygon = [[-3,-2],[3,-2],[3,1],[0,2],[-3,1]]\n"
    "[[boundary]]\nsides = [\"left\", \"right\", \"bottom\"]\ntype = \"fixed\"\n"
    "stiffness = 1e10\n";

TEST(TileStep, SleepChangesNothing) {
  compare_asleep_and_awake(loose_roof, 2000);
}

TEST(TileStep, FacesFollow) {
  EXPECT_GT(follow(hit_wall, 20000), 20u);
}
TEST(TileStep, FacesFollowAsARoofFalls) {
  EXPECT_GT(follow(loose_roof, 2000), 50u);
}
TEST(TileStep, FacesFollowInAHeap) {
  EXPECT_GT(follow(falling_heap(), 20000), 100u);
}
TEST(TileStep, FacesFollowWhereBlocksFallOnEachOther) {
  std::string text =
      "[materials.rock]\ndensity = 2600.0\nyoung = 200e9\ndamping = 0\npoisson = 0.2\n"
      "[joints.j]\nfriction_angle = 0.0\n[contact]\nnormal_stiffness = 2e9\n[solver]\n"
      "duration = 2.5\nsafety = 0.4\n[[block]]\nfixed = true\n"
      "polygon = [[-6,-1],[6,-1],[6,0],[-6,0]]\n";
  for (int i = 0; i < 6; ++i) {
    const double c = 0.5 * std::cos(0.1 * i), s = 0.5 * std::sin(0.1 * i), y = 0.625 + 1.25 * i;
    text += "[[block]]\npolygon = [";
    for (const auto& [px, py] :
         {std::pair{-c + s, -s - c}, {c + s, s - c}, {c - s, s + c}, {-c - s, c - s}}) {
      text += "[" + std::to_string(px) + "," + std::to_string(y + py) + "],";
    }
    text += "]\n";
  }
  EXPECT_GT(follow(text, 60000), 20u);
}
/// A step in which a vertex moves too far is made again with half of the length.
TEST(TileStep, FacesFollowWhereAStepIsMadeAgain) {
  std::uint64_t redone = 0;
  follow(falling_heap(), 20000, [&](Simulation& sim, int n) {
    redone = sim.accounts.steps.redone;
    if (sim.accounts.open_close.switched > 50 && redone < 4 && n % 500 == 0)
      sim.scene.edit().displacement_limit = 0.98 * sim.control.last_displacement;
  });
  EXPECT_GT(redone, 1u);
}
TEST(TileStep, DashpotsThatAreTakenAwayLeaveTheTiles) {
  bool left = false;
  follow(falling_heap(), 12000, [&](Simulation& sim, int n) {
    if (n == 6000) change_damping(sim, {}, false);
    left = !sim.motion.contacts.dashpots;
  });
  EXPECT_TRUE(left);
}
/// A wall that stands on dashpots, and a block that falls beside it and makes lists be renewed.
const std::string wall_and_falling_block =
    rock +
    "[solver.damping]\ncontact = 0.1\n[contact]\njoint = \"j\"\n[[block]]\nfixed = true\n"
    "polygon = [[-4, -1], [8, -1], [8, 0], [-4, 0]]\n[[brick_wall]]\ncolumns = 4\nrows = 4\n"
    "brick = [1.0, 0.5]\njoint = \"j\"\n[[block]]\nvelocity = [0.0, -3.0]\n"
    "angular_velocity = 1.0\npolygon = [[6.0, 2.2], [6.6, 2.2], [6.6, 2.9], [6.0, 2.9]]\n";
/// What dashpots did last is neither lost with them nor counted again: it is what each step says.
void expect_work_of_dashpots(bool list_at_once) {
  Simulation sim = testing::prepared(wall_and_falling_block).sim;
  start(sim, 100.0);
  double done = account_energy(sim).damping, last = 0.0;
  const auto go = [&](int steps) {
    for (int n = 0; n < steps; ++n) {
      ASSERT_FALSE(step(sim));
      last = 0.0;
      for (std::size_t k = 0; k < sim.motion.contacts.size(); ++k) {
        const FaceFields face = face_row(sim, k).state;
        last += face.damping_work + face.damping_due;
      }
      done += last;
    }
  };
  go(500);
  change_damping(sim, {}, false);
  go(1);
  if (list_at_once) search(sim, sim.motion.contacts.reach);
  EXPECT_TRUE(sim.motion.contacts.dashpots);
  EXPECT_GT(last, 1e-6 * done);
  go(8000);
  EXPECT_FALSE(sim.motion.contacts.dashpots);
  put_faces(sim, take_faces(sim));
  go(10);
  EXPECT_NEAR(account_energy(sim).damping / done, 1.0, 1e-12);
}
TEST(TileStep, WorkOfDashpotsThatAreTakenAwayIsCountedOnce) {
  expect_work_of_dashpots(false);
  expect_work_of_dashpots(true);
}
/// Also between two steps of the implicit method, whose limits of shear are those of a step alone.
TEST(TileStep, BondsFailAtRestWhereTheirStrengthIsReduced) {
  for (const char* method : {"edda", "dda"}) {
    Simulation sim = testing::prepared(
                         "[materials.rock]\ndensity = 2600\nyoung = 1e9\npoisson = 0.2\n"
                         "[joints.j]\nfriction_angle = 30\ncohesion = 1e6\n"
                         "tensile_strength = 3e5\n[contact]\njoint = \"j\"\n[solver]\n"
                         "duration = 1\nmethod = \"" +
                         std::string(method) +
                         "\"\n[[block]]\nfixed = true\npolygon = [[0,1],[1,1],[1,2],[0,2]]\n"
                         "[[block]]\npolygon = [[0,0],[1,0],[1,1],[0,1]]\n")
                         .sim;
    start(sim, 1.0);
    for (int n = 0; n < 20; ++n) ASSERT_FALSE(step(sim));
    EXPECT_EQ(sim.motion.contacts.broken, 0u) << method;
    set_strength_factor(sim, 1e3);
    const FaceSet& faces = sim.motion.contacts;
    for (std::size_t k = 0; k < faces.size(); ++k) EXPECT_FALSE(faces.bonded(k)) << method;
  }
}
TEST(TileStep, BlocksAreDividedAnewWhereTheirNeighboursHaveChanged) {
  Simulation sim = testing::prepared(falling_heap()).sim;
  sim.motion.tiled.most_blocks = 7;
  start(sim, 100.0);
  int divided = 0;
  for (int n = 0; n < 20000; ++n) {
    const double in_two_tiles = sim.motion.tiled.in_two_tiles;
    ASSERT_FALSE(step(sim));
    if (sim.motion.tiled.in_two_tiles != in_two_tiles) ++divided;
  }
  EXPECT_GT(divided, 0);
}
TEST(TileStep, FacesFollowWhereBondsFail) {
  std::string text = hit_wall;
  text.replace(text.find("[solver]"), 0, "cohesion = 2e5\ntensile_strength = 1e5\n");
  std::uint64_t broken = 0;
  follow(text, 20000, [&](Simulation& sim, int) { broken = sim.motion.contacts.broken; });
  EXPECT_GT(broken, 5u);
}
TEST(TileStep, FacesFollowWhereJointsSoften) {
  std::string text = hit_wall;
  text.replace(text.find("[solver]"), 0,
               "cohesion = 2e5\ntensile_strength = 1e5\nfracture_energy = 4\n"
               "shear_fracture_energy = 40\n");
  std::uint64_t broken = 0, soften = 0;
  follow(text, 20000, [&](Simulation& sim, int) {
    const FaceSet& c = sim.motion.contacts;
    broken = c.cracks_tension + c.cracks_shear;
    for (std::size_t k = 0; k < c.size(); ++k) soften += c.is(FaceFlag::softens, k) ? 1 : 0;
  });
  EXPECT_GT(broken, 5u);
  EXPECT_GT(soften, 100u);
}
TEST(TileStep, FacesFollowWithBonds) {
  std::string text = falling_heap();
  const std::string bonds = "cohesion = 2e5\ntensile_strength = 1e5\n";
  text.replace(text.find("[solver]"), 0, bonds);
  EXPECT_GT(follow(text, 20000), 100u);
}
/// Joints whose strength and opening depend on slip, also where faces open and close again.
TEST(TileStep, FacesFollowWithLawsThatDependOnSlip) {
  for (const char* law :
       {"type = \"slip-weakening\"\nfriction_angle = 30\ncohesion = 2e4\nslip_distance = 1e-3\n"
        "residual = { friction_angle = 15 }\ndilation_angle = 5\n",
        "friction_angle = 20\ndilation_angle = 8\nslip_distance = 2e-2\n",
        "type = \"barton-bandis\"\njrc = 9\njcs = 8e7\nresidual_angle = 25\n"}) {
    for (std::string text : {hit_wall, falling_heap()}) {
      const std::string friction = "friction_angle = 20\n";
      text.replace(text.find(friction), friction.size(), law);
      EXPECT_GT(follow(text, 10000), 20u) << law;
    }
  }
}
/// Faces that come into contact while joints are glued are glued, too.
TEST(TileStep, FacesFollowWhileJointsAreGlued) {
  std::string text = rock +
                     "[contact]\njoint = \"j\"\n[[block]]\nfixed = true\n"
                     "polygon = [[-9,-1],[9,-1],[9,0],[-9,0]]\n";
  for (int n = 0; n < 12; ++n) {
    const double x = 1.1 * (n % 4) - 2.0, y = 1e-4 + 0.5001 * (n / 4);
    const auto at = [&](double dx, double dy) {
      return "[" + std::to_string(x + dx) + "," + std::to_string(y + dy) + "]";
    };
    text += "[[block]]\npolygon = [" + at(0, 0) + "," + at(1, 0) + "," + at(1, 0.5) + "," +
            at(0, 0.5) + "]\n";
  }
  std::size_t glued = 0;
  follow(text, 6000, [&](Simulation& sim, int n) {
    if (n == 100) glue_joints(sim, true);
    if (n == 5000) {
      const FaceSet& c = sim.motion.contacts;
      for (std::size_t k = 0; k < c.size(); ++k) glued += c.glued(k) ? 1 : 0;
      glue_joints(sim, false);
    }
  });
  EXPECT_GT(glued, 4u);
}

}  // namespace
}  // namespace edda::tile_step_test
