// How much of a factor the stiffness of rock and joints costs: the same search where both are ten
// times as stiff.
#pragma once

#include "study/fos_start.hpp"

namespace edda {

/// A sentence that says how far the factor of blocks that deform is below `limit`, that of rigid
/// ones. Where these hinge, as arches do, it says what the factor is with rock and joints ten times
/// as stiff, if that is found within some seconds, and else how to find it.
std::string why_below_rigid(const Model& model, const Fos& fos, const FosOptions& options,
                            const FosStart& start, const FosResult& found, double limit);

}  // namespace edda
