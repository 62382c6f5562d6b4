// Free-field boundary (theory, section 13.6): columns of ground beyond the sides of a model under
// ground motion. They move as ground would that extends without end and uniformly, and they act on
// the sides of the model.
//
// A column consists of cells of height D with nodes between them. Its strains are those of plane
// waves that travel up and down, and so are its stresses beyond those at rest:
//
//  s_xy = mu du_x/dy,   s_yy = (lambda + 2 mu) du_y/dy,   s_xx = lambda du_y/dy.
//
// rho D a = s(above) - s(below) at each node, with half of that mass at the free top and at the
// bottom. The rock of a cell has the viscosity and the mass-proportional damping of the block
// beside it. At the bottom a dashpot, rho c (2 v_in - v), lets the incoming wave in and the
// outgoing wave out; or the bottom moves with the ground.
#pragma once

#include <vector>

#include "attachments/dashpots.hpp"

namespace edda {

struct FreeFieldColumn {
  Index boundary = none;                    ///< row of Model::boundaries
  double bottom = 0.0;                      ///< y, m
  double cell = 0.0;                        ///< D, m
  double outward = 1.0;                     ///< x of the model's outward normal at that side
  std::vector<double> density, lambda, mu;  ///< [cells]
  std::vector<Id> block;                    ///< [cells] of the side whose rock it is
  std::vector<Vec2> softer;  ///< [cells] mu and lambda + 2 mu over those of the rock, less than 1
                             ///< where joints, which have no viscosity, make it slower
  std::vector<Vec2> moved, velocity;  ///< [cells + 1] u at n, m; v at n - 1/2, m/s

  /// Interpolates u or v between the nodes, at height y.
  Vec2 at(const std::vector<Vec2>& nodes, double y) const;
  /// Traction on a face with the model's outward normal, Pa, for these displacements.
  Vec2 traction(const std::vector<Vec2>& nodes, double y) const;
  /// The same of the viscosity eta of blocks, for these velocities.
  Vec2 viscous_traction(const std::vector<double>& eta, const std::vector<Vec2>& nodes,
                        double y) const;
  std::size_t cell_at(double y) const;
};

/// Motion of the bottoms of the columns, and damping, in a step.
struct FreeFieldDrive {
  bool lets_waves_in = false;  ///< the bottom is a dashpot; else it moves with the ground
  Vec2 twice_incoming;         ///< 2 v_in at n, m/s
  Vec2 ground;                 ///< velocity of the ground at n + 1/2, m/s
  Vec2 frame;  ///< m/s2: acceleration of the frame; all masses feel its opposite as inertia force
  double mass_damping = 0.0;  ///< coefficient of mass-proportional damping, 1/s, as for the blocks
  const std::vector<double>*decay = nullptr,
        *viscosity = nullptr;  ///< Masses::decay, in place of mass_damping, and Masses::viscosity;
                               ///< null or empty: none
  double local_damping = 0.0;  ///< beta, as for the blocks
};

struct FreeField {
  std::vector<FreeFieldColumn> columns;
  std::vector<Index> column;   ///< [points of Dashpots] or none
  std::vector<double> height;  ///< [points] y, m, at which the column moves beside them
  std::vector<double> middle;  ///< [points] y, m, at which its stress acts on them
  std::vector<double> face;    ///< [points] tributary area of the point on the side, m2
  bool empty() const { return columns.empty(); }
  /// Largest step of the columns, s: 0.9 D/c_p; infinite without columns.
  double largest_step() const;
};

/// Columns beside all boundaries of type free-field, of the rock at the model's side. Their cells
/// are as high as the shortest face there is long, but high enough for steps of `step` (s).
FreeField attach_free_field(const Model& model, const BlockSet& blocks, const Dashpots& dashpots,
                            double step);

/// The columns at n + 1 (velocities at n + 1/2): v+ = ((1 - a h/2) v- + h f/m)/(1 + a h/2), with h
/// the mean of both steps; the dashpot at the bottom is centred, and the viscous stresses are those
/// of v+, as in blocks.
std::vector<FreeFieldColumn> next_columns(const std::vector<FreeFieldColumn>& columns,
                                          const FreeFieldDrive& drive, double h_old, double h_new);

}  // namespace edda
