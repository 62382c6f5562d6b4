// Data that the layers of a picture share: the blocks of a frame and their drawn positions.
#pragma once

#include <string>
#include <vector>

#include "report/canvas.hpp"
#include "report/colour_scale.hpp"
#include "report/drawn_range.hpp"
#include "report/faces.hpp"
#include "report/layout.hpp"
#include "report/plot.hpp"
#include "report/shapes.hpp"

namespace edda {

namespace ink {
inline constexpr Colour line{0.12, 0.12, 0.14}, block{0.87, 0.85, 0.80}, white{1.0, 1.0, 1.0};
inline constexpr Colour light_line{0.80, 0.80, 0.83};
inline constexpr Colour fixed{0.80, 0.80, 0.80}, hatch{0.62, 0.62, 0.62};
inline constexpr Colour vector{0.05, 0.05, 0.05}, force{0.75, 0.10, 0.10};
inline constexpr Colour compression{0.05, 0.15, 0.45}, tension{0.85, 0.20, 0.05};
inline constexpr Colour pressure{0.05, 0.35, 0.75};
inline constexpr Colour monitor{0.80, 0.05, 0.45}, bolt{0.05, 0.25, 0.65}, joint{0.85, 0.10, 0.05};
}  // namespace ink

inline constexpr double pressure_line = 0.5;  ///< about the pressures on joints, pt
inline constexpr double pressure_fill = 0.4;  ///< their opacity
inline constexpr double joint_width = 1.6;    ///< of PlotOptions::joints and cracks, pt

/// The field broken_by of faces by its numbers.
inline constexpr double crack_in_tension = 1.0, crack_in_shear = 2.0;

/// One drawing.
struct PlotScene {
  const Snapshot& shot;
  View view;
  std::vector<Vec2> points;  ///< of the grid, as drawn, m
  std::vector<BlockShape> shapes;
  std::vector<DrawnFace> faces;  ///< a contact each; none where the frame does not have them
  std::vector<Vec2> contacts;    ///< drawn positions, m
  double exaggeration = 1.0;     ///< of displacements
  double font = 8.0;             ///< pt

  const Grid& grid() const { return shot.blocks; }
};

PlotScene make_scene(const Snapshot& shot, double exaggeration);

/// Whether the block of that cell is fixed.
bool is_fixed(const Grid& grid, std::size_t cell);

/// Approximate side of a block on paper where this number of blocks is visible, pt.
double block_size(const PlotScene& scene, std::size_t blocks);

/// Lengths on paper of the quantities that layers draw as lines, the same in all drawings of a
/// page.
struct ArrowScale {
  double per_unit = 0.0;   ///< pt per unit of the quantity; 0: there is nothing to draw
  double reference = 0.0;  ///< a round value for the legend
  double longest = 0.0;    ///< pt; longer arrows are cut and have two heads; 0: none is cut
};

bool is_inside(const PlotScene& scene, Vec2 p);

/// Length of the longest arrow, pt.
double longest(const PlotScene& scene);

/// The scale with which `most` is `length` pt long.
ArrowScale scale_for(double most, double length);

/// The same for the largest of these sizes; unless `whole`, for the size that nearly all of their
/// weight stays below: a few may then be longest_beyond times as long. Reorders them.
ArrowScale scale_for(std::vector<Weighed>& sizes, bool whole, double length);

/// A round value (1, 2 or 5 times a power of ten) not above `largest`; 0 of 0.
double round_below(double largest);

// The layers, from the bottom to the top.
void draw_blocks(Canvas& canvas, const PlotScene& scene, const ColourScale& scale, bool outlines);
void draw_contact_field(Canvas& canvas, const PlotScene& scene, const ColourScale& scale);
void draw_joints(Canvas& canvas, const PlotScene& scene, const PlotOptions& options);
/// Lines along the faces that have broken, by what has broken them.
void draw_cracks(Canvas& canvas, const PlotScene& scene);

/// Principal stresses as crosses; none where all are below `least`, Pa.
ArrowScale stress_scale(const std::vector<PlotScene>& scenes, double least);
void draw_stresses(Canvas& canvas, const PlotScene& scene, const ArrowScale& scale);

/// The arrows of options.vectors.
ArrowScale vector_scale(const std::vector<PlotScene>& scenes, const PlotOptions& options);
void draw_vectors(Canvas& canvas, const PlotScene& scene, const std::string& name,
                  const ArrowScale& scale);
ArrowScale force_scale(const std::vector<PlotScene>& scenes);
void draw_forces(Canvas& canvas, const PlotScene& scene, const ArrowScale& scale);

/// Pressures on joints, across them; beyond the longest they are cut.
ArrowScale pressure_scale(const std::vector<PlotScene>& scenes, const PlotOptions& options);
void draw_pressures(Canvas& canvas, const PlotScene& scene, const ArrowScale& scale);

/// Bolts, as wide as their force where the scale says how wide.
ArrowScale bolt_scale(const std::vector<PlotScene>& scenes);
void draw_bolts(Canvas& canvas, const PlotScene& scene, const PlotOptions& options,
                const ArrowScale& scale);

/// Thrust, moment or shear of linings, across them; positive values on the side of the wall.
ArrowScale lining_scale(const std::vector<PlotScene>& scenes);
void draw_linings(Canvas& canvas, const PlotScene& scene, const ArrowScale& scale);

/// Monitors and convergence lines, with their names beside them.
void draw_marks(Canvas& canvas, const PlotScene& scene, const PlotOptions& options);

/// The frame and its ticks. `y_labels`: not on every one of several drawings.
void draw_axes(Canvas& canvas, const View& view, double font, bool y_labels);

/// Room that the labels of the y axis of such a drawing take, pt.
double axis_room(const Box& world, double font);

}  // namespace edda
