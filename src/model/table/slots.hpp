// Slots made from pointers to members: at<&Material::young> gives access to the field that a key
// fills, whatever its type; at<&JointLaw::peak, &Strength::cohesion> goes through a member.
#pragma once

#include <array>
#include <string_view>
#include <type_traits>

#include "model/table/keys.hpp"

namespace edda {

// Names of the values of each enumeration, in the order of the enumeration.
inline constexpr std::array<std::string_view, 2> plane_names{"strain", "stress"};
inline constexpr std::array<std::string_view, 2> method_names{"edda", "dda"};
inline constexpr std::array<std::string_view, 4> deformation_names{"auto", "corners", "uniform",
                                                                   "zones"};
inline constexpr std::array<std::string_view, 3> mass_names{"matched", "covering", "consistent"};
inline constexpr std::array<std::string_view, 2> switching_names{"exact", "plain"};
inline constexpr std::array<std::string_view, 2> contact_model_names{"faces", "points"};
inline constexpr std::array<std::string_view, 4> law_names{"coulomb", "glued", "slip-weakening",
                                                           "barton-bandis"};
inline constexpr std::array<std::string_view, 3> stage_end_names{"time", "equilibrium", "collapse"};
inline constexpr std::array<std::string_view, 1> hold_names{"equilibrium"};
inline constexpr std::array<std::string_view, 2> stage_joint_names{"as given", "glued"};
inline constexpr std::array<std::string_view, 2> stage_mass_names{"as given", "scaled"};
inline constexpr std::array<std::string_view, 2> falling_names{"report", "wait"};
inline constexpr std::array<std::string_view, 2> loose_names{"go on", "stop"};
inline constexpr std::array<std::string_view, 2> spread_names{"uniform", "normal"};
inline constexpr std::array<std::string_view, 3> joint_spread_names{"uniform", "normal",
                                                                    "exponential"};
inline constexpr std::array<std::string_view, 4> length_names{"lognormal", "power", "constant",
                                                              "exponential"};
inline constexpr std::array<std::string_view, 3> network_names{"traces", "baecher", "veneziano"};
inline constexpr std::array<std::string_view, 4> shape_names{"arch", "circle", "rectangle",
                                                             "horseshoe"};
inline constexpr std::array<std::string_view, 2> import_as_names{"lines", "blocks"};
inline constexpr std::array<std::string_view, 6> unit_names{"m", "mm", "cm", "km", "ft", "in"};
inline constexpr std::array<std::string_view, 3> action_names{"merge", "report", "error"};
inline constexpr std::array<std::string_view, 7> boundary_names{
    "fixed", "roller", "viscous", "stress", "velocity", "free-field", "displacement"};
inline constexpr std::array<std::string_view, 3> shaking_names{"base", "inertia", "upgoing"};
inline constexpr std::array<std::string_view, 6> acceleration_unit_names{
    "as stated", "m/s2", "g", "cm/s2", "gal", "mm/s2"};
inline constexpr std::array<std::string_view, 2> bolt_names{"grouted", "end"};
inline constexpr std::array<std::string_view, 2> surface_names{"level", "outline"};
inline constexpr std::array<std::string_view, 4> side_names{"left", "right", "bottom", "top"};

constexpr std::span<const std::string_view> names_of(Plane) {
  return plane_names;
}
constexpr std::span<const std::string_view> names_of(Method) {
  return method_names;
}
constexpr std::span<const std::string_view> names_of(BlockDeformation) {
  return deformation_names;
}
constexpr std::span<const std::string_view> names_of(MassKind) {
  return mass_names;
}
constexpr std::span<const std::string_view> names_of(Switching) {
  return switching_names;
}
constexpr std::span<const std::string_view> names_of(ContactModel) {
  return contact_model_names;
}
constexpr std::span<const std::string_view> names_of(LawType) {
  return law_names;
}
constexpr std::span<const std::string_view> names_of(StageEnd) {
  return stage_end_names;
}
constexpr std::span<const std::string_view> names_of(HoldFor) {
  return hold_names;
}
constexpr std::span<const std::string_view> names_of(StageJoints) {
  return stage_joint_names;
}
constexpr std::span<const std::string_view> names_of(StageMasses) {
  return stage_mass_names;
}
constexpr std::span<const std::string_view> names_of(FallingBlocks) {
  return falling_names;
}
constexpr std::span<const std::string_view> names_of(LooseBlocks) {
  return loose_names;
}
constexpr std::span<const std::string_view> names_of(BoundaryType) {
  return boundary_names;
}
constexpr std::span<const std::string_view> names_of(Spread) {
  return spread_names;
}
constexpr std::span<const std::string_view> names_of(JointSpread) {
  return joint_spread_names;
}
constexpr std::span<const std::string_view> names_of(LengthKind) {
  return length_names;
}
constexpr std::span<const std::string_view> names_of(NetworkModel) {
  return network_names;
}
constexpr std::span<const std::string_view> names_of(ShapeKind) {
  return shape_names;
}
constexpr std::span<const std::string_view> names_of(AccelerationUnit) {
  return acceleration_unit_names;
}
constexpr std::span<const std::string_view> names_of(ImportAs) {
  return import_as_names;
}
constexpr std::span<const std::string_view> names_of(LengthUnit) {
  return unit_names;
}
constexpr std::span<const std::string_view> names_of(QualityAction) {
  return action_names;
}
constexpr std::span<const std::string_view> names_of(ShakingKind) {
  return shaking_names;
}
constexpr std::span<const std::string_view> names_of(BoltType) {
  return bolt_names;
}
constexpr std::span<const std::string_view> names_of(SurfaceKind) {
  return surface_names;
}

// Keys of the tables inside a key.
std::span<const Key> keys_of(const RockStrength&);
std::span<const Key> keys_of(const Yield&);
std::span<const Key> keys_of(const RockMass&);
std::span<const Key> keys_of(const FoliationInputs&);
std::span<const Key> keys_of(const Strength&);
std::span<const Key> keys_of(const Damping&);
std::span<const Key> keys_of(const Rayleigh&);
std::span<const Key> keys_of(const LiningResidual&);
std::span<const Key> keys_of(const Deviation&);
std::span<const Key> keys_of(const AngleSpread&);
std::span<const Key> keys_of(const LengthSpread&);
std::span<const Key> keys_of(const OpeningShape&);
std::span<const Key> keys_of(const Acceleration&);
std::span<const Key> keys_of(const BoltBond&);
std::span<const Key> keys_of(const BoltDowel&);
std::span<const Key> keys_of(const FosFails&);
std::span<const Key> keys_of(const Ramp&);
std::span<const Key> keys_of(const PropertyChange&);

template <class Field>
Slot slot_of(Field& field) {
  if constexpr (std::is_enum_v<Field>) {
    return Choice{names_of(field), &field,
                  [](const void* f) { return static_cast<int>(*static_cast<const Field*>(f)); },
                  [](void* f, int value) { *static_cast<Field*>(f) = static_cast<Field>(value); }};
  } else if constexpr (requires { keys_of(field); }) {
    SubTable table{keys_of(field), &field, nullptr, nullptr, nullptr};
    if constexpr (requires { field.file; }) table.file = &field.file;
    return table;
  } else if constexpr (requires { keys_of(*field); }) {
    return SubTable{keys_of(typename Field::value_type{}), field ? &*field : nullptr, &field,
                    [](void* f) -> void* { return &static_cast<Field*>(f)->emplace(); }, nullptr};
  } else if constexpr (requires { keys_of(field.front()); }) {
    using Item = typename Field::value_type;
    return TableList{keys_of(Item{}),
                     &field,
                     [](const void* f) { return static_cast<const Field*>(f)->size(); },
                     [](void* f, std::size_t i) -> void* { return &(*static_cast<Field*>(f))[i]; },
                     [](void* f) -> void* { return &static_cast<Field*>(f)->emplace_back(); },
                     [](void* object) { return &static_cast<Item*>(object)->where; }};
  } else {
    return &field;
  }
}

template <class Owner, class Member>
Owner owner_of(Member Owner::*);

template <auto first, auto... rest>
Slot at(void* object) {
  using Owner = decltype(owner_of(first));
  auto& field = static_cast<Owner*>(object)->*first;
  return slot_of((field.*....*rest));
}

/// Access to the objects of a section through the member of Model, or of another root, that holds
/// them.
template <auto member>
struct Held {
  using Root = decltype(owner_of(member));
  using Type = std::remove_reference_t<decltype(std::declval<Root&>().*member)>;
  static constexpr bool is_list = requires(Type t) { t.emplace_back(); };
  static constexpr bool is_optional = requires(Type t) { t.has_value(); };

  static Type& in(void* root) { return static_cast<Root*>(root)->*member; }
  static std::size_t count(const void* root) {
    const Type& held = static_cast<const Root*>(root)->*member;
    if constexpr (is_list) {
      return held.size();
    } else if constexpr (is_optional) {
      return held.has_value() ? 1 : 0;
    } else {
      return 1;
    }
  }
  static void* add(void* root) {
    if constexpr (is_list) {
      return &in(root).emplace_back();
    } else if constexpr (is_optional) {
      return &in(root).emplace();
    } else {
      return &in(root);
    }
  }
  static void* at(void* root, std::size_t i) {
    if constexpr (is_list) {
      return &in(root)[i];
    } else if constexpr (is_optional) {
      return &*in(root);
    } else {
      return &in(root);
    }
  }
};

template <auto member>
auto object_type() {
  using Type = typename Held<member>::Type;
  if constexpr (Held<member>::is_list || Held<member>::is_optional) {
    return std::type_identity<typename Type::value_type>{};
  } else {
    return std::type_identity<Type>{};
  }
}

template <auto member>
constexpr Section section(std::string_view name, Shape shape, std::span<const Key> keys,
                          std::string_view meaning) {
  using Object = typename decltype(object_type<member>())::type;
  Section s{name,
            shape,
            Held<member>::is_optional,
            keys,
            meaning,
            &Held<member>::count,
            &Held<member>::add,
            &Held<member>::at,
            nullptr,
            nullptr};
  if constexpr (requires(Object o) { o.where; }) {
    s.where = [](void* o) { return &static_cast<Object*>(o)->where; };
  }
  if constexpr (requires(Object o) { o.name; }) {
    if (shape == Shape::named) {
      s.name_of = [](void* o) { return &static_cast<Object*>(o)->name; };
    }
  }
  return s;
}

/// The keys outside any table.
constexpr Section root_section(std::span<const Key> keys, std::string_view meaning) {
  return {"",
          Shape::root,
          false,
          keys,
          meaning,
          [](const void*) { return std::size_t{1}; },
          [](void* root) { return root; },
          [](void* root, std::size_t) { return root; },
          nullptr,
          nullptr};
}

}  // namespace edda
