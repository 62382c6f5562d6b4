#include "imports/dxf_blocks.hpp"

#include <cmath>
#include <set>

#include "imports/file_words.hpp"

namespace edda {
namespace {

std::string in_capitals(std::string text) {
  for (char& c : text) {
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  }
  return text;
}

std::size_t parts_of(const DxfContent& content) {
  std::size_t parts = 0;
  for (const DrawnLine& line : content.lines) parts += line.points.size();
  for (const auto& [kind, count] : content.skipped) parts += static_cast<std::size_t>(count);
  return parts;
}

/// Reads the block that has begun with `head`, up to its end. A fault in it stays with the block,
/// since drawings contain blocks that are not used.
void read_block(DxfSection& section, const DxfEntity& head, DxfBlocks& blocks) {
  DxfFault fault(section.fault().path());
  DxfValues values(head, fault);
  DxfBlock block;
  const std::string name = in_capitals(values.text(2));
  block.base = values.point(10);
  constexpr int external = 4 | 8;
  block.elsewhere = (values.whole(70, 0) & external) != 0;
  DxfCollector content(fault);
  while (const auto entity = section.next()) {
    if (DxfSection::is_end(*entity) || entity->name == "BLOCK") {
      section.fault().add(entity->line, "a BLOCK is not ended by ENDBLK");
      return;
    }
    if (entity->name == "ENDBLK") {
      block.content = content.finish(entity->line);
      block.parts = parts_of(block.content);
      block.fault = fault.found();
      blocks.try_emplace(name, std::move(block));
      return;
    }
    content.add(*entity);
  }
}

class Placer {
 public:
  Placer(const DxfBlocks& blocks, Drawing& drawing, DxfFault& fault)
      : blocks_(blocks), drawing_(drawing), fault_(fault) {}

  /// `outer`, `layer`: the map of the block that contains it, and the layer that its layer "0"
  /// stands for.
  bool place(const DxfInsert& insert, const PlaneMap& outer, const std::string& layer) {
    const auto found = blocks_.find(in_capitals(insert.block));
    if (!spend(1, insert)) return false;
    if (found == blocks_.end()) return count("INSERT without its block", 1);
    const DxfBlock& block = found->second;
    if (block.elsewhere) return count("INSERT of another drawing", 1);
    if (block.fault) {
      const Fault& f = *block.fault;
      return fault_.add(f.where.line, f.problem, f.remedy);
    }
    if (!open_.insert(&block).second) {
      return fail(insert, "block \"" + for_message(insert.block) + "\" is inserted into itself");
    }
    constexpr std::size_t deepest = 100;
    if (open_.size() > deepest) return fail(insert, "blocks are nested more than 100 deep");
    const std::string& here = insert.layer == "0" ? layer : insert.layer;
    for (int row = 0; row < insert.rows; ++row) {
      for (int column = 0; column < insert.columns; ++column) {
        PlaneMap map = insert.map;
        map.origin += column * insert.column_step + row * insert.row_step - map.along(block.base);
        if (!draw(block, insert, outer * map, here)) return false;
      }
    }
    open_.erase(&block);
    return true;
  }

 private:
  bool draw(const DxfBlock& block, const DxfInsert& insert, const PlaneMap& map,
            const std::string& layer) {
    if (!spend(block.parts + 1, insert)) return false;
    for (const auto& [kind, n] : block.content.skipped) count(kind, n);
    for (const DrawnLine& line : block.content.lines) {
      DrawnLine drawn{{}, line.layer == "0" ? layer : line.layer, line.line};
      for (const Vec2 p : line.points) {
        drawn.points.push_back(map(p));
        constexpr double largest = 1e12;  // as for coordinates in files
        const Vec2 q = drawn.points.back();
        if (!(std::abs(q.x) <= largest && std::abs(q.y) <= largest)) {
          return fail(insert, "an inserted block reaches beyond 1e12");
        }
      }
      drawing_.lines.push_back(std::move(drawn));
    }
    for (const DxfInsert& inner : block.content.inserts) {
      if (!place(inner, map, layer)) return false;
    }
    return true;
  }

  bool count(const std::string& kind, int n) {
    drawing_.skipped[kind] += n;
    return true;
  }
  bool fail(const DxfInsert& insert, std::string problem) {
    return fault_.add(insert.line, std::move(problem),
                      "explode the blocks that are needed, or export the lines as .csv");
  }
  /// Everything counts against the limit, also blocks without lines, since they cost time.
  bool spend(std::size_t parts, const DxfInsert& insert) {
    spent_ += parts;
    constexpr std::size_t most = 1'000'000;
    return spent_ <= most || fail(insert, "inserted blocks make more than 1000000 points");
  }

  const DxfBlocks& blocks_;
  Drawing& drawing_;
  DxfFault& fault_;
  std::set<const DxfBlock*> open_;  ///< blocks that are being drawn, one within the other
  std::size_t spent_ = 0;
};

}  // namespace

void read_blocks(DxfSection& section, DxfBlocks& blocks) {
  while (const auto entity = section.next()) {
    if (entity->name == "BLOCK") {
      read_block(section, *entity, blocks);
    } else if (entity->name == "ENDSEC") {
      return;
    } else if (DxfSection::is_end(*entity)) {
      section.fault().add(entity->line, "the section of blocks is not ended by ENDSEC");
      return;
    }
  }
  section.fault().add(section.line(), "breaks off within its blocks");
}

void place_blocks(const DxfBlocks& blocks, const std::vector<DxfInsert>& inserts, Drawing& drawing,
                  DxfFault& fault) {
  Placer placer(blocks, drawing, fault);
  for (const DxfInsert& insert : inserts) {
    if (!placer.place(insert, {}, insert.layer)) return;
  }
}

}  // namespace edda
