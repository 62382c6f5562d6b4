#include "observe/fracture_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "contacts/face_softening.hpp"
#include "step/faces_now.hpp"

namespace edda {
namespace {

/// The faces of a law that may crack.
struct CrackedLaw {
  double longest = 0.0;                                   ///< m
  double zone = std::numeric_limits<double>::infinity();  ///< m, least l_ch
  double kn = std::numeric_limits<double>::infinity();    ///< Pa/m, least
  double ks = std::numeric_limits<double>::infinity();
};

/// E' of the softer of the two blocks of face k, Pa.
double plane_modulus(const Simulation& sim, std::size_t k) {
  const BlockSet& b = sim.scene->blocks;
  const Model& model = sim.scene->model;
  double least = std::numeric_limits<double>::infinity();
  for (const Id i :
       {block_of_edge(b, sim.motion.contacts, k), block_of_facing(b, sim.motion.contacts, k)}) {
    if (b.material[i] == none) continue;
    const Material& m = model.materials[static_cast<std::size_t>(b.material[i])];
    const double across = model.plane == Plane::strain ? 1.0 - m.poisson * m.poisson : 1.0;
    least = std::min(least, m.young / across);
  }
  return least;
}

CrackedLaw cracked_law(const Simulation& sim, std::size_t row) {
  const FaceSet& c = sim.motion.contacts;
  const LawTable& laws = sim.motion.laws;
  const JointLaw& law = sim.scene->model.joints[row];
  const double tension = law.peak.tensile_strength;
  CrackedLaw of;
  for (std::size_t k = 0; k < c.size(); ++k) {
    if (c.law[k] != row || !may_soften(c, laws, k)) continue;
    of.longest = std::max(of.longest, face_row(sim, k).state.length);
    of.zone = std::min(of.zone, plane_modulus(sim, k) * *law.fracture_energy / (tension * tension));
    of.kn = std::min(of.kn, c.stiffness[k] / laws.thickness);
    of.ks = std::min(of.ks, c.shear_stiffness[k] / laws.thickness);
  }
  return of;
}

}  // namespace

void warn_of_coarse_cracks(const Simulation& sim, std::vector<std::string>& warnings) {
  if (!sim.motion.laws.any_softens) return;
  const std::vector<JointLaw>& joints = sim.scene->model.joints;
  constexpr double most_of_zone = 1.0 / 3.0, most_of_crack = 0.1;
  for (std::size_t row = 0; row < joints.size(); ++row) {
    const Law& law = sim.motion.laws.rows[row];
    if (!law.softens) continue;
    const CrackedLaw of = cracked_law(sim, row);
    if (of.longest > most_of_zone * of.zone) {
      warnings.push_back(fmt::format(
          "{}: faces of up to {:.3g} m are long for its fracture process zone of {:.3g} m, so that "
          "the strength of the body depends on the size of its blocks: make the blocks so small "
          "that faces are at most a third of it, or raise fracture_energy",
          joints[row].where.key, of.longest, of.zone));
    }
    const double by_opening = law.peak_tension / of.kn / law.crack_opening,
                 by_slip = law.peak_cohesion / of.ks / law.crack_slip;
    if (std::max(by_opening, by_slip) > most_of_crack) {
      warnings.push_back(fmt::format(
          "{}: its springs {} by {:.2g} of what spends the fracture energy before the strength is "
          "reached, and from a third of it cracks would run in jumps: raise its {}",
          joints[row].where.key, by_opening > by_slip ? "open" : "slip",
          std::max(by_opening, by_slip), by_opening > by_slip ? "kn" : "ks"));
    }
  }
}

}  // namespace edda
