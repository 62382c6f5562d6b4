// Lines that are drawn at random: [[fracture_network]] and [voronoi].
#pragma once

#include "base/fault.hpp"
#include "lines/line_work.hpp"

namespace edda {

/// Adds the fractures of a network that reach into the domain (and the network's region). Centres
/// are uniform in a box that reaches half a longest fracture beyond, so that the edge of the domain
/// sees as many as its middle; length is counted inside alone, and drawing ends as near to p21 as
/// whole fractures come. Says in work.notes what was reached. Faults: more than `limit` fractures,
/// or more to be drawn than any machine should. O(fractures drawn).
Faults add_network(LineWork& work, const FractureNetwork& network, Index source, Vec2 origin,
                   double snap, double limit);

/// Adds the edges of Voronoi polygons round points thrown at random, one per size^2, after
/// `smoothing` rounds in which each point moved to the centroid of its polygon (Lloyd 1982). With a
/// region its outline is added, too. O(n log n) in polygons, in each round.
Faults add_voronoi(LineWork& work, const Voronoi& voronoi, Index source, Vec2 origin, double snap);

}  // namespace edda
