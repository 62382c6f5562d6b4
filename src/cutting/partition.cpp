#include "cutting/partition.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <utility>

#include "base/place.hpp"

namespace edda {
namespace {

/// Whether an edge of the face belongs to `source` alone: where lines coincide the edge has the
/// first source, and this one is the last.
bool touches(const PlanarGraph& graph, const Faces& faces, int face, Index source) {
  bool any = false;
  for_each_half_edge(faces, face, [&](int h) {
    any = any || graph.edge[static_cast<std::size_t>(h / 2)].source == source;
  });
  return any;
}

}  // namespace

Result<Partition> partition(const Model& model, const PlanarGraph& graph, Cycles cycles,
                            const LineWork& work, bool framed) {
  Partition p;
  p.faces = find_faces(graph, std::move(cycles));
  p.zone.assign(p.faces.outer.size(), Zone::outside);
  p.opening.assign(p.faces.outer.size(), none);
  const auto outline = static_cast<Index>(work.sources.size()) - 1;
  const std::vector<std::uint8_t> inside = inside_ring(graph, p.faces, outline);
  if (inside[0] || std::find(inside.begin(), inside.end(), 1) == inside.end()) {
    return Fault{member_of(model.domain->where, "outline"),
                 "encloses no area once points closer than domain.snap are joined",
                 "lower domain.snap or enlarge the outline"};
  }
  for (std::size_t f = 0; f < inside.size(); ++f) {
    if (inside[f] && !(framed && touches(graph, p.faces, static_cast<int>(f), outline))) {
      p.zone[f] = Zone::rock;
    }
  }
  for (std::size_t s = 0; s < work.sources.size(); ++s) {
    if (work.sources[s].kind != LineKind::opening) continue;
    const Opening& opening = model.openings[static_cast<std::size_t>(work.sources[s].index)];
    const std::vector<std::uint8_t> taken = inside_ring(graph, p.faces, static_cast<Index>(s));
    bool any = false;
    for (std::size_t f = 0; f < inside.size(); ++f) {
      if (!inside[f] || !taken[f]) continue;
      any = true;
      if (p.zone[f] == Zone::rock) p.opening[f] = work.sources[s].index;
      p.zone[f] = Zone::opening;
    }
    if (!any) {
      return Fault{member_of(opening.where, opening.shape ? "shape" : "polygon"),
                   "lies wholly outside domain.outline",
                   "move it into the outline or leave it out"};
    }
  }
  p.rock.assign(p.zone.size(), -1);
  for (std::size_t f = 0; f < p.zone.size(); ++f) {
    if (p.zone[f] == Zone::rock) p.rock[f] = 0;
    if (p.opening[f] == none) continue;
    if (model.openings[static_cast<std::size_t>(p.opening[f])].staged) p.rock[f] = 1 + p.opening[f];
  }
  return p;
}

/// See partition.hpp. Regions may overlap openings, and each other.
Result<std::vector<Index>> regions_of_half_edges(const Model& model, const PlanarGraph& graph,
                                                 const Partition& parts, const LineWork& work) {
  if (model.regions.empty()) return std::vector<Index>{};
  std::vector<Index> regions(2 * graph.edge.size(), none);
  for (std::size_t s = 0; s < work.sources.size(); ++s) {
    if (work.sources[s].kind != LineKind::region) continue;
    const std::vector<std::uint8_t> inside = inside_ring(graph, parts.faces, static_cast<Index>(s));
    bool any = false;
    for (std::size_t h = 0; h < regions.size(); ++h) {
      if (!graph.alive[h / 2]) continue;
      const auto face = static_cast<std::size_t>(face_of(parts.faces, static_cast<int>(h)));
      if (!inside[face] || parts.zone[face] == Zone::outside) continue;
      regions[h] = work.sources[s].index;
      any = true;
    }
    if (!any) {
      const Region& region = model.regions[static_cast<std::size_t>(work.sources[s].index)];
      return Fault{member_of(region.where, "polygon"), "lies wholly outside domain.outline",
                   "move it into the outline or leave it out"};
    }
  }
  return regions;
}

Index region_of(const PlanarGraph& graph, const Faces& faces, int face,
                const std::vector<Index>& of_half_edges) {
  if (of_half_edges.empty()) return none;
  std::map<Index, double> length;
  for_each_half_edge(faces, face, [&](int h) {
    length[of_half_edges[static_cast<std::size_t>(h)]] +=
        norm(graph.node[static_cast<std::size_t>(target_of(graph, h))] -
             graph.node[static_cast<std::size_t>(origin_of(graph, h))]);
  });
  Index best = none;
  double most = -1.0;
  for (const auto& [region, sum] : length) {
    if (sum <= most) continue;
    most = sum;
    best = region;
  }
  return best;
}

long long count(const Partition& p, Zone zone) {
  return std::count(p.zone.begin(), p.zone.end(), zone);
}

}  // namespace edda
