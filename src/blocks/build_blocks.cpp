#include "blocks/build_blocks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "blocks/cover.hpp"
#include "blocks/kinematics.hpp"
#include "cutting/linings.hpp"
#include "cutting/triangulate.hpp"
#include "cutting/zone_size.hpp"

namespace edda {
namespace {

struct Lame {
  double lambda, mu;
};

/// Lame's constants for the model's plane: plane strain E nu/((1+nu)(1-2nu)), plane stress E
/// nu/(1-nu^2).
Lame lame(const Material& m, Plane plane) {
  const double mu = m.young / (2.0 * (1.0 + m.poisson));
  const double lambda = plane == Plane::strain
                            ? m.young * m.poisson / ((1.0 + m.poisson) * (1.0 - 2.0 * m.poisson))
                            : m.young * m.poisson / (1.0 - m.poisson * m.poisson);
  return {lambda, mu};
}

/// Half the least distance between two parallel lines, one of them along an edge, that enclose the
/// ring.
double half_width(std::span<const Vec2> ring) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2 edge = ring[(i + 1) % ring.size()] - ring[i];
    const double length = norm(edge);
    if (length == 0.0) continue;
    const Vec2 n = perp(edge) / length;
    double lo = 0.0, hi = 0.0;
    for (Vec2 p : ring) {
      const double h = dot(p - ring[i], n);
      lo = std::min(lo, h);
      hi = std::max(hi, h);
    }
    least = std::min(least, hi - lo);
  }
  return 0.5 * least;
}

/// How far the ring reaches to the left of a line through p in the direction of `along`, m.
double height_over(const Ring& ring, Vec2 p, Vec2 along) {
  const Vec2 n = perp(unit(along));
  double most = 0.0;
  for (const Vec2 q : ring) most = std::max(most, dot(q - p, n));
  return most;
}

double interior_angle(Vec2 before, Vec2 at, Vec2 after) {
  const Vec2 in = at - before, out = after - at;
  return std::numbers::pi - std::atan2(cross(in, out), dot(in, out));
}

const Lining* lining_of(const Model& model, const BlockPolygon& polygon) {
  return polygon.lining == none ? nullptr
                                : &model.linings[static_cast<std::size_t>(polygon.lining)];
}

/// Areas that belong to the corners of a lining: a quarter of each piece to each of its four.
std::vector<double> corner_areas(const BlockPolygon& lining) {
  const StripSections s = sections_of(lining);
  const std::vector<Vec2> corner = all_corners(lining);
  std::vector<double> area(corner.size(), 0.0);
  for (std::uint32_t p = 0; p < s.pieces(); ++p) {
    const auto [a, b, c, d] = s.corners(p);
    const double quarter = 0.125 * cross(corner[c] - corner[a], corner[d] - corner[b]);
    for (const std::uint32_t k : {a, b, c, d}) area[k] += quarter;
  }
  return area;
}

/// Of a lining those of the masses of its sections, so that its motion as a whole and its
/// deformation have the same ones.
Moments moments_of(const BlockPolygon& polygon) {
  Moments m = moments(polygon.rings);
  if (polygon.lining == none) return m;
  const std::vector<Vec2> corner = all_corners(polygon);
  const std::vector<double> area = corner_areas(polygon);
  Vec2 first;
  for (std::size_t k = 0; k < corner.size(); ++k) first += area[k] * corner[k];
  m.centroid = first / m.area;
  m.sxx = m.syy = m.sxy = 0.0;
  for (std::size_t k = 0; k < corner.size(); ++k) {
    const Vec2 arm = corner[k] - m.centroid;
    m.sxx += area[k] * arm.x * arm.x;
    m.syy += area[k] * arm.y * arm.y;
    m.sxy += area[k] * arm.x * arm.y;
  }
  return m;
}

/// `lining`: or null.
void add_vertices(BlockSet& b, const BlockPolygon& polygon, const Lining* lining, double young,
                  const Moments& m, const NodeVectors& g) {
  const Id block = static_cast<Id>(b.area.size());
  double smallest_edge = std::numeric_limits<double>::infinity(), radius = 0.0;
  for (std::size_t r = 0; r < polygon.rings.size(); ++r) {
    const Ring& ring = polygon.rings[r];
    const Id first = static_cast<Id>(b.vertex_block.size());
    const Id n = static_cast<Id>(ring.size());
    for (Id i = 0; i < n; ++i) {
      const Vec2 p = ring[i], after = ring[(i + 1) % n], before = ring[(i + n - 1) % n];
      double first_weight = 1.0;
      for (std::size_t k = 1; k < nodes_per_block; ++k) {
        b.weight[k].push_back(centroid_weights[k] + dot(g[k], p - m.centroid));
        first_weight -= b.weight[k].back();
      }
      b.weight[0].push_back(first_weight);
      b.vertex_block.push_back(block);
      b.next.push_back(first + (i + 1) % n);
      b.previous.push_back(first + (i + n - 1) % n);
      b.edge_joint.push_back(polygon.joint[r][i]);
      b.edge_table.push_back(polygon.table.empty() ? none : polygon.table[r][i]);
      b.edge_length.push_back(norm(after - p));
      const double height = lining != nullptr ? lining->drawn_thickness()
                                              : height_over(polygon.rings[0], p, after - p);
      b.compliance.push_back(height / young);
      b.corner.push_back(interior_angle(before, p, after));
      // The weight of a corner that hardly turns would jump with the rounding of its angle.
      const double turns = 1.0 - b.corner.back() / std::numbers::pi, hardly = 1e-3;
      const bool reentrant = turns < -hardly, straight = std::abs(turns) <= hardly;
      b.exterior_cosine.push_back(reentrant ? 0.0 : straight ? 1.0 : -std::cos(b.corner.back()));
      b.exterior_sine.push_back(reentrant ? 1.0 : straight ? 0.0 : std::sin(b.corner.back()));
      b.vertex_x.push_back(p.x);
      b.vertex_y.push_back(p.y);
      smallest_edge = std::min(smallest_edge, norm(after - p));
      radius = std::max(radius, norm(p - m.centroid));
    }
  }
  b.smallest_edge.push_back(smallest_edge);
  b.radius.push_back(radius);
}

/// Of a block whose vertices are there, if it is not convex.
void add_triangles(BlockSet& b, const BlockPolygon& polygon) {
  if (polygon.rings.size() == 1 && is_convex(polygon.rings[0])) return;
  const Id block = static_cast<Id>(b.vertex_begin.size() - 1), first = b.vertex_begin[block];
  std::vector<std::array<Id, 3>> triangles = triangulate(polygon.rings);
  for (std::array<Id, 3>& triangle : triangles) {
    for (Id& corner : triangle) corner += first;
  }
  b.triangles[block] = std::move(triangles);
}

/// Whether block i, built so far, has modes beside its uniform strain.
bool bends(const Model& model, const BlockPolygon& polygon, const BlockSet& b, std::size_t i) {
  const std::size_t n = b.vertex_begin[i + 1] - b.vertex_begin[i];
  return may_bend(model, polygon) && n > nodes_per_block && n <= most_corners_that_bend;
}

/// The modes of block i, of which all else is there.
void add_modes(BlockSet& b, const Moments& m, std::size_t i) {
  const Id first = b.vertex_begin[i], last = b.vertex_begin[i + 1];
  std::vector<Vec2> corner, gradient;
  std::vector<double> tributary;
  for (Id v = first; v < last; ++v) {
    const Vec2 after = b.vertex(b.next[v]), before = b.vertex(b.previous[v]);
    corner.push_back(b.vertex(v) - m.centroid);
    gradient.push_back((0.5 / m.area) * Vec2{after.y - before.y, before.x - after.x});
    tributary.push_back(0.5 * (b.edge_length[v] + b.edge_length[b.previous[v]]));
  }
  add_modes(b.bending, {corner, gradient, tributary, m.sxx, m.syy, m.sxy, b.lame_lambda[i],
                        b.lame_mu[i], b.thickness});
}

/// The mesh of a lining: two triangles for each piece.
void add_strip(Meshes& meshes, const BlockPolygon& lining, Vec2 centroid) {
  const StripSections s = sections_of(lining);
  std::vector<Vec2> node = all_corners(lining);
  for (Vec2& p : node) p -= centroid;
  std::vector<std::array<std::uint32_t, 3>> triangle;
  for (std::uint32_t p = 0; p < s.pieces(); ++p) {
    const auto [a, b, c, d] = s.corners(p);
    triangle.push_back({a, b, c});
    triangle.push_back({a, c, d});
  }
  add_mesh(meshes, {node, triangle, corner_areas(lining)});
}

/// How the last block deforms beside its uniform strain.
void add_deformation(BlockSet& b, const Model& model, const BlockPolygon& polygon, const Moments& m,
                     const ZoneSizes& sizes) {
  if (const std::size_t i = b.area.size() - 1; bends(model, polygon, b, i)) {
    add_modes(b, m, i);
  } else {
    add_no_modes(b.bending);
  }
  if (!may_be_meshed(model, polygon)) return add_no_mesh(b.meshes);
  if (polygon.lining != none) return add_strip(b.meshes, polygon, m.centroid);
  Mesh mesh = mesh_polygon(polygon.rings, sizes.of(polygon));
  for (Vec2& node : mesh.nodes) node -= m.centroid;
  add_mesh(b.meshes, {mesh.nodes, mesh.triangles});
}

/// Reserves exact sizes, so that no array ends with excess capacity.
void reserve(BlockSet& b, const std::vector<BlockPolygon>& polygons) {
  const std::size_t nb = polygons.size();
  std::size_t nv = 0;
  for (const BlockPolygon& polygon : polygons) {
    for (const Ring& ring : polygon.rings) nv += ring.size();
  }
  for (auto* nodes : {&b.grad_x, &b.grad_y, &b.node_x, &b.node_y}) {
    for (auto& values : *nodes) values.reserve(nb);
  }
  for (auto* values : {&b.volume, &b.lame_lambda, &b.lame_mu, &b.area, &b.mass, &b.damping,
                       &b.centroid_x, &b.centroid_y, &b.smallest_edge, &b.radius, &b.inradius}) {
    values->reserve(nb);
  }
  b.rayleigh.reserve(nb);
  b.fixed.reserve(nb);
  b.material.reserve(nb);
  b.vertex_begin.reserve(nb + 1);
  for (auto& values : b.weight) values.reserve(nv);
  for (auto* values : {&b.edge_length, &b.compliance, &b.corner, &b.exterior_cosine,
                       &b.exterior_sine, &b.vertex_x, &b.vertex_y})
    values->reserve(nv);
  for (auto* ids : {&b.vertex_block, &b.next, &b.previous}) ids->reserve(nv);
  b.edge_joint.reserve(nv);
  b.edge_table.reserve(nv);
}

}  // namespace

namespace {

BlockDeformation deformation_of(const Model& model, const BlockPolygon& block) {
  if (model.contact.model != ContactModel::faces || block.fixed || block.material == none)
    return BlockDeformation::uniform;
  if (block.lining != none || block.fill != none) return BlockDeformation::zones;
  const Material& material = model.materials[static_cast<std::size_t>(block.material)];
  if (material.deformation != BlockDeformation::automatic) return material.deformation;
  if (material.yield || material.foliation) return BlockDeformation::zones;
  if (model.deformation != BlockDeformation::automatic) return model.deformation;
  return model.zones ? BlockDeformation::zones : BlockDeformation::corners;
}

}  // namespace

bool may_be_meshed(const Model& model, const BlockPolygon& block) {
  return deformation_of(model, block) == BlockDeformation::zones;
}

bool may_bend(const Model& model, const BlockPolygon& block) {
  return deformation_of(model, block) == BlockDeformation::corners;
}

StripSections sections_of(const BlockSet& b, std::size_t i) {
  const Id first = b.vertex_begin[i], all = b.vertex_begin[i + 1] - first;
  Id ring = 1;
  for (Id v = b.next[first]; v != first; v = b.next[v]) ++ring;
  return {ring < all ? ring : all / 2, ring < all};
}

BlockSet build_blocks(const Model& model, const PolygonSet& polygons) {
  BlockSet b;
  b.origin = polygons.origin;
  b.tables = polygons.tables;
  b.thickness = model.thickness;
  b.mass_kind = model.solver.mass;
  reserve(b, polygons.blocks);
  const ZoneSizes sizes(model, polygons);
  b.vertex_begin.push_back(0);
  for (const BlockPolygon& polygon : polygons.blocks) {
    const Lining* const lining = lining_of(model, polygon);
    const Moments m = moments_of(polygon);
    const Material& material = model.materials[static_cast<std::size_t>(polygon.material)];
    const bool matched = model.solver.mass == MassKind::matched;
    const Cover cover = matched ? matched_cover(m) : covering_cover(polygon.rings[0], m.centroid);
    const NodeVectors g = gradients(cover);
    const double volume = m.area * model.thickness;
    const double mass = material.density * volume * (lining != nullptr ? lining->solidity() : 1.0);
    const Lame elastic = lame(material, model.plane);
    add_vertices(b, polygon, lining, material.young, m, g);
    add_triangles(b, polygon);
    for (std::size_t k = 0; k < nodes_per_block; ++k) {
      b.grad_x[k].push_back(g[k].x);
      b.grad_y[k].push_back(g[k].y);
      b.node_x[k].push_back(cover[k].x);
      b.node_y[k].push_back(cover[k].y);
    }
    if (model.solver.mass == MassKind::consistent) {
      std::array<double, 6> per_mass = consistent_mass(m, g, centroid_weights);
      const std::array<double, 6> inverse = inverse_symmetric(per_mass);
      for (std::size_t e = 0; e < 6; ++e) b.inverse_mass[e].push_back(inverse[e] / mass);
    }
    b.volume.push_back(volume);
    b.lame_lambda.push_back(elastic.lambda);
    b.lame_mu.push_back(elastic.mu);
    b.fixed.push_back(polygon.fixed ? 1 : 0);
    b.area.push_back(m.area);
    b.mass.push_back(mass);
    b.damping.push_back(material.damping);
    b.rayleigh.push_back(material.rayleigh);
    b.centroid_x.push_back(m.centroid.x);
    b.centroid_y.push_back(m.centroid.y);
    b.inradius.push_back(lining != nullptr ? 0.5 * lining->drawn_thickness()
                                           : half_width(polygon.rings[0]));
    b.material.push_back(polygon.material);
    for (const auto& [rows, row] : {std::pair{&b.opening, polygon.opening},
                                    {&b.lining, polygon.lining},
                                    {&b.fill, polygon.fill}}) {
      if (row == none) continue;
      rows->resize(polygons.blocks.size(), none);
      (*rows)[b.area.size() - 1] = row;
    }
    if (!polygon.name.empty()) b.names[static_cast<Id>(b.area.size() - 1)] = polygon.name;
    b.vertex_begin.push_back(static_cast<Id>(b.vertex_block.size()));
    add_deformation(b, model, polygon, m, sizes);
  }
  if (!b.bending.any()) b.bending = {};
  if (!b.meshes.any()) b.meshes = {};
  return b;
}

State initial_state(const BlockSet& b, const PolygonSet& polygons) {
  State s;
  const std::size_t nb = b.size();
  s.velocity = s.position = zero_vectors(b);
  s.position.x = b.node_x;
  s.position.y = b.node_y;
  s.reference = s.position;
  for (std::size_t i = 0; i < nb; ++i) {
    const BlockPolygon& p = polygons.blocks[i];
    if (p.fixed) continue;
    const Vec2 centre{b.centroid_x[i], b.centroid_y[i]};
    store(rigid_velocities(vector_of(b, s.position, i), centre, p.velocity, p.angular_velocity), b,
          s.velocity, i);
  }
  s.alive.assign(nb, 1);
  s.turns.assign(nb, 0);
  return s;
}

}  // namespace edda
