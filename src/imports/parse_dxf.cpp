// DXF drawings: their sections. dxf_groups.hpp describes their structure.
#include "imports/drawing.hpp"
#include "imports/dxf_blocks.hpp"

namespace edda {
namespace {

void read_entities(DxfSection& section, DxfCollector& content) {
  while (const auto entity = section.next()) {
    if (entity->name == "ENDSEC") return;
    if (DxfSection::is_end(*entity)) {
      section.fault().add(entity->line, "the section of entities is not ended by ENDSEC");
      return;
    }
    if (!content.add(*entity)) return;
  }
  section.fault().add(section.line(), "breaks off within its entities");
}

/// The unit of the header variable $INSUNITS; nothing for units that [[import]] does not have.
std::optional<LengthUnit> drawing_unit(std::optional<int> number) {
  switch (number.value_or(0)) {
    case 1:
      return LengthUnit::in;
    case 2:
      return LengthUnit::ft;
    case 4:
      return LengthUnit::mm;
    case 5:
      return LengthUnit::cm;
    case 6:
      return LengthUnit::m;
    case 7:
      return LengthUnit::km;
    default:
      return std::nullopt;
  }
}

}  // namespace

Result<Drawing> parse_dxf(std::string_view text, const std::string& path) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  DxfFault fault(path);
  DxfGroups file(text, fault);
  if (text.starts_with("AutoCAD Binary DXF")) fault.add(1, "is a binary drawing");
  DxfCollector entities(fault);
  DxfBlocks blocks;
  Drawing drawing;
  bool section = false, has_entities = false, says_units = false;
  for (auto group = file.next(); group && !fault.found(); group = file.next()) {
    const bool names_it = section && group->code == 2;
    section = group->code == 0 && group->value == "SECTION";
    if (says_units && group->code == 70) drawing.units = drawing_unit(whole_number(group->value));
    says_units = group->code == 9 && group->value == "$INSUNITS";
    if (!names_it) continue;
    DxfSection inner(file);
    if (group->value == "BLOCKS") read_blocks(inner, blocks);
    if (group->value != "ENTITIES") continue;
    has_entities = true;
    read_entities(inner, entities);
  }
  DxfContent content = entities.finish(file.line());
  if (!has_entities) fault.add(0, "has no section of entities");
  drawing.lines = std::move(content.lines);
  drawing.skipped = std::move(content.skipped);
  if (!fault.found()) place_blocks(blocks, content.inserts, drawing, fault);
  if (fault.found()) return *fault.found();
  return drawing;
}

}  // namespace edda
