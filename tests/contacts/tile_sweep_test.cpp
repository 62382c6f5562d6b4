// The sweep over tiles must give every face the state, to the bit, that it has alone,
// and every block the sum of the forces of its faces, however the blocks are divided.
#include <gtest/gtest.h>

#include <bit>
#include <string_view>

#include "contacts/drifting_heap.hpp"
#include "contacts/face_bonds.hpp"
#include "contacts/face_reading.hpp"
#include "contacts/tile_columns.hpp"
#include "contacts/tile_loading.hpp"
#include "contacts/tile_renewal.hpp"
#include "contacts/tile_rows.hpp"
#include "contacts/tile_sweep.hpp"
#include "forces/nodal_forces.hpp"

namespace edda {
namespace {

/// Equal to the bit, but for the sign of a zero.
void expect_same(double a, double b, const char* what, std::size_t k) {
  EXPECT_EQ(std::bit_cast<std::uint64_t>(a + 0.0), std::bit_cast<std::uint64_t>(b + 0.0))
      << what << " of face " << k << ": " << a << ", " << b;
}

/// A number of those that a face has.
template <class Fields>
double number(const Fields& numbers, std::size_t column) {
  return std::bit_cast<std::array<double, columns_in<Fields>>>(numbers)[column];
}

/// Faces of a heap that moves at random, with dashpots and bonds as wanted.
struct Drift {
  std::mt19937 rng{7}, of_moves;
  DriftingHeap heap;
  NearEdges near;
  double damping;
  bool with_sums = false;
  std::size_t listed = 0, kept = 0;  ///< faces that a new list has added, and taken over
  std::size_t carrying = 0, sliding = 0, opened = 0, open = 0, asleep = 0, resting = 0;
  std::size_t only_bonded = 0, only_carried = 0;  ///< carry shear, or did so, and store no energy
  unsigned moves = 0, steady = 1;                 ///< so many moves are alike
  unsigned jolts = 0;  ///< a third of the blocks jumps by any distance in each so many moves
  std::size_t jumper = no_id;  ///< a block that moves farther than others, by this factor
  double jump = 1.0;

  Drift(int blocks, double zeta, double bonded_part, double locked_part)
      : heap(odd_polygons(rng, blocks)), damping(zeta) {
    FaceSet& c = heap.alone.faces;
    place();
    place();
    heap.find(0.1);
    std::uniform_real_distribution<double> u(0.0, 1.0);
    for (std::size_t k = 0; k < c.size(); ++k) {
      c.friction[k] = 0.3;
      c.cohesion[k] = 10.0 * u(rng);
      if (u(rng) < bonded_part) c.set(FaceFlag::glued_by_stage, k);
      if (u(rng) < locked_part) c.locked_closure_a[k] = c.locked_closure_b[k] = 1e-4 * u(rng);
    }
    set_face_dashpots(c, heap.laws, damping);
  }

  void place() {
    Pose& pose = heap.pose;
    pose.x1 = pose.x;
    pose.y1 = pose.y;
    for (std::size_t i = 0; i < heap.blocks.size(); ++i) {
      place_vertices(heap.blocks, heap.state.position, i, pose.x, pose.y);
    }
  }

  /// Shifts, turns and strains every block at random, by some 1e-3 of its size times `far`. Returns
  /// the largest motion of a vertex, m.
  double move_blocks(double far) {
    std::uniform_real_distribution<double> u(-1.0, 1.0);
    State& state = heap.state;
    if (moves++ % steady == 0) {
      of_moves = rng;
      rng.discard(10000);
    }
    std::mt19937 same = of_moves;
    const bool jolted = jolts > 0 && moves % jolts == 0;
    const double of_some = jolted ? std::pow(10.0, 2.2 + 2.2 * u(rng)) : 1.0;
    for (std::size_t i = 0; i < heap.blocks.size(); ++i) {
      if (heap.blocks.fixed[i] != 0) continue;
      const Vec2 shift{u(same), u(same)}, centre = centroid(state.position, i);
      const double turn = u(same), strain = 0.01 * u(same), size = heap.blocks.radius[i];
      NodeVectors x = vectors_of(state.position, i);
      const double farther = i == jumper ? jump : jolted && u(rng) > 0.3 ? of_some : 1.0;
      const double by = far * 1e-3 * farther;
      for (Vec2& node : x) {
        const Vec2 arm = node - centre;
        node += by * (size * shift + turn * perp(arm) + strain * Vec2{arm.x, -arm.y});
      }
      store(x, state.position, i);
    }
    place();
    double most = 0.0;
    const Pose& p = heap.pose;
    for (std::size_t v = 0; v < p.x.size(); ++v) {
      most = std::max(most, std::hypot(p.x[v] - p.x1[v], p.y[v] - p.y1[v]));
    }
    return most;
  }

  /// Makes a move and compares with faces that are taken into tiles before it. most: blocks of a
  /// tile.
  void move(std::size_t most, bool with_fixed) {
    FaceTiles t;
    divide_blocks(t, heap.blocks, heap.state, with_fixed, most);
    FaceSet own = heap.alone.faces;
    load_faces(t, own, heap.alone.states, heap.blocks, heap.pose);
    move_on(t, own, with_fixed, 1.0, 0.0);
  }

  /// Makes a move with the faces of `own` in tiles, and compares.
  void move_on(FaceTiles& t, FaceSet& own, bool with_fixed, double far, double least_margin) {
    FaceSet& c = heap.alone.faces;
    next_step(own, t);
    heap.alone.next_step();
    const double moved = move_blocks(far);
    heap.alone.evaluate(heap.scene(), 1e-3);
    BodyVectors on = zero_vectors(heap.blocks);
    SweepScratch scratch;
    SweepScene scene{.blocks = heap.blocks,
                     .masses = heap.masses,
                     .faces = own,
                     .pose = heap.pose,
                     .largest_move = moved,
                     .pushed = 0.0,
                     .least_margin = least_margin,
                     .step = 1e-3,
                     .corrects = false};
    const auto sweep = [&] {
      for (std::size_t q = 0; q < t.tiles.size(); ++q) sweep_tile(t, scene, q, false, scratch, on);
    };
    sweep();
    take_decisions(t, own);
    scene.corrects = true;
    sweep();
    for (std::size_t k = 0; k < c.size(); ++k) {
      compare(t, with_fixed, k);
      if (with_sums) compare_sums(t, k);
    }
    compare_forces(t, on);
  }

  /// Makes a new list, of the faces alone and in tiles.
  void renew(FaceTiles& t, FaceSet& own, double reach) {
    const DriftingHeap& h = heap;
    FaceSet& c = heap.alone.faces;
    std::vector<std::uint8_t> carry(own.size());
    for (std::size_t k = 0; k < own.size(); ++k)
      carry[k] = t.remembers(lane_bits::stored, k) ? 1 : 0;
    recall_work(own, t);
    const std::vector<Id> old =
        find_faces(own, h.blocks, h.state, h.pose, h.laws, {reach}, near, carry);
    heap.find(reach);
    for (FaceSet* faces : {&own, &c}) set_face_dashpots(*faces, h.laws, damping);
    renew_tiles(t, own, h.blocks, h.pose, old);
    ASSERT_EQ(own.size(), c.size());
    for (const auto& column : face_properties) {
      for (std::size_t k = 0; k < c.size(); ++k)
        expect_same((own.*column.values)[k], (c.*column.values)[k], column.name, k);
    }
    EXPECT_EQ(own.flags, c.flags);
    for (const Id k : old) (k == no_id ? listed : kept) += 1;
  }

  /// Takes over what has been decided of the faces alone: nothing of faces that sleep, and nothing
  /// of what faces have done so far.
  void take_decisions(FaceTiles& t, FaceSet& own) {
    const FaceSet& c = heap.alone.faces;
    recall_work(own, t);
    const auto of_history = [](const auto& column) {
      const std::string_view name = column.name;
      return name == "transfer" || name.ends_with("_work");
    };
    for (std::size_t k = 0; k < c.size(); ++k) {
      constexpr auto history = static_cast<std::uint16_t>(FaceFlag::opened) |
                               static_cast<std::uint16_t>(FaceFlag::slipped);
      bool same = ((own.flags[k] ^ c.flags[k]) & ~history) == 0;
      own.flags[k] = static_cast<std::uint16_t>((own.flags[k] & history) | (c.flags[k] & ~history));
      for (const auto& column : face_properties) {
        if (of_history(column)) continue;
        double& value = (own.*column.values)[k];
        same = same && value == (c.*column.values)[k];
        value = (c.*column.values)[k];
      }
      if (same) continue;
      load_decisions(t, own, heap.blocks, k);
      EXPECT_TRUE(t.place[k][0] == no_id || is_awake(t, t.place[k][0])) << "face " << k;
    }
  }
  static bool is_awake(const FaceTiles& t, Id place) { return t.rest[place / lanes] == 0.0; }

  void compare(const FaceTiles& t, bool with_fixed, std::size_t k) {
    const FaceSet& c = heap.alone.faces;
    const FaceFields& m = heap.alone.states.now[k];
    const auto is_in = [&](Id edge) {
      return with_fixed || heap.blocks.fixed[heap.blocks.vertex_block[edge]] == 0;
    };
    std::size_t copies = 0, owned = 0;
    for (const Id place : t.place[k]) {
      if (place == no_id) continue;
      ++copies;
      const std::size_t q = place / lanes, lane = place % lanes;
      ASSERT_EQ(t.face[place], k);
      owned += t.owned[q] >> lane & 1u;
      const auto memory = [&](std::size_t column) {
        return number(get<FaceMemoryColumns<double>>(t, t.now, place), column);
      };
      expect_same(memory(0), m.slip_a, "slip a", k);
      expect_same(memory(1), m.slip_b, "slip b", k);
      expect_same(memory(3), m.spring, "spring", k);
      if (m.spring > 0.0) expect_same(memory(2), m.overlap, "overlap", k);
      if (is_awake(t, place)) {
        const EdgeCoordinates at = coordinates_at(c, heap.pose.x, heap.pose.y, k);
        const double corners[] = {at.s2, at.y2, at.r1, at.r2, at.z2};
        for (std::size_t n = 0; n < std::size(corners); ++n)
          expect_same(memory(4 + n), corners[n], "corner", k);
      } else {
        ++asleep;
        if (q < t.tiles[t.tile_of_chunk[q]].awake_end) ++resting;
      }
      const LaneBits bits = t.bits[t.now][q];
      EXPECT_EQ(lane_bits::test(bits, lane_bits::stored, lane), m.energy > 0.0);
      EXPECT_EQ(lane_bits::test(bits, lane_bits::on, lane), m.gate > 0.0);
      EXPECT_EQ(lane_bits::test(bits, lane_bits::switched, lane), m.switched > 0.0);
      if (is_awake(t, place)) compare_found(t.found[t.now][q], lane, k);
      compare_work(t, place, k);
    }
    EXPECT_EQ(copies > 0 ? 1u : 0u, owned);
    EXPECT_EQ(copies > 0, is_in(c.edge[k]) || is_in(c.facing[k]));
    carrying += m.energy > 0.0;
    open += m.energy == 0.0;
    sliding += m.slip_a != m.trial_a;
    opened += heap.alone.states.before[k].energy > 0.0 && m.energy == 0.0;
  }

  void compare_found(LaneBits found, std::size_t lane, std::size_t k) {
    const FaceSet& c = heap.alone.faces;
    const FaceFields &m = heap.alone.states.now[k], &old = heap.alone.states.before[k];
    const bool touches = m.energy > 0.0 || (c.bonded(k) && m.gate > 0.0);
    const bool worked = old.energy > 0.0 || old.spring > 0.0;
    const bool opens = old.energy > 0.0 && m.energy == 0.0,
               slides = m.slip_a != m.trial_a || m.slip_b != m.trial_b;
    EXPECT_EQ(lane_bits::test(found, lane_bits::loaded, lane), touches || worked) << "face " << k;
    EXPECT_EQ(lane_bits::test(found, lane_bits::opens, lane), opens) << "face " << k;
    EXPECT_EQ(lane_bits::test(found, lane_bits::slides, lane), slides) << "face " << k;
    only_bonded += touches && m.energy == 0.0;
    only_carried += worked && old.energy == 0.0;
  }

  /// Of a chunk that did no work nothing is kept.
  void compare_work(const FaceTiles& t, Id place, std::size_t k) {
    const FaceFields& m = heap.alone.states.now[k];
    const double expected[] = {m.friction_work, m.transfer, m.trial_a,      m.trial_b,
                               m.shear_a,       m.shear_b,  m.damping_work, m.damping_due};
    if (t.fresh[t.now][place / lanes] == 0) {
      expect_same(m.trial_a, m.slip_a, "trial a", k);
      expect_same(m.trial_b, m.slip_b, "trial b", k);
      for (const unsigned i : {0u, 1u, 6u, 7u}) expect_same(0.0, expected[i], "work", k);
      return;
    }
    for (std::size_t i = 0; i < work_columns; ++i) {
      expect_same(number(get<FaceWorkColumns<double>>(t, t.now, place), i), expected[i], "work", k);
    }
  }

  /// Work of all steps before this one.
  void compare_sums(const FaceTiles& t, std::size_t k) const {
    const FaceSet& c = heap.alone.faces;
    const double expected[] = {c.friction_work[k], c.transfer[k], c.damping_work[k]};
    const Id place = t.place[k][0];
    for (std::size_t i = 0; i < sum_columns && place != no_id; ++i) {
      expect_same(number(get<FaceSumColumns<double>>(t.sums, place), i), expected[i], "sum", k);
    }
  }

  /// Forces on an edge are added in the same order as those of the faces alone.
  void compare_forces(const FaceTiles& t, const BodyVectors& on) {
    BodyVectors alone;
    sum_faces(alone, heap.blocks, heap.alone.faces, heap.alone.forces);
    for (const Id i : t.blocks) {
      const BodyVector here = vector_of(heap.blocks, on, i),
                       there = vector_of(heap.blocks, alone, i);
      for (std::size_t n = 0; n < nodes_per_block; ++n) {
        expect_same(here.nodes[n].x, there.nodes[n].x, "force x, block", i);
        expect_same(here.nodes[n].y, there.nodes[n].y, "force y, block", i);
      }
      for (std::size_t a = 0; a < here.count; ++a)
        EXPECT_EQ(here.modes[a], there.modes[a]) << "block " << i;
    }
  }
};

void drift(double damping, double bonded_part, double locked_part, std::size_t most,
           bool with_fixed) {
  Drift d(60, damping, bonded_part, locked_part);
  for (int move = 0; move < 100 && !testing::Test::HasFailure(); ++move) d.move(most, with_fixed);
  EXPECT_GT(d.carrying, 1000u);
  EXPECT_GT(d.open, 1000u);
  EXPECT_GT(d.sliding, 50u);
  EXPECT_GT(d.opened, 10u);
  if (bonded_part > 0.0) {
    EXPECT_GT(d.only_bonded, 1000u);
    EXPECT_GT(d.only_carried, 1000u);
  }
}

TEST(TileSweep, GivesFacesTheStateThatTheyHaveAlone) {
  drift(0.0, 0.0, 0.0, 256, false);
}
TEST(TileSweep, DoesSoInSmallTiles) {
  drift(0.0, 0.0, 0.0, 7, false);
}
TEST(TileSweep, DoesSoWithDashpotsAndFixedBlocks) {
  drift(0.2, 0.0, 0.0, 7, true);
}
TEST(TileSweep, DoesSoWithBonds) {
  drift(0.0, 0.3, 0.0, 12, false);
}
TEST(TileSweep, DoesSoWithLockedClosures) {
  drift(0.2, 0.1, 0.5, 12, false);
}

/// Which faces sleep, and how faces lie within their tile, changes no bit; and none sleeps through
/// a change.
void drift_asleep(double damping, double bonded_part, double locked_part, double far,
                  unsigned steady = 40, unsigned jolts = 0) {
  Drift d(60, damping, bonded_part, locked_part);
  d.steady = steady;
  d.jolts = jolts;
  d.with_sums = true;
  d.move(12, false);
  FaceTiles t;
  divide_blocks(t, d.heap.blocks, d.heap.state, false, 12);
  FaceSet own = d.heap.alone.faces;
  load_faces(t, own, d.heap.alone.states, d.heap.blocks, d.heap.pose);
  for (int move = 0; move < 800 && !testing::Test::HasFailure(); ++move) {
    d.move_on(t, own, false, far, 1e-9);
    // Between others far enough apart that faces sleep as long as they may.
    if (move % 200 < 40 && move % 10 == 5) d.renew(t, own, move % 20 == 5 ? 0.1 : 0.15);
  }
  EXPECT_EQ(dashpots_work(t), damping > 0.0);
  EXPECT_GT(d.asleep, 1000u);
  EXPECT_GE(d.resting, far > 0.01 || jolts > 0 ? 100u : 0u);
  EXPECT_GT(d.listed, 100u);
  EXPECT_GT(d.kept, 1000u);
}
TEST(TileSleep, ChangesNothingInSlowMotion) {
  drift_asleep(0.0, 0.0, 0.0, 0.002);
}
TEST(TileSleep, ChangesNothingInFastMotion) {
  drift_asleep(0.0, 0.0, 0.0, 0.2, 150);
}
TEST(TileSleep, EndsWhereBlocksJump) {
  drift_asleep(0.0, 0.0, 0.0, 0.005, 1000, 7);
}
/// First by more than faces rest by, and less than others sleep by; and then against its
/// neighbours.
TEST(TileSleep, EndsWhereABlockStraysTwice) {
  for (std::size_t i = 0; i < 60 && !testing::Test::HasFailure(); ++i) {
    Drift d(60, 0.0, 0.0, 0.0);
    d.steady = 1000;
    FaceTiles t;
    divide_blocks(t, d.heap.blocks, d.heap.state, false);
    FaceSet own = d.heap.alone.faces;
    load_faces(t, own, d.heap.alone.states, d.heap.blocks, d.heap.pose);
    for (int move = 0; move < 8; ++move) {
      d.jumper = move == 3 || move == 6 ? i : no_id;
      d.jump = move == 3 ? 3.0 : 3000.0;
      d.move_on(t, own, false, 0.01, 1e-9);
    }
  }
}
TEST(TileSleep, ChangesNothingWithDashpots) {
  drift_asleep(0.2, 0.0, 0.0, 0.02);
}
TEST(TileSleep, ChangesNothingWithBondsAndLockedClosures) {
  drift_asleep(0.0, 0.2, 0.2, 0.02);
}

/// Tiles hold each block once, are nearly whole, and do not spread.
TEST(TileSweep, DividesBlocksByTheirPlaces) {
  std::mt19937 rng(3);
  const DriftingHeap heap(random_polygons(rng, 500, 1.0));
  FaceTiles t;
  divide_blocks(t, heap.blocks, heap.state, true, 20);
  EXPECT_EQ(t.tiles.size(), 25u);
  std::vector<int> seen(heap.blocks.size(), 0);
  for (const Tile& tile : t.tiles) {
    EXPECT_EQ(tile.last_block - tile.first_block, 20u);
    for (Id n = tile.first_block; n < tile.last_block; ++n) ++seen[t.blocks[n]];
  }
  for (const int times : seen) EXPECT_EQ(times, 1);
}

}  // namespace
}  // namespace edda
