#include "base/vector_loop.hpp"

namespace edda {

const double hidden_zero = 0.0, hidden_one = 1.0;

}  // namespace edda
