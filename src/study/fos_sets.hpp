// What fails first, and what follows; and whether the factor hangs on how far blocks may move.
#pragma once

#include "study/fos_search.hpp"

namespace edda {

/// The equilibrium state `rest`, with the positions from which displacements of `later` count.
Simulation at_start(const Simulation& rest, const Simulation& later);

/// The trial of this factor; null: there is none.
const Trial* trial_at(const std::vector<Trial>& trials, double factor);

/// How it fails at the lowest factor that failed; none where that trial has diverged.
std::optional<Mechanism> first_mechanism(const FosStart& start, const FosResult& r);

/// The set that fails first at the end of a bracket.
std::optional<FailedSet> first_set(const FosResult& r, const BlockSet& b);

/// What fails next, once what has failed has gone its way: sought near the limit of rigid blocks
/// that comes next, as long as that moves more than all before together.
void find_later_sets(const Model& model, const Fos& fos, FosStart start, const FosOptions& options,
                     FosResult& r);

/// Whether the factor hangs on how far blocks may move: bolts that have to be stretched, a gap that
/// closes. Fills holds_wide and fails_wide then.
void find_wide(const Model& model, const Fos& fos, FosStart start, const FosOptions& options,
               FosResult& r);

/// "in order: 0.82: 1 block (0.3 m2), sliding ...; 1.36: ..."; empty where one set alone is known.
std::string sets_text(const FosResult& r);

/// A search from `start` in this bracket, of which only the result is wanted.
FosResult found_between(const Model& model, const Fos& fos, const FosBracket& bracket,
                        FosStart& start, const FosOptions& options);

}  // namespace edda
