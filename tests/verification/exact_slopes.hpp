// Slopes of several blocks whose factors of safety limit equilibrium gives exactly: planes,
// step-paths, wedges (slices after Sarma 1979), toppling (Goodman and Bray 1976).
#pragma once

#include <array>
#include <string>
#include <vector>

#include "base/polygon.hpp"

namespace edda {

struct ExactSlope {
  std::string name;
  std::string model;    ///< TOML, without its [fos]
  std::string exclude;  ///< names of joints that keep their strength, as in [fos]; may be empty
  std::string motion;   ///< beginning of the sentence that describes the mechanism
  double factor = 0.0;
};

/// A rock mass over a stepped base, cut by beds that dip out of the face and by cross joints. The
/// sliding mass moves along the beds and opens cross joints behind it: F is the least of [c L + (W
/// cos a - U - V') tan phi]/(W sin a + V) over all paths through beds and cross joints that only
/// step up. U: water on the beds; V, V': that on the cross joints of the path, along the beds and
/// across.
struct BeddedSlope {
  double dip = 38.0;                  ///< degrees, of the beds
  double bed = 2.0;                   ///< m, spacing across them; one goes through (0, 0)
  double cross = 2.5;                 ///< m along the beds, spacing of the cross joints
  double lean = 90.0;                 ///< degrees from the beds to the cross joints
  double cross_from = 0.0;            ///< m, along the beds: where one of the cross joints is
  double cohesion = 0.0, phi = 40.0;  ///< Pa, degrees; of the beds
  Ring surface{};  ///< m, from the back of the base over the crest to the toe (0, 0)
  std::vector<std::array<double, 2>>
      steps{};                ///< m along the beds, m across: risers of the base, by cross joints
  std::vector<Vec2> table{};  ///< m, of the water; empty: none

  double exact() const;
  std::string toml() const;

 private:
  struct Part;
  struct Cells;
  struct Extent;
  struct Path;

  Vec2 along() const;
  Vec2 riser() const;
  Vec2 place(double u, double v) const;
  double u_of(Vec2 p) const;
  double v_of(Vec2 p) const;
  Ring profile() const;
  Ring mass() const;
  Vec2 push_on_riser() const;
  Extent extent_of(const Ring& whole) const;
  void add_cell(Cells& cells, const Ring& whole, const Extent& extent, int k) const;
  void add_water_at_back(Cells& cells, const Ring& whole, const Extent& extent) const;
  Path least_path(const Cells& cells, double guess) const;
};

/// Slices from toe to top on bases of their own, with joints between them, all at their limit
/// together (Sarma 1979, without moments, which blocks that lie on faces do not need). Where base
/// and joint meet there is a hollow; otherwise the corner of the slice above would stand on the
/// base below.
struct SlicedSlope {
  std::vector<Vec2> base{};  ///< m, [slices + 1] from the toe up
  std::vector<Vec2>
      surface{};  ///< m, [slices + 1]: the joint between two slices goes from base[i] to surface[i]
  double base_cohesion = 0.0, base_phi = 35.0;    ///< Pa, degrees
  double joint_cohesion = 0.0, joint_phi = 30.0;  ///< Pa, degrees
  std::vector<Vec2> table{};                      ///< m, of the water; empty: none
  double hollow = 0.4;                            ///< m, sides of the hollows

  double exact() const;
  std::string toml() const;
};

/// The slope of sixteen blocks of Goodman and Bray (1976), in the numbers of Hoek and Bray's
/// example.
struct TopplingSlope {
  static constexpr int count = 16, crest = 10;
  static constexpr double width = 10.0, a1 = 5.0, a2 = 5.2, b = 1.0, unit_weight = 25e3;
  static constexpr double dip = 30.0;  ///< of the bases, degrees

  std::array<double, count + 1> height{};  ///< [1..count] from the toe

  TopplingSlope();
  double y(int n) const { return height[static_cast<std::size_t>(n)]; }
  /// Force that keeps block 1 in equilibrium, computed from block to block down the slope: each
  /// exerts the force that it needs not to topple, or not to slide, whichever is larger (Goodman
  /// and Bray's equations).
  double tie(double phi) const;
  /// The friction angle at which no tie is needed, degrees.
  double limit() const;
  std::string toml(double phi) const;
};

/// The ten slopes of tools/study-fos.
std::vector<ExactSlope> exact_slopes();

}  // namespace edda
