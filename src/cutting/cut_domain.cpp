#include "cutting/cut_domain.hpp"
#include "base/text.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "base/place.hpp"
#include "base/rings.hpp"
#include "cutting/crossings.hpp"
#include "cutting/face_polygons.hpp"
#include "cutting/idle_lines.hpp"
#include "cutting/joined_ends.hpp"
#include "cutting/line_work.hpp"
#include "cutting/noding.hpp"
#include "cutting/partition.hpp"
#include "cutting/planar_graph.hpp"
#include "cutting/poor_faces.hpp"
#include "cutting/rock_area.hpp"
#include "cutting/unenclosed.hpp"
#include "imports/import_units.hpp"

namespace edda {
namespace {

double perimeter_of(const Ring& ring) {
  double sum = 0.0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    sum += norm(ring[i + 1 == ring.size() ? 0 : i + 1] - ring[i]);
  }
  return sum;
}

bool in_rock(const LineWork& work, Vec2 p, double snap) {
  if (side_of({&work.outline, 1}, p, snap) <= 0) return false;
  return std::none_of(work.openings.begin(), work.openings.end(), [&](const Ring& o) {
    return side_of({&o, 1}, p, snap) >= 0;
  });
}

std::optional<Fault> not_simple(const Model& model, const LineWork& work) {
  const auto fault = [](const Where& table, const char* member) {
    return Fault{member_of(table, member), "crosses or touches itself",
                 "list the corners in order along the boundary"};
  };
  if (self_crossing(work.outline)) return fault(model.domain->where, "outline");
  for (std::size_t i = 0; i < work.openings.size(); ++i) {
    if (self_crossing(work.openings[i])) {
      return fault(model.openings[i].where, model.openings[i].shape ? "shape" : "polygon");
    }
  }
  return std::nullopt;
}

std::optional<Fault> wrong_count(const Model& model, const Partition& p, bool framed) {
  const long long blocks = count(p, Zone::rock);
  if (blocks == 0 && framed) {
    return Fault{member_of(model.imports.front().where, "file"), "the lines enclose nothing",
                 "give lines that bound blocks, or a [domain] for them to cut"};
  }
  if (blocks == 0) {
    return Fault{member_of(model.domain->where, "outline"), "is wholly excavated by openings",
                 "shrink the openings or enlarge the outline"};
  }
  if (blocks > model.domain->max_blocks) {
    return Fault{member_of(model.domain->where, "max_blocks"),
                 "the domain is cut into " + std::to_string(blocks) + " blocks, more than " +
                     std::to_string(model.domain->max_blocks),
                 "raise max_blocks, or cut with wider spacings"};
  }
  return std::nullopt;
}

/// Joint sets were counted when the model was read. Lines through one point make fewer blocks than
/// crossings are counted, hence the margin.
std::optional<Fault> too_many_crossings(const Model& model, const LineWork& work) {
  const auto finite = [](const JointSet& set) { return set.trace_length.has_value(); };
  const bool sets_alone = model.traces.empty() && model.imports.empty() && model.networks.empty() &&
                          std::none_of(model.joint_sets.begin(), model.joint_sets.end(), finite);
  if (sets_alone) return std::nullopt;
  constexpr double allowance = 4.0;
  const double crossings = estimated_crossings(work.lines);
  const auto most = static_cast<double>(model.domain->max_blocks);
  if (crossings <= allowance * most) return std::nullopt;
  return Fault{member_of(model.domain->where, "max_blocks"),
               "the lines cross about " + number_text(crossings) + " times, too often for " +
                   number_text(most) + " blocks",
               "raise max_blocks, or give fewer lines or wider spacings"};
}

struct Arrangement {
  PlanarGraph graph;
  Partition parts;
  CutReport report;  ///< what was trimmed, and whether by snap rounding
  std::vector<Index> region_of_half_edge;
};

bool is_staged(const Model& model, Index opening) {
  return opening != none && model.openings[static_cast<std::size_t>(opening)].staged;
}

/// Rock beside an opening that a stage excavates: its side of the outline names no law. The law of
/// the outline ends with the rock inside; later contacts there are those of any other face.
std::vector<LineSource> sources_for(const Model& model, const LineWork& work, Zone zone) {
  std::vector<LineSource> sources = work.sources;
  for (LineSource& s : sources) {
    const bool outline = s.kind == LineKind::opening && is_staged(model, s.index);
    if (outline && zone == Zone::rock) s.joint = none;
  }
  return sources;
}

std::vector<BlockPolygon> polygons(const Model& model, const Arrangement& a, const LineWork& work,
                                   Zone zone, double snap) {
  const Partition& p = a.parts;
  const std::vector<LineSource> sources = sources_for(model, work, zone);
  std::vector<BlockPolygon> blocks;
  blocks.reserve(static_cast<std::size_t>(count(p, zone)));
  for (std::size_t f = 1; f < p.zone.size(); ++f) {
    if (p.zone[f] != zone) continue;
    BlockPolygon block = face_polygon(a.graph, p.faces, static_cast<int>(f), sources, 4.0 * snap);
    const Index region = region_of(a.graph, p.faces, static_cast<int>(f), a.region_of_half_edge);
    block.material = region == none ? model.domain->material
                                    : model.regions[static_cast<std::size_t>(region)].material;
    block.where = model.domain->where;
    block.opening = p.opening[f];
    blocks.push_back(std::move(block));
  }
  sort_by_centroid(blocks, 1e-12 * size_of(work.outline));
  return blocks;
}

double area_of(const std::vector<BlockPolygon>& blocks) {
  double sum = 0.0;
  for (const BlockPolygon& block : blocks) {
    for (const Ring& ring : block.rings) sum += signed_area(ring);
  }
  return sum;
}

/// Rock that a stage excavates is present until then; it follows the other cut blocks.
void keep_staged(const Model& model, DomainCut& cut) {
  const auto gone = std::stable_partition(
      cut.removed.begin(), cut.removed.end(),
      [&](const BlockPolygon& block) { return is_staged(model, block.opening); });
  const std::vector<BlockPolygon> kept(cut.removed.begin(), gone);
  cut.removed.erase(cut.removed.begin(), gone);
  for (BlockPolygon& block : cut.blocks) block.opening = none;
  cut.report.area_in += area_of(kept);
  cut.blocks.insert(cut.blocks.end(), kept.begin(), kept.end());
}

/// Snapping may move the outline by `snap`; apart from that the area of the faces must be that of
/// the domain.
std::optional<Fault> lost_area(const Model& model, const Arrangement& a, const LineWork& work,
                               double snap, double area_in) {
  double sum = 0.0, perimeter = perimeter_of(work.outline);
  for (const Ring& opening : work.openings) perimeter += perimeter_of(opening);
  for (std::size_t f = 1; f < a.parts.zone.size(); ++f) {
    if (a.parts.zone[f] != Zone::rock) continue;
    sum += face_area(a.graph, a.parts.faces, static_cast<int>(f));
  }
  if (std::abs(sum - area_in) <= 1e-9 * area_in + 4.0 * snap * perimeter) return std::nullopt;
  return Fault{member_of(model.domain->where, "snap"),
               "the blocks fill " + number_text(sum) + " m2 of the " + number_text(area_in) +
                   " m2 that the outline encloses",
               "change domain.snap tenfold, or move apart lines that nearly coincide"};
}

/// Trims lines that bound no block and counts them.
Cycles trim(PlanarGraph& graph, const LineWork& work, double snap, CutReport& report) {
  for (int v : trim_free_ends(graph)) {
    report.dangling += in_rock(work, graph.node[static_cast<std::size_t>(v)], snap);
  }
  Cycles cycles = trace_cycles(graph);
  const std::vector<int> bridges = remove_bridges(graph, cycles);
  for (int e : bridges) {
    const GraphEdge& edge = graph.edge[static_cast<std::size_t>(e)];
    const Vec2 middle = 0.5 * (graph.node[static_cast<std::size_t>(edge.from)] +
                               graph.node[static_cast<std::size_t>(edge.to)]);
    report.bridging += in_rock(work, middle, snap);
  }
  return bridges.empty() ? std::move(cycles) : trace_cycles(graph);
}

/// Nodes the lines and finds their faces. Lines that coincide may then have nodes that the other
/// line does not share, with a face thinner than snap between them; noding once more, with all
/// nodes as vertices, makes them one.
Result<Arrangement> arrange(const Model& model, LineWork& work, double snap, bool framed) {
  constexpr int most_rounds = 3;
  for (int round = 1;; ++round) {
    Result<NodedLines> noded = node_lines(work, snap, model.domain->where);
    if (!noded.ok()) return noded.faults();
    Arrangement a;
    a.report.snap_rounded = noded.value().snap_rounded;
    if (round < most_rounds) work.lines = line_strings(noded.value());
    a.graph = planar_graph(std::move(noded.value()), work.sources);
    Cycles cycles = trim(a.graph, work, snap, a.report);
    Result<Partition> parts = partition(model, a.graph, std::move(cycles), work, framed);
    if (!parts.ok()) return parts.faults();
    a.parts = std::move(parts.value());
    if (round < most_rounds && has_thin_face(a.graph, a.parts.faces, snap)) continue;
    auto regions = regions_of_half_edges(model, a.graph, a.parts, work);
    if (!regions.ok()) return regions.faults();
    a.region_of_half_edge = std::move(regions.value());
    return a;
  }
}

double rock_in(const Arrangement& a) {
  double sum = 0.0;
  for (std::size_t f = 1; f < a.parts.zone.size(); ++f) {
    if (a.parts.zone[f] == Zone::rock) {
      sum += face_area(a.graph, a.parts.faces, static_cast<int>(f));
    }
  }
  return sum;
}

/// Calls merge(), which returns how many faces it merged, until it merges none.
template <class Merge>
std::optional<Faults> merge_all(const Model& model, Arrangement& a, const LineWork& work,
                                bool framed, int& merged, Merge merge) {
  while (const int now = merge()) {
    merged += now;
    Result<Partition> parts = partition(model, a.graph, trace_cycles(a.graph), work, framed);
    if (!parts.ok()) return parts.faults();
    a.parts = std::move(parts.value());
  }
  return std::nullopt;
}

/// Points of blocks that are to be fixed, m, local.
std::vector<Vec2> fixed_points(const Model& model, const Imports& imports, Vec2 origin) {
  std::vector<Vec2> points;
  for (const FixedPoint& fixed : model.fixed) points.push_back(fixed.point - origin);
  for (const auto& [a, b] : imports.fixed_lines) {
    for (const Vec2 p : {a, 0.5 * (a + b), b}) points.push_back(p - origin);
  }
  return points;
}

/// Warnings of joints that cut nothing; for imports in doubtful units that warning instead, since
/// it may be the cause.
std::vector<std::string> cut_warnings(const Model& model, const Imports& imports,
                                      const Arrangement& a, const LineWork& work, bool framed,
                                      const std::function<bool(Vec2)>& inside) {
  std::vector<std::string> warnings = idle_lines(model, work, a.graph, a.parts, framed, inside);
  for (std::string& shortened : shortened_sets(model, work, a.graph, a.parts, inside)) {
    warnings.push_back(std::move(shortened));
  }
  for (std::size_t i = 0; i < model.imports.size(); ++i) {
    const auto doubt = unit_doubt(model, imports, i);
    if (!doubt) continue;
    const std::string idle = model.imports[i].where.key + " cuts nothing";
    std::erase_if(warnings, [&](const std::string& w) { return w.starts_with(idle); });
    warnings.push_back(*doubt);
  }
  return warnings;
}

/// Merges faces that are none, and slivers by [quality].
std::optional<Faults> merge_faces(const Model& model, const Imports& imports, Arrangement& a,
                                  const LineWork& work, bool framed, double snap, Vec2 origin,
                                  CutReport& report) {
  const std::vector<double> thin = widths_of_rounding(work);
  const auto merge_thin = [&] {
    return merge_slivers(a.graph, a.parts.faces, a.parts.rock, snap, thin);
  };
  if (auto faults = merge_all(model, a, work, framed, report.merged, merge_thin)) {
    return faults;
  }
  const Quality& q = model.quality;
  const bool asks = q.min_area > 0.0 || q.min_edge > 0.0 || q.min_angle > 0.0;
  if (asks && q.action == QualityAction::merge) {
    const std::vector<Vec2> fixed = fixed_points(model, imports, origin);
    std::vector<FaceMerge> merges;
    const auto merge_poor = [&] {
      return merge_poor_faces(a.graph, a.parts, q,
                              {a.region_of_half_edge, fixed, work.sources, snap}, merges);
    };
    if (auto faults = merge_all(model, a, work, framed, report.quality_merged, merge_poor)) {
      return faults;
    }
    for (const FaceMerge& m : merges) {
      const LineSource& source = work.sources[static_cast<std::size_t>(m.source)];
      report.quality_area += m.area;
      report.merges.push_back({m.at + origin, m.area, table_of(model, source), m.lost});
    }
  }
  return std::nullopt;
}

/// Notes of what was read, drawn and joined, and warnings of lines that cut nothing or too little.
void report_lines(const Model& model, const Imports& imports, const Arrangement& a,
                  const LineWork& work, bool framed, const JoinedEnds& joined,
                  const std::function<bool(Vec2)>& in_rock, CutReport& report) {
  report.left_out = imports.left_out;
  for (const auto* notes : {&imports.notes, &work.notes, &joined.notes}) {
    report.notes.insert(report.notes.end(), notes->begin(), notes->end());
  }
  report.warnings = cut_warnings(model, imports, a, work, framed, in_rock);
  for (const auto* warnings : {&joined.warnings, &imports.warnings}) {
    report.warnings.insert(report.warnings.end(), warnings->begin(), warnings->end());
  }
}

}  // namespace

double snap_of(const Model& model) {
  const Domain& domain = *model.domain;
  const double size = size_of(domain.outline);
  double farthest = 0.0;
  for (Vec2 p : domain.outline) farthest = std::max({farthest, std::abs(p.x), std::abs(p.y)});
  const double snap = domain.snap > 0.0 ? domain.snap : 1e-9 * size;
  const double resolved = 4.0 * std::numeric_limits<double>::epsilon() * farthest;
  return std::max({snap, resolved, std::numeric_limits<double>::min()});
}

Result<DomainCut> cut_domain(const Model& model, Vec2 origin, const Imports& imports, bool framed) {
  const double snap = snap_of(model);
  Result<LineWork> lines = line_work(model, origin, snap, imports);
  if (!lines.ok()) return lines.faults();
  LineWork& work = lines.value();
  if (auto fault = not_simple(model, work)) return *fault;
  if (auto fault = too_many_crossings(model, work)) return *fault;
  std::optional<double> area_in = rock_area(work.outline, work.openings);
  if (!area_in) {
    return Fault{member_of(model.domain->where, "outline"),
                 "the area of the outline without its openings cannot be measured",
                 "simplify the outline or the openings where they nearly touch"};
  }
  const auto inside = [&](Vec2 p) { return in_rock(work, p, snap); };
  const JoinedEnds joined = join_ends(model, work, snap, framed, origin, inside);
  Result<Arrangement> arranged = arrange(model, work, snap, framed);
  if (!arranged.ok()) return arranged.faults();
  Arrangement& a = arranged.value();
  if (framed) area_in = rock_in(a);

  DomainCut cut;
  for (const LineSource& source : work.sources) cut.tables.push_back(table_of(model, source));
  cut.report = a.report;
  cut.report.area_in = *area_in;
  report_lines(model, imports, a, work, framed, joined, inside, cut.report);
  if (auto faults = merge_faces(model, imports, a, work, framed, snap, origin, cut.report)) {
    return *faults;
  }
  if (auto fault = wrong_count(model, a.parts, framed)) return *fault;
  if (auto fault = lost_area(model, a, work, snap, *area_in)) return *fault;
  cut.blocks = polygons(model, a, work, Zone::rock, snap);
  cut.removed = polygons(model, a, work, Zone::opening, snap);
  if (framed) {
    if (auto warning = unenclosed_warning(imports, cut.blocks, origin))
      cut.report.warnings.push_back(std::move(*warning));
  }
  keep_staged(model, cut);
  cut.report.cut_blocks = static_cast<int>(cut.blocks.size());
  cut.report.area_out = area_of(cut.blocks);
  return cut;
}

}  // namespace edda
