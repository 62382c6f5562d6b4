#include "model/table/synonyms.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>

namespace edda {
namespace {

// clang-format off
constexpr std::array other_words{
    // Fixities and boundaries.
    Synonym{"held", "block.fixed", ""},
    Synonym{"fix", "block.fixed fixed boundary", ""},
    Synonym{"fixity", "block.fixed fixed boundary", ""},
    Synonym{"fixed_block", "block.fixed fixed", ""},
    Synonym{"anchor", "bolt block.fixed", ""},
    Synonym{"clamp", "block.fixed fixed boundary", ""},
    Synonym{"boundary_condition", "boundary", ""},
    Synonym{"boundary_conditions", "boundary", ""},
    Synonym{"bc", "boundary", ""},
    Synonym{"boundary_xvel", "boundary", "a side without displacement normal to it has type = \"roller\", one that moves type = \"velocity\""},
    Synonym{"boundary_yvel", "boundary", "a side without displacement normal to it has type = \"roller\", one that moves type = \"velocity\""},
    Synonym{"xvel", "boundary.velocity block.velocity", ""},
    Synonym{"yvel", "boundary.velocity block.velocity", ""},
    Synonym{"xfix", "boundary", "with type = \"roller\""},
    Synonym{"yfix", "boundary", "with type = \"roller\""},
    Synonym{"roller", "boundary", "with type = \"roller\""},
    Synonym{"platen", "boundary", "with type = \"velocity\", and frictionless = true where it is smooth"},
    Synonym{"viscous", "boundary", "with type = \"viscous\""},
    Synonym{"quiet", "boundary", "with type = \"viscous\""},
    Synonym{"ff", "boundary", "with type = \"free-field\""},
    Synonym{"free_field", "boundary", "with type = \"free-field\""},
    Synonym{"boundary_stress", "boundary.traction", "with type = \"stress\""},
    // Support.
    Synonym{"support", "bolt bolt_pattern boundary", "[[bolt]] where steel supports the rock, [[boundary]] or fixed = true where the model ends"},
    Synonym{"cable", "bolt", ""},
    Synonym{"rockbolt", "bolt", ""},
    Synonym{"rock_bolt", "bolt", ""},
    Synonym{"anchors", "bolt", ""},
    Synonym{"head", "bolt.from", ""},
    Synonym{"toe", "bolt.to", ""},
    Synonym{"dowels", "bolt", "with a dowel and no pretension"},
    Synonym{"reinforcement", "bolt", ""},
    Synonym{"struct", "lining bolt bolt_pattern", ""},
    Synonym{"structure", "lining bolt bolt_pattern", ""},
    Synonym{"beam", "lining", ""},
    Synonym{"liner", "lining", ""},
    Synonym{"steel_set", "lining", "with area, inertia and spacing"},
    Synonym{"rib", "lining", "with area, inertia and spacing"},
    Synonym{"shotcrete", "lining", ""},
    Synonym{"backfill", "fill", ""},
    Synonym{"paste", "fill", ""},
    // Stress, loads and water.
    Synonym{"insitu", "initial_stress", ""},
    Synonym{"in_situ", "initial_stress", ""},
    Synonym{"in_situ_stress", "initial_stress", ""},
    Synonym{"insitu_stress", "initial_stress", ""},
    Synonym{"far_field_stress", "initial_stress", ""},
    Synonym{"prestress", "initial_stress bolt.pretension", ""},
    Synonym{"szz", "initial_stress.k0_out", ""},
    Synonym{"ini", "initial_stress block.velocity", ""},
    Synonym{"initial", "initial_stress block.velocity", ""},
    Synonym{"grav", "gravity", ""},
    Synonym{"apply", "load boundary", ""},
    Synonym{"at", "load.point monitor.point fixed.point", ""},
    Synonym{"surcharge", "load.pressure", ""},
    Synonym{"pore_pressure", "water", ""},
    Synonym{"pp", "water", ""},
    Synonym{"water_table", "water.table", ""},
    Synonym{"groundwater", "water", ""},
    Synonym{"phreatic", "water.table", ""},
    Synonym{"earthquake", "shaking", ""},
    Synonym{"seismic", "shaking", ""},
    Synonym{"accelerogram", "shaking.acceleration", ""},
    // Geometry.
    Synonym{"zone", "", "blocks are not divided into zones: a block has one stress; smaller blocks ([voronoi], glued joints) show how stress varies"},
    Synonym{"gridpoint", "monitor", "there are no gridpoints: a point of a block is a monitor"},
    Synonym{"gp", "monitor", "there are no gridpoints: a point of a block is a monitor"},
    Synonym{"grid", "domain", ""},
    Synonym{"mesh", "domain", "its joints cut it into blocks"},
    Synonym{"block_create", "domain block", ""},
    Synonym{"block_cut", "joint_set trace", "which cut the [domain]"},
    Synonym{"jset", "joint_set", ""},
    Synonym{"jregion", "joint_set.region", ""},
    Synonym{"joint_regions", "joint_set.region", ""},
    Synonym{"crack", "trace", ""},
    Synonym{"fault", "trace", ""},
    Synonym{"fracture", "trace fracture_network", ""},
    Synonym{"dfn", "fracture_network", ""},
    Synonym{"tunnel", "opening", ""},
    Synonym{"excavation", "opening stage.excavate", "an [[opening]] that a [[stage]] excavates"},
    Synonym{"delete", "opening stage.excavate", ""},
    Synonym{"null", "opening stage.excavate", ""},
    Synonym{"range", "region.polygon joint_set.region", ""},
    Synonym{"group", "region", ""},
    Synonym{"edge", "domain.snap quality.min_edge", ""},
    Synonym{"round", "", "corners are sharp and need no rounding: leave it out"},
    Synonym{"rounding", "", "corners are sharp and need no rounding: leave it out"},
    Synonym{"vertices", "block.polygon domain.outline", ""},
    Synonym{"std", "joint_set.deviation", ""},
    Synonym{"stdev", "joint_set.deviation", ""},
    Synonym{"std_dev", "joint_set.deviation", ""},
    Synonym{"standard_deviation", "joint_set.deviation", ""},
    Synonym{"scatter", "joint_set.deviation", ""},
    Synonym{"dip", "joint_set.deviation.angle", ""},
    Synonym{"dipdir", "joint_set.dip_direction", ""},
    Synonym{"dd", "joint_set.dip_direction", ""},
    // Materials.
    Synonym{"material", "materials", "[materials.NAME], one for each"},
    Synonym{"prop", "materials joints", ""},
    Synonym{"property", "materials joints", ""},
    Synonym{"bulk", "materials.young materials.poisson", "young = 9 K G/(3 K + G), poisson = (3 K - 2 G)/(6 K + 2 G)"},
    Synonym{"bulk_modulus", "materials.young materials.poisson", "young = 9 K G/(3 K + G), poisson = (3 K - 2 G)/(6 K + 2 G)"},
    Synonym{"shear", "materials.young materials.poisson", "young = 9 K G/(3 K + G), poisson = (3 K - 2 G)/(6 K + 2 G)"},
    Synonym{"shear_modulus", "materials.young materials.poisson", "young = 9 K G/(3 K + G), poisson = (3 K - 2 G)/(6 K + 2 G)"},
    Synonym{"youngs_modulus", "materials.young", ""},
    Synonym{"elastic_modulus", "materials.young", ""},
    Synonym{"modulus", "materials.young", ""},
    Synonym{"emod", "materials.young", ""},
    Synonym{"e", "materials.young", ""},
    Synonym{"nu", "materials.poisson", ""},
    Synonym{"dens", "materials.density", ""},
    Synonym{"rho", "materials.density", ""},
    Synonym{"gamma", "materials.unit_weight", ""},
    Synonym{"sigci", "materials.strength", "with ucs and tension"},
    Synonym{"ucs", "materials.strength", "strength = { ucs = ..., tension = ... }"},
    // Joints.
    Synonym{"joint", "joints", "[joints.NAME], one for each; joint = \"NAME\" in what has it"},
    Synonym{"joint_model", "joints.type", ""},
    Synonym{"jmodel", "joints.type", ""},
    Synonym{"jcons", "joints.type", ""},
    Synonym{"jmat", "joints", ""},
    Synonym{"mat", "materials", ""},
    Synonym{"law", "joints", ""},
    Synonym{"jkn", "joints.kn", ""},
    Synonym{"jks", "joints.ks", ""},
    Synonym{"normal_stiffness_joint", "joints.kn", ""},
    Synonym{"jfric", "joints.friction_angle", ""},
    Synonym{"phi", "joints.friction_angle", ""},
    Synonym{"mu", "joints.friction_angle", "in degrees: the arc tangent of the coefficient"},
    Synonym{"friction_coefficient", "joints.friction_angle", "in degrees: the arc tangent of the coefficient"},
    Synonym{"jcoh", "joints.cohesion", ""},
    Synonym{"c", "joints.cohesion", ""},
    Synonym{"jtens", "joints.tensile_strength", ""},
    Synonym{"tension", "joints.tensile_strength materials.strength", ""},
    Synonym{"tensile", "joints.tensile_strength", ""},
    Synonym{"jdil", "joints.dilation_angle", ""},
    Synonym{"dilation", "joints.dilation_angle", ""},
    Synonym{"dilatancy", "joints.dilation_angle", ""},
    Synonym{"resfric", "joints.residual", "residual = { friction_angle = ... }"},
    Synonym{"penalty", "contact.normal_stiffness", ""},
    // The run.
    Synonym{"cycle", "solver.duration stage.until", "a run goes on for its duration, or until = \"equilibrium\""},
    Synonym{"cycles", "solver.duration stage.until", "a run goes on for its duration, or until = \"equilibrium\""},
    Synonym{"step", "solver.duration stage.until", "a run goes on for its duration, or until = \"equilibrium\""},
    Synonym{"steps", "solver.duration stage.until", "a run goes on for its duration, or until = \"equilibrium\""},
    Synonym{"solve", "stage.until", "a [[stage]] with until = \"equilibrium\""},
    Synonym{"solve_ratio", "stage.ratio", ""},
    Synonym{"equilibrium", "stage.until", "until = \"equilibrium\""},
    Synonym{"end_time", "solver.duration", ""},
    Synonym{"total_time", "solver.duration", ""},
    Synonym{"time", "solver.duration", ""},
    Synonym{"dt", "solver.time_step", ""},
    Synonym{"timestep", "solver.time_step", ""},
    Synonym{"mscale", "solver.mass_scaling stage.masses", ""},
    Synonym{"damp", "solver.damping", "for instance damping = { contact = 0.1 }; a [[stage]] with until = \"equilibrium\" brings its own"},
    Synonym{"local", "solver.damping.local", "damping = { local = 0.8 }; it falsifies all motion, and a [[stage]] with until = \"equilibrium\" needs none"},
    Synonym{"local_damping", "solver.damping.local", "damping = { local = 0.8 }; it falsifies all motion, and a [[stage]] with until = \"equilibrium\" needs none"},
    Synonym{"rayleigh", "solver.damping.rayleigh", "damping = { rayleigh = { fraction = 0.02, frequency = \"2 Hz\" } }; materials.NAME.rayleigh is that of one material"},
    Synonym{"gravity_loading", "gravity", ""},
    Synonym{"factor_of_safety", "fos", "edda fos finds it"},
    Synonym{"srf", "fos stage.strength_factor", "edda fos finds it"},
    Synonym{"ssr", "fos", "edda fos finds it"},
    // Output.
    Synonym{"hist", "monitor output.history_every", ""},
    Synonym{"history", "monitor output.history_every", ""},
    Synonym{"histories", "monitor output.history_every", ""},
    Synonym{"measure", "measurement monitor convergence", ""},
    Synonym{"extensometer", "convergence", ""},
    Synonym{"points", "convergence.between", ""},
    Synonym{"plot", "", "pictures are drawn of results: edda plot"},
    Synonym{"save", "output.checkpoint_every output.stages", ""},
    Synonym{"restore", "", "edda run --resume or --from STAGE goes on from a checkpoint"},
    Synonym{"config", "solver", ""},
    Synonym{"set", "solver", ""},
    Synonym{"new", "", "every file is a model of its own: leave it out"},
};
// clang-format on

/// The text in lower case, with "_" between words.
std::string plain(std::string_view word) {
  std::string text(word);
  for (char& c : text) {
    c = c == '-' || c == ' ' ? '_' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return text;
}

const Synonym* find_synonym(std::string_view word) {
  const std::string asked = plain(word);
  const auto found = std::find_if(other_words.begin(), other_words.end(),
                                  [&](const Synonym& s) { return s.word == asked; });
  return found == other_words.end() ? nullptr : &*found;
}

std::vector<std::string_view> words_of(std::string_view text) {
  std::vector<std::string_view> words;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(' '), text.size());
    words.push_back(text.substr(0, end));
    text.remove_prefix(std::min(text.size(), end + 1));
  }
  return words;
}

/// The key with that dotted name; null where it is the name of a table.
const Key* key_at(std::string_view dotted) {
  const std::size_t dot = dotted.find('.');
  const Section* section = find_section(dotted.substr(0, dot));
  if (section == nullptr || dot == std::string_view::npos) return nullptr;
  const std::string_view rest = dotted.substr(dot + 1);
  const std::size_t inner = rest.find('.');
  const Key* key = find_key(section->keys, rest.substr(0, inner));
  if (key == nullptr || inner == std::string_view::npos) return key;
  Model model;
  return find_key(inner_keys_of(key->slot(section->add(&model))), rest.substr(inner + 1));
}

bool is_among(const Key* key, std::span<const Key> keys) {
  return std::any_of(keys.begin(), keys.end(), [&](const Key& k) { return &k == key; });
}

}  // namespace

std::span<const Synonym> synonyms() {
  return other_words;
}

std::string in_file(const Section& section) {
  const char* form = section.shape == Shape::list    ? "[[{}]]"
                     : section.shape == Shape::named ? "[{}.NAME]"
                                                     : "[{}]";
  return fmt::format(fmt::runtime(form), section.name);
}

std::string named_in_file(std::string_view dotted_key) {
  const std::size_t dot = dotted_key.find('.');
  const Section* section = find_section(dotted_key.substr(0, dot));
  if (section == nullptr) return std::string(dotted_key);
  const std::string name = in_file(*section);
  if (dot == std::string_view::npos) return name;
  return fmt::format("{} of {}", dotted_key.substr(dot + 1), name);
}

std::vector<const Key*> keys_called(std::string_view word, std::span<const Key> keys) {
  const Synonym* found = find_synonym(word);
  std::vector<const Key*> called;
  if (found == nullptr) return called;
  for (const std::string_view dotted : words_of(found->keys)) {
    const Key* key = key_at(dotted);
    if (is_among(key, keys)) called.push_back(key);
  }
  return called;
}

std::string synonym_hint(std::string_view word, std::span<const Key> keys) {
  const Synonym* found = find_synonym(word);
  if (found == nullptr) return {};
  const bool here = !keys_called(word, keys).empty();
  std::vector<std::string> names;
  for (const std::string_view dotted : words_of(found->keys)) {
    if (!here || is_among(key_at(dotted), keys)) names.push_back(named_in_file(dotted));
  }
  if (names.empty()) return std::string(found->note);
  std::string text = "here that is ";
  for (std::size_t i = 0; i < names.size(); ++i) {
    text += (i == 0 ? "" : i + 1 == names.size() ? " or " : ", ") + names[i];
  }
  return found->note.empty() ? text : fmt::format("{}: {}", text, found->note);
}

}  // namespace edda
