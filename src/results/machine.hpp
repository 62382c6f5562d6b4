// Resources of the computer.
#pragma once

namespace edda {

/// Bytes of memory; infinity where it is unknown.
double memory_here();

}  // namespace edda
