#include "cutting/near_ends.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/rings.hpp"
#include "cutting/geos.hpp"
#include "cutting/planar_graph.hpp"

namespace edda {
namespace {

struct NetSegment {
  int from = 0, to = 0;  ///< nodes
  Index source = 0;
  std::size_t line = 0;
};

/// A point at which lines have corners.
struct NetNode {
  Vec2 place;
  double unit = 0.0;   ///< m, the coarsest of its lines
  double snap = -1.0;  ///< m; negative: none is given
  int lines = 0;       ///< corners of lines here, a closed line's first and last as one
  bool end = false;    ///< a line ends here
  bool moves = true;
  Index source = 0;
  std::size_t line = 0;  ///< one of its lines
};

/// The line work as corners that lines share.
struct Net {
  std::vector<NetNode> nodes;
  std::vector<std::vector<int>> corners;  ///< [line][corner]
  std::vector<NetSegment> segments;
};

bool is_drawn(LineKind kind) {
  return kind == LineKind::trace || kind == LineKind::import;
}

/// Numbers the points, of which equal ones are one.
std::vector<std::vector<int>> numbered(const LineWork& work, std::vector<NetNode>& nodes) {
  std::vector<std::pair<std::size_t, std::size_t>> order;
  std::vector<std::vector<int>> corners;
  for (std::size_t i = 0; i < work.lines.size(); ++i) {
    corners.emplace_back(work.lines[i].points.size());
    for (std::size_t k = 0; k < work.lines[i].points.size(); ++k) order.emplace_back(i, k);
  }
  const auto point = [&](const auto& place) {
    return work.lines[place.first].points[place.second];
  };
  std::sort(order.begin(), order.end(), [&](const auto& a, const auto& b) {
    const Vec2 p = point(a), q = point(b);
    return p.x < q.x || (p.x == q.x && p.y < q.y);
  });
  for (const auto& place : order) {
    const Vec2 p = point(place);
    if (nodes.empty() || !(nodes.back().place == p)) {
      nodes.emplace_back();
      nodes.back().place = p;
    }
    corners[place.first][place.second] = static_cast<int>(nodes.size()) - 1;
  }
  return corners;
}

Net net_of(const LineWork& work) {
  Net net;
  net.corners = numbered(work, net.nodes);
  for (std::size_t i = 0; i < work.lines.size(); ++i) {
    const std::vector<int>& corners = net.corners[i];
    const Index number = work.lines[i].source;
    const LineSource& source = work.sources[at(number)];
    const bool closed = corners.front() == corners.back();
    for (std::size_t k = 0; k < corners.size(); ++k) {
      NetNode& node = net.nodes[at(corners[k])];
      const bool last = k + 1 == corners.size();
      if (!(closed && last)) ++node.lines;
      node.unit = std::max(node.unit, source.unit);
      node.snap = std::max(node.snap, source.snap.value_or(-1.0));
      node.end = node.end || (!closed && (k == 0 || last));
      node.moves = node.moves && is_drawn(source.kind);
      node.source = number;
      node.line = i;
      if (!last) net.segments.push_back({corners[k], corners[k + 1], number, i});
    }
  }
  return net;
}

/// The segments near a point. Long ones are held in pieces, whose boxes are small.
class Nearby {
 public:
  Nearby(const Net& net, double piece) : net_(net), tree_(10, net.segments.size()) {
    for (std::size_t s = 0; s < net.segments.size(); ++s) {
      const Vec2 a = net.nodes[at(net.segments[s].from)].place;
      const Vec2 b = net.nodes[at(net.segments[s].to)].place;
      const int parts = std::max(1, static_cast<int>(std::min(norm(b - a) / piece, 1e4)));
      for (int k = 0; k < parts; ++k) {
        const Vec2 p = a + (static_cast<double>(k) / parts) * (b - a);
        const Vec2 q = a + (static_cast<double>(k + 1) / parts) * (b - a);
        tree_.insert(geos::geom::Envelope(std::min(p.x, q.x), std::max(p.x, q.x),
                                          std::min(p.y, q.y), std::max(p.y, q.y)),
                     s);
      }
    }
  }

  /// The segments near node n that do not end there, each once.
  const std::vector<std::size_t>& of(int n, double reach) {
    found_.clear();
    const Vec2 p = net_.nodes[at(n)].place;
    tree_.query(geos::geom::Envelope(p.x - reach, p.x + reach, p.y - reach, p.y + reach), found_);
    std::sort(found_.begin(), found_.end());
    found_.erase(std::unique(found_.begin(), found_.end()), found_.end());
    std::erase_if(found_, [&](std::size_t s) {
      return net_.segments[s].from == n || net_.segments[s].to == n;
    });
    return found_;
  }

 private:
  const Net& net_;
  geos::index::strtree::TemplateSTRtree<std::size_t> tree_;
  std::vector<std::size_t> found_;
};

Vec2 nearest_point(Vec2 p, Vec2 a, Vec2 b) {
  const Vec2 u = b - a;
  const double length2 = dot(u, u);
  if (!(length2 > 0.0)) return a;
  return a + std::clamp(dot(p - a, u) / length2, 0.0, 1.0) * u;
}

class Joiner {
 public:
  Joiner(Net& net, const LineWork& work, double snap, bool framed)
      : net_(net),
        work_(work),
        snap_(snap),
        framed_(framed),
        reach_(largest_reach()),
        nearby_(net, std::max(size_of(work.outline) / 64.0, 4.0 * reach_)) {}

  /// True where a node has moved. A line that moves takes along what was put on it only in the next
  /// round.
  bool round() {
    bool any = false;
    for (int n = 0; n < static_cast<int>(net_.nodes.size()); ++n) {
      const NetNode& node = net_.nodes[at(n)];
      if (!node.moves) continue;
      const Vec2 to = node.snap >= 0.0 ? snapped(n) : unrounded(n);
      if (to == node.place) continue;
      net_.nodes[at(n)].place = to;
      any = true;
    }
    return any;
  }

 private:
  double largest_reach() const {
    double unit = 0.0, snap = 0.0;
    for (const LineSource& source : work_.sources) {
      unit = std::max(unit, source.unit);
      snap = std::max(snap, source.snap.value_or(0.0));
    }
    // Nodes move by less than this before the next query.
    return 4.0 * std::max(unit, snap);
  }

  bool is_target(const NetSegment& s) const {
    return !(framed_ && work_.sources[at(s.source)].kind == LineKind::outline);
  }

  /// By rounding to a unit u a point moves by u/2 at most in x and in y, so that its distance from
  /// a line of normal n changes by less than (|n_x| + |n_y|) (u + u of the line) / 2.
  Vec2 unrounded(int n) {
    constexpr double less_than = 1.0 - 1e-6;
    const NetNode& node = net_.nodes[at(n)];
    Vec2 best = node.place;
    double least = std::numeric_limits<double>::infinity();
    for (const std::size_t k : nearby_.of(n, reach_)) {
      const NetSegment& s = net_.segments[k];
      const double unit = work_.sources[at(s.source)].unit;
      // Small curves stay what they are: their corners lie this close to other pieces of them.
      if (s.line == node.line && !node.end) continue;
      if (!is_target(s) || (node.unit == 0.0 && unit == 0.0)) continue;
      const Vec2 a = net_.nodes[at(s.from)].place, b = net_.nodes[at(s.to)].place;
      if (a == b) continue;
      const Vec2 normal = perp(edda::unit(b - a)), q = nearest_point(node.place, a, b);
      const double d = norm(q - node.place);
      if (d <= snap_) return node.place;
      const double bound = 0.5 * (std::abs(normal.x) + std::abs(normal.y)) * (node.unit + unit);
      if (d < less_than * bound && d < least) best = q, least = d;
    }
    return best;
  }

  /// A free end within the snap of its import: onto the nearest corner there is, else onto the
  /// line.
  Vec2 snapped(int n) {
    const NetNode& node = net_.nodes[at(n)];
    if (!node.end || node.lines != 1 || node.snap == 0.0) return node.place;
    Vec2 best = node.place;
    double least = node.snap;
    bool corner = false;
    for (const std::size_t k : nearby_.of(n, reach_)) {
      const NetSegment& s = net_.segments[k];
      if (!is_target(s)) continue;
      const Vec2 a = net_.nodes[at(s.from)].place, b = net_.nodes[at(s.to)].place;
      const Vec2 q = nearest_point(node.place, a, b);
      if (norm(q - node.place) <= snap_) return node.place;
      for (const Vec2 p : {a, b}) {
        const double d = norm(p - node.place);
        if (d <= node.snap && (!corner || d < least)) best = p, least = d, corner = true;
      }
      const double d = norm(q - node.place);
      if (!corner && d <= least) best = q, least = d;
    }
    return best;
  }

  Net& net_;
  const LineWork& work_;
  double snap_;
  bool framed_;
  double reach_;
  Nearby nearby_;
};

bool segments_cross(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  const auto side = [](Vec2 p, Vec2 q, Vec2 r) { return cross(q - p, r - p) > 0.0; };
  return side(a, b, c) != side(a, b, d) && side(c, d, a) != side(c, d, b);
}

/// The free end of a line and the corner before it.
struct FreeEnd {
  int node = 0, before = 0;
};

std::vector<FreeEnd> free_ends(const Net& net, const LineWork& work,
                               const std::vector<bool>& counted) {
  std::vector<FreeEnd> ends;
  for (std::size_t i = 0; i < net.corners.size(); ++i) {
    const std::vector<int>& c = net.corners[i];
    if (!counted[at(work.lines[i].source)] || c.front() == c.back()) continue;
    if (net.nodes[at(c.front())].lines == 1) ends.push_back({c.front(), c[1]});
    if (net.nodes[at(c.back())].lines == 1) ends.push_back({c.back(), c[c.size() - 2]});
  }
  return ends;
}

}  // namespace

std::vector<MovedCorners> join_rounded_corners(LineWork& work, double snap, bool framed) {
  std::vector<MovedCorners> moved(work.sources.size());
  const bool any = std::any_of(work.sources.begin(), work.sources.end(),
                               [](const LineSource& s) { return is_drawn(s.kind); });
  if (!any) return moved;
  Net net = net_of(work);
  const std::vector<NetNode> before = net.nodes;
  Joiner joiner(net, work, snap, framed);
  constexpr int most_rounds = 8;
  for (int i = 0; i < most_rounds && joiner.round(); ++i) {
  }
  for (std::size_t i = 0; i < work.lines.size(); ++i) {
    std::vector<Vec2>& points = work.lines[i].points;
    for (std::size_t k = 0; k < points.size(); ++k) {
      points[k] = net.nodes[at(net.corners[i][k])].place;
    }
    points = without_repeats(std::move(points));
  }
  std::erase_if(work.lines, [](const LineString& line) { return line.points.size() < 2; });
  for (std::size_t n = 0; n < net.nodes.size(); ++n) {
    const double by = norm(net.nodes[n].place - before[n].place);
    if (!(by > 0.0)) continue;
    MovedCorners& of_source = moved[at(net.nodes[n].source)];
    ++of_source.count;
    of_source.farthest = std::max(of_source.farthest, by);
  }
  return moved;
}

std::vector<NearMiss> near_misses(const LineWork& work, const std::vector<bool>& counted,
                                  double snap, double reach, bool framed,
                                  const std::function<bool(Vec2)>& in_rock) {
  const Net net = net_of(work);
  const std::vector<FreeEnd> ends = free_ends(net, work, counted);
  std::vector<NearMiss> misses;
  if (ends.empty()) return misses;
  Nearby nearby(net, std::max(size_of(work.outline) / 64.0, 4.0 * reach));
  for (const FreeEnd& end : ends) {
    const Vec2 p = net.nodes[at(end.node)].place, q = net.nodes[at(end.before)].place;
    double gap = reach;
    bool met = false;
    for (const std::size_t k : nearby.of(end.node, reach)) {
      const NetSegment& s = net.segments[k];
      if (framed && work.sources[at(s.source)].kind == LineKind::outline) continue;
      const Vec2 a = net.nodes[at(s.from)].place, b = net.nodes[at(s.to)].place;
      met = met || (s.from != end.before && s.to != end.before && segments_cross(p, q, a, b));
      gap = std::min(gap, distance_to_segment(p, a, b));
    }
    if (met || gap <= snap || gap >= reach || !in_rock(p)) continue;
    misses.push_back({p, gap, net.nodes[at(end.node)].source});
  }
  return misses;
}

}  // namespace edda
