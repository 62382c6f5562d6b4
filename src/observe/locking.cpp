#include "observe/locking.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/polygon.hpp"
#include "base/text.hpp"
#include "step/faces_now.hpp"
#include "step/labels.hpp"

namespace edda {
namespace {

/// E' of block i, Pa: of a bar in the plane.
double bar_modulus(const BlockSet& b, Id i) {
  const double mu = b.lame_mu[i], lambda = b.lame_lambda[i];
  return 4.0 * mu * (lambda + mu) / (lambda + 2.0 * mu);
}

/// Stiffness of face k, across it and along it, over that of the two blocks behind it.
struct StiffnessRatio {
  double across, along;
};
StiffnessRatio stiffness_ratio(const BlockSet& b, const FaceSet& f, std::size_t k) {
  const double per = 0.5 * (b.compliance[f.edge[k]] + b.compliance[f.facing[k]]) / b.thickness;
  return {f.stiffness[k] * per, f.shear_stiffness[k] * per};
}

/// How much stiffer in bending than by the integral of its pressure: with a penalty that is taken
/// at the ends (theory, section 4.2).
double bending_rule(const FaceSet& f, std::size_t k) {
  return f.of_law(k).at_ends && f.leans(k) ? 3.0 : 1.0;
}

/// Corners of block i where its outline turns.
std::size_t corners_of(const BlockSet& b, Id i) {
  constexpr double straight = 0.1;  // rad
  std::size_t corners = 0;
  for (Id v = b.vertex_begin[i]; v < b.vertex_begin[i + 1]; ++v) {
    corners += std::abs(b.corner[v] - std::numbers::pi) > straight ? 1 : 0;
  }
  return corners;
}

/// Both free, not cut out of the opening itself, and pressed or bonded at the start.
bool counts(const Simulation& sim, const FaceRow& row, Index opening) {
  const BlockSet& b = sim.scene->blocks;
  const Id i = block_of_edge(b, row.of, row.k), j = block_of_facing(b, row.of, row.k);
  const auto stays = [&](Id block) {
    return is_free(b, sim.motion.state, block) &&
           (b.opening.empty() || b.opening[block] != opening);
  };
  return stays(i) && stays(j) && meets(row);
}

/// Whether a joint beside a wall that carries this stress along it can hold blocks together,
/// however it lies: what slips there closes the opening, and not the rock.
bool holds_beside(const FaceSet& f, double thickness, double stress, std::size_t k) {
  const double t = f.friction[k];
  return f.glued(k) || f.cohesion[k] / thickness >= 0.5 * stress * (std::sqrt(1.0 + t * t) - t);
}

/// The largest stress along the wall of a circular opening, three times the larger principal stress
/// less the smaller, from that of the ground at block i, Pa in compression.
double wall_stress(const BlockSet& b, Id i) {
  const double mean = -0.5 * (b.initial_xx[i] + b.initial_yy[i]),
               half = std::hypot(0.5 * (b.initial_xx[i] - b.initial_yy[i]), b.initial_xy[i]);
  return std::max(2.0 * mean + 4.0 * half, 0.0);
}

/// The smaller principal stress of the ground at block i over the larger, 0 to 1.
double stress_ratio(const BlockSet& b, Id i) {
  const double mean = std::abs(0.5 * (b.initial_xx[i] + b.initial_yy[i])),
               half = std::hypot(0.5 * (b.initial_xx[i] - b.initial_yy[i]), b.initial_xy[i]);
  return mean + half > 0.0 ? std::max(mean - half, 0.0) / (mean + half) : 1.0;
}

/// The joints within two radii of the centre, by their length.
LockedOpening around(const Simulation& sim, std::size_t row) {
  const BlockSet& b = sim.scene->blocks;
  const FaceSet& f = sim.motion.contacts;
  const Moments hole = moments(std::span(&sim.scene->model.openings[row].polygon, 1));
  LockedOpening o{row};
  o.radius = std::sqrt(std::abs(hole.area) / std::numbers::pi);
  const Vec2 centre = hole.centroid - b.origin;
  double length = 0.0, area = 0.0, bends = 0.0, held = 0.0, can_bend = 0.0;
  for (std::size_t k = 0; k < f.size(); ++k) {
    const FaceRow face = face_row(sim, k);
    if (norm(middle_of(face, sim.motion.pose) - centre) > 2.0 * o.radius) continue;
    if (!counts(sim, face, static_cast<Index>(row))) continue;
    const Id i = block_of_edge(b, f, k), j = block_of_facing(b, f, k);
    const double l = std::min(b.edge_length[f.edge[k]], b.edge_length[f.facing[k]]);
    const StiffnessRatio ratio = stiffness_ratio(b, f, k);
    length += l;
    held += holds_beside(f, b.thickness, wall_stress(b, i), k) ? l : 0.0;
    area += l * 0.5 * (b.area[i] + b.area[j]);
    o.stiffness += l * ratio.across;
    const auto bends_itself = [&](Id block) { return b.bends(block); };
    const auto locks = [&](Id block) {
      return corners_of(b, block) > 3 && !bends_itself(block) ? b.area[block] : 0.0;
    };
    can_bend += 0.5 * l * ((bends_itself(i) ? 1.0 : 0.0) + (bends_itself(j) ? 1.0 : 0.0));
    bends += l * (2.0 - stress_ratio(b, i)) *
             (0.13 * bending_rule(f, k) * ratio.across + 0.15 * ratio.along) * 0.5 *
             (locks(i) + locks(j));
  }
  if (!(held > 0.5 * length)) return o;
  o.stiffness /= length;
  o.size = std::sqrt(area / length);
  o.lost = lost_closure(bends / length / (o.radius * o.radius));
  o.bends = can_bend > 0.5 * length;
  if (o.bends) o.lost = std::max(o.lost, lost_by_size(o.size / o.radius));
  return o;
}

/// The two neighbours of a block in a row, and the normals of the joints with them.
struct Row {
  Id joints = 0;  ///< faces that carry tension, to two blocks
  Id other[2] = {no_id, no_id};
  Vec2 middle[2];
  double stiffness = 0.0;  ///< the sum over them of the bending stiffness over that of the block
  bool alone = true;       ///< it touches nothing else
};

/// Bending stiffness of face k over that of `block` along the row: k (integral or trapezoidal rule
/// over the face) L^3/12 c/(E' L^3/12), with the length c of the block along the row.
double bending_ratio(const Simulation& sim, std::size_t k, Id block, double along) {
  const BlockSet& b = sim.scene->blocks;
  const FaceSet& f = sim.motion.contacts;
  return bending_rule(f, k) * f.stiffness[k] / b.thickness * along / bar_modulus(b, block);
}

std::vector<Row> rows_of(const Simulation& sim) {
  const BlockSet& b = sim.scene->blocks;
  const FaceSet& f = sim.motion.contacts;
  std::vector<Row> rows(b.size());
  for (std::size_t k = 0; k < f.size(); ++k) {
    const FaceRow face = face_row(sim, k);
    if (!meets(face)) continue;
    const Id pair[2] = {block_of_edge(b, f, k), block_of_facing(b, f, k)};
    for (int side = 0; side < 2; ++side) {
      Row& row = rows[pair[side]];
      if (!f.carries_tension(k) || row.joints >= 2) {
        row.alone = false;
        continue;
      }
      row.other[row.joints] = pair[1 - side];
      row.middle[row.joints++] = middle_of(face, sim.motion.pose);
      const double l = std::min(b.edge_length[f.edge[k]], b.edge_length[f.facing[k]]);
      row.stiffness += 0.5 * bending_ratio(sim, k, pair[side], b.area[pair[side]] / l);
    }
  }
  return rows;
}

/// Whether gravity, a load or a ground motion acts across this direction.
bool is_bent(const Simulation& sim, Vec2 along) {
  const Model& m = sim.scene->model;
  const auto across = [&](Vec2 force) {
    constexpr double part = 0.1;
    return std::abs(cross(along, force)) > part * norm(force);
  };
  bool bent = across(m.gravity);
  for (const PointLoad& p : sim.attached.loads.points) bent = bent || across(p.force);
  const BlockSet& b = sim.scene->blocks;
  for (const EdgeLoad& e : sim.attached.loads.edges) {
    const Vec2 t = unit(b.vertex(b.next[e.edge]) - b.vertex(e.edge));
    bent = bent || across(e.traction - e.pressure * outward_normal(t));
  }
  for (const Shaking& q : m.shakings) {
    bent = bent || (q.acceleration.file.empty() ? across(q.acceleration.direction)
                                                : !q.record.acceleration.empty());
  }
  return bent;
}

}  // namespace

double lost_closure(double x) {
  return 1.0 - 1.0 / std::sqrt(1.0 + x);
}

double lost_by_size(double size) {
  constexpr double fine = 0.5, most = 0.09;  // measured: 0.003 at 1/2, 0.08 at 2/3, 0.09 at 1
  return most * std::clamp((size - fine) / (0.67 - fine), 0.0, 1.0);
}

std::vector<LockedOpening> locked_openings(const Simulation& sim) {
  std::vector<LockedOpening> found;
  if (!sim.scene->model.initial_stress) return found;
  for (std::size_t q = 0; q < sim.scene->model.openings.size(); ++q) {
    found.push_back(around(sim, q));
  }
  return found;
}

LockedRow locked_row(const Simulation& sim) {
  const BlockSet& b = sim.scene->blocks;
  LockedRow found;
  const std::vector<Row> rows = rows_of(sim);
  const auto continues = [&](Id block) {  // or ends, or is held
    return rows[block].alone || !is_free(b, sim.motion.state, block);
  };
  for (Id i = 0; i < b.size(); ++i) {
    const Row& row = rows[i];
    if (!is_free(b, sim.motion.state, i) || b.bends(i) || !row.alone || row.joints != 2 ||
        row.other[0] == row.other[1] || !continues(row.other[0]) || !continues(row.other[1]))
      continue;
    const Vec2 centre{b.centroid_x[i], b.centroid_y[i]}, to_first = row.middle[0] - centre,
                                                         to_second = row.middle[1] - centre;
    const bool opposite = dot(to_first, to_second) < -0.7 * norm(to_first) * norm(to_second);
    if (!opposite || !is_bent(sim, unit(row.middle[1] - row.middle[0]))) continue;
    found.blocks.push_back(i);
    found.stiffness += row.stiffness;
    found.kn += bar_modulus(b, i) / norm(row.middle[1] - row.middle[0]);
    found.triangles = found.triangles || corners_of(b, i) == 3;
  }
  if (found.blocks.empty()) return found;
  const auto count = static_cast<double>(found.blocks.size());
  found.stiffness /= count;
  found.kn /= count;
  found.lost = 1.0 - 1.0 / (1.0 + found.stiffness);
  return found;
}

void warn_of_locking(const Simulation& sim, std::vector<std::string>& warnings) {
  constexpr double closure = 0.05, deflection = 0.6;  // joints with kn = E/c lose a half
  for (const LockedOpening& o : locked_openings(sim)) {
    if (!(o.lost > closure)) continue;
    const std::string opening =
        row_label("opening", sim.scene->model.openings[o.opening].name, o.opening);
    if (o.bends) {
      warnings.push_back(fmt::format(
          "the elastic closure of {} comes out about {:.0f} % too small: blocks of {:.2g} m are "
          "too "
          "coarse beside an opening of radius {:.2g} m; use blocks of half the radius at most "
          "(theory, section 4.9)",
          opening, 100.0 * o.lost, o.size, o.radius));
      continue;
    }
    warnings.push_back(fmt::format(
        "the elastic closure of {} comes out about {:.0f} % too small: blocks of {:.2g} m have one "
        "strain each and do not bend, and the joints around an opening of radius {:.2g} m are "
        "{:.2g} times as stiff as they are; use deformation = \"corners\" (theory, section 4.9)",
        opening, 100.0 * o.lost, o.size, o.radius, o.stiffness));
  }
  const LockedRow row = locked_row(sim);
  if (!(row.lost > deflection)) return;
  warnings.push_back(fmt::format(
      "the bending deflection of {} glued in a row ({} first) comes out about {:.0f} % too small: "
      "blocks have one strain each and do not bend, and the joints across the row are {:.2g} times "
      "too stiff to bend for them; use deformation = \"{}\", or give these joints kn = "
      "E/c = {:.2g} Pa/m, with the length c of a block along the row (theory, section 4.9)",
      counted(row.blocks.size(), "block"), block_label(sim.scene->blocks, row.blocks.front()),
      100.0 * row.lost, row.stiffness, row.triangles ? "zones" : "corners", row.kn));
}

}  // namespace edda
