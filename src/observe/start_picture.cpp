#include "observe/start_picture.hpp"

#include "attachments/bolts.hpp"

namespace edda {

Picture start_picture(const Model& model, const BlockSet& b) {
  Picture p;
  p.blocks.reserve(b.size());
  for (std::size_t i = 0; i < b.size(); ++i) {
    BlockRecord r;
    r.id = static_cast<std::uint32_t>(i);
    r.name = b.name(i);
    r.material_index = b.material[i];
    if (b.material[i] != none)
      r.material = model.materials[static_cast<std::size_t>(b.material[i])].name;
    r.fixed = b.fixed[i] != 0;
    r.position = Vec2{b.centroid_x[i], b.centroid_y[i]} + b.origin;
    r.area = b.area[i];
    p.blocks.push_back(r);
  }
  const std::size_t nv = b.vertex_count(), points = nv + b.meshes.nodes();
  for (auto* values : {&p.ux, &p.uy, &p.vx, &p.vy}) values->assign(points, 0.0);
  p.zones.resize(b.meshes.zone.size());
  p.x.reserve(points);
  p.y.reserve(points);
  for (std::size_t v = 0; v < nv; ++v) {
    p.x.push_back(b.vertex_x[v] + b.origin.x);
    p.y.push_back(b.vertex_y[v] + b.origin.y);
  }
  for (std::size_t i = 0; b.meshes.any() && i < b.size(); ++i) {
    for (std::size_t j = b.meshes.begin[i]; j < b.meshes.begin[i + 1]; ++j) {
      p.x.push_back(b.centroid_x[i] + b.meshes.arm_x[j] + b.origin.x);
      p.y.push_back(b.centroid_y[i] + b.meshes.arm_y[j] + b.origin.y);
    }
  }
  return p;
}

std::vector<std::array<Vec2, 2>> bolt_lines(const Model& model) {
  std::vector<std::array<Vec2, 2>> lines;
  for (const Bolt& bolt : all_bolts(model)) lines.push_back({bolt.from, bolt.to});
  return lines;
}

}  // namespace edda
