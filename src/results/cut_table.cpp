#include "results/cut_table.hpp"

#include "results/columns.hpp"
#include "results/csv_file.hpp"

namespace edda {
namespace {

std::string joint_name(const Model& model, Index joint) {
  if (joint == none) return {};
  const auto k = static_cast<std::size_t>(joint);
  return k < model.joints.size() ? model.joints[k].name : "glued";
}

std::string table_name(const PolygonSet& polygons, const BlockPolygon& b, std::size_t ring,
                       std::size_t edge) {
  const Index row = b.table.empty() ? none : b.table[ring][edge];
  return row == none ? "" : polygons.tables[static_cast<std::size_t>(row)];
}

}  // namespace

Trouble write_cut_csv(const std::string& path, const PolygonSet& polygons, const Model& model) {
  Csv csv = begin_table(ResultFile::cut);
  return write_rows(path, csv, polygons.blocks.size(), [&](std::size_t i) {
    const BlockPolygon& b = polygons.blocks[i];
    const std::string material =
        b.material == none ? "" : model.materials[static_cast<std::size_t>(b.material)].name;
    for (std::size_t r = 0; r < b.rings.size(); ++r) {
      for (std::size_t k = 0; k < b.rings[r].size(); ++k) {
        const Vec2 p = b.rings[r][k] + polygons.origin;
        csv.add(i)
            .add(material)
            .add(r)
            .add(p.x)
            .add(p.y)
            .add(joint_name(model, b.joint[r][k]))
            .add(table_name(polygons, b, r, k))
            .end();
      }
    }
  });
}

}  // namespace edda
