// The state of blocks and contacts at one time, as written: rows of the tables, values of the
// frames. Filled by run/; model coordinates, SI units; stresses of blocks are positive in tension,
// normal forces and normal stresses of joints in compression. Names are those of the model and the
// blocks, which must outlive a record.
#pragma once

#include <cstdint>
#include <limits>
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
  double overstress = 0.0;  ///< utilisation of the rock's strength, 0 where none is given
};

/// Numbers of the states in the frames.
enum class ContactState : std::int32_t { open = 0, stick = 1, slide = 2, bonded = 3 };

/// What has broken a joint with fracture energy.
enum class CrackMode : std::int32_t { unbroken = 0, tension = 1, shear = 2 };

/// A face: an edge of block i against one of block j. Forces are of the model's thickness.
struct ContactRecord {
  std::uint32_t block_i = 0, block_j = 0;
  std::string_view joint;     ///< its law
  std::string_view table;     ///< of the joint set, trace ... on which its edges lie; may be empty
  Vec2 position;              ///< middle of the overlap, m
  Vec2 displacement;          ///< of block i there since the start, m
  Vec2 force;                 ///< on block i, N
  double normal_force = 0.0;  ///< N, positive in compression
  double shear_force = 0.0;   ///< N, positive where it drives block i from end a to end b
  double opening = 0.0;       ///< m, minus the larger drawn closure of the two ends
  double slip = 0.0;          ///< m from end a to end b since the start
  ContactState state = ContactState::open;
  bool ever_slipped = false, ever_opened = false;
  double mobilised = 0.0;  ///< |shear| over shear strength, 0 without shear
  Vec2 a, b;               ///< ends of the overlap, block j on the left on the way from a to b, m
  double length = 0.0, closed_length = 0.0;  ///< of the overlap, and of the part that carries, m
  double normal_stress = 0.0;  ///< Pa, positive in compression: the mean over the overlap
  double normal_stress_a = 0.0,
         normal_stress_b = 0.0;  ///< at the ends: linear over the part that carries, 0 elsewhere
  double shear_stress = 0.0;     ///< Pa: the mean over the overlap, signed as shear_force
  double damage = 0.0;           ///< part of its strength that a joint with fracture energy lost
  CrackMode crack = CrackMode::unbroken;
  // Of a joint through which water flows; 0: there is none.
  double aperture = 0.0;                                  ///< m, hydraulic
  double discharge = 0.0;                                 ///< m2/s, from end a to end b
  double water_pressure_a = 0.0, water_pressure_b = 0.0;  ///< Pa, at its ends
  double head = 0.0;  ///< m, mean of both ends: y + p/gamma; NaN where dry
};

/// Larger ones are written as this.
inline constexpr double largest_strength_factor = 10.0;

/// A zone of a meshed block.
struct ZoneRecord {
  double sxx = 0.0, syy = 0.0, szz = 0.0, sxy = 0.0;  ///< Pa
  double plastic_strain = 0.0;  ///< accumulated e1 - e3, and slip on the foliation
  int yields = 0;  ///< at this time: 1 in shear, 2 in tension, 3 along the foliation; 0: not
  /// By which Mohr's circle may grow until the rock yields; none where it has no strength.
  double strength_factor = std::numeric_limits<double>::quiet_NaN();
  double pore_pressure = 0.0;  ///< Pa; stresses are total ones
};

/// Everything at one time.
struct Picture {
  double time = 0.0;                ///< s
  std::vector<BlockRecord> blocks;  ///< alive ones, by id
  std::vector<ContactRecord> contacts;
  std::vector<ZoneRecord> zones;       ///< of all meshed blocks, in the order of BlockSet::meshes
  std::vector<double> x, y;            ///< [nv + mesh nodes] vertices of all blocks, then the nodes
                                       ///< of their meshes, corners too, m
  std::vector<double> ux, uy, vx, vy;  ///< likewise: displacement (m) and velocity (m/s)
};

}  // namespace edda
