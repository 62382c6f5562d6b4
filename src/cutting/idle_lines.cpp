#include "cutting/idle_lines.hpp"

#include "base/text.hpp"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

namespace edda {
namespace {

bool is_joint(LineKind kind) {
  return kind != LineKind::region && kind != LineKind::opening && kind != LineKind::outline;
}

/// Per edge, whether it separates two blocks, or, where blocks lie between lines of imports, bounds
/// one.
std::vector<std::uint8_t> edges_that_cut(const PlanarGraph& graph, const Partition& parts,
                                         bool framed) {
  std::vector<std::uint8_t> cuts(graph.edge.size(), 0);
  const auto is_rock = [&](std::size_t h) {
    return parts.rock[static_cast<std::size_t>(face_of(parts.faces, static_cast<int>(h)))] >= 0;
  };
  for (std::size_t e = 0; e < graph.edge.size(); ++e) {
    if (!graph.alive[e]) continue;
    const bool left = is_rock(2 * e), right = is_rock(2 * e + 1);
    cuts[e] = framed ? left || right : left && right;
  }
  return cuts;
}

using Ends = std::tuple<double, double, double, double>;

Ends ends_of(Vec2 a, Vec2 b) {
  if (std::pair(b.x, b.y) < std::pair(a.x, a.y)) std::swap(a, b);
  return {a.x, a.y, b.x, b.y};
}

/// What has become of the lines of one table.
enum class Fate { none_drawn, beside, trimmed, on_others };

const Where& where_of(const Model& model, LineKind kind, std::size_t i) {
  switch (kind) {
    case LineKind::trace:
      return model.traces[i].where;
    case LineKind::import:
      return model.imports[i].where;
    case LineKind::joint_set:
      return model.joint_sets[i].where;
    case LineKind::network:
      return model.networks[i].where;
    case LineKind::region:
      return model.regions[i].where;
    case LineKind::opening:
      return model.openings[i].where;
    case LineKind::outline:
      return model.domain->where;
    default:
      return model.voronoi->where;
  }
}

std::string warning_of(const Model& model, LineKind kind, std::size_t i, Fate fate) {
  const std::string key = where_of(model, kind, i).key;
  if (fate == Fate::trimmed && kind == LineKind::trace) {
    return key +
           " ends inside blocks on both sides: it is trimmed away whole; lengthen it to other "
           "joints or to the outline";
  }
  if (fate == Fate::trimmed) {
    return key +
           " cuts nothing: all its lines end inside blocks and are trimmed away whole; lengthen "
           "them to other joints or to the outline, or give more of them";
  }
  const std::string begin = key + " cuts nothing: ";
  const std::string beside = fate == Fate::none_drawn ? "the domain" : "the rock of the domain";
  switch (kind) {
    case LineKind::joint_set:
      return begin + "none of its joints crosses " + beside +
             (model.joint_sets[i].region.empty() ? "; look at its origin and spacing"
                                                 : "; look at its region, origin and spacing");
    case LineKind::voronoi:
      return begin + "no edge of its polygons crosses " + beside + "; give a smaller size";
    case LineKind::import:
      return begin + "none of its lines crosses " + beside + "; look at its units, scale and shift";
    default:
      return begin + "it does not cross " + beside + "; move it, or leave it out";
  }
}

}  // namespace

std::string table_of(const Model& model, const LineSource& source) {
  return where_of(model, source.kind, static_cast<std::size_t>(source.index)).key;
}

std::vector<std::string> shortened_sets(const Model& model, const LineWork& work,
                                        const PlanarGraph& graph, const Partition& parts,
                                        const std::function<bool(Vec2)>& in_rock) {
  const std::vector<std::uint8_t> cuts = edges_that_cut(graph, parts, false);
  std::vector<double> lost(work.sources.size(), 0.0), left(work.sources.size(), 0.0);
  for (std::size_t e = 0; e < graph.edge.size(); ++e) {
    const GraphEdge& edge = graph.edge[e];
    const auto s = static_cast<std::size_t>(edge.source);
    if (work.sources[s].kind != LineKind::joint_set) continue;
    const Vec2 a = graph.node[static_cast<std::size_t>(edge.from)];
    const Vec2 b = graph.node[static_cast<std::size_t>(edge.to)];
    if (cuts[e]) {
      left[s] += norm(b - a);
    } else if (!graph.alive[e] && in_rock(0.5 * (a + b))) {
      lost[s] += norm(b - a);
    }
  }
  std::vector<std::string> warnings;
  for (std::size_t s = 0; s < lost.size(); ++s) {
    constexpr double noticed = 1.0 / 3.0;
    const double whole = lost[s] + left[s];
    if (left[s] == 0.0 || lost[s] <= noticed * whole) continue;
    warnings.push_back(table_of(model, work.sources[s]) + ": " + number_text(lost[s], 3) +
                       " m of its " + number_text(whole, 3) +
                       " m end inside blocks and are trimmed away: lengthen its traces to other "
                       "joints, or let them run from one bed to the next (bounded_by)");
  }
  return warnings;
}

std::vector<std::string> idle_lines(const Model& model, const LineWork& work,
                                    const PlanarGraph& graph, const Partition& parts, bool framed,
                                    const std::function<bool(Vec2)>& in_rock) {
  const std::vector<std::uint8_t> cuts = edges_that_cut(graph, parts, framed);
  std::vector<std::uint8_t> busy(work.sources.size(), 0);
  for (std::size_t e = 0; e < cuts.size(); ++e) {
    if (cuts[e]) busy[static_cast<std::size_t>(graph.edge[e].source)] = 1;
  }
  // An import has a source per law.
  std::map<std::pair<LineKind, Index>, Fate> idle;
  for (const LineSource& s : work.sources) {
    if (is_joint(s.kind)) idle.emplace(std::pair(s.kind, s.index), Fate::none_drawn);
  }
  for (std::size_t s = 0; s < busy.size(); ++s) {
    if (busy[s]) idle.erase({work.sources[s].kind, work.sources[s].index});
  }
  if (idle.empty()) return {};
  std::vector<Ends> cutting;
  for (std::size_t e = 0; e < cuts.size(); ++e) {
    if (!cuts[e]) continue;
    const auto node = [&](int n) { return graph.node[static_cast<std::size_t>(n)]; };
    cutting.push_back(ends_of(node(graph.edge[e].from), node(graph.edge[e].to)));
  }
  std::sort(cutting.begin(), cutting.end());
  for (const LineString& line : work.lines) {
    const LineSource& s = work.sources[static_cast<std::size_t>(line.source)];
    const auto found = idle.find({s.kind, s.index});
    if (found == idle.end()) continue;
    Fate& fate = found->second;
    for (std::size_t k = 0; k + 1 < line.points.size() && fate != Fate::on_others; ++k) {
      const Vec2 a = line.points[k], b = line.points[k + 1];
      if (std::binary_search(cutting.begin(), cutting.end(), ends_of(a, b))) {
        fate = Fate::on_others;
      } else if (fate != Fate::trimmed) {
        fate = in_rock(0.5 * (a + b)) ? Fate::trimmed : Fate::beside;
      }
    }
  }
  std::vector<std::string> warnings;
  for (const auto& [table, fate] : idle) {
    if (fate == Fate::on_others) continue;
    warnings.push_back(
        warning_of(model, table.first, static_cast<std::size_t>(table.second), fate));
  }
  return warnings;
}

}  // namespace edda
