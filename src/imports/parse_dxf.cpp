// DXF drawings: their sections. dxf_groups.hpp describes their structure.
#include "imports/code_page.hpp"
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
    content.add(*entity);
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

Result<Drawing> parse_dxf(std::string_view text, const std::string& path,
                          const std::vector<std::string>& shown) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  const std::string decoded = utf8_of(text);
  text = decoded;
  DxfFault fault(path);
  DxfGroups file(text, fault);
  if (text.starts_with("AutoCAD Binary DXF")) fault.add(1, "is a binary drawing");
  Drawing drawing;
  DxfCollector entities(path, drawing.digits);
  DxfBlocks blocks;
  DxfTables tables(shown);
  bool section = false, has_entities = false, says_units = false;
  for (auto group = file.next(); group && !fault.found(); group = file.next()) {
    const bool names_it = section && group->code == 2;
    section = group->code == 0 && group->value == "SECTION";
    if (says_units && group->code == 70) drawing.units = drawing_unit(whole_number(group->value));
    says_units = group->code == 9 && group->value == "$INSUNITS";
    if (!names_it) continue;
    DxfSection inner(file);
    if (group->value == "BLOCKS") read_blocks(inner, drawing.digits, blocks);
    if (group->value == "TABLES") tables.read_layers(inner);
    if (group->value == "OBJECTS") tables.read_objects(inner);
    if (group->value != "ENTITIES") continue;
    has_entities = true;
    read_entities(inner, entities);
  }
  if (!has_entities) fault.add(0, "has no section of entities");
  if (!fault.found()) place_content(entities.finish(), blocks, tables, drawing, fault);
  if (fault.found()) return *fault.found();
  return drawing;
}

}  // namespace edda
