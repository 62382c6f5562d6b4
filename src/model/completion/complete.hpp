// Completion of a model beyond the table of keys: defaults that depend on other keys, and checks of
// several keys together.
#pragma once

#include "model/files/reader.hpp"

namespace edda {

/// Fills every default of `reading.model` that depends on other keys, and adds a fault for
/// everything that can be checked without cutting the geometry: laws and materials that are not
/// named, duplicate names, keys that exclude each other, counts too large for any memory. `root` is
/// what the model was read from.
void complete(const Value& root, Reading& reading);

/// Blocks that joint sets and polygons would cut the domain into: 1 + joints + crossings, and one
/// per polygon. An upper estimate where sets are confined to regions; infinite rather than
/// overflowing. Precondition: model.domain is set, with an outline.
double estimated_blocks(const Model& model);
/// The same for joint sets alone.
double estimated_blocks(const Domain& domain, const std::vector<JointSet>& sets);

/// As complete(), for [slope] and the shapes of openings: outlines from a few parameters.
void complete_shapes(const Value& root, Reading& reading);

/// As complete(), for the tables of random and mapped lines, [[import]], [[region]],
/// [[contact_pair]] and [[arch]].
void complete_lines(const Value& root, Reading& reading);

/// The built-in law of outlines that name none, which glues them. Made where it is needed.
Index glued_law(Reading& reading);

/// As complete(), for [[load]] and [[water]]: keys that exclude each other, histories read from
/// their files, openings that are named.
void complete_loads(const Value& root, Reading& reading);
void complete_flow(const Value& root, Reading& reading);

/// As complete(), for [[boundary]]: the keys that each type needs, and those that it does not have.
void complete_boundaries(const Value& root, Reading& reading);

/// As complete(), for [initial_stress], boundaries that take their traction from it, and
/// [[convergence]].
void complete_initial_stress(const Value& root, Reading& reading);
/// Whether rock may yield as it is to, and the model may have zones.
void complete_zones(const Value& root, Reading& reading);

/// As complete(), for [[shaking]]: records read from their files, the boundary that is named.
void complete_shakings(const Value& root, Reading& reading);

/// As complete(), for [[bolt]] and [[bolt_pattern]]: the keys that each type needs, openings that
/// are named.
void complete_bolts(const Value& root, Reading& reading);

/// As complete(), for [[lining]]: where it is and its section; methods that have none.
void complete_linings(const Value& root, Reading& reading);

/// As complete(), for [[fill]]: where it is; what it is not available with; that a stage places it.
void complete_fills(const Value& root, Reading& reading);

/// As complete(), for [joints.NAME]: the keys that each type needs and those that it does not have;
/// residual strength.
void complete_joints(const Value& root, Reading& reading);

/// As complete(), for [fos]: the stage, the joints and the varied table must exist.
void complete_fos(const Value& root, Reading& reading);

/// As complete(), for contact.model = "points": what the paper's contacts do not have is refused.
void complete_points(const Value& root, Reading& reading);

/// That linings which are there from the start lie on walls that are. After complete_stages().
void check_first_linings(const Value& root, Reading& reading);

/// As complete(), for [[stage]]: defaults of damping and masses, names, sum of durations.
void complete_stages(const Value& root, Reading& reading);

/// As complete(), for counts of blocks and the defaults of snap and [quality].
void complete_geometry(const Value& root, Reading& reading);

}  // namespace edda
