// Contacts that chatter: they open and close without end where they ought to rest or slide.
#pragma once

#include <cstdint>
#include <vector>

#include "run/simulation.hpp"

namespace edda {

/// What contacts did in a window of some hundred steps, and how often they have chattered so far.
struct Chatter {
  std::vector<double> sum, squares;       ///< [nc] of N over the looks of the window, N, N2
  std::vector<Id> before;                 ///< [nc] switches before it
  std::uint64_t looks = 0, rebuilds = 0;  ///< of the window; of the list it belongs to
  std::uint64_t count = 0;                ///< switches in windows in which their contact chattered
  std::uint64_t worst = 0;                ///< most of one contact in a window
  Id block_i = no_id, block_j = no_id;    ///< its blocks
  double time = 0.0;                      ///< s, end of that window
};

/// A contact chatters in a window in which it opens or closes again and again, and in which its
/// spring stores more than twice what the mean force would: a block that rests or slides smoothly
/// does neither, one that strikes and bounces does not do it for so long. Not in stages until
/// equilibrium, whose motion means nothing. Once every few steps.
void look_for_chatter(Chatter& chatter, const Simulation& sim);

}  // namespace edda
