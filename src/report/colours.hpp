// Colours of pictures: perceptually uniform maps, and a palette for categories.
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

/// The k-th of a few light, clearly different colours, repeated from the first.
Colour kind_colour(std::size_t k);
inline constexpr std::size_t kind_colour_count = 8;

/// Colour of a contact's state (contact_states), different from the others and from plain blocks
/// for the colour-blind, too; open contacts have a rim.
Colour state_colour(std::size_t state);

}  // namespace edda
