// What this machine has.
#pragma once

namespace edda {

/// Bytes of memory; infinity where the system does not say.
double memory_here();

}  // namespace edda
