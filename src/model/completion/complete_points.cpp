// contact.model = "points" is for comparison with the paper and has only what the paper has.
#include <string>

#include "model/completion/complete_tools.hpp"

namespace edda {
namespace {

void refuse(const Value* table, std::string_view key, const std::string& path, const char* what,
            Reading& reading) {
  add_fault(reading, place_of(table, key), path,
            std::string("contact.model = \"points\" is the paper's contact model, without ") + what,
            "leave it out, or use contact.model = \"faces\"");
}

void check_joint(const Value* node, const JointLaw& law, Reading& reading) {
  const auto unless = [&](bool known, const char* key, const char* what) {
    if (!known) refuse(node, key, law.where.key + "." + key, what, reading);
  };
  const Strength& after = law.residual;
  unless(law.type == LawType::coulomb, "type", "law but Coulomb's friction");
  unless(law.peak.cohesion == 0.0, "cohesion", "cohesion");
  unless(law.peak.tensile_strength == 0.0, "tensile_strength", "tensile strength");
  unless(after.friction_angle == law.peak.friction_angle && after.cohesion == 0.0 &&
             after.tensile_strength == 0.0,
         "residual", "residual strength");
  unless(!law.dilation_angle, "dilation_angle", "dilation");
  unless(!law.kn, "kn", "stiffness per area, but contact.normal_stiffness of a point");
  unless(law.kn || !law.ks, "ks", "stiffness per area, but contact.shear_stiffness of a point");
  unless(!law.restitution, "restitution", "restitution");
}

/// The place of the first element of a list, if any is given.
template <class Items>
void check_absent(const Value& root, const char* section, const Items& items, const char* what,
                  Reading& reading) {
  if (items.empty()) return;
  const Value* first = element(root, section, 0);
  refuse(first != nullptr ? first : &root, "", section, what, reading);
}

void check_solver(const Value* node, const Solver& solver, Reading& reading) {
  const auto unless = [&](bool known, const char* key, const char* what) {
    if (!known) refuse(node, key, std::string("solver.") + key, what, reading);
  };
  unless(solver.method == Method::edda, "method", "implicit method");
  unless(solver.mass_scaling == 0.0, "mass_scaling", "scaling of masses");
  if (solver.damping.contact > 0.0)
    refuse(find(node, "damping"), "contact", "solver.damping.contact", "dashpots", reading);
  if (solver.damping.adaptive > 0.0)
    refuse(find(node, "damping"), "adaptive", "solver.damping.adaptive", "adaptive damping",
           reading);
}

}  // namespace

void complete_points(const Value& root, Reading& reading) {
  Model& model = reading.model;
  if (model.contact.model != ContactModel::points) return;
  const Value* solver = find(&root, "solver");
  if (!given(solver, "switching")) {
    model.solver.switching = Switching::plain;
  } else if (model.solver.switching == Switching::exact) {
    refuse(solver, "switching", "solver.switching", "exact switching", reading);
  }
  for (const JointLaw& law : model.given_joints()) {
    check_joint(find(find(&root, "joints"), law.name), law, reading);
  }
  check_solver(solver, model.solver, reading);
  for (std::size_t q = 0; q < model.boundaries.size(); ++q) {
    const Boundary& boundary = model.boundaries[q];
    if (boundary.type == BoundaryType::fixed || boundary.type == BoundaryType::roller) continue;
    refuse(element(root, "boundary", q), "type", boundary.where.key + ".type",
           "boundaries but fixed and roller", reading);
  }
  if (model.initial_stress)
    refuse(&root, "initial_stress", "initial_stress", "initial stress", reading);
  if (model.fos) refuse(&root, "fos", "fos", "factor of safety", reading);
  check_absent(root, "water", model.waters, "water in joints", reading);
  check_absent(root, "shaking", model.shakings, "shaking", reading);
  check_absent(root, "stage", model.stages, "stages", reading);
  check_absent(root, "bolt", model.bolts, "bolts", reading);
  check_absent(root, "bolt_pattern", model.bolt_patterns, "bolts", reading);
}

}  // namespace edda
