// Loops over several threads whose results do not depend on how many there are.
#pragma once

#include <omp.h>

#include <algorithm>
#include <cstddef>
#include <vector>

#ifndef EDDA_WORTH_SHARING  // builds that look for races and differences divide every loop among
                            // threads
#define EDDA_WORTH_SHARING 8192
#endif

namespace edda {

/// Loops shorter than this are not worth waking other threads for.
inline constexpr std::size_t worth_sharing = EDDA_WORTH_SHARING;

/// Blocks that go through all stages of a step together, so that the results of one stage are still
/// in the cache for the next.
inline constexpr std::size_t blocks_at_once = 256;

/// Calls body(i) for i in [0, n), in parallel. body must write only what belongs to i.
template <class Body>
void parallel_for(std::size_t n, Body body) {
  if (n < worth_sharing) {
    for (std::size_t i = 0; i < n; ++i) body(i);
    return;
  }
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < n; ++i) body(i);
}

/// Calls body(chunk, begin, end) for [0, n) cut into chunks of `size`, in parallel. body must write
/// only what belongs to its chunk.
template <class Body>
void parallel_chunks(std::size_t n, std::size_t size, Body body) {
  const std::size_t chunks = (n + size - 1) / size;
  if (n < worth_sharing) {
    for (std::size_t c = 0; c < chunks; ++c) body(c, c * size, std::min(n, (c + 1) * size));
    return;
  }
#pragma omp parallel for schedule(static)
  for (std::size_t c = 0; c < chunks; ++c) body(c, c * size, std::min(n, (c + 1) * size));
}

/// Calls body(task, scratch) for tasks in [0, n), in parallel; `elements`: of all of them. scratch:
/// working memory that no other task uses at the time. body must write only what belongs to its
/// task.
template <class Scratch, class Body>
void parallel_tasks(std::size_t n, std::size_t elements, std::vector<Scratch>& scratch, Body body) {
  if (elements < worth_sharing || n < 2) {
    if (scratch.empty()) scratch.resize(1);
    for (std::size_t q = 0; q < n; ++q) body(q, scratch[0]);
    return;
  }
  scratch.resize(std::max(scratch.size(), static_cast<std::size_t>(omp_get_max_threads())));
#pragma omp parallel for schedule(static)
  for (std::size_t q = 0; q < n; ++q) {
    body(q, scratch[static_cast<std::size_t>(omp_get_thread_num())]);
  }
}

/// Sum of term(i) over [0, n): chunks of fixed size are summed each in order, then the chunks in
/// order, so the bits are the same for any number of threads.
template <class Term>
double ordered_sum(std::size_t n, Term term) {
  constexpr std::size_t chunk = 4096;
  const auto sum_of = [&](std::size_t begin, std::size_t end) {
    double sum = 0.0;
    for (std::size_t i = begin; i < end; ++i) sum += term(i);
    return sum;
  };
  if (n <= chunk) return sum_of(0, n);
  const std::size_t chunks = (n + chunk - 1) / chunk;
  std::vector<double> partial(chunks, 0.0);
#pragma omp parallel for schedule(static)
  for (std::size_t c = 0; c < chunks; ++c) {
    partial[c] = sum_of(c * chunk, std::min(n, (c + 1) * chunk));
  }
  double sum = 0.0;
  for (double p : partial) sum += p;
  return sum;
}

}  // namespace edda
