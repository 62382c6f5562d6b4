#include "view/mesh.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "view/bytes.hpp"

namespace edda {
namespace {

double whole(const Grid& g, const char* name, std::size_t cell) {
  const Field* field = g.cell_field(name);
  return field == nullptr ? 0.0 : field->values[cell];
}

/// Adds one block: its vertices in the order of its cells, each once.
void add_block(const Grid& g, const BlockShape& shape, const std::vector<Vec2>& points,
               ViewMesh& mesh) {
  const Vec2 centre = centre_of(g, shape, points);
  mesh.id.push_back(static_cast<std::int32_t>(whole(g, "id", shape.first_cell)));
  mesh.material.push_back(static_cast<std::int32_t>(whole(g, "material", shape.first_cell)));
  mesh.fixed.push_back(whole(g, "fixed", shape.first_cell) != 0.0 ? 1 : 0);
  mesh.centre.push_back(centre);
  const bool any_zones = g.cell_field("plastic_strain") != nullptr;
  mesh.zoned.push_back(any_zones && shape.end_cell - shape.first_cell > 1 ? 1 : 0);
  std::map<std::int64_t, std::uint32_t> vertex_of;
  const auto vertex = [&](std::int64_t point) {
    const auto [at, is_new] =
        vertex_of.try_emplace(point, static_cast<std::uint32_t>(mesh.vertex.size()));
    if (is_new) {
      mesh.vertex.push_back(points[static_cast<std::size_t>(point)] - centre);
      mesh.point.push_back(point);
    }
    return at->second;
  };
  for (std::size_t c = shape.first_cell; c < shape.end_cell; ++c) {
    const std::size_t from = g.begin(c), to = static_cast<std::size_t>(g.ends[c]);
    for (std::size_t k = from + 1; k + 1 < to; ++k) {
      mesh.triangles.push_back(
          {vertex(g.corners[from]), vertex(g.corners[k]), vertex(g.corners[k + 1])});
    }
  }
  for (const auto& [a, b] : shape.outline) mesh.edges.push_back({vertex(a), vertex(b)});
  mesh.begin.push_back(mesh.vertex.size());
  mesh.edge_begin.push_back(mesh.edges.size());
}

}  // namespace

std::size_t ViewMesh::row_of(std::int32_t block) const {
  const auto at = std::lower_bound(id.begin(), id.end(), block);
  return at == id.end() || *at != block ? size() : static_cast<std::size_t>(at - id.begin());
}

double ViewMesh::reach(std::size_t row) const {
  double reach = 0.0;
  for (std::size_t v = begin[row]; v < begin[row + 1]; ++v)
    reach = std::max({reach, std::abs(vertex[v].x), std::abs(vertex[v].y)});
  return reach;
}

ViewMesh view_mesh(const Grid& first) {
  ViewMesh mesh;
  mesh.points = first.point_count();
  mesh.begin.push_back(0);
  mesh.edge_begin.push_back(0);
  const std::vector<Vec2> points = drawn_points(first, 1.0);
  for (const BlockShape& shape : block_shapes(first)) add_block(first, shape, points, mesh);
  return mesh;
}

std::string mesh_bytes(const ViewMesh& mesh) {
  Bytes bytes;
  const auto count = [&](std::size_t n) { bytes.u32(static_cast<std::uint32_t>(n)); };
  count(mesh.size());
  count(mesh.vertex.size());
  count(mesh.triangles.size());
  count(mesh.edges.size());
  for (const Vec2 c : mesh.centre) {
    bytes.f64(c.x);
    bytes.f64(c.y);
  }
  for (const Vec2 v : mesh.vertex) {
    bytes.f32(v.x);
    bytes.f32(v.y);
  }
  for (const std::int32_t i : mesh.id) bytes.u32(static_cast<std::uint32_t>(i));
  for (const std::int32_t m : mesh.material) bytes.u32(static_cast<std::uint32_t>(m));
  for (const std::size_t b : mesh.begin) count(b);
  for (const auto& t : mesh.triangles) {
    for (const std::uint32_t v : t) bytes.u32(v);
  }
  for (const auto& e : mesh.edges) {
    for (const std::uint32_t v : e) bytes.u32(v);
  }
  for (const auto* flags : {&mesh.fixed, &mesh.zoned}) {
    for (const std::uint8_t f : *flags) bytes.u8(f);
  }
  return bytes.text();
}

}  // namespace edda
