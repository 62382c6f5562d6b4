#include "imports/dxf_blocks.hpp"

#include <cmath>
#include <set>

#include "imports/file_words.hpp"

namespace edda {
namespace {

std::size_t parts_of(const DxfContent& content) {
  std::size_t parts = 0;
  for (const DrawnLine& line : content.lines) parts += line.points.size();
  for (const auto& [kind, count] : content.skipped) parts += static_cast<std::size_t>(count);
  return parts;
}

/// Reads the block that has begun with `head`, up to its end. A fault in its head stays with the
/// block, since drawings contain blocks that are not used.
void read_block(DxfSection& section, const DxfEntity& head, Digits& digits, DxfBlocks& blocks) {
  DxfFault fault(section.fault().path());
  DxfValues values(head, fault);
  DxfBlock block;
  const std::string name = in_capitals(values.text(2));
  block.base = values.point(10);
  constexpr int external = 4 | 8;
  block.elsewhere = (values.whole(70, 0) & external) != 0;
  DxfCollector content(section.fault().path(), digits);
  while (const auto entity = section.next()) {
    if (DxfSection::is_end(*entity) || entity->name == "BLOCK") {
      section.fault().add(entity->line, "a BLOCK is not ended by ENDBLK");
      return;
    }
    if (entity->name == "ENDBLK") {
      block.content = content.finish();
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
  Placer(const DxfBlocks& blocks, const DxfTables& tables, Drawing& drawing, DxfFault& fault)
      : blocks_(blocks), tables_(tables), drawing_(drawing), fault_(fault) {}

  /// `outer`, `layer`: the map of the block that contains it, and the layer that its layer "0"
  /// stands for.
  bool place(const DxfInsert& insert, const PlaneMap& outer, const std::string& layer) {
    const auto found = blocks_.find(in_capitals(insert.block));
    const std::string& here = insert.layer == "0" ? layer : insert.layer;
    if (!spend(1, insert)) return false;
    if (tables_.clips(insert.dictionary)) return count("INSERT that is clipped (XCLIP)", 1);
    if (tables_.frozen(here)) return count("INSERT on frozen layer \"" + clear(here) + '"', 1);
    if (found == blocks_.end()) return count("INSERT without its block", 1);
    const DxfBlock& block = found->second;
    if (block.elsewhere) return count("INSERT of another drawing", 1);
    if (block.fault) return leave_out(*block.fault);
    constexpr std::size_t deepest = 100;
    if (open_.size() >= deepest) return leave_out(insert, "blocks are nested more than 100 deep");
    if (!open_.insert(&block).second) {
      return leave_out(insert,
                       "block \"" + for_message(insert.block) + "\" is inserted into itself");
    }
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

  /// Takes the line unless its layer is hidden.
  void take(DrawnLine line) {
    if (tables_.hidden(line.layer)) {
      count("on hidden layer \"" + clear(line.layer) + '"', 1);
    } else {
      drawing_.lines.push_back(std::move(line));
    }
  }

 private:
  bool draw(const DxfBlock& block, const DxfInsert& insert, const PlaneMap& map,
            const std::string& layer) {
    if (!spend(block.parts + 1, insert)) return false;
    for (const auto& [kind, n] : block.content.skipped) count(kind, n);
    drawing_.faulty += block.content.faulty;
    if (block.content.fault && !drawing_.fault) drawing_.fault = block.content.fault;
    for (const DrawnLine& line : block.content.lines) {
      DrawnLine drawn{{}, line.layer == "0" ? layer : line.layer, line.line};
      for (const Vec2 p : line.points) {
        drawn.points.push_back(map(p));
        constexpr double largest = 1e12;  // as for coordinates in files
        const Vec2 q = drawn.points.back();
        if (!(std::abs(q.x) <= largest && std::abs(q.y) <= largest)) {
          return leave_out(insert, "an inserted block reaches beyond 1e12");
        }
      }
      take(std::move(drawn));
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
  static std::string clear(const std::string& layer) { return for_message(layer); }
  bool leave_out(const Fault& fault) {
    ++drawing_.faulty;
    if (!drawing_.fault) drawing_.fault = fault;
    return count("INSERT with a fault", 1);
  }
  bool leave_out(const DxfInsert& insert, std::string problem) {
    DxfFault fault(fault_.path());
    fault.add(insert.line, std::move(problem), explode);
    return leave_out(*fault.found());
  }
  bool fail(const DxfInsert& insert, std::string problem) {
    return fault_.add(insert.line, std::move(problem), explode);
  }
  /// Everything counts against the limit, also blocks without lines, since they cost time.
  bool spend(std::size_t parts, const DxfInsert& insert) {
    spent_ += parts;
    constexpr std::size_t most = 1'000'000;
    return spent_ <= most || fail(insert, "inserted blocks make more than 1000000 points");
  }

  static constexpr const char* explode =
      "explode the blocks that are needed, or export the lines as .csv";

  const DxfBlocks& blocks_;
  const DxfTables& tables_;
  Drawing& drawing_;
  DxfFault& fault_;
  std::set<const DxfBlock*> open_;  ///< blocks that are being drawn, one within the other
  std::size_t spent_ = 0;
};

}  // namespace

void read_blocks(DxfSection& section, Digits& digits, DxfBlocks& blocks) {
  while (const auto entity = section.next()) {
    if (entity->name == "BLOCK") {
      read_block(section, *entity, digits, blocks);
    } else if (entity->name == "ENDSEC") {
      return;
    } else if (DxfSection::is_end(*entity)) {
      section.fault().add(entity->line, "the section of blocks is not ended by ENDSEC");
      return;
    }
  }
  section.fault().add(section.line(), "breaks off within its blocks");
}

void place_content(DxfContent content, const DxfBlocks& blocks, const DxfTables& tables,
                   Drawing& drawing, DxfFault& fault) {
  Placer placer(blocks, tables, drawing, fault);
  drawing.skipped = std::move(content.skipped);
  drawing.faulty = content.faulty;
  drawing.fault = std::move(content.fault);
  for (DrawnLine& line : content.lines) placer.take(std::move(line));
  for (const DxfInsert& insert : content.inserts) {
    if (!placer.place(insert, {}, insert.layer)) return;
  }
}

}  // namespace edda
