#include "observe/wave_path.hpp"

#include <algorithm>
#include <cmath>

namespace edda {
namespace {

/// A part of the line inside of one block, and the edge through which it leaves.
struct Piece {
  double from, to;
  Id block, exit;
};

/// Where the line from + t along crosses the outlines of the blocks, by block and ascending.
std::vector<Piece> pieces_of(const BlockSet& b, Vec2 from, Vec2 along) {
  std::vector<Piece> pieces;
  std::vector<std::pair<double, Id>> crossings;
  for (Id i = 0; i < b.size(); ++i) {
    const Vec2 centre{b.centroid_x[i], b.centroid_y[i]};
    if (std::abs(cross(along, centre - from)) > b.radius[i]) continue;
    crossings.clear();
    for (Id v = b.vertex_begin[i]; v < b.vertex_begin[i + 1]; ++v) {
      const Vec2 p = b.vertex(v) - from, q = b.vertex(b.next[v]) - from;
      const double at_p = cross(along, p), at_q = cross(along, q);
      if ((at_p > 0.0) == (at_q > 0.0)) continue;
      const double part = at_p / (at_p - at_q);
      crossings.push_back({dot(along, p + part * (q - p)), v});
    }
    std::sort(crossings.begin(), crossings.end());
    for (std::size_t k = 0; k + 1 < crossings.size(); k += 2) {
      if (crossings[k + 1].first > 0.0)
        pieces.push_back({crossings[k].first, crossings[k + 1].first, i, crossings[k + 1].second});
    }
  }
  std::sort(pieces.begin(), pieces.end(), [](const Piece& p, const Piece& q) {
    return p.from != q.from ? p.from < q.from : p.block < q.block;
  });
  return pieces;
}

double modulus_of(const BlockSet& b, Id i, bool along_motion) {
  return along_motion ? b.lame_lambda[i] + 2.0 * b.lame_mu[i] : b.lame_mu[i];
}

/// Compliance of the joint between two blocks, m/Pa; 0 where they have no face.
double joint_compliance(const Simulation& sim, Id i, Id j, bool along_motion) {
  const BlockSet& b = sim.scene->blocks;
  const FaceSet& f = sim.motion.contacts;
  double stiffest = 0.0;
  f.for_faces(b.vertex_begin[i], b.vertex_begin[i + 1], [&](Id k, bool of_edge) {
    if (b.vertex_block[of_edge ? f.facing[k] : f.edge[k]] != j) return;
    stiffest = std::max(stiffest, along_motion ? f.stiffness[k] : f.shear_stiffness[k]);
  });
  return stiffest > 0.0 ? b.thickness / stiffest : 0.0;
}

PathEnd end_of(const Simulation& sim, const Piece& last, Vec2 along, Vec2 motion) {
  const BlockSet& b = sim.scene->blocks;
  for (const Dashpot& d : sim.attached.dashpots.points) {
    if (d.block == last.block && dot(d.normal, along) > 0.5) return PathEnd::absorbing;
  }
  const BoundarySprings& s = sim.attached.springs;
  for (std::size_t q = 0; q < s.size(); ++q) {
    if (s.vertex[q] != last.exit && s.vertex[q] != b.next[last.exit]) continue;
    const auto& k = s.acting_k[q];
    const double along_motion =
        motion.x * motion.x * k[0] + motion.y * motion.y * k[1] + 2.0 * motion.x * motion.y * k[2];
    if (along_motion > 0.1 * (k[0] + k[1])) return PathEnd::held;
  }
  return PathEnd::open;
}

/// Adds a block to the path; joint: the compliance of the joint before it.
void add_block(const BlockSet& b, const Masses& masses, const Piece& piece, double joint,
               bool along_motion, Index& material, double& compliance, WavePath& path) {
  const Id i = piece.block;
  const double length = piece.to - piece.from, of_rock = length / modulus_of(b, i, along_motion);
  if (path.layers.empty() || b.material[i] != material) {
    path.layers.emplace_back();
    path.layers.back().density = b.mass[i] / b.volume[i];
    compliance = 0.0;
    material = b.material[i];
  }
  WaveLayer& layer = path.layers.back();
  const double eta = viscosity_of(masses, i);
  const double before = compliance;
  compliance += of_rock + joint;
  layer.viscosity = (before * layer.viscosity + of_rock * eta) / compliance;
  layer.length += length;
  layer.modulus = layer.length / compliance;
}

}  // namespace

double WaveLayer::speed() const {
  return std::sqrt(modulus / density);
}

double WavePath::length() const {
  double sum = 0.0;
  for (const WaveLayer& layer : layers) sum += layer.length;
  return sum;
}

double WavePath::travel_time() const {
  double sum = 0.0;
  for (const WaveLayer& layer : layers) sum += layer.length / layer.speed();
  return sum;
}

WavePath wave_path(const Simulation& sim, const Masses& masses, Vec2 from, Vec2 along,
                   Vec2 motion) {
  const BlockSet& b = sim.scene->blocks;
  const bool along_motion = std::abs(dot(along, motion)) > std::sqrt(0.5);
  constexpr double gap = 1e-2;  // of the block: a void
  WavePath path;
  Piece last{0.0, 0.0, no_id, no_id};
  Index material = none;
  double compliance = 0.0;
  for (const Piece& piece : pieces_of(b, from, along)) {
    const bool begun = last.block != no_id;
    if (b.fixed[piece.block] != 0) {
      if (!begun) continue;
      path.end = PathEnd::held;
      return path;
    }
    if (begun && piece.from - last.to > gap * std::sqrt(b.area[piece.block])) break;
    if (piece.to <= last.to && begun) continue;
    add_block(b, masses, piece,
              begun ? joint_compliance(sim, last.block, piece.block, along_motion) : 0.0,
              along_motion, material, compliance, path);
    last = piece;
  }
  if (last.block != no_id) path.end = end_of(sim, last, along, motion);
  return path;
}

}  // namespace edda
