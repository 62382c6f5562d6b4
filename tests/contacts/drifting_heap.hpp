// A random heap whose blocks move at random; its list of faces is compared with the oracle at every
// move.
#pragma once

#include <limits>
#include <map>

#include "blocks/build_blocks.hpp"
#include "contacts/acting_oracle.hpp"
#include "contacts/faces_alone.hpp"
#include "contacts/random_shapes.hpp"

namespace edda {

/// Sizes spread over `decades` powers of ten; blocks may overlap each other.
inline PolygonSet random_polygons(std::mt19937& rng, int n, double decades) {
  std::uniform_real_distribution<double> u(0.0, 1.0);
  PolygonSet set;
  Vec2 last;
  for (int i = 0; i < n; ++i) {
    const double size = std::pow(10.0, -decades * u(rng));
    // Half of them lie beside the one before, so that small ones also have contacts.
    const bool near_last = i > 0 && u(rng) < 0.5;
    const Vec2 c = near_last ? last + (2.0 * size) * Vec2{u(rng) - 0.5, u(rng) - 0.5}
                             : 6.0 * Vec2{u(rng) - 0.5, u(rng) - 0.5};
    BlockPolygon p;
    p.rings = {random_shape(rng, c, size)};
    p.joint = {std::vector<Index>(p.rings[0].size(), none)};
    p.material = 0;
    p.fixed = u(rng) < 0.1;
    const std::size_t corner = static_cast<std::size_t>(u(rng) * 3.0);
    last = p.rings[0][corner];
    set.blocks.push_back(p);
  }
  return set;
}

/// The same with plates of 1 : 30 to 1 : 1,000, needles of 2 degrees and blocks with a hole among
/// them.
inline PolygonSet odd_polygons(std::mt19937& rng, int n) {
  std::uniform_real_distribution<double> u(0.0, 1.0);
  PolygonSet set = random_polygons(rng, n, 1.0);
  for (BlockPolygon& p : set.blocks) {
    const double kind = u(rng), turn = 2.0 * std::numbers::pi * u(rng);
    const Vec2 c = p.rings[0][0];
    const auto place = [&](Ring ring) {
      for (Vec2& q : ring) q = c + rotated(q, turn);
      return ring;
    };
    const double thin = 0.03 * std::pow(0.03, u(rng));
    const double tip = std::tan(1.0 / 180.0 * std::numbers::pi);
    if (kind < 0.2) {
      p.rings = {place({{-1, -thin}, {1, -thin}, {1, thin}, {-1, thin}})};
    } else if (kind < 0.4) {
      p.rings = {place({{-1, -tip}, {1, 0}, {-1, tip}})};
    } else if (kind < 0.6) {
      const double wide = 0.3 + 0.6 * u(rng);
      p.rings = {place({{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}),
                 place({{-wide, -wide}, {-wide, wide}, {wide, wide}, {wide, -wide}})};
    }
    p.joint.clear();
    for (const Ring& ring : p.rings) p.joint.push_back(std::vector<Index>(ring.size(), none));
  }
  return set;
}

struct DriftingHeap {
  BlockSet blocks;
  Masses masses;
  State state;
  Pose pose;
  LawTable laws;
  FacesAlone alone;
  NearEdges near;

  DriftingHeap(std::mt19937& rng, int n, double decades)
      : DriftingHeap(random_polygons(rng, n, decades)) {}

  explicit DriftingHeap(const PolygonSet& polygons) {
    Model model;
    model.materials.push_back({"rock", 2600.0, 1e9, 0.2, {}});
    model.contact.normal_stiffness = model.contact.shear_stiffness = 1e9;
    blocks = build_blocks(model, polygons);
    masses = given_masses(blocks);
    state = initial_state(blocks, polygons);
    laws = build_laws(model);
    pose = {blocks.vertex_x, blocks.vertex_y, blocks.vertex_x, blocks.vertex_y};
  }

  /// Rotates and shifts every block at random, no vertex by more than `most` m.
  void move_at_random(std::mt19937& rng, double most) {
    std::uniform_real_distribution<double> u(-1.0, 1.0);
    pose.x1 = pose.x;
    pose.y1 = pose.y;
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      if (blocks.fixed[i]) continue;
      const Id begin = blocks.vertex_begin[i], end = blocks.vertex_begin[i + 1];
      Vec2 middle;
      for (Id v = begin; v < end; ++v) middle += at(pose.x, pose.y, v);
      middle = middle / static_cast<double>(end - begin);
      double radius = 0.0;
      for (Id v = begin; v < end; ++v)
        radius = std::max(radius, norm(at(pose.x, pose.y, v) - middle));
      const double part = std::abs(u(rng));
      const double turn = std::clamp(part * most / radius, 0.0, 1.0) * (u(rng) < 0.0 ? -1.0 : 1.0);
      const Vec2 shift = (1.0 - part) * 0.7 * most * Vec2{u(rng), u(rng)};
      for (Id v = begin; v < end; ++v) {
        const Vec2 p = middle + rotated(at(pose.x, pose.y, v) - middle, turn) + shift;
        pose.x[v] = p.x;
        pose.y[v] = p.y;
      }
    }
  }

  FaceScene scene() const { return {blocks, masses, pose, laws}; }
  void find(double reach) { alone.find(blocks, state, pose, laws, {reach}, near); }

  ListFaults check() const { return check_list(alone.faces, blocks, state.alive, pose.x, pose.y); }
};

/// One heap of odd shapes, which overlap each other, through `lists` lists and `moves`
/// moves under each: which faces act.
inline ActingFaults acting_heap(unsigned seed, int blocks, int lists, int moves) {
  std::mt19937 rng(seed);
  std::uniform_real_distribution<double> u(0.0, 1.0);
  DriftingHeap heap(odd_polygons(rng, blocks));
  ActingOracle oracle(1e-10);
  ActingFaults sum;
  for (int list = 0; list < lists; ++list) {
    const double reach = 0.3 * std::pow(10.0, -3.0 * u(rng));
    FaceSet& c = heap.alone.faces;
    heap.find(reach);
    for (int move = 0; move < moves; ++move) {
      heap.alone.next_step();
      heap.move_at_random(rng, 0.5 * reach / moves);
      heap.alone.evaluate(heap.scene(), 1.0);
      sum.add(oracle.look(c, heap.alone.states, heap.blocks, heap.pose));
    }
  }
  return sum;
}

/// One heap through `lists` lists and `moves` moves under each; faces that carry must remain in
/// every new list.
inline ListFaults drifting_heap(unsigned seed, int blocks, int lists, int moves) {
  std::mt19937 rng(seed);
  std::uniform_real_distribution<double> u(0.0, 1.0);
  DriftingHeap heap(rng, blocks, 4.0 * u(rng));
  ListFaults sum;
  auto add = [&](const ListFaults& f) {
    sum.wanted += f.wanted;
    sum.missed += f.missed;
    sum.repeated += f.repeated;
  };
  for (int list = 0; list < lists; ++list) {
    const double reach = 0.3 * std::pow(10.0, -3.0 * u(rng));
    std::map<EdgePair, double> carry;
    FaceSet& c = heap.alone.faces;
    std::vector<FaceFields>& now = heap.alone.states.now;
    for (std::size_t k = 0; k < c.size(); ++k) {
      if (now[k].energy > 0.0) carry[{c.edge[k], c.facing[k]}] = now[k].energy;
    }
    heap.find(reach);
    for (std::size_t k = 0; k < c.size(); ++k) {
      const auto did = carry.find({c.edge[k], c.facing[k]});
      const double had = did != carry.end() ? did->second : 0.0;
      sum.missed += now[k].energy == had ? 0 : 1;
      if (u(rng) < 0.1) now[k].energy = 1.0 + u(rng);
    }
    add(heap.check());
    for (int move = 0; move < moves; ++move) {
      heap.move_at_random(rng, 0.5 * reach / moves);
      add(heap.check());
    }
  }
  return sum;
}

}  // namespace edda
