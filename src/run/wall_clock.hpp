// Wall time.
#pragma once

#include <chrono>

namespace edda {

/// Wall time since `start`, s.
inline double since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace edda
