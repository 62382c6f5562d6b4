#include "cutting/given_blocks.hpp"

#include <algorithm>
#include <limits>

#include "base/polygon.hpp"
#include "base/rings.hpp"

namespace edda {
namespace {

struct Box {
  Vec2 low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  Vec2 high{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
};

void grow(Box& box, Vec2 p) {
  box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y)};
  box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y)};
}

void grow(Box& box, const Ring& ring) {
  for (Vec2 p : ring) grow(box, p);
}

Vec2 wall_extent(const BrickWall& wall) {
  return {wall.columns * wall.brick.x, wall.rows * wall.brick.y};
}

/// Corner of a wall at half brick `i` along and row `j` up; not a sum of sizes, so that the bricks
/// that share it have it to the bit.
Vec2 wall_corner(const BrickWall& wall, Vec2 low, int i, int j) {
  return {low.x + i * (wall.brick.x / 2.0), low.y + j * wall.brick.y};
}

BlockPolygon brick(const BrickWall& wall, Vec2 low, int from, int to, int row) {
  BlockPolygon block;
  block.rings = {{wall_corner(wall, low, from, row), wall_corner(wall, low, to, row),
                  wall_corner(wall, low, to, row + 1), wall_corner(wall, low, from, row + 1)}};
  block.joint = {std::vector<Index>(4, wall.joint)};
  block.material = wall.material;
  block.where = wall.where;
  return block;
}

/// A block of one ring, relative to `origin`. Input: has joint, material and fixed.
template <class Input>
BlockPolygon block_of(const Ring& given, const Input& input, Vec2 origin) {
  Ring ring;
  ring.reserve(given.size());
  for (const Vec2 p : given) ring.push_back(p - origin);
  if (signed_area(ring) < 0.0) std::reverse(ring.begin(), ring.end());
  BlockPolygon block;
  block.joint = {std::vector<Index>(ring.size(), input.joint)};
  block.rings = {std::move(ring)};
  block.material = input.material;
  block.fixed = input.fixed;
  return block;
}

/// Inner and outer corner of each joint in turn, the first again at the end of a full circle.
std::vector<Vec2> arch_corners(const Arch& arch, Vec2 centre) {
  constexpr double full = 360.0;
  const double turn = arch.to_angle - arch.from_angle;
  std::vector<Vec2> corners;
  for (int i = 0; i <= arch.count; ++i) {
    const bool closes = turn == full && i == arch.count;
    const Vec2 out = direction_of(arch.from_angle + (closes ? 0.0 : turn * i / arch.count));
    corners.push_back(centre + (arch.radius - 0.5 * arch.thickness) * out);
    corners.push_back(centre + (arch.radius + 0.5 * arch.thickness) * out);
  }
  return corners;
}

}  // namespace

Vec2 model_centre(const Model& model, const Imports& imports) {
  Box box;
  for (const BlockInput& block : model.blocks) grow(box, block.polygon);
  for (const BrickWall& wall : model.walls) {
    grow(box, wall.origin);
    grow(box, wall.origin + wall_extent(wall));
  }
  for (const Arch& arch : model.arches) {
    for (const Vec2 p : arch_corners(arch, arch.centre)) grow(box, p);
  }
  if (model.domain) grow(box, model.domain->outline);
  for (const Opening& opening : model.openings) grow(box, opening.polygon);
  for (const Lining& lining : model.linings) grow(box, lining.along);
  for (const Fill& fill : model.fills) grow(box, fill.polygon);
  for (const ImportedBlock& block : imports.blocks) grow(box, block.ring);
  if (box.low.x > box.high.x) return {};
  return box.low + (box.high - box.low) / 2.0;
}

std::vector<BlockPolygon> given_blocks(const Model& model, Vec2 origin) {
  std::vector<BlockPolygon> blocks;
  blocks.reserve(model.blocks.size());
  for (const BlockInput& input : model.blocks) {
    BlockPolygon block = block_of(input.polygon, input, origin);
    block.velocity = input.velocity;
    block.angular_velocity = input.angular_velocity;
    block.name = input.name;
    block.where = input.where;
    blocks.push_back(std::move(block));
  }
  return blocks;
}

std::vector<BlockPolygon> imported_blocks(const Model& model, const Imports& imports, Vec2 origin) {
  std::vector<BlockPolygon> blocks;
  blocks.reserve(imports.blocks.size());
  for (const ImportedBlock& input : imports.blocks) {
    blocks.push_back(block_of(input.ring, input, origin));
    blocks.back().where = model.imports[static_cast<std::size_t>(input.import)].where;
  }
  return blocks;
}

std::vector<BlockPolygon> wall_bricks(const Model& model, Vec2 origin) {
  std::vector<BlockPolygon> blocks;
  for (const BrickWall& wall : model.walls) {
    const Vec2 low = wall.origin - origin;
    const int end = 2 * wall.columns;
    for (int row = 0; row < wall.rows; ++row) {
      if (row % 2 == 0) {
        for (int i = 0; i < end; i += 2) blocks.push_back(brick(wall, low, i, i + 2, row));
        continue;
      }
      blocks.push_back(brick(wall, low, 0, 1, row));
      for (int i = 1; i + 2 < end; i += 2) blocks.push_back(brick(wall, low, i, i + 2, row));
      blocks.push_back(brick(wall, low, end - 1, end, row));
    }
  }
  return blocks;
}

std::vector<BlockPolygon> voussoirs(const Model& model, Vec2 origin) {
  std::vector<BlockPolygon> blocks;
  for (const Arch& arch : model.arches) {
    const std::vector<Vec2> corners = arch_corners(arch, arch.centre - origin);
    for (std::size_t i = 0; i + 3 < corners.size(); i += 2) {
      BlockPolygon block;
      block.rings = {{corners[i], corners[i + 1], corners[i + 3], corners[i + 2]}};
      block.joint = {std::vector<Index>(4, arch.joint)};
      block.material = arch.material;
      block.where = arch.where;
      blocks.push_back(std::move(block));
    }
  }
  return blocks;
}

}  // namespace edda
