// Contacts that chatter: they open and close again and again where they should stay closed or
// slide (theory, section 9.9).
#pragma once

#include <cstdint>
#include <vector>

#include "step/simulation.hpp"

namespace edda {

/// Contact forces and events in a window of some hundred steps, and the count of chatter so far.
struct Chatter {
  std::vector<double> sum, squares;       ///< [nf] sums of the normal force over the samples since
                                          ///< the first event in the window, N, N2
  std::vector<Id> samples;                ///< [nf] how many these are
  std::vector<Id> before;                 ///< [nf] opening and closing events before the window
  std::uint64_t looks = 0, rebuilds = 0;  ///< samples in the window; FaceSet::rebuilds of its list
  std::vector<std::uint64_t> last;        ///< pairs of blocks of the contacts that vibrated in the
                                          ///< last window, ascending
  std::uint64_t count = 0;                ///< events in windows in which their contact chattered
  std::uint64_t worst = 0;                ///< most events of one contact in a window
  Id block_i = no_id, block_j = no_id;    ///< blocks of that contact
  double time = 0.0;                      ///< s, end of that window
};

/// A contact vibrates in a window in which it opens or closes many times and in which its spring,
/// since it first did so, stores more than twice the energy at the mean force. It chatters where it
/// did so in the window before, too: blocks that strike each other ring for one window, and go on.
/// A block in equilibrium or in smooth sliding does neither. Stages until equilibrium are left out,
/// since their motion is not physical. Call once every few steps.
void look_for_chatter(Chatter& chatter, const Simulation& sim);

}  // namespace edda
