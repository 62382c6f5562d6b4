#include "zones/koiter.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace edda {
namespace {

double excess(const YieldPlane& p, const Principal& s) {
  return dot(p.normal, s) - p.limit;
}

/// The multipliers of some planes: sum_b (n_a . C m_b) l_b = n_a . s* - d_a. False: they are not
/// independent.
bool solve(std::array<std::array<double, 4>, 3>& rows, std::size_t n, Principal& l) {
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t pivot = k;
    for (std::size_t r = k + 1; r < n; ++r)
      if (std::abs(rows[r][k]) > std::abs(rows[pivot][k])) pivot = r;
    std::swap(rows[k], rows[pivot]);
    double size = 0.0;
    for (std::size_t c = 0; c < n; ++c) size = std::max(size, std::abs(rows[k][c]));
    if (!(std::abs(rows[k][k]) > 1e-10 * size)) return false;
    for (std::size_t r = k + 1; r < n; ++r) {
      const double factor = rows[r][k] / rows[k][k];
      for (std::size_t c = k; c < 4; ++c) rows[r][c] -= factor * rows[k][c];
    }
  }
  for (std::size_t k = n; k-- > 0;) {
    double rest = rows[k][3];
    for (std::size_t c = k + 1; c < n; ++c) rest -= rows[k][c] * l[c];
    l[k] = rest / rows[k][k];
  }
  return true;
}

class Return {
 public:
  Return(const Principal& trial, const IsotropicElasticity& elastic,
         std::span<const YieldPlane> planes, double rounding)
      : trial_(trial), elastic_(elastic), planes_(planes), rounding_(rounding) {}

  bool by(std::span<const std::size_t> active, ReturnedStress& found) const {
    std::array<std::array<double, 4>, 3> rows{};
    for (std::size_t a = 0; a < active.size(); ++a) {
      for (std::size_t b = 0; b < active.size(); ++b)
        rows[a][b] = dot(planes_[active[a]].normal, elastic_.stress(planes_[active[b]].flow));
      rows[a][3] = excess(planes_[active[a]], trial_);
    }
    Principal l{};
    if (!solve(rows, active.size(), l)) return false;
    ReturnedStress r;
    r.count = active.size();
    for (std::size_t a = 0; a < active.size(); ++a) {
      if (!(l[a] >= 0.0)) return false;
      r.tensile += planes_[active[a]].tensile;
      for (std::size_t k = 0; k < r.plastic.size(); ++k)
        r.plastic[k] += l[a] * planes_[active[a]].flow[k];
    }
    const Principal relaxed = elastic_.stress(r.plastic);
    for (std::size_t k = 0; k < r.stress.size(); ++k) r.stress[k] = trial_[k] - relaxed[k];
    for (const YieldPlane& p : planes_)
      if (excess(p, r.stress) > rounding_) return false;
    found = r;
    return true;
  }

 private:
  const Principal& trial_;
  const IsotropicElasticity& elastic_;
  std::span<const YieldPlane> planes_;
  double rounding_;
};

}  // namespace

YieldPlane tensile_plane(std::size_t i, double limit) {
  YieldPlane p{{}, limit, {}, true};
  p.normal[i] = p.flow[i] = 1.0;
  return p;
}

ReturnedStress return_to_planes(const Principal& trial, const IsotropicElasticity& elastic,
                                std::span<const YieldPlane> planes, double rounding) {
  ReturnedStress found;
  found.stress = trial;
  if (std::none_of(planes.begin(), planes.end(),
                   [&](const YieldPlane& p) { return excess(p, trial) > 0.0; }))
    return found;
  const Return by(trial, elastic, planes, rounding);
  const std::size_t n = planes.size();
  for (std::size_t a = 0; a < n; ++a)
    if (const std::array active{a}; by.by(active, found)) return found;
  for (std::size_t a = 0; a < n; ++a) {
    for (std::size_t b = a + 1; b < n; ++b)
      if (const std::array active{a, b}; by.by(active, found)) return found;
  }
  for (std::size_t a = 0; a < n; ++a) {
    for (std::size_t b = a + 1; b < n; ++b) {
      for (std::size_t c = b + 1; c < n; ++c)
        if (const std::array active{a, b, c}; by.by(active, found)) return found;
    }
  }
  return found;
}

}  // namespace edda
