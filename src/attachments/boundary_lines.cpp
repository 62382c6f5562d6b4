#include "attachments/boundary_lines.hpp"

#include <algorithm>
#include <limits>

namespace edda {
namespace {

struct Box {
  Vec2 low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  Vec2 high{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  void add(Vec2 p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
};

/// Of the rock; linings and fill count where there is none.
Box model_box(const Model& model, const BlockSet& b) {
  Box rock, all;
  if (model.domain) {
    for (Vec2 p : model.domain->outline) rock.add(p - b.origin);
    return rock;
  }
  for (std::size_t v = 0; v < b.vertex_count(); ++v) {
    all.add(b.vertex(v));
    if (!b.is_added(b.vertex_block[v])) rock.add(b.vertex(v));
  }
  return rock.low.x < rock.high.x ? rock : all;
}

}  // namespace

std::vector<Line> lines_along(const Model& model, const BlockSet& b,
                              const std::vector<std::string>& sides,
                              const std::vector<Vec2>& along) {
  std::vector<Line> lines;
  if (!sides.empty()) {
    const Box box = model_box(model, b);
    const Vec2 ll = box.low, ur = box.high, lr{ur.x, ll.y}, ul{ll.x, ur.y};
    for (const std::string& side : sides) {
      if (side == "left") lines.push_back({ll, ul});
      if (side == "right") lines.push_back({lr, ur});
      if (side == "bottom") lines.push_back({ll, lr});
      if (side == "top") lines.push_back({ul, ur});
    }
  }
  for (std::size_t i = 0; i + 1 < along.size(); ++i) {
    lines.push_back({along[i] - b.origin, along[i + 1] - b.origin});
  }
  return lines;
}

double boundary_snap(const Model& model, const BlockSet& b) {
  const Box box = model_box(model, b);
  const double extent = std::max(box.high.x - box.low.x, box.high.y - box.low.y);
  return std::max(model.domain ? 4.0 * model.domain->snap : 0.0, 1e-9 * extent);
}

}  // namespace edda
