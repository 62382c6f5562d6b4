// Loops over several array elements at once.
//
// A hot loop is written for one element, with the same inline formulas as everywhere else, in a
// function of its own that is marked EDDA_VECTOR, under `#pragma omp simd`. g++ then compiles the
// function for AVX-512, for AVX2 and for any processor, and the program chooses by its processor
// when it starts. Every element goes through the same roundings in all of them (no sum runs across
// elements, no multiply-add is fused), so the bits are the same on every processor.
//
// Functions that such a loop calls must be inlined before the function is compiled three times;
// they are marked EDDA_INLINE.
//
// Vectors and other structures belong in those inlined functions, not into the body of the loop
// itself, where OpenMP would keep them in memory.
//
// To be fast such a loop has selections and no branches, arrays of one width (double, with Id
// as an index), and no sums over its elements: only largest values. g++ 12 refuses loops that
// select one of two truths (`a ? b > c : d > e`; write it with & and |) or that copy a structure
// within another.
#pragma once

#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) && defined(__OPTIMIZE__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(EDDA_PLAIN_LOOPS)
#define EDDA_VECTOR __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define EDDA_VECTOR
#endif

/// Marks a function that hot loops call.
#define EDDA_INLINE [[gnu::always_inline]] inline

namespace edda {

/// Four numbers that are added together, for sums too short for a loop over several.
using Four __attribute__((vector_size(32))) = double;
/// x and y of a vector.
using Two __attribute__((vector_size(16), aligned(16))) = double;

/// std::max by value: g++ does not vectorise a choice between references.
EDDA_INLINE double larger(double a, double b) {
  return a < b ? b : a;
}
EDDA_INLINE double smaller(double a, double b) {
  return b < a ? b : a;
}

/// 0 and 1, of whose values g++ must not know: a processor takes the larger of two numbers in one
/// instruction, which g++ does not see where one of them is a constant.
extern const double hidden_zero, hidden_one;

EDDA_INLINE double positive_part(double x) {
  return larger(x, hidden_zero);
}
EDDA_INLINE double at_most_one(double x) {
  return smaller(x, hidden_one);
}

}  // namespace edda
