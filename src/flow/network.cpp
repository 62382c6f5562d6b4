#include "flow/network.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "attachments/boundary_lines.hpp"
#include "attachments/edges_on_line.hpp"

namespace edda {
namespace {

/// Corners nearer to each other along a face than this part of its shorter edge share a node.
constexpr double same_node = 1e-3;

/// The overlap of a face: its ends, and the corners that bound them.
struct Overlap {
  Id face;
  double length;                // m
  FaceEnds xi, eta;             // along its edges, as in FaceFields
  FaceEnds opening;             // of the surfaces as drawn, m
  Id corner_a[2], corner_b[2];  // the second no_id where one corner alone bounds the end
  bool is_point;                // shorter than what makes two nodes
};

class Nodes {
 public:
  explicit Nodes(std::size_t corners) : parent_(corners), used_(corners, 0) {
    std::iota(parent_.begin(), parent_.end(), Id{0});
  }
  Id root(Id v) {
    while (parent_[v] != v) v = parent_[v] = parent_[parent_[v]];
    return v;
  }
  void use(Id v) { used_[v] = 1; }
  void join(Id v, Id w) {
    use(v);
    use(w);
    const Id a = root(v), b = root(w);
    parent_[std::max(a, b)] = std::min(a, b);
  }
  /// Numbers the nodes by their first corner.
  std::vector<Id> number(std::size_t& count) {
    std::vector<Id> node(parent_.size(), no_id);
    count = 0;
    for (Id v = 0; v < node.size(); ++v) {
      if (used_[v] == 0) continue;
      const Id first = root(v);
      node[v] = first == v ? static_cast<Id>(count++) : node[first];
    }
    return node;
  }

 private:
  std::vector<Id> parent_;
  std::vector<std::uint8_t> used_;
};

/// The overlap of face k, or nothing where its edges do not lie against each other.
std::optional<Overlap> overlap_of_face(const FlowScene& s, std::size_t k) {
  const FaceSet& c = s.faces;
  if (!c.acts(k)) return {};
  const FacePair pair = face_pair(c, s.blocks, k);
  const EdgeGeometry o = geometry_of_edges(face_points(c, s.pose.x, s.pose.y, k), pair);
  if (!(o.s2 > 0.0) || !(o.r1 > o.r2) || !(o.cosine > pair.gate_from)) return {};
  if (!overlaps(o.ma, o.mb, pair)) return {};
  const double near = same_node / std::max(pair.inverse_e, pair.inverse_f);
  Overlap f;
  f.face = static_cast<Id>(k);
  f.length = o.mb - o.ma;
  f.xi = {o.ma * o.per_e, o.mb * o.per_e};
  f.eta = {(o.ma - o.r2) * o.per_f, (o.mb - o.r2) * o.per_f};
  f.opening = {-(o.closure_at_0 + o.closure_slope * o.ma),
               -(o.closure_at_0 + o.closure_slope * o.mb)};
  // Walls that part by more than 1 in 2 are those of a void; far sides of thin blocks do not meet.
  constexpr double parting = 0.5;
  if (std::abs(o.closure_slope) > parting) return {};
  if (std::min(f.opening.a, f.opening.b) < -pair.passing) return {};
  const bool e_at_a = o.r2 <= 0.0, e_at_b = o.s2 <= o.r1;
  const auto corners = [&](Id(&to)[2], Id of_e, Id of_f, bool e_bounds, double apart) {
    to[0] = e_bounds ? of_e : of_f;
    to[1] = std::abs(apart) <= near ? (e_bounds ? of_f : of_e) : no_id;
  };
  corners(f.corner_a, c.edge[k], c.facing_end[k], e_at_a, o.r2);
  corners(f.corner_b, c.edge_end[k], c.facing[k], e_at_b, o.s2 - o.r1);
  f.is_point = f.length <= near;
  return f;
}

/// The hydraulic aperture of a joint that has opened by so much; its law has one.
Aperture aperture_of(const JointLaw& law, double opening) {
  const double drawn = *law.aperture;
  return {drawn + opening, law.residual_aperture.value_or(0.1 * drawn),
          law.largest_aperture.value_or(10.0 * drawn)};
}

/// Fractions from end a to end b at which lines of heads cross the face as drawn, with their water.
struct Crossing {
  double at;
  Index water;
};
std::vector<Crossing> crossings(const FlowScene& s, const FlowGround& ground, const Overlap& f) {
  std::vector<Crossing> found;
  const Id e = s.faces.edge[f.face];
  const Vec2 p = s.blocks.vertex(e), u = s.blocks.vertex(s.faces.edge_end[f.face]) - p;
  for (const FlowGround::HeadLine& line : ground.heads) {
    if (!s.intervals.waters[static_cast<std::size_t>(line.water)].acts()) continue;
    const Vec2 w = line.b - line.a;
    const double across = cross(u, w);
    if (std::abs(across) <= 1e-9 * norm(u) * norm(w)) continue;
    const double on_edge = cross(line.a - p, w) / across, on_line = cross(line.a - p, u) / across;
    const double at = (on_edge - f.xi.a) / (f.xi.b - f.xi.a);
    if (on_line < 0.0 || on_line > 1.0 || at < -same_node || at > 1.0 + same_node) continue;
    found.push_back({at, line.water});
  }
  std::sort(found.begin(), found.end(), [](Crossing x, Crossing y) { return x.at < y.at; });
  return found;
}

class Builder {
 public:
  Builder(const FlowScene& scene, const FlowGround& ground, bool with_boundaries = true)
      : s_(scene), ground_(ground), corners_(scene.blocks.vertex_count()) {
    for (std::size_t q = 0; q < scene.model.waters.size(); ++q) {
      if (scene.model.waters[q].rain && scene.intervals.waters[q].acts()) rains_ = true;
    }
    supported_.assign(scene.blocks.vertex_count(), 0);
    for (std::size_t q = 0; q < ground.along.size() && with_boundaries; ++q) {
      if (!scene.intervals.boundaries[q].acts()) continue;
      for (const Id edge : ground.along[q]) supported_[edge] = 1;
    }
    find_overlaps();
    join_corners();
    find_gaps();
  }

  FlowNetwork build() {
    trace_voids();
    number_nodes();
    for (const Overlap& f : overlaps_) add_pipes(f);
    for (const FlowPipe& pipe : net_.pipes) {
      net_.nodes[pipe.from].conductance += pipe.conductance;
      net_.nodes[pipe.to].conductance += pipe.conductance;
    }
    add_open_parts();
    return std::move(net_);
  }

  std::vector<Id> uncovered() const {
    std::vector<Id> edges;
    for (const Gap& gap : gaps_) edges.push_back(gap.edge);
    return edges;
  }

 private:
  /// A wall sees the nearest one alone: of two faces that cover the same part of an edge the one
  /// that has opened less counts, unless that is but a small part of the other.
  void find_overlaps() {
    std::vector<Overlap> all;
    for (std::size_t k = 0; k < s_.faces.size(); ++k) {
      if (const std::optional<Overlap> f = overlap_of_face(s_, k)) all.push_back(*f);
    }
    std::vector<std::size_t> nearest(all.size());
    std::iota(nearest.begin(), nearest.end(), std::size_t{0});
    const auto apart = [&](std::size_t q) {
      return std::abs(all[q].opening.a) + std::abs(all[q].opening.b);
    };
    std::stable_sort(nearest.begin(), nearest.end(),
                     [&](std::size_t x, std::size_t y) { return apart(x) < apart(y); });
    std::vector<std::vector<Part>> taken(s_.blocks.vertex_count());
    std::vector<std::uint8_t> counts(all.size(), 0);
    for (const std::size_t q : nearest) {
      const Overlap& f = all[q];
      const Id e = s_.faces.edge[f.face], g = s_.faces.facing[f.face];
      const Part on_e{f.xi.a, f.xi.b}, on_g{1.0 - f.eta.b, 1.0 - f.eta.a};
      counts[q] = f.is_point || !(is_taken(taken[e], on_e) || is_taken(taken[g], on_g)) ? 1 : 0;
      if (f.is_point || counts[q] == 0) continue;
      taken[e].push_back(on_e);
      taken[g].push_back(on_g);
    }
    for (std::size_t q = 0; q < all.size(); ++q) {
      if (counts[q] != 0) overlaps_.push_back(all[q]);
    }
  }
  static bool is_taken(const std::vector<Part>& taken, Part part) {
    double common = 0.0;
    for (const Part t : taken)
      common += std::max(0.0, std::min(t.to, part.to) - std::max(t.from, part.from));
    return common > 0.5 * (part.to - part.from);
  }

  void join_corners() {
    for (const Overlap& f : overlaps_) {
      for (const auto* end : {&f.corner_a, &f.corner_b}) {
        corners_.use((*end)[0]);
        if ((*end)[1] != no_id) corners_.join((*end)[0], (*end)[1]);
      }
      if (f.is_point) corners_.join(f.corner_a[0], f.corner_b[0]);
    }
  }

  /// What no face covers of the edges of free blocks, between two corners, its own or those of
  /// blocks against it.
  struct Gap {
    Id edge;
    double from, to;
    Id from_corner, to_corner;
    bool open = false, wet = false;
  };
  void find_gaps() {
    struct Cover {
      Id edge;
      double from, to;
      Id from_corner, to_corner;
    };
    std::vector<Cover> covers;
    for (const Overlap& f : overlaps_) {
      if (f.is_point) continue;
      const Id a = f.corner_a[0], b = f.corner_b[0];
      covers.push_back({s_.faces.edge[f.face], f.xi.a, f.xi.b, a, b});
      covers.push_back({s_.faces.facing[f.face], 1.0 - f.eta.b, 1.0 - f.eta.a, b, a});
    }
    std::sort(covers.begin(), covers.end(), [](const Cover& x, const Cover& y) {
      return x.edge != y.edge ? x.edge < y.edge : x.from < y.from;
    });
    constexpr double rounding = 1e-12;
    std::size_t c = 0;
    for (Id v = 0; v < s_.blocks.vertex_count(); ++v) {
      double reached = 0.0;
      Id corner = v;
      const bool counts =
          is_free(s_.blocks, s_.state, s_.blocks.vertex_block[v]) && supported_[v] == 0;
      for (; c < covers.size() && covers[c].edge == v; ++c) {
        if (counts && covers[c].from - reached > rounding)
          gaps_.push_back({v, reached, covers[c].from, corner, covers[c].from_corner});
        if (covers[c].to < reached) continue;
        reached = covers[c].to;
        corner = covers[c].to_corner;
      }
      if (counts && 1.0 - reached > rounding)
        gaps_.push_back({v, reached, 1.0, corner, s_.blocks.next[v]});
    }
  }

  /// Gaps that meet at corners are one void. It lies open where a part of it was open as drawn, or
  /// an opening is there; then there is water where water was drawn beside it. Else it is enclosed:
  /// a node.
  void trace_voids() {
    Nodes voids(s_.blocks.vertex_count());
    for (const Gap& gap : gaps_)
      voids.join(corners_.root(gap.from_corner), corners_.root(gap.to_corner));
    const auto void_of = [&](const Gap& gap) { return voids.root(corners_.root(gap.from_corner)); };
    std::vector<std::uint8_t> open(s_.blocks.vertex_count(), 0), wet(open);
    for (const Gap& gap : gaps_) {
      if (ground_.open[gap.edge] == 0) continue;
      open[void_of(gap)] = 1;
      const auto at = std::lower_bound(ground_.outside.begin(), ground_.outside.end(), gap.edge,
                                       [](const WetEdge& e, Id edge) { return e.edge < edge; });
      if (at != ground_.outside.end() && at->edge == gap.edge) wet[void_of(gap)] = 1;
    }
    for (Gap& gap : gaps_) {
      gap.open = open[void_of(gap)] != 0;
      gap.wet = wet[void_of(gap)] != 0;
    }
    for (const Gap& gap : gaps_) {
      if (!gap.open) corners_.join(gap.from_corner, gap.to_corner);
    }
  }

  void number_nodes() {
    std::size_t count = 0;
    net_.node_of = corners_.number(count);
    net_.nodes.resize(count);
    net_.with_corners = count;
    std::vector<double> corners(count, 0.0);
    for (Id v = 0; v < net_.node_of.size(); ++v) {
      const Id n = net_.node_of[v];
      if (n == no_id) continue;
      net_.nodes[n].place += at(s_.pose.x, s_.pose.y, v);
      corners[n] += 1.0;
      for (const FlowGround::HeadLine& line : ground_.heads) {
        if (s_.intervals.waters[static_cast<std::size_t>(line.water)].acts() &&
            distance_to_segment(s_.blocks.vertex(v), line.a, line.b) <= ground_.snap)
          net_.heads.push_back({n, line.water});
      }
    }
    for (std::size_t n = 0; n < count; ++n)
      net_.nodes[n].place = (1.0 / corners[n]) * net_.nodes[n].place;
  }

  /// The pipes of a face, and the parts of its two edges that they wet.
  void add_pipes(const Overlap& f) {
    const std::size_t law = s_.faces.law[f.face];
    if (f.is_point || law >= s_.model.joints.size()) return;
    const JointLaw& joint = s_.model.joints[law];
    if (joint.aperture.value_or(0.0) == 0.0) return;
    const Id from = net_.node_of[f.corner_a[0]], to = net_.node_of[f.corner_b[0]];
    double last = 0.0;
    Id last_node = from;
    const auto add = [&](double until, Id node) {
      const auto there = [&](double t) {
        return aperture_of(joint, (1.0 - t) * f.opening.a + t * f.opening.b);
      };
      const double length = (until - last) * f.length;
      const Aperture at_last = there(last), at_node = there(until);
      const double h = at_last.value(), next = at_node.value();
      const FlowPipe pipe{f.face,
                          last_node,
                          node,
                          last,
                          until,
                          length,
                          conductance_of(h, next, length, s_.model.flow->viscosity),
                          parts_of_end(h, next),
                          {at_last, at_node}};
      cover(f, pipe);
      net_.pipes.push_back(pipe);
      last = until;
      last_node = node;
    };
    for (const Crossing c : crossings(s_, ground_, f)) {
      Id node = c.at <= same_node ? from : c.at >= 1.0 - same_node ? to : last_node;
      if (node == last_node && c.at - last > same_node && c.at < 1.0 - same_node) {
        node = static_cast<Id>(net_.nodes.size());
        const Id e = s_.faces.edge[f.face], end = s_.faces.edge_end[f.face];
        const double xi = (1.0 - c.at) * f.xi.a + c.at * f.xi.b;
        net_.nodes.push_back(
            {(1.0 - xi) * at(s_.pose.x, s_.pose.y, e) + xi * at(s_.pose.x, s_.pose.y, end)});
        add(c.at, node);
      }
      net_.heads.push_back({node, c.water});
    }
    add(1.0, to);
  }

  void cover(const Overlap& f, const FlowPipe& pipe) {
    const auto between = [](FaceEnds ends, double t) { return (1.0 - t) * ends.a + t * ends.b; };
    const Id row = static_cast<Id>(net_.pipes.size());
    const double from = pipe.part_from, to = pipe.part_to;
    net_.covered.push_back(
        {s_.faces.edge[f.face], between(f.xi, from), between(f.xi, to), pipe.from, row});
    net_.covered.push_back({s_.faces.facing[f.face], 1.0 - between(f.eta, to),
                            1.0 - between(f.eta, from), pipe.to, row});
  }

  void add_open_parts() {
    for (std::size_t g = 0; g < gaps_.size(); ++g) {
      const Gap& gap = gaps_[g];
      const Id from = net_.node_of[gap.from_corner], to = net_.node_of[gap.to_corner];
      OpenPart part{gap.edge, gap.from, gap.to, gap.open ? no_id : from, gap.wet, from, to, 0.0};
      if (gap.open && rains_) {
        part.sky = width_under_sky(gap);
        if (part.sky > 0.0) choose_outcrops(g, part);
      }
      net_.open.push_back(part);
      if (!gap.open) continue;
      if (from != no_id) net_.outcrops.push_back({from, gap.edge, gap.from, gap.wet});
      if (to != no_id) net_.outcrops.push_back({to, gap.edge, gap.to, gap.wet});
    }
  }

  /// Rain runs to the outcrops on both sides, but up no wall where it can run down.
  void choose_outcrops(std::size_t g, OpenPart& part) const {
    part.from_node = outcrop_beside(g, false);
    part.to_node = outcrop_beside(g, true);
    const double y = s_.pose.y[part.edge], rise = s_.pose.y[s_.blocks.next[part.edge]] - y;
    const double top = std::max(y + part.from * rise, y + part.to * rise) + ground_.snap;
    const auto is_low = [&](Id n) { return n != no_id && net_.nodes[n].place.y <= top; };
    const bool from = is_low(part.from_node), to = is_low(part.to_node);
    if (from && !to) part.to_node = no_id;
    if (to && !from) part.from_node = no_id;
  }

  /// The next outcrop of a joint along the open edges of the block of gap g.
  Id outcrop_beside(std::size_t g, bool onwards) const {
    const std::size_t first = g;
    for (;;) {
      const Gap& gap = gaps_[g];
      const Id node = net_.node_of[onwards ? gap.to_corner : gap.from_corner];
      if (node != no_id && net_.nodes[node].conductance > 0.0) return node;
      const Id edge = onwards ? s_.blocks.next[gap.edge] : gap.edge;
      const auto is_beside = [&](const Gap& other) {
        return onwards ? other.edge == edge && other.from == 0.0
                       : s_.blocks.next[other.edge] == edge && other.to == 1.0;
      };
      const auto beside = std::find_if(gaps_.begin(), gaps_.end(), is_beside);
      if (beside == gaps_.end() || !beside->open) return no_id;
      g = static_cast<std::size_t>(beside - gaps_.begin());
      if (g == first) return no_id;
    }
  }

  /// Of ground that faces up, less what the undersides of rock above it cover.
  double width_under_sky(const Gap& gap) const {
    const auto corner = [&](Id v) { return at(s_.pose.x, s_.pose.y, v); };
    const Vec2 p = corner(gap.edge), u = corner(s_.blocks.next[gap.edge]) - p;
    const double left = p.x + gap.to * u.x, right = p.x + gap.from * u.x;
    std::vector<Part> covered;
    for (Id v = 0; v < s_.blocks.vertex_count() && right > left; ++v) {
      const Vec2 q = corner(v), w = corner(s_.blocks.next[v]) - q;
      const Part part{std::max(left, q.x), std::min(right, q.x + w.x)};
      if (!(part.to > part.from) || s_.state.alive[s_.blocks.vertex_block[v]] == 0) continue;
      const double x = 0.5 * (part.from + part.to);
      if (q.y + w.y * (x - q.x) / w.x > p.y + u.y * (x - p.x) / u.x) covered.push_back(part);
    }
    std::sort(covered.begin(), covered.end(), [](Part c, Part d) { return c.from < d.from; });
    double width = std::max(0.0, right - left), reached = left;
    for (const Part c : covered) {
      width -= std::max(0.0, c.to - std::max(reached, c.from));
      reached = std::max(reached, c.to);
    }
    return width;
  }

  const FlowScene& s_;
  const FlowGround& ground_;
  bool rains_ = false;
  std::vector<std::uint8_t> supported_;  // [nv] 1: the edge lies along a boundary that acts
  std::vector<Overlap> overlaps_;
  Nodes corners_;
  std::vector<Gap> gaps_;
  FlowNetwork net_;
};

}  // namespace

double conductance_of(double from, double to, double length, double viscosity) {
  const double both = from * to;
  return both * both / (6.0 * viscosity * length * (from + to));
}

FaceEnds parts_of_end(double a, double b) {
  if (b > a) {  // f from the other end, of which it is 1 - f
    const FaceEnds other = parts_of_end(b, a);
    return {0.5 - other.b, 0.5 - other.a};
  }
  const double r = b / a, x = 1.0 - r;
  const double whole = r / (1.0 + r);  // of f
  double of_b;
  if (x < 0.1) {
    constexpr int terms = 16;
    double above = 0.0, below = 0.0;
    for (int k = terms; k >= 1; --k) {
      above = (k + 1.0) / (k + 2.0) + x * above;
      below = (k + 1.0) + x * below;
    }
    of_b = above / below;
  } else {
    of_b = ((std::log(r) + x / r) / (x * x) - 0.5) * r * r / (x * (1.0 + r));
  }
  return {whole - of_b, of_b};
}

FlowGround flow_ground(const Model& model, const BlockSet& b, std::vector<WetEdge> outside) {
  FlowGround ground;
  ground.snap = boundary_snap(model, b);
  ground.along.resize(model.boundaries.size());
  for (std::size_t q = 0; q < model.boundaries.size(); ++q) {
    if (model.boundaries[q].traction) continue;
    for (const Line& line : boundary_lines(model, b, model.boundaries[q])) {
      for (const OnLine& on : edges_on(b, line.a, line.b, ground.snap))
        ground.along[q].push_back(on.edge);
    }
  }
  for (std::size_t q = 0; q < model.waters.size(); ++q) {
    const Water& water = model.waters[q];
    for (const Line& line : lines_along(model, b, water.sides, water.along))
      ground.heads.push_back({line.a, line.b, static_cast<Index>(q)});
  }
  ground.open.assign(b.vertex_count(), 0);
  for (const Opening& opening : model.openings) {
    for (std::size_t k = 0; k < opening.polygon.size(); ++k) {
      const Vec2 p = opening.polygon[k] - b.origin,
                 q = opening.polygon[(k + 1) % opening.polygon.size()] - b.origin;
      for (const OnLine& on : edges_on(b, p, q, ground.snap)) ground.open[on.edge] = 1;
    }
  }
  ground.outside = std::move(outside);
  return ground;
}

FlowNetwork flow_network(const FlowScene& scene, const FlowGround& ground) {
  return Builder(scene, ground).build();
}

void note_open_edges(const FlowScene& scene, FlowGround& ground) {
  for (const Id edge : Builder(scene, ground, false).uncovered()) ground.open[edge] = 1;
}

}  // namespace edda
