// From polygons to blocks with mass, cover and initial state.
#pragma once

#include "blocks/block_set.hpp"
#include "blocks/state.hpp"
#include "cutting/linings.hpp"
#include "cutting/polygon_set.hpp"
#include "model/model.hpp"

namespace edda {

/// The sections of block i, a lining; corners are numbered from its first vertex.
StripSections sections_of(const BlockSet& blocks, std::size_t i);

/// Whether a block of the model is meshed (blocks/meshes.hpp).
bool may_be_meshed(const Model& model, const BlockPolygon& block);
/// Whether a block of the model may bend (blocks/bending.hpp): if it has more than three corners.
bool may_bend(const Model& model, const BlockPolygon& block);

/// Computes moments, covers, masses and elastic constants of every polygon (theory, sections 1
/// to 3). The polygons must be valid: positive area, no ring crosses itself.
BlockSet build_blocks(const Model& model, const PolygonSet& polygons);

/// Every block where it was drawn, without strain, with its given velocity (v_0, not yet v_{-1/2}).
State initial_state(const BlockSet& blocks, const PolygonSet& polygons);

}  // namespace edda
