#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "model/completion/complete_tools.hpp"
#include "model/table/slots.hpp"

namespace edda {
namespace {

/// Keys that each type of joint needs, and those that do not apply to it.
void check_law_keys(const Value* node, const JointLaw& law, Reading& reading) {
  constexpr LawType C = LawType::coulomb, S = LawType::slip_weakening, B = LawType::barton_bandis;
  struct LawKey {
    const char* key;
    std::vector<LawType> types, required;
  };
  const LawKey keys[] = {{"friction_angle", {C, S, B, LawType::glued}, {C, S}},
                         {"dilation_angle", {C, S}, {}},
                         {"slip_distance", {C, S}, {S}},
                         {"decay_time", {C, S}, {}},
                         {"fracture_energy", {C}, {}},
                         {"shear_fracture_energy", {C}, {}},
                         {"jrc", {B}, {B}},
                         {"jcs", {B}, {B}},
                         {"residual_angle", {B}, {B}}};
  const auto among = [&](const std::vector<LawType>& types) {
    return std::find(types.begin(), types.end(), law.type) != types.end();
  };
  const std::string type(law_names[static_cast<std::size_t>(law.type)]);
  for (const LawKey& k : keys) {
    const Value* value = find(node, k.key);
    const std::string path = law.where.key + "." + k.key;
    if (value != nullptr && !among(k.types)) {
      add_fault(reading, value->place, path, "does not apply to type \"" + type + '"',
                "leave it out, or give another type");
    } else if (value == nullptr && among(k.required)) {
      add_fault(reading, node->place, path, "is missing",
                "give " + expected(*find_key(find_section("joints")->keys, k.key)) +
                    (law.type == C ? ", or type = \"glued\"" : ""));
    }
  }
  if (law.type == C && law.slip_distance && !law.dilation_angle) {
    add_fault(reading, find(node, "slip_distance")->place, law.where.key + ".slip_distance",
              "has no effect without a dilation_angle or type = \"slip-weakening\"",
              "give one of them, or leave it out");
  }
  const double least = std::min(law.peak.friction_angle, law.residual.friction_angle);
  if (law.dilation_angle && *law.dilation_angle >= least) {
    add_fault(
        reading, place_of(node, "dilation_angle"), law.where.key + ".dilation_angle",
        fmt::format(
            "is not below the friction angle of {:.6g} degrees: the joint would create energy",
            least),
        "give less");
  }
}

/// Fracture energy needs the strength that it lets fall, to friction alone.
void check_fracture(const Value* node, const JointLaw& law, Reading& reading) {
  if (law.type != LawType::coulomb || (!law.fracture_energy && !law.shear_fracture_energy)) return;
  const bool tension = law.fracture_energy.has_value();
  const char* const key = tension ? "fracture_energy" : "shear_fracture_energy";
  const auto refuse = [&](std::string problem, std::string remedy) {
    add_fault(reading, place_of(node, key), law.where.key + "." + key, std::move(problem),
              std::move(remedy));
  };
  const Strength &peak = law.peak, &after = law.residual;
  const bool both = given(node, "fracture_energy") && given(node, "shear_fracture_energy");
  if (!both) {
    refuse("is given alone: a crack may open and slip, and needs the energies of both",
           std::string("give ") + (tension ? "shear_fracture_energy" : "fracture_energy") +
               ", too; in rock that of shear is some 10 times that of tension");
  } else if (!(peak.tensile_strength > 0.0) || !(peak.cohesion > 0.0)) {
    refuse("needs a strength that falls", "give tensile_strength and cohesion above 0");
  } else if (after.cohesion > 0.0 || after.tensile_strength > 0.0 ||
             after.friction_angle != peak.friction_angle) {
    refuse("lets the strength fall to that of friction, and does not go with another residual one",
           "leave out residual, or the fracture energies");
  } else if (law.dilation_angle) {
    refuse("does not go with a dilation_angle", "leave out one of them");
  } else if (reading.model.solver.method == Method::dda) {
    refuse("is not available with method = \"dda\"",
           "use method = \"edda\", or leave out the fracture energies");
  }
}

/// Strength that falls with time needs one to which it falls.
void check_decay(const Value* node, const JointLaw& law, Reading& reading) {
  const bool has_peak = law.type == LawType::coulomb || law.type == LawType::slip_weakening;
  if (!law.decay_time || !has_peak) return;
  const auto refuse = [&](std::string problem, std::string remedy) {
    add_fault(reading, place_of(node, "decay_time"), law.where.key + ".decay_time",
              std::move(problem), std::move(remedy));
  };
  const Strength &peak = law.peak, &after = law.residual;
  if (law.fracture_energy) {
    refuse("does not go with a fracture_energy", "leave out one of them");
  } else if (reading.model.solver.method == Method::dda) {
    refuse("is not available with method = \"dda\"", "use method = \"edda\", or leave it out");
  } else if (peak.friction_angle <= after.friction_angle && peak.cohesion <= after.cohesion &&
             peak.tensile_strength <= after.tensile_strength) {
    refuse("leaves the strength as it is, which is the residual one",
           "give residual = { friction_angle = ... }, or cohesion");
  }
}

/// Barton-Bandis joints have only the strength that follows from jrc, jcs and residual_angle; a
/// written model states this.
void check_no_strength(const Value* node, const JointLaw& law, Reading& reading) {
  const auto refuse = [&](const char* key) {
    add_fault(reading, find(node, key)->place, law.where.key + "." + key,
              "does not apply to type \"barton-bandis\"",
              "leave it out: jrc, jcs and residual_angle give the strength of the joint");
  };
  const Strength& peak = law.peak;
  const double angle = law.residual_angle.value_or(peak.friction_angle);
  if (given(node, "friction_angle") && peak.friction_angle != angle) refuse("friction_angle");
  if (peak.cohesion != 0.0) refuse("cohesion");
  if (peak.tensile_strength != 0.0) refuse("tensile_strength");
  const Strength& after = law.residual;
  const bool same =
      !given(find(node, "residual"), "friction_angle") || after.friction_angle == angle;
  if (!same || after.cohesion != 0.0 || after.tensile_strength != 0.0) refuse("residual");
}

/// Restitution needs the dashpots of the explicit method, and blocks that separate.
void check_restitution(const Value* node, const JointLaw& law, Reading& reading) {
  if (!law.restitution) return;
  const auto refuse = [&](std::string problem, std::string remedy) {
    add_fault(reading, place_of(node, "restitution"), law.where.key + ".restitution",
              std::move(problem), std::move(remedy));
  };
  if (reading.model.solver.method == Method::dda) {
    refuse(
        "belongs to method = \"edda\": the implicit method dissipates its own part of every impact",
        "use method = \"edda\", or leave it out");
  } else if (law.type == LawType::glued) {
    refuse("does not apply to type \"glued\": these contacts never open",
           "leave it out, or give another type");
  }
}

void complete_strength(const Value* node, JointLaw& law, Reading& reading) {
  const Value* type = find(node, "type");
  const bool known = type == nullptr || std::holds_alternative<std::string>(type->content);
  if (law.type == LawType::barton_bandis) {
    check_no_strength(node, law, reading);
    law.peak = law.residual = {law.residual_angle.value_or(0.0), 0.0, 0.0};
  } else if (!given(find(node, "residual"), "friction_angle")) {
    law.residual.friction_angle = law.peak.friction_angle;
  }
  if (known) {
    check_law_keys(node, law, reading);
    check_fracture(node, law, reading);
    check_decay(node, law, reading);
  }
  const bool more = law.type == LawType::slip_weakening || law.type == LawType::barton_bandis ||
                    law.dilation_angle;
  if (more && reading.model.solver.method == Method::dda) {
    add_fault(reading, node->place, law.where.key,
              "slip-weakening, barton-bandis and dilation are not available with method = \"dda\"",
              "use method = \"edda\", or Coulomb friction");
  }
}

}  // namespace

void complete_joints(const Value& root, Reading& reading) {
  auto& joints = reading.model.joints;
  constexpr std::size_t most = 65535;  // a contact keeps its law in 16 bits
  if (joints.size() > most) {
    add_fault(reading, find(&root, "joints")->place, "joints",
              fmt::format("has {} laws, more than {}", joints.size(), most),
              "let edges of similar strength share a law");
    return;
  }
  for (JointLaw& law : joints) {
    const Value* node = find(find(&root, "joints"), law.name);
    complete_strength(node, law, reading);
    check_restitution(node, law, reading);
    constexpr double shear_over_normal = 0.4;
    if (law.kn && !law.ks && !given(node, "ks")) law.ks = fitted(shear_over_normal * *law.kn);
  }
}

}  // namespace edda
