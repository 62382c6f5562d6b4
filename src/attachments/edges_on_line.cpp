#include "attachments/edges_on_line.hpp"

#include <algorithm>
#include <cmath>

namespace edda {
namespace {

/// Joins overlapping pieces, since a line may turn back or touch an edge twice.
void unite(std::vector<Piece>& pieces) {
  std::sort(pieces.begin(), pieces.end(), [](const Piece& x, const Piece& y) {
    return x.edge != y.edge ? x.edge < y.edge : x.part.from < y.part.from;
  });
  std::vector<Piece> united;
  for (const Piece& p : pieces) {
    if (!united.empty() && united.back().edge == p.edge && p.part.from <= united.back().part.to) {
      united.back().part.to = std::max(united.back().part.to, p.part.to);
    } else {
      united.push_back(p);
    }
  }
  pieces = std::move(united);
}

}  // namespace

Part on_segment(const BlockSet& b, Id v, Vec2 p, Vec2 q, double snap) {
  const Vec2 a = b.vertex(v), u = b.vertex(b.next[v]) - a;
  const double length2 = dot(u, u);
  const double sp = dot(p - a, u) / length2, sq = dot(q - a, u) / length2;
  const Part part{std::clamp(std::min(sp, sq), 0.0, 1.0), std::clamp(std::max(sp, sq), 0.0, 1.0)};
  if ((part.to - part.from) * std::sqrt(length2) <= snap) return {};
  const bool near = distance_to_segment(a + part.from * u, p, q) <= snap &&
                    distance_to_segment(a + part.to * u, p, q) <= snap;
  return near ? part : Part{};
}

std::vector<OnLine> edges_on(const BlockSet& b, Vec2 p, Vec2 q, double snap) {
  const Vec2 t = unit(q - p);
  std::vector<OnLine> found;
  for (Id v = 0; v < b.vertex_count(); ++v) {
    const Part part = on_segment(b, v, p, q, snap);
    if (part.to <= part.from) continue;
    const Vec2 a = b.vertex(v), u = b.vertex(b.next[v]) - a;
    const double s = dot(a + part.from * u - p, t), e = dot(a + part.to * u - p, t);
    found.push_back({v, part, std::min(s, e), std::max(s, e), e > s});
  }
  return found;
}

std::vector<Part> without(Part whole, std::vector<Part> taken) {
  std::sort(taken.begin(), taken.end(), [](Part x, Part y) { return x.from < y.from; });
  std::vector<Part> left;
  for (const Part t : taken) {
    if (t.from > whole.from) left.push_back({whole.from, std::min(t.from, whole.to)});
    whole.from = std::max(whole.from, t.to);
    if (whole.from >= whole.to) return left;
  }
  left.push_back(whole);
  return left;
}

std::vector<Part> free_parts(const std::vector<OnLine>& all, const OnLine& one, const BlockSet& b,
                             double snap) {
  std::vector<Part> covered;
  for (const OnLine& other : all) {
    if (other.along != one.along && b.vertex_block[other.edge] != b.vertex_block[one.edge] &&
        !b.is_added(b.vertex_block[other.edge]))
      covered.push_back({other.low, other.high});
  }
  std::vector<Part> parts;
  for (const Part p : without({one.low, one.high}, covered)) {
    if (p.to - p.from <= snap) continue;
    const double scale = (one.part.to - one.part.from) / (one.high - one.low);
    const auto s_of = [&](double at) {
      return one.along ? one.part.from + scale * (at - one.low)
                       : one.part.from + scale * (one.high - at);
    };
    parts.push_back(one.along ? Part{s_of(p.from), s_of(p.to)} : Part{s_of(p.to), s_of(p.from)});
  }
  return parts;
}

std::vector<Piece> pieces_on(const BlockSet& b, const std::vector<Line>& lines, WhichFaces faces,
                             double snap, bool& in_joints) {
  std::vector<Piece> pieces;
  for (const Line& line : lines) {
    const std::vector<OnLine> all = edges_on(b, line.a, line.b, snap);
    // The back of a lining or of fill, where rock lies on the same line.
    const auto is_back = [&](const OnLine& e) {
      return b.is_added(b.vertex_block[e.edge]) &&
             std::any_of(all.begin(), all.end(), [&](const OnLine& other) {
               return other.along != e.along && !b.is_added(b.vertex_block[other.edge]) &&
                      other.low < e.high && other.high > e.low;
             });
    };
    for (const OnLine& e : all) {
      if (b.fixed[b.vertex_block[e.edge]] || is_back(e)) continue;
      const std::vector<Part> parts =
          faces == WhichFaces::open ? free_parts(all, e, b, snap) : std::vector<Part>{e.part};
      in_joints = in_joints || parts.empty();
      for (const Part p : parts) pieces.push_back({e.edge, p});
    }
  }
  unite(pieces);
  return pieces;
}

}  // namespace edda
