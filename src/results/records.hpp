// What a run tells of its blocks and contacts at one time: rows of the tables, values of the
// frames. Filled by run/; model coordinates, SI units, stresses positive in tension. Names are
// those of the model and the blocks, which must outlive a record.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "base/vec2.hpp"

namespace edda {

struct BlockRecord {
  std::uint32_t id = 0;
  std::string_view name, material;
  std::int32_t material_index = 0;
  bool fixed = false;
  Vec2 position;                                      ///< centroid, m
  double area = 0.0;                                  ///< as deformed, m2
  Vec2 displacement;                                  ///< of the centroid, m
  double rotation = 0.0;                              ///< rad, full turns counted
  Vec2 velocity;                                      ///< of the centroid, m/s
  double omega = 0.0;                                 ///< rad/s
  double sxx = 0.0, syy = 0.0, szz = 0.0, sxy = 0.0;  ///< Pa
  double overstress = 0.0;  ///< part of the rock's strength that is used, 0 where none is given
};

/// Numbers as in the frames.
enum class ContactState : std::int32_t { open = 0, stick = 1, slide = 2, bonded = 3 };

struct ContactRecord {
  std::uint32_t block_i = 0, block_j = 0;  ///< of the vertex, of the edge
  std::string_view joint;                  ///< its law
  Vec2 position;                           ///< of the vertex, m
  Vec2 displacement;                       ///< of the vertex since the start, m
  Vec2 force;                              ///< on block i, N
  double normal_force = 0.0;               ///< N, positive in compression
  double shear_force = 0.0;                ///< N, positive where it drives block i along the edge
  double opening = 0.0;                    ///< m, negative: penetrated
  double slip = 0.0;                       ///< m along the edge since the start
  ContactState state = ContactState::open;
  bool ever_slipped = false, ever_opened = false;
  double mobilised = 0.0;  ///< |shear| over shear strength, 0 where none is called on
};

/// Everything at one time.
struct Picture {
  double time = 0.0;                ///< s
  std::vector<BlockRecord> blocks;  ///< alive ones, by id
  std::vector<ContactRecord> contacts;
  std::vector<double> x, y;            ///< [nv] vertices of all blocks, m
  std::vector<double> ux, uy, vx, vy;  ///< [nv] their displacement (m) and velocity (m/s)
};

}  // namespace edda
