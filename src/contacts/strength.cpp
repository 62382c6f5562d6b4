#include "contacts/strength.hpp"

namespace edda {

LawTable divided_laws(const Model& model, const std::vector<double>& factors) {
  LawTable laws = build_laws(model);
  laws.divided_by = factors;
  for (std::size_t r = 0; r < laws.rows.size(); ++r) {
    Law& law = laws.rows[r];
    for (double* strength : {&law.peak_friction, &law.peak_cohesion, &law.peak_tension,
                             &law.residual_friction, &law.residual_cohesion, &law.residual_tension})
      *strength /= factors[r];
  }
  return laws;
}

void take_strength(FaceSet& c, const LawTable& before, const LawTable& now) {
  for (std::size_t k = 0; k < c.size(); ++k) {
    const std::size_t row = c.law[k];
    const double ratio = before.divided_by[row] / now.divided_by[row];
    if (ratio == 1.0) continue;
    c.friction[k] *= ratio;
    c.cohesion[k] *= ratio;
    c.tension[k] *= ratio;
  }
}

}  // namespace edda
