// Pairs of triangles for mixed discretisation (zones/zone.hpp).
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "cutting/mesh.hpp"

namespace edda {

inline constexpr std::uint32_t no_partner = 0xffffffffu;

/// Pairs of triangles that share an edge, each in one pair, and those that remain alone
/// (second: no_partner). Quadrilaterals near a square are taken first: the longer the shared edge
/// compared with the other edges of both, the earlier. Then partners change along alternating paths
/// (Berge 1957) until few are alone.
std::vector<std::pair<std::uint32_t, std::uint32_t>> pair_triangles(const Mesh& mesh);

}  // namespace edda
