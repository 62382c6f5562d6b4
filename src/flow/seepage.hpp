// Flow through the network of joints, with a free surface (theory, section 13.9).
// Within a time dt the nodes store water, too (13.9.5):
//   V (s + p/K) + sum s s' drawn - content + dt sum q = 0
// with what walls that part draw to the node in pipes from others (drawn_to()).
//
// Of a node: p >= 0 its pressure, s the part of it that water fills, phi = p + gamma y. Either p >
// 0 and s = 1 (wet), or p = 0 and 0 <= s <= 1 (air enters). A pipe from i to j, phi_i >= phi_j, has
//   q = s_i C (phi_i - phi_j)
// so that water falls from a node that air enters, and none rises to it: below it stands. At each
// node inside the rock the discharges sum to zero; one that no pipes connect to a given pressure is
// dry.
#pragma once

#include <cstdint>
#include <vector>

#include "flow/network.hpp"

namespace edda {

/// What is given at a node.
struct NodeCondition {
  enum class Kind : std::uint8_t {
    inside,    ///< nothing: water neither comes nor goes
    pressure,  ///< its pressure
    air,       ///< atmospheric pressure: water may leave, none comes in
    rain       ///< the same, but for `source`, as far as the joints take it in
  };
  Kind kind = Kind::inside;
  double pressure = 0.0;  ///< Pa
  Index water = none;     ///< which gives the pressure, or the rain
  double source = 0.0;    ///< m2/s: of rain, or what is injected
};

struct NodeWater {
  double pressure = 0.0;  ///< p, Pa
  double filled = 0.0;    ///< s
  /// s + p/K, of the volume of its node.
  double content(double bulk_modulus) const { return filled + pressure / bulk_modulus; }
};

/// What the joints store while a time passes.
struct Storage {
  double passed = 0.0;          ///< s
  double bulk_modulus = 0.0;    ///< K of water, Pa
  std::vector<double> content;  ///< [nodes] V (s + p/K) at the beginning, m2
  std::vector<double> before;   ///< [2 pipes] apertures at their ends at the beginning, m
  std::vector<double> acting;  ///< [nodes] the pressures under which the apertures are those of the
                               ///< network, Pa
  struct Give {
    Id end, node;       ///< end e of pipe q: 2 q + e
    double compliance;  ///< m/Pa: how the walls at `end` open under a pressure at `node`
  };
  std::vector<Give> gives;  ///< by end
};

/// Solves for the water of all nodes. [nodes] water: on entry a guess, as that of a state before.
/// unit_weight: gamma, N/m3. Returns whether the set of wet nodes has been found; else the last one
/// tried is taken. storage: null: the flow is steady.
bool solve_seepage(const FlowNetwork& network, const std::vector<NodeCondition>& given,
                   double unit_weight, std::vector<NodeWater>& water,
                   const Storage* storage = nullptr);

/// Discharge of a pipe from its node `from` to its node `to`, m2/s.
double discharge_of(const FlowNetwork& network, const FlowPipe& pipe, double unit_weight,
                    const std::vector<NodeWater>& water);

/// Level of the water at the two ends of a pipe, as it presses on its walls: p = gamma (level - y)
/// where that is positive; m, local coordinates.
struct PipeLevels {
  double from, to;
};
PipeLevels levels_of(const FlowNetwork& network, const FlowPipe& pipe, double unit_weight,
                     const std::vector<NodeWater>& water);

}  // namespace edda
