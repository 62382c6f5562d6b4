#include "contacts/settling.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "contacts/candidates.hpp"
#include "contacts/gap.hpp"
#include "contacts/gaps.hpp"
#include "contacts/stored_energy.hpp"

namespace edda {
namespace {

namespace cs = contact_state;

/// What is preloaded has a negative rest penetration, and keeps it.
bool may_settle(const ContactSet& c, const LawTable& laws, std::size_t k, bool leaps) {
  return c.rest[k] > 0.0 && c.is(k, cs::closed) && !c.is(k, cs::bonded | cs::pulls) &&
         c.share[k] > 0.0 && (leaps ? c.cut(k) : c.is(k, cs::sliding)) &&
         !dilates(laws.rows[c.law[k]]);
}

/// In the last step, m: by parts of the edge, so that no end of it counts for more.
double slid(const ContactSet& c, const Pose& pose, std::size_t k) {
  const double part = previous_gap(c, pose, k).foot / previous_edge(c, pose, k).length;
  return std::abs(c.foot[k] - part * c.span[k]);
}

/// An edge that lies against another.
struct Facing {
  Id edge, other;
  bool operator<(const Facing& f) const { return edge != f.edge ? edge < f.edge : other < f.other; }
};

/// Those of a contact: its edge, and the vertex's own ones that lie against it.
template <class Take>
void faces_of(const ContactSet& c, const BlockSet& b, const Pose& pose, std::size_t k, Take take) {
  for (const Id f : {b.previous[c.vertex[k]], c.vertex[k]}) {
    const Vec2 t = unit(at(pose.x, pose.y, b.next[f]) - at(pose.x, pose.y, f));
    if (-dot(tangent_of(c, k), t) >= opposite) take(f, c.edge[k]);
  }
}

/// Of all closed contacts, both ways round, in order.
std::vector<Facing> all_faces(const ContactSet& c, const BlockSet& b, const Pose& pose) {
  std::vector<Facing> faces;
  for (std::size_t k = 0; k < c.size(); ++k) {
    if (!c.is(k, cs::closed) || c.share[k] == 0.0) continue;
    faces_of(c, b, pose, k, [&](Id f, Id g) {
      faces.push_back({f, g});
      faces.push_back({g, f});
    });
  }
  std::sort(faces.begin(), faces.end());
  return faces;
}

/// Whether edge g of another block goes on in edge h: parallel, and flush within r_v.
bool goes_on(const BlockSet& b, const Pose& pose, Id g, Id h) {
  if (b.vertex_block[g] == b.vertex_block[h]) return false;
  const EdgeFrame e = edge_frame(at(pose.x, pose.y, g), at(pose.x, pose.y, b.next[g]));
  const EdgeFrame f = edge_frame(at(pose.x, pose.y, h), at(pose.x, pose.y, b.next[h]));
  const double flush = corner_reach * std::min(e.length, f.length);
  return dot(e.t, f.t) > opposite && std::abs(gap_to(e, f.start).depth) <= flush &&
         std::abs(gap_to(f, e.start).depth) <= flush;
}

/// Whether the contact lies beside a seam: an edge of its lies against one, and against another
/// block's that goes on in it.
bool beside_seam(const ContactSet& c, const BlockSet& b, const Pose& pose, std::size_t k,
                 const std::vector<Facing>& faces) {
  bool found = false;
  const auto look = [&](Id f, Id g) {
    for (auto q = std::lower_bound(faces.begin(), faces.end(), Facing{f, 0});
         !found && q != faces.end() && q->edge == f; ++q) {
      found = q->other != g && goes_on(b, pose, g, q->other);
    }
  };
  faces_of(c, b, pose, k, [&](Id f, Id g) {
    look(f, g);
    look(g, f);
  });
  return found;
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
                  double steps, bool leaps) {
  constexpr double part = 0.05;
  std::vector<double> deepest;
  std::vector<Facing> faces;
  for (std::size_t k = 0; k < c.size(); ++k) {
    if (!may_settle(c, laws, k, leaps)) continue;
    if (deepest.empty()) {
      deepest = deepest_of_blocks(c, b);
      faces = all_faces(c, b, pose);
    }
    // A held block bears what others press on it: it tells nothing of this one.
    double load = 0.0;
    for (const Id i : {c.block_i[k], c.block_j[k]}) {
      if (!b.fixed[i]) load = std::max(load, deepest[i]);
    }
    if (c.rest[k] >= 2.0 * load || !beside_seam(c, b, pose, k, faces)) continue;
    const double allowed = std::min(1.0, 2.0 - c.rest[k] / load);
    const double edge = std::min({b.edge_length[c.edge[k]], b.edge_length[c.vertex[k]],
                                  b.edge_length[b.previous[c.vertex[k]]]});
    const double before = stored_energy(c, k);
    c.rest[k] *= std::exp(-allowed * steps * slid(c, pose, k) / (part * edge));
    c.friction_work[k] += before - stored_energy(c, k);
    c.stir(k);
  }
}

void glue_pressed(ContactSet& c) {
  for (std::size_t k = 0; k < c.size(); ++k) {
    if (!c.is(k, contact_state::closed) || c.is(k, contact_state::bonded | contact_state::pulls))
      continue;
    if (!(c.effective(k) > 0.0 && c.effective_1(k) > 0.0)) continue;
    c.keep_slips(k);
    c.lent[k] = contact_state::closed;
    c.set(k, contact_state::glued | contact_state::bonded | contact_state::pulls);
    c.forget_cut(k);
  }
}

}  // namespace edda
