// Colours of pictures: maps whose steps look even, and a palette for kinds.
#pragma once

#include <cstddef>

namespace edda {

struct Colour {
  double r = 0.0, g = 0.0, b = 0.0;  ///< 0 to 1
};

/// Dark blue to yellow (viridis): even steps, readable in grey and by the colour-blind. s in [0,
/// 1].
Colour sequential(double s);

/// Blue over white to red: for values of both signs, 0 at s = 1/2.
Colour diverging(double s);

/// The k-th of a few light, well told apart colours, again from the first after the last.
Colour kind_colour(std::size_t k);
inline constexpr std::size_t kind_colour_count = 8;

/// Of a contact's state (contact_states): told apart from each other and from plain blocks by the
/// colour-blind, too; open ones have a rim.
Colour state_colour(std::size_t state);

}  // namespace edda
