#include "contacts/tile_decisions.hpp"

#include <algorithm>
#include <array>

#include "base/parallel.hpp"
#include "contacts/evaluate_face.hpp"
#include "contacts/face_bonds.hpp"
#include "contacts/face_softening.hpp"
#include "contacts/joint_laws.hpp"
#include "contacts/tile_loading.hpp"
#include "contacts/tile_rows.hpp"
#include "contacts/tile_sleep.hpp"

namespace edda {
namespace {

/// What an update of its law may change of a face, as far as its step reads it.
auto in_force(const FaceSet& c, std::size_t k) {
  return std::array{c.friction[k],         c.cohesion[k],         c.tension[k],
                    c.locked_closure_a[k], c.locked_closure_b[k], c.friction_work[k]};
}

/// Whether the law of face k may change its strength or its opening at all.
bool may_change(const FaceSet& c, const FaceTiles& t, const Law& law, std::size_t k) {
  if (!law.changes || t.place[k][0] == no_id) return false;
  if (t.remembered_before(lane_bits::stored, k) || c.carries_tension(k)) return true;
  const bool weakens = law.type == LawType::slip_weakening && c.slip_so_far[k] < law.slip_distance;
  return weakens || (dilates(law) && t.remembered_before(lane_bits::on, k));
}

/// Loads the faces of a tile that have changed.
void load_changed(FaceTiles& t, const FaceSet& c, const Pose& pose, std::size_t tile,
                  const std::vector<std::uint8_t>& changed) {
  const Tile& of = t.tiles[tile];
  for (Id q = of.first_chunk; q < of.last_chunk; ++q) {
    unsigned mask = 0;
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const Id k = t.face[q * lanes + lane];
      if (k != no_id && changed[k] != 0) mask |= 1u << lane;
    }
    if (mask == 0) continue;
    load_strengths(t, c, tile, q, mask);
    if (t.rest[q] > 0.0) wake_chunk(t, c, pose, q);
  }
}

/// Loads all that have changed.
void load_changed(FaceTiles& t, const FaceSet& c, const Pose& pose,
                  const std::vector<std::uint8_t>& changed) {
  if (std::find(changed.begin(), changed.end(), 1) == changed.end()) return;
  std::vector<char> no_scratch;
  parallel_tasks(t.tiles.size(), 20 * c.size(), no_scratch,
                 [&](std::size_t tile, char&) { load_changed(t, c, pose, tile, changed); });
}

/// Weakens the faces whose cracks have slipped in the last step.
void soften_slipping(FaceSet& c, FaceTiles& t, const BlockSet& b, const Pose& pose,
                     const LawTable& laws) {
  std::vector<std::uint8_t> changed(c.size(), 0);
  parallel_for(
      c.size(),
      [&](std::size_t k) {
        if (!c.is(FaceFlag::softens, k) || !t.found_before(lane_bits::slides, k)) return;
        recall_work(c, t, k);
        soften_by_slip(c, b, pose, laws, remembered(t, k), k);
        changed[k] = 1;
      },
      2);
  load_changed(t, c, pose, changed);
}

}  // namespace

void update_joint_laws(FaceSet& c, FaceTiles& t, const BlockSet& b, const Pose& pose,
                       const LawTable& laws) {
  c.risen.assign(c.size(), 0.0);
  c.dilation_work.assign(c.size(), 0.0);
  std::vector<std::uint8_t> changed(c.size(), 0);
  constexpr std::size_t cost = 100;
  parallel_for(
      c.size(),
      [&](std::size_t k) {
        const Law& law = laws.rows[c.law[k]];
        if (!may_change(c, t, law, k)) return;
        recall_work(c, t, k);
        const auto had = in_force(c, k);
        FaceAtN at_n{remembered(t, k), false};
        at_n.complete = at_n.state.energy > 0.0;
        update_joint_law(c, b, pose, laws, at_n, k);
        changed[k] = in_force(c, k) == had ? 0 : 1;
      },
      cost);
  load_changed(t, c, pose, changed);
}

void begin_step(FaceSet& c, FaceTiles& t, const BlockSet& b, const Pose& pose,
                const LawTable& laws) {
  c.risen.clear();
  c.dilation_work.clear();
  if (c.gluing) glue_pressed(c, t, b, pose.x1, pose.y1);
  next_step(c, t);
  if (laws.any_changes) update_joint_laws(c, t, b, pose, laws);
  if (laws.any_softens) soften_slipping(c, t, b, pose, laws);
}

void glue_pressed(FaceSet& c, FaceTiles& t, const BlockSet& b, const std::vector<double>& x,
                  const std::vector<double>& y) {
  std::vector<Id> glued;
  for (std::size_t q = 0; q < t.chunks(); ++q) {
    const LaneBits pressed =
        (t.bits[0][q] & t.bits[1][q]) >> lane_bits::stored & LaneBits{t.owned[q]};
    for (std::size_t lane = 0; pressed != 0 && lane < lanes; ++lane) {
      if (!lane_bits::test(pressed, 0, lane)) continue;
      const Id k = t.face[q * lanes + lane];
      if (c.glued(k)) continue;
      if (glue_if_whole(c, face_at(c, b, x, y, k).closure, k)) glued.push_back(k);
    }
  }
  for (const Id k : glued) {
    recall_work(c, t, k);
    load_decisions(t, c, b, k);
  }
}

}  // namespace edda
