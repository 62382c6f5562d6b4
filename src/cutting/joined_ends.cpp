#include "cutting/joined_ends.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/rings.hpp"
#include "base/text.hpp"
#include "cutting/idle_lines.hpp"
#include "cutting/joint_draws.hpp"
#include "cutting/near_ends.hpp"
#include "cutting/planar_graph.hpp"

namespace edda {
namespace {

/// What messages call the table of a source; all traces are one.
std::string name_of(const Model& model, const LineSource& source) {
  return source.kind == LineKind::trace ? "trace" : table_of(model, source);
}

/// 1, 2 or 5 times a power of ten, not below x.
double round_up(double x) {
  const double power = std::pow(10.0, std::floor(std::log10(x)));
  for (const double m : {1.0, 2.0, 5.0}) {
    if (x <= m * power) return m * power;
  }
  return 10.0 * power;
}

/// The sources whose lines end where somebody put their ends: traces, imports and patterns of
/// traces without deviations.
std::vector<bool> drawn_by_hand(const Model& model, const LineWork& work) {
  std::vector<bool> drawn;
  for (const LineSource& s : work.sources) {
    bool by_hand = s.kind == LineKind::trace || s.kind == LineKind::import;
    if (s.kind == LineKind::joint_set) {
      const JointSet& set = model.joint_sets[static_cast<std::size_t>(s.index)];
      by_hand = set.trace_length.has_value() && is_regular(set.deviation);
    }
    drawn.push_back(by_hand);
  }
  return drawn;
}

/// A sentence per table of the model about corners that moved.
std::vector<std::string> joined_notes(const Model& model, const LineWork& work,
                                      const std::vector<MovedCorners>& moved) {
  std::map<std::string, MovedCorners> sums;
  for (std::size_t i = 0; i < moved.size(); ++i) {
    if (moved[i].count == 0) continue;
    MovedCorners& sum = sums[name_of(model, work.sources[i])];
    sum.count += moved[i].count;
    sum.farthest = std::max(sum.farthest, moved[i].farthest);
  }
  std::vector<std::string> notes;
  for (const auto& [key, sum] : sums) {
    notes.push_back(key + ": " + counted(sum.count, "corner") + " moved by up to " +
                    number_text(sum.farthest, 2) + " m onto lines that " +
                    (sum.count == 1 ? "it" : "they") + " missed by no more than rounding, or snap");
  }
  return notes;
}

/// A sentence per table about its near misses: how many, where the nearest is, and the snap that
/// would join them.
std::vector<std::string> near_miss_warnings(const Model& model, const LineWork& work,
                                            const std::vector<NearMiss>& misses, Vec2 origin) {
  std::map<std::string, std::vector<NearMiss>> of_table;
  for (const NearMiss& miss : misses) {
    of_table[name_of(model, work.sources[at(miss.source)])].push_back(miss);
  }
  std::vector<std::string> warnings;
  for (const auto& [key, found] : of_table) {
    const auto nearer = [](const NearMiss& a, const NearMiss& b) { return a.gap < b.gap; };
    const NearMiss nearest = *std::min_element(found.begin(), found.end(), nearer);
    const double widest = std::max_element(found.begin(), found.end(), nearer)->gap;
    const bool one = found.size() == 1;
    const bool import = work.sources[at(nearest.source)].kind == LineKind::import;
    const Vec2 p = nearest.at + origin;
    warnings.push_back(
        key + ": " + counted(found.size(), "end") + " of its lines " + (one ? "stops" : "stop") +
        " in the rock less than " + number_text(round_up(widest), 3) +
        " m short of another line, and what does not bound a block is trimmed; " +
        (one ? "it" : "the nearest") + " misses by " + number_text(nearest.gap, 3) + " m at (" +
        number_text(p.x) + ", " + number_text(p.y) + "): " + (import ? key : "domain") +
        ".snap = " + number_text(round_up(widest), 3) + " joins " + (one ? "it" : "them") +
        " if that is meant");
  }
  return warnings;
}

}  // namespace

JoinedEnds join_ends(const Model& model, LineWork& work, double snap, bool framed, Vec2 origin,
                     const std::function<bool(Vec2)>& in_rock) {
  constexpr double reach = 1e-3;  // of the domain
  JoinedEnds joined;
  joined.notes = joined_notes(model, work, join_rounded_corners(work, snap, framed));
  const auto misses = near_misses(work, drawn_by_hand(model, work), snap,
                                  reach * size_of(work.outline), framed, in_rock);
  joined.warnings = near_miss_warnings(model, work, misses, origin);
  return joined;
}

std::vector<double> widths_of_rounding(const LineWork& work) {
  constexpr double of_unit = 0.9, snap_of_unit = 1.5;
  std::vector<double> widths;
  for (const LineSource& s : work.sources) {
    const bool drawn = s.kind == LineKind::trace || s.kind == LineKind::import;
    const double unit = std::max(s.unit, s.snap.value_or(0.0) / snap_of_unit);
    widths.push_back(drawn ? of_unit * unit : 0.0);
  }
  return widths;
}

}  // namespace edda
