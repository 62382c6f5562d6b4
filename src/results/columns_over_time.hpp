// The columns of the tables that a run writes while it goes on: parts of column_table.cpp.
#pragma once

#include <array>

#include "results/columns.hpp"

namespace edda::column_table {

using C = ResultColumn;

// Columns that several files have.
constexpr C time_column{"time", "s", "Time since the start of the run."};
constexpr C kinetic{"kinetic", "J", "Kinetic energy of the free blocks."};
constexpr C strain{
    "strain", "J",
    "Elastic energy of the blocks; with an initial stress that of the whole stress."};
constexpr C contact{"contact", "J", "Energy stored in contacts, boundary springs and bolts."};
constexpr C gravity{"gravity", "J", "Potential energy of weight, less that at the start."};
constexpr C friction{
    "friction", "J",
    "Energy dissipated since the start by sliding, by rock that yields in zones, and in bolts by "
    "grout that slips and steel that yields."};
constexpr C damping{
    "damping", "J",
    "Energy dissipated since the start by all kinds of damping and by boundaries that "
    "absorb waves."};
constexpr C fracture{"fracture", "J",
                     "Energy released since the start by joints and bolts that fail."};
constexpr C external{
    "external", "J",
    "Work done on the blocks since the start by loads, boundaries, ground motion and "
    "the changes of stages."};
constexpr C drift{
    "drift", "1",
    "Energy balance error: the change since the start of kinetic + strain + contact + "
    "gravity + friction + damping + fracture + transfer + step_change - external, over "
    "the largest kinetic + strain + contact + friction + damping + fracture so far."};
constexpr C transfer{
    "transfer", "J",
    "Energy taken since the start by rules of contacts that are no physical process: "
    "overlaps of sticking faces that change, locked closures, activation factors without a root."};
constexpr C convergence{
    "NAME.convergence", "m",
    "Decrease of the distance between the two points of a convergence line since "
    "the start or the last reset of displacements; positive where they have come "
    "nearer to each other.",
    ColumnOf::convergence};

constexpr std::array history{
    time_column,
    C{"NAME.ux", "m",
      "Displacement of a monitor to the right since the start or the last reset of displacements.",
      ColumnOf::monitor},
    C{"NAME.uy", "m",
      "Displacement of a monitor upwards since the start or the last reset of displacements.",
      ColumnOf::monitor},
    C{"NAME.vx", "m/s", "Velocity of a monitor to the right.", ColumnOf::monitor},
    C{"NAME.vy", "m/s", "Velocity of a monitor upwards.", ColumnOf::monitor},
    C{"NAME.ax", "m/s2",
      "Acceleration of a monitor to the right in a frame at rest, with that of the ground under "
      "apply = inertia: the mean since the row before.",
      ColumnOf::monitor},
    C{"NAME.ay", "m/s2", "The same upwards, without gravity: 0 at rest, -g in free fall.",
      ColumnOf::monitor},
    C{"NAME.sxx", "Pa", "Stress xx of the block that holds the monitor, positive in tension.",
      ColumnOf::monitor},
    C{"NAME.syy", "Pa", "Stress yy of the block that holds the monitor, positive in tension.",
      ColumnOf::monitor},
    C{"NAME.sxy", "Pa", "Shear stress xy of the block that holds the monitor.", ColumnOf::monitor},
    convergence,
    C{"NAME.mean_sxx", "Pa",
      "Mean stress xx of a measured region, positive in tension; voids in it count without stress.",
      ColumnOf::measurement},
    C{"NAME.mean_syy", "Pa", "Mean stress yy of the region, positive in tension.",
      ColumnOf::measurement},
    C{"NAME.mean_szz", "Pa", "Mean out-of-plane stress of the region, positive in tension.",
      ColumnOf::measurement},
    C{"NAME.mean_sxy", "Pa", "Mean shear stress xy of the region.", ColumnOf::measurement},
    C{"NAME.mean_exx", "1",
      "Mean strain xx of the region since the start or the last reset of displacements, with what "
      "its joints have opened and slipped; positive in extension.",
      ColumnOf::measurement},
    C{"NAME.mean_eyy", "1", "Mean strain yy of the region, positive in extension.",
      ColumnOf::measurement},
    C{"NAME.mean_exy", "1", "Mean shear strain xy of the region, half of the angle of shear.",
      ColumnOf::measurement},
    kinetic,
    strain,
    contact,
    gravity,
    friction,
    damping,
    fracture,
    external,
    C{"step_change", "J",
      "Energy that changes of the time step and of scaled masses have taken since the start; "
      "negative where they have added energy."},
    drift,
    C{"unbalanced", "1",
      "Mean resultant force of the free blocks over the mean normal force at the ends of the "
      "contacts that carry load, or over the mean of weight and loads where none does."},
    transfer,
    C{"cracks_tension", "1",
      "Number of joints so far that have spent their fracture energy, mostly by opening."},
    C{"cracks_shear", "1",
      "Number of joints so far that have spent their fracture energy, mostly by slip."},
};

constexpr std::array reactions{
    time_column,
    C{"NAME.fx", "N",
      "Force of a boundary on the blocks, positive to the right; a boundary without a name is "
      "called by its number, from 0.",
      ColumnOf::boundary},
    C{"NAME.fy", "N", "Force of the boundary on the blocks, positive upwards.", ColumnOf::boundary},
};

constexpr std::array bolts{
    time_column,
    C{"bolt", "text", "Name of the bolt."},
    C{"distance", "m", "Distance of the node from the head of the bolt, along the bolt."},
    C{"x", "m", "Coordinate x of the node now."},
    C{"y", "m", "Coordinate y of the node now."},
    C{"axial_force", "N",
      "Axial force of one bolt, positive in tension; at a joint that of the steel across it."},
    C{"bond_force", "N/m",
      "Force of the bond per length of one bolt, positive where the rock resists slip of the bolt "
      "away from its head."},
    C{"dowel_force", "N", "Shear force of one bolt across the joint at this node."},
    C{"utilisation", "1",
      "Largest of axial force over yield force, bond force over bond strength and "
      "dowel_utilisation."},
    C{"yielded", "1", "1: the steel beside the node has yielded at some time; 0: it has not."},
    C{"ruptured", "1", "1: the steel beside the node has ruptured; 0: it has not."},
    C{"dowel_utilisation", "1",
      "Dowel force over dowel strength; of a dowel whose strength follows from the bar that of "
      "shear and axial force together, sqrt((V/V_p)^2 + (N/N_p)^2)."},
    C{"dowel_angle", "rad",
      "Angle by which such a bar has turned in the joint at this node, counter-clockwise."},
};

constexpr std::array bolt_summary{
    C{"bolt", "text", "Name of the bolt."},
    C{"largest_force", "N",
      "Axial force of one bolt that is largest by size, of all its nodes in all frames, positive "
      "in "
      "tension."},
    C{"time", "s", "Time of that frame."},
    C{"distance", "m", "Distance of that node from the head of the bolt."},
    C{"x", "m", "Coordinate x of the node at that time."},
    C{"y", "m", "Coordinate y of the node at that time."},
    C{"axial_force", "N",
      "Axial force of one bolt at the end that is largest by size, positive in tension."},
    C{"bond_force", "N/m",
      "Force of the bond per length of one bolt at the end that is largest by size, positive where "
      "the rock resists slip of the bolt away from its head."},
    C{"dowel_force", "N",
      "Shear force of one bolt across a joint at the end that is largest by size."},
    C{"utilisation", "1", "Largest utilisation of its nodes at the end, as in bolts.csv."},
    C{"bond_slipped", "1", "1: the bond has slipped somewhere at some time; 0: it has not."},
    C{"yielded", "1", "1: the steel has yielded somewhere at some time; 0: it has not."},
    C{"ruptured", "1", "1: the steel has ruptured somewhere; 0: it has not."},
    C{"largest_dowel_force", "N",
      "Shear force of one bolt that is largest by size, of all joints that it crosses in all "
      "frames."},
    C{"dowel_utilisation", "1",
      "Largest dowel_utilisation of its nodes at the end, as in bolts.csv."},
};

constexpr std::array linings{
    time_column,
    C{"lining", "text", "Name of the lining, or its number in the model, from 0."},
    C{"piece", "1", "Number of the piece along the lining, from 0; each has a row for either end."},
    C{"distance", "m", "Distance of that end from the start of the lining, along it."},
    C{"x", "m", "Coordinate x of the middle of the section now."},
    C{"y", "m", "Coordinate y of the middle of the section now."},
    C{"thrust", "N", "Thrust of the thickness of the model, positive in compression."},
    C{"moment", "N m",
      "Moment of the thickness of the model, positive where it puts the side at the wall in "
      "tension; the mean of the two pieces that meet in the section."},
    C{"shear", "N", "Shear force of the thickness of the model: slope of the moment."},
    C{"utilisation", "1",
      "By what thrust and moment would have to be divided to be at the strength of the section; 0 "
      "without a strength."},
    C{"hinge_rotation", "rad",
      "Plastic rotation of that end so far, positive where it opens the side at the wall."},
    C{"material", "text", "Name of the material that the lining has by then (stage.change)."},
    C{"yielded", "1",
      "1: the section has yielded so far, and utilisation is that of its residual strength, if it "
      "has one; 0: not yet."},
};

constexpr std::array stages{
    C{"stage", "1", "Number of the stage, from 1."},
    C{"name", "text", "Name of the stage; empty where it has none."},
    C{"until", "text", "What ends the stage: time, equilibrium, or collapse under a ramp."},
    C{"reached", "1",
      "1: the stage has reached its end; 0: it has found no equilibrium within its duration, or "
      "its "
      "ramp has not reached the end asked for."},
    C{"start", "s", "Time at which the stage began."},
    C{"end", "s", "Time at which the stage ended."},
    C{"steps", "1", "Number of time steps of the stage."},
    C{"ratio", "1",
      "Mean resultant force of the blocks over the mean normal force at the ends of the contacts "
      "that "
      "carry load, or over the mean of weight and loads where none does; blocks without contact "
      "and loose blocks do not count."},
    C{"largest_ratio", "1", "The same ratio of the block that is furthest from equilibrium."},
    C{"largest_block", "1", "Id of that block; empty where no block counts."},
    kinetic,
    strain,
    contact,
    gravity,
    friction,
    damping,
    fracture,
    external,
    drift,
    C{"contacts", "1", "Number of closed contacts."},
    C{"sliding", "1", "Number of closed contacts that slide."},
    C{"bonded", "1", "Number of closed contacts that still have their peak strength."},
    C{"detached", "1", "Number of free blocks without contact."},
    C{"open", "1",
      "Number of contacts that have opened and whose edges are still near each other."},
    C{"broken", "1", "Number of bonds of joints that have failed since the start of the run."},
    C{"yielded_bolts", "1",
      "Number of bolts of which any part has yielded, slipped in its grout or ruptured."},
    C{"loose", "1",
      "Number of blocks that slide or fall away while the others come to equilibrium."},
    transfer,
    convergence,
};

constexpr std::array curve{
    C{"stage", "1", "Number of the stage, from 1."},
    C{"vary", "text", "What its ramp varies, as the model names it."},
    C{"value", "as varied", "Value at which this increment of the ramp was held."},
    C{"holds", "1", "1: the model is in equilibrium at this value; 0: it fails."},
    C{"time", "s", "Time since the start of the run."},
    C{"steps", "1", "Number of time steps of the increment."},
    C{"moved", "m", "Largest displacement of a corner in the increment."},
    C{"fx", "N",
      "Sum of what is varied on all free blocks, to the right: the load, the water's pressure, the "
      "reaction at the boundary or the weight; 0 for strength."},
    C{"fy", "N", "The same upwards."},
    C{"reason", "text", "Why it holds or fails."},
    C{"NAME.ux", "m",
      "Displacement of a monitor to the right since the start or the last reset of displacements.",
      ColumnOf::monitor},
    C{"NAME.uy", "m",
      "Displacement of a monitor upwards since the start or the last reset of displacements.",
      ColumnOf::monitor},
};

}  // namespace edda::column_table
