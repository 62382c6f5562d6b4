// The joint distribution of a study's variables, by OpenTURNS.
#pragma once

#include <nlohmann/json.hpp>
#include <openturns/OT.hxx>
#include <vector>

namespace edda::sampler {

/// Variables with their dependence. Standard space: independent standard normal variables, which
/// the transformation of Nataf or Rosenblatt turns into the variables.
class Variables {
 public:
  /// variables: a list of { distribution, and its parameters }; dependence: a list of
  /// { between: [i, j], copula, rank | theta }. Throws OT::Exception where no such distribution
  /// exists.
  Variables(const nlohmann::json& variables, const nlohmann::json& dependence);

  std::size_t count() const { return order_.size(); }
  /// From standard space.
  OT::Point from_normal(const OT::Point& u) const;
  /// From independent variables uniform in (0, 1).
  OT::Point from_uniform(const OT::Point& p) const;

 private:
  /// OpenTURNS has the von Mises distribution in radians around its mean.
  struct Scale {
    double zero = 0.0, unit = 1.0;
  };
  /// Dip and dip direction of an orientation, of Fisher's distribution.
  struct Orientation {
    std::size_t dip = 0, direction = 0;  ///< variables
    double mean_dip = 0.0, mean_direction = 0.0, concentration = 1.0;
  };
  void orient(const Orientation& o, OT::Point& x) const;
  std::vector<Orientation> orientations_;
  OT::Distribution joint_;
  std::vector<std::size_t> order_;  ///< variable of each of joint_'s components
  std::vector<Scale> scale_;        ///< of each variable
};

}  // namespace edda::sampler
