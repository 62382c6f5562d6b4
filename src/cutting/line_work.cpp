#include "cutting/line_work.hpp"

#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "base/digits.hpp"
#include "base/place.hpp"
#include "base/rings.hpp"
#include "base/text.hpp"
#include "cutting/joint_sets.hpp"
#include "cutting/random_lines.hpp"
#include "cutting/strata_bound.hpp"

namespace edda {
namespace {

void add_ring(LineWork& work, const Ring& ring, Index source) {
  std::vector<Vec2> points = closed(ring);
  if (points.size() > 3) work.lines.push_back({std::move(points), source});
}

Index add_source(LineWork& work, LineKind kind, std::size_t index, Index joint) {
  work.sources.push_back({kind, static_cast<Index>(index), joint, 0.0, {}});
  return static_cast<Index>(work.sources.size()) - 1;
}

Fault too_many_lines(const JointSet& set, long long max_blocks) {
  return {member_of(set.where, "spacing"),
          "makes more lines than domain.max_blocks = " + std::to_string(max_blocks) + " blocks",
          "raise the spacing, give the set a region, or raise domain.max_blocks"};
}

double last_digit_of(const std::vector<Trace>& traces) {
  std::vector<Ring> all;
  for (const Trace& trace : traces) all.push_back(trace.points);
  return last_digit(all);
}

/// The lines that are drawn by points: one unit of the last digit of these, and the snap of
/// imports.
void add_rounding(const Model& model, const Imports& imports, LineWork& work) {
  const double size = size_of(work.outline), traces = last_digit_of(model.traces);
  for (LineSource& s : work.sources) {
    const auto i = static_cast<std::size_t>(s.index);
    double unit = 0.0;
    if (s.kind == LineKind::trace) unit = traces;
    if (s.kind == LineKind::import) {
      s.snap = model.imports[i].snap;
      if (!s.snap) unit = imports.last_digit[i];
    }
    if (s.kind == LineKind::region) unit = last_digit({&model.regions[i].polygon, 1});
    if (s.kind == LineKind::opening) unit = last_digit({&model.openings[i].given_polygon, 1});
    if (s.kind == LineKind::outline) unit = last_digit({&model.domain->given_outline, 1});
    s.unit = rounding(unit, size);
  }
}

std::optional<Fault> coarse_snap(const Model& model, const LineWork& work) {
  constexpr double largest_part = 1e-2;  // as of domain.snap
  const double most = largest_part * size_of(work.outline);
  for (const Import& import : model.imports) {
    if (import.snap.value_or(0.0) <= most) continue;
    return Fault{member_of(import.where, "snap"),
                 number_text(*import.snap) + " m is too coarse for a domain of " +
                     number_text(size_of(work.outline)) + " m",
                 "give at most " + number_text(most, 3)};
  }
  return std::nullopt;
}

/// One source per import and law, in the order of the lines.
void add_imports(LineWork& work, const Imports& imports, Vec2 origin, Index otherwise) {
  std::map<std::pair<Index, Index>, Index> known;
  for (const ImportedLine& imported : imports.lines) {
    const Index joint = imported.joint == none ? otherwise : imported.joint;
    const auto [source, is_new] = known.try_emplace({imported.import, joint}, none);
    if (is_new) {
      source->second =
          add_source(work, LineKind::import, static_cast<std::size_t>(imported.import), joint);
    }
    LineString line{{}, source->second};
    for (Vec2 p : imported.points) line.points.push_back(p - origin);
    line.points = without_repeats(std::move(line.points));
    if (line.points.size() > 1) work.lines.push_back(std::move(line));
  }
}

}  // namespace

double rounding(double unit, double size) {
  constexpr double coarsest = 2.1e-3;
  return unit <= coarsest * size ? unit : 0.0;
}

double last_digit(std::span<const Ring> rings) {
  Digits digits;
  for (const Ring& ring : rings) {
    for (const Vec2 p : ring) {
      digits.add(p.x);
      digits.add(p.y);
    }
  }
  return digits.unit();
}

Result<LineWork> line_work(const Model& model, Vec2 origin, double snap, const Imports& imports) {
  const Domain& domain = *model.domain;
  const auto law = [&](Index joint) { return joint == none ? domain.joint : joint; };
  LineWork work;
  work.outline = local_ring(domain.outline, origin);
  for (const Opening& opening : model.openings) {
    work.openings.push_back(local_ring(opening.polygon, origin));
  }
  for (std::size_t i = 0; i < model.traces.size(); ++i) {
    const Index source = add_source(work, LineKind::trace, i, law(model.traces[i].joint));
    LineString line{{}, source};
    for (Vec2 p : model.traces[i].points) line.points.push_back(p - origin);
    line.points = without_repeats(std::move(line.points));
    if (line.points.size() > 1) work.lines.push_back(std::move(line));
  }
  add_imports(work, imports, origin, domain.joint);
  const auto most = static_cast<double>(domain.max_blocks);
  for (std::size_t i = 0; i < model.joint_sets.size(); ++i) {
    const JointSet& set = model.joint_sets[i];
    const Index source = add_source(work, LineKind::joint_set, i, law(set.joint));
    const bool few =
        set.beds == none
            ? add_joint_set(work, set, source, origin, snap, most)
            : add_strata_bound(work, set, model.joint_sets[static_cast<std::size_t>(set.beds)],
                               source, origin, snap, most);
    if (!few) {
      return too_many_lines(set, domain.max_blocks);
    }
  }
  for (std::size_t i = 0; i < model.networks.size(); ++i) {
    const FractureNetwork& network = model.networks[i];
    const Index source = add_source(work, LineKind::network, i, law(network.joint));
    Faults faults = add_network(work, network, source, origin, snap, most);
    if (!faults.empty()) return faults;
  }
  if (model.voronoi) {
    const Index source = add_source(work, LineKind::voronoi, 0, law(model.voronoi->joint));
    Faults faults = add_voronoi(work, *model.voronoi, source, origin, snap);
    if (!faults.empty()) return faults;
  }
  for (std::size_t i = 0; i < model.regions.size(); ++i) {
    const Index source = add_source(work, LineKind::region, i, model.regions[i].joint);
    add_ring(work, local_ring(model.regions[i].polygon, origin), source);
  }
  for (std::size_t i = 0; i < model.openings.size(); ++i) {
    const Index source = add_source(work, LineKind::opening, i, model.openings[i].joint);
    add_ring(work, work.openings[i], source);
  }
  add_ring(work, work.outline, add_source(work, LineKind::outline, 0, none));
  add_rounding(model, imports, work);
  if (auto fault = coarse_snap(model, work)) return *fault;
  return work;
}

}  // namespace edda
