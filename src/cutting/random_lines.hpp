// Lines that are drawn at random: [[fracture_network]] and [voronoi].
#pragma once

#include "base/fault.hpp"
#include "cutting/line_work.hpp"

namespace edda {

/// Adds the fractures of a network that reach into the domain (and the network's region). Centres
/// are uniform in a box that reaches half a longest fracture beyond, so that the density at the
/// edge of the domain is that in its middle; only the length inside counts, and drawing ends with
/// the number of fractures that comes nearest to p21. work.notes reports the density obtained.
/// Faults: more than `limit` fractures, or too many to be drawn in a reasonable time. O(fractures
/// drawn).
Faults add_network(LineWork& work, const FractureNetwork& network, Index source, Vec2 origin,
                   double snap, double limit);

/// Adds the edges of Voronoi polygons around random points, one per size^2, after
/// `smoothing` rounds in which each point moved to the centroid of its polygon (Lloyd 1982). With a
/// region its outline is added, too. O(n log n) in polygons, in each round.
Faults add_voronoi(LineWork& work, const Voronoi& voronoi, Index source, Vec2 origin, double snap);

}  // namespace edda
