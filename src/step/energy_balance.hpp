// The energy balance in the leapfrog's own terms (theory, section 10): kinetic energy at half
// steps, stored energies as products of two neighbouring steps. In these terms it closes to
// rounding, except for what rotation and sliding along an edge create.
#pragma once

#include <iterator>

#include "attachments/boundary_springs.hpp"
#include "blocks/pose.hpp"
#include "blocks/state.hpp"
#include "contacts/face_set.hpp"
#include "integrate/leapfrog.hpp"
#include "step/faces_now.hpp"

namespace edda {

struct Simulation;

/// All in J.
struct EnergyBalance {
  double kinetic = 0.0, strain = 0.0, contact = 0.0;
  double gravity = 0.0;                                  ///< relative to t = 0
  double friction = 0.0, damping = 0.0, fracture = 0.0;  ///< dissipated, >= 0
  double external = 0.0;                                 ///< work done on the blocks
  double transfer = 0.0;     ///< removed by rules without a physical process
  double step_change = 0.0;  ///< removed by changes of the step
  double error = 0.0;        ///< balance less that at the start, over the largest scale so far

  double balance() const {
    return kinetic + strain + contact + gravity + friction + damping + fracture + transfer +
           step_change - external;
  }
  /// Reference for the error.
  double scale() const { return kinetic + strain + contact + friction + damping + fracture; }
};

/// Its terms, by the names that files give them.
struct EnergyTerm {
  const char* name;
  double EnergyBalance::*value;
};
inline constexpr EnergyTerm energy_terms[] = {{"kinetic", &EnergyBalance::kinetic},
                                              {"strain", &EnergyBalance::strain},
                                              {"contact", &EnergyBalance::contact},
                                              {"gravity", &EnergyBalance::gravity},
                                              {"friction", &EnergyBalance::friction},
                                              {"damping", &EnergyBalance::damping},
                                              {"fracture", &EnergyBalance::fracture},
                                              {"external", &EnergyBalance::external},
                                              {"step_change", &EnergyBalance::step_change},
                                              {"transfer", &EnergyBalance::transfer},
                                              {"drift", &EnergyBalance::error}};
static_assert(sizeof(EnergyBalance) == std::size(energy_terms) * sizeof(double),
              "a term is not listed");

/// Energy that rounding alone may store in springs and rock and release over a long run, J: all
/// blocks on the stiffest spring, stretched by 1e4 roundings of a coordinate, and lowered by as
/// much. Changes of energy below a part of it have no meaning.
double rounding_energy(const BlockSet& blocks, const FaceSet& contacts, Vec2 gravity);

/// All terms but the error, from positions at step n and velocities at the instant at which the
/// method has them.
EnergyBalance energy_balance(const Simulation& sim);
EnergyBalance energy_balance(const Simulation& sim, const FaceMeasures& faces);
/// The same with the error; updates Accounts::start_energy and largest_energy.
EnergyBalance account_energy(Simulation& sim);
EnergyBalance account_energy(Simulation& sim, const FaceMeasures& faces);
/// EnergyBalance::balance(), J.
double total_energy(const Simulation& sim);

/// Counts what changes from outside, between two steps, as external work: all that the total energy
/// gains while it exists, or until it is ended.
class AsExternalWork {
 public:
  explicit AsExternalWork(Simulation& sim);
  ~AsExternalWork() noexcept(false);
  AsExternalWork(const AsExternalWork&) = delete;
  AsExternalWork& operator=(const AsExternalWork&) = delete;
  void end();

 private:
  Simulation& sim_;
  double energy_;
  bool ended_ = false;
  int thrown_;
};

/// Reference for the error: the largest scale so far, not less than rounding_energy(), J.
double energy_scale(const Simulation& sim, const EnergyBalance& energy);

}  // namespace edda
