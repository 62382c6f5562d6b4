// Ground beyond the sides of a model that an earthquake shakes: columns that move as if the ground
// went on for ever, alike everywhere, and what they do to the model's sides (free-field boundary).
//
// A column is cut into cells of height D with nodes between them. Its strains are those of plane
// waves that go up and down, and so are its stresses beyond those at rest:
//
//   s_xy = mu du_x/dy,   s_yy = (lambda + 2 mu) du_y/dy,   s_xx = lambda du_y/dy.
//
// rho D a = s(above) - s(below) at each node, half of that mass at the top, which is free, and at
// the bottom. There, a wave that comes up is let in and what comes down let out by a dashpot,
// rho c (2 v_in - v); or the bottom moves with the ground.
#pragma once

#include <vector>

#include "attachments/dashpots.hpp"

namespace edda {

struct FreeFieldColumn {
  Index boundary = none;                    ///< row of Model::boundaries
  double bottom = 0.0;                      ///< y, m
  double cell = 0.0;                        ///< D, m
  double outward = 1.0;                     ///< x of the model's outward normal there
  std::vector<double> density, lambda, mu;  ///< [cells]
  std::vector<Vec2> moved, velocity;        ///< [cells + 1] u at n, m; v at n - 1/2, m/s

  /// At height y: u or v between the nodes.
  Vec2 at(const std::vector<Vec2>& nodes, double y) const;
  /// Stress on a face with the model's outward normal, Pa, for these displacements.
  Vec2 traction(const std::vector<Vec2>& nodes, double y) const;
  std::size_t cell_at(double y) const;
};

/// What moves the bottoms of columns, and all of them, in a step.
struct FreeFieldDrive {
  bool lets_waves_in = false;  ///< the bottom is a dashpot; else it moves with the ground
  Vec2 twice_incoming;         ///< 2 v_in at n, m/s
  Vec2 ground;                 ///< velocity of the ground at n + 1/2, m/s
  Vec2 frame;                  ///< acceleration of the ground that all feel backwards, m/s2
  double mass_damping = 0.0;   ///< a, 1/s, as of the blocks
  double local_damping = 0.0;  ///< beta, as of the blocks
};

struct FreeField {
  std::vector<FreeFieldColumn> columns;
  std::vector<Index> column;   ///< [points of Dashpots] or none
  std::vector<double> height;  ///< [points] y, m
  std::vector<double> face;    ///< [points] area of the side that the point stands for, m2
  bool empty() const { return columns.empty(); }
  /// The step that all columns bear, s; infinite without any: 0.9 D/c_p.
  double largest_step() const;
};

/// Columns beside all boundaries of type free-field, of the rock at the model's side. Their cells
/// are as high as faces there are long, but no lower than lets them take steps of `step` (s).
FreeField attach_free_field(const Model& model, const BlockSet& blocks, const Dashpots& dashpots,
                            double step);

/// The columns at n + 1 (velocities at n + 1/2): v+ = ((1 - a h/2) v- + h f/m)/(1 + a h/2), h the
/// mean of both steps; the dashpot at the bottom is centred.
std::vector<FreeFieldColumn> next_columns(const std::vector<FreeFieldColumn>& columns,
                                          const FreeFieldDrive& drive, double h_old, double h_new);

}  // namespace edda
