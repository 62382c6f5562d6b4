// Lists of what may come to touch, made anew in time.
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel.hpp"
#include "contacts/face_bonds.hpp"
#include "contacts/find_faces.hpp"
#include "contacts/place_faces.hpp"
#include "run/simulation.hpp"

namespace edda {

void Simulation::place_all() {
  parallel_for(blocks.size(), [&](std::size_t i) {
    if (state.alive[i]) place_vertices(blocks, state.x, state.y, i, pose.x, pose.y);
  });
}

void Simulation::search(double reach) {
  if (at_points()) {
    find_points(point_contacts, blocks, state, pose, laws, reach);
    State of_no_faces;
    of_no_faces.alive.assign(blocks.size(), 0);
    return find_faces(contacts, blocks, of_no_faces, pose, laws, reach);
  }
  find_faces(contacts, blocks, state, pose, laws, reach);
  set_face_dashpots(contacts, laws, damping.contact);
}

/// The faces at n, whose strength has changed.
void Simulation::place_again() {
  if (step_before_ > 0.0) {
    place_faces(contacts, blocks, pose, laws, step_before_);
  }
}

bool Simulation::list_is_due() {
  contacts.travel += last_displacement;
  // How far any vertex may go before this is asked again.
  const double ahead = explicit_method() ? 2.0 * last_displacement : displacement_limit;
  if (contacts.travel + ahead <= 0.5 * contacts.reach) return false;
  // The sum of displacements is a bound; what counts is how far any vertex is from where it was.
  const std::size_t nv = blocks.vertex_count();
  double moved2 = 0.0;
  for (std::size_t v = 0; v < nv; ++v) {
    const double dx = pose.x[v] - contacts.built_x[v], dy = pose.y[v] - contacts.built_y[v];
    const double d2 = dx * dx + dy * dy;
    if (!(d2 <= moved2)) moved2 = d2;
  }
  contacts.travel = std::sqrt(moved2);
  if (!(contacts.travel <= 100.0 * (contacts.reach + displacement_limit))) {
    last_displacement = std::numeric_limits<double>::infinity();  // inspect() ends the run
    return false;
  }
  const double margin = explicit_method() ? 2.0 * ahead : ahead;
  return contacts.travel + margin > 0.5 * contacts.reach;
}

/// Faces that carry stand first in the list (find_faces()): whether so many of the others carry by
/// now that it is worth a new one.
bool Simulation::list_is_scattered() const {
  constexpr std::uint64_t every = 256;  // steps
  constexpr std::size_t few = 16;       // chunks
  if (state.steps % every != 0) return false;
  const FaceSet& c = contacts;
  std::size_t carrying = 0, touched = 0;
  for (std::size_t q = 0; q < c.chunks(); ++q) {
    const std::size_t begin = q * FaceSet::chunk, end = std::min(begin + FaceSet::chunk, c.size());
    const std::size_t before = carrying;
    for (std::size_t k = begin; k < end; ++k) carrying += c.now.energy[k] > 0.0 ? 1 : 0;
    touched += carrying > before ? 1 : 0;
  }
  return touched > few + 3 * carrying / (2 * FaceSet::chunk);
}

void Simulation::search_if_due() {
  if (!list_is_due() && !list_is_scattered()) return;
  search(std::max(base_reach, 20.0 * last_displacement));
  set_limit();
}

}  // namespace edda
