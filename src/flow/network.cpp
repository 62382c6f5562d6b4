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

/// The hydraulic aperture of a joint that has opened by so much, m; 0: watertight.
double aperture_of(const JointLaw& law, double opening) {
  const double drawn = law.aperture.value_or(0.0);
  if (drawn == 0.0) return 0.0;
  return std::clamp(drawn + opening, law.residual_aperture.value_or(0.1 * drawn),
                    law.largest_aperture.value_or(10.0 * drawn));
}

/// Fractions from end a to end b at which lines of heads cross the face as drawn, with their water.
struct Crossing {
  double at;
  Index water;
};
std::vector<Crossing> crossings(const FlowScene& s, const FlowGround& ground,
                                const std::vector<std::uint8_t>& acts, const Overlap& f) {
  std::vector<Crossing> found;
  const Id e = s.faces.edge[f.face];
  const Vec2 p = s.blocks.vertex(e), u = s.blocks.vertex(s.faces.edge_end[f.face]) - p;
  for (const FlowGround::HeadLine& line : ground.heads) {
    if (acts[static_cast<std::size_t>(line.water)] == 0) continue;
    const Vec2 w = line.b - line.a;
    const double across = cross(u, w);
    if (std::abs(across) <= 1e-9 * norm(u) * norm(w)) continue;
    const double on_edge = cross(line.a - p, w) / across, on_line = cross(line.a - p, u) / across;
    const double at = (on_edge - f.xi.a) / (f.xi.b - f.xi.a);
    if (on_line < 0.0 || on_line > 1.0 || at <= same_node || at >= 1.0 - same_node) continue;
    found.push_back({at, line.water});
  }
  std::sort(found.begin(), found.end(), [](Crossing x, Crossing y) { return x.at < y.at; });
  return found;
}

class Builder {
 public:
  Builder(const FlowScene& scene, const FlowGround& ground, const std::vector<std::uint8_t>& acts)
      : s_(scene), ground_(ground), acts_(acts) {}

  FlowNetwork build() {
    for (std::size_t k = 0; k < s_.faces.size(); ++k) {
      if (const std::optional<Overlap> f = overlap_of_face(s_, k)) overlaps_.push_back(*f);
    }
    make_nodes();
    for (const Overlap& f : overlaps_) add_pipes(f);
    for (const FlowPipe& pipe : net_.pipes) {
      net_.nodes[pipe.from].conductance += pipe.conductance;
      net_.nodes[pipe.to].conductance += pipe.conductance;
    }
    std::sort(net_.covered.begin(), net_.covered.end(),
              [](const CoveredPart& x, const CoveredPart& y) {
                return x.edge != y.edge ? x.edge < y.edge : x.from < y.from;
              });
    find_open_parts();
    return std::move(net_);
  }

 private:
  void make_nodes() {
    Nodes nodes(s_.blocks.vertex_count());
    for (const Overlap& f : overlaps_) {
      for (const auto* end : {&f.corner_a, &f.corner_b}) {
        nodes.use((*end)[0]);
        if ((*end)[1] != no_id) nodes.join((*end)[0], (*end)[1]);
      }
      if (f.is_point) nodes.join(f.corner_a[0], f.corner_b[0]);
    }
    std::size_t count = 0;
    net_.node_of = nodes.number(count);
    net_.nodes.resize(count);
    std::vector<double> corners(count, 0.0);
    for (Id v = 0; v < net_.node_of.size(); ++v) {
      const Id n = net_.node_of[v];
      if (n == no_id) continue;
      net_.nodes[n].place += at(s_.pose.x, s_.pose.y, v);
      corners[n] += 1.0;
      for (const FlowGround::HeadLine& line : ground_.heads) {
        if (acts_[static_cast<std::size_t>(line.water)] != 0 &&
            distance_to_segment(s_.blocks.vertex(v), line.a, line.b) <= ground_.snap)
          net_.nodes[n].water = line.water;
      }
    }
    for (std::size_t n = 0; n < count; ++n)
      net_.nodes[n].place = (1.0 / corners[n]) * net_.nodes[n].place;
  }

  /// The pipes of a face, and the parts of its two edges that they wet.
  void add_pipes(const Overlap& f) {
    const std::size_t law = s_.faces.law[f.face];
    const Id from = net_.node_of[f.corner_a[0]], to = net_.node_of[f.corner_b[0]];
    FaceEnds aperture;
    if (law < s_.model.joints.size()) {
      aperture = {aperture_of(s_.model.joints[law], f.opening.a),
                  aperture_of(s_.model.joints[law], f.opening.b)};
    }
    if (f.is_point || aperture.a == 0.0) return cover(f, 0.0, 1.0, from, to, no_id);
    double last = 0.0;
    Id last_node = from;
    const auto add = [&](double until, Id node) {
      const auto there = [&](double t) { return (1.0 - t) * aperture.a + t * aperture.b; };
      FlowPipe pipe{f.face,      last_node,    node, last, until, (until - last) * f.length,
                    there(last), there(until), 0.0};
      pipe.conductance = conductance_of(pipe.from_aperture, pipe.to_aperture, pipe.length,
                                        s_.model.flow->viscosity);
      cover(f, last, until, last_node, node, static_cast<Id>(net_.pipes.size()));
      net_.pipes.push_back(pipe);
      last = until;
      last_node = node;
    };
    for (const Crossing c : crossings(s_, ground_, acts_, f)) {
      const Id e = s_.faces.edge[f.face], end = s_.faces.edge_end[f.face];
      const double xi = (1.0 - c.at) * f.xi.a + c.at * f.xi.b;
      FlowNode node;
      node.place = (1.0 - xi) * at(s_.pose.x, s_.pose.y, e) + xi * at(s_.pose.x, s_.pose.y, end);
      node.water = c.water;
      net_.nodes.push_back(node);
      add(c.at, static_cast<Id>(net_.nodes.size() - 1));
    }
    add(1.0, to);
  }

  void cover(const Overlap& f, double from, double to, Id from_node, Id to_node, Id pipe) {
    const auto between = [](FaceEnds ends, double t) { return (1.0 - t) * ends.a + t * ends.b; };
    net_.covered.push_back(
        {s_.faces.edge[f.face], between(f.xi, from), between(f.xi, to), from_node, to_node, pipe});
    net_.covered.push_back({s_.faces.facing[f.face], 1.0 - between(f.eta, to),
                            1.0 - between(f.eta, from), to_node, from_node, pipe});
  }

  /// What no face covers of the edges of free blocks. Gaps between two faces, and between a face
  /// and a corner, that are shorter than what makes two nodes belong to what is covered.
  void find_open_parts() {
    const BlockSet& b = s_.blocks;
    std::size_t c = 0;
    for (Id v = 0; v < b.vertex_count(); ++v) {
      const std::size_t first = c;
      while (c < net_.covered.size() && net_.covered[c].edge == v) ++c;
      const Id i = b.vertex_block[v];
      if (!is_free(b, s_.state, i)) continue;
      double reached = 0.0;
      for (std::size_t q = first; q < c; ++q) {
        CoveredPart& part = net_.covered[q];
        if (part.from - reached > same_node) {
          add_open(v, reached, part.from, q > first ? &net_.covered[q - 1] : nullptr, &part);
        } else if (q > first) {
          part.from = net_.covered[q - 1].to = 0.5 * (part.from + net_.covered[q - 1].to);
        } else {
          part.from = 0.0;
        }
        reached = std::max(reached, part.to);
      }
      if (1.0 - reached > same_node) {
        add_open(v, reached, 1.0, c > first ? &net_.covered[c - 1] : nullptr, nullptr);
      } else if (c > first) {
        net_.covered[c - 1].to = 1.0;
      }
    }
  }

  void add_open(Id edge, double from, double to, const CoveredPart* before,
                const CoveredPart* after) {
    net_.open.push_back({edge, from, to});
    if (ground_.supported[edge] != 0) return;
    const auto beside = [&](Id node, double at) {
      if (node == no_id) return;
      net_.nodes[node].edge = edge;
      net_.nodes[node].at = at;
    };
    beside(before != nullptr ? before->to_node : net_.node_of[edge], from);
    beside(after != nullptr ? after->from_node : net_.node_of[s_.blocks.next[edge]], to);
  }

  const FlowScene& s_;
  const FlowGround& ground_;
  const std::vector<std::uint8_t>& acts_;
  std::vector<Overlap> overlaps_;
  FlowNetwork net_;
};

}  // namespace

double conductance_of(double from, double to, double length, double viscosity) {
  const double both = from * to;
  return both * both / (6.0 * viscosity * length * (from + to));
}

FlowGround flow_ground(const Model& model, const BlockSet& b, std::vector<WetEdge> outside) {
  FlowGround ground;
  ground.snap = boundary_snap(model, b);
  ground.supported.assign(b.vertex_count(), 0);
  for (const Boundary& boundary : model.boundaries) {
    for (const Line& line : boundary_lines(model, b, boundary)) {
      for (const OnLine& on : edges_on(b, line.a, line.b, ground.snap))
        ground.supported[on.edge] = 1;
    }
  }
  for (std::size_t q = 0; q < model.waters.size(); ++q) {
    const Water& water = model.waters[q];
    for (const Line& line : lines_along(model, b, water.sides, water.along))
      ground.heads.push_back({line.a, line.b, static_cast<Index>(q)});
  }
  ground.outside = std::move(outside);
  return ground;
}

FlowNetwork flow_network(const FlowScene& scene, const FlowGround& ground,
                         const std::vector<std::uint8_t>& acts) {
  return Builder(scene, ground, acts).build();
}

}  // namespace edda
