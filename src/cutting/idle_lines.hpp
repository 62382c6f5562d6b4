// Joints that cut nothing, or less than they were given for: drawn beside the rock, or trimmed
// away.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "cutting/line_work.hpp"
#include "cutting/partition.hpp"

namespace edda {

/// The table of the model from which a line comes: "joint_set.bedding".
std::string table_of(const Model& model, const LineSource& source);

/// A warning per trace, import, set, network or [voronoi] none of whose lines separates two blocks
/// (of blocks between the lines of imports, `framed`: bounds one), with why and what to do; none
/// where its lines lie on others that do. `work`: lines as noded. `in_rock`: whether a point, m,
/// local, lies inside rock.
std::vector<std::string> idle_lines(const Model& model, const LineWork& work,
                                    const PlanarGraph& graph, const Partition& parts, bool framed,
                                    const std::function<bool(Vec2)>& in_rock);

/// A warning per joint set that loses more than a third of its length in rock, since its joints end
/// inside blocks, with the lengths; none for those that lose all (idle_lines()).
std::vector<std::string> shortened_sets(const Model& model, const LineWork& work,
                                        const PlanarGraph& graph, const Partition& parts,
                                        const std::function<bool(Vec2)>& in_rock);

}  // namespace edda
