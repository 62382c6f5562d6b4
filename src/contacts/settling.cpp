#include "contacts/settling.hpp"

#include <algorithm>
#include <cmath>

#include "contacts/gap.hpp"
#include "contacts/stored_energy.hpp"

namespace edda {
namespace {

namespace cs = contact_state;

/// Dilation keeps its memory in the rest penetration.
bool dilates(const Law& law) {
  return law.dilation > 0.0 || law.type == LawType::barton_bandis;
}

bool may_settle(const ContactSet& c, const LawTable& laws, std::size_t k) {
  return c.rest[k] != 0.0 && c.is(k, cs::closed) && !c.is(k, cs::bonded | cs::pulls) &&
         c.share[k] > 0.0 && (c.cut(k) || c.is(k, cs::sliding)) && !dilates(laws.rows[c.law[k]]);
}

/// In the last step, m: by parts of the edge, so that no end of it counts for more.
double slid(const ContactSet& c, const Pose& pose, std::size_t k) {
  const EdgeFrame before =
      edge_frame(at(pose.x1, pose.y1, c.edge[k]), at(pose.x1, pose.y1, c.edge_end[k]));
  const double foot = gap_to(before, at(pose.x1, pose.y1, c.vertex[k])).foot;
  return std::abs(c.foot[k] - foot / before.length * c.span[k]);
}

/// [blocks] the deepest that a contact of each is pressed in, m.
std::vector<double> deepest_of_blocks(const ContactSet& c, const BlockSet& b) {
  std::vector<double> deepest(b.size(), 0.0);
  for (std::size_t k = 0; k < c.size(); ++k) {
    if (!c.is(k, cs::closed)) continue;
    for (const Id i : {c.block_i[k], c.block_j[k]}) {
      deepest[i] = std::max(deepest[i], c.effective(k));
    }
  }
  return deepest;
}

}  // namespace

void settle_rests(ContactSet& c, const BlockSet& b, const Pose& pose, const LawTable& laws,
                  double steps) {
  constexpr double part = 0.05;
  std::vector<double> deepest;
  for (std::size_t k = 0; k < c.size(); ++k) {
    if (!may_settle(c, laws, k)) continue;
    if (deepest.empty()) deepest = deepest_of_blocks(c, b);
    // A held block bears what others press on it: it tells nothing of this one.
    double load = 0.0;
    for (const Id i : {c.block_i[k], c.block_j[k]}) {
      if (!b.fixed[i]) load = std::max(load, deepest[i]);
    }
    if (c.rest[k] >= 2.0 * load) continue;
    const double allowed = std::min(1.0, 2.0 - c.rest[k] / load);
    const double edge = std::min({b.edge_length[c.edge[k]], b.edge_length[c.vertex[k]],
                                  b.edge_length[b.previous[c.vertex[k]]]});
    const double before = stored_energy(c, k);
    c.rest[k] *= std::exp(-allowed * steps * slid(c, pose, k) / (part * edge));
    c.friction_work[k] += before - stored_energy(c, k);
    c.stir(k);
  }
}

}  // namespace edda
