// Loops over several threads whose results do not depend on how many there are.
#pragma once

#include <omp.h>

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#ifndef EDDA_WORTH_SHARING  // builds that look for races and differences divide every loop among
                            // threads
#define EDDA_WORTH_SHARING 8000
#endif

namespace edda {

/// ns: loops that take less are not worth sharing. The cost of an element, as the loops below take
/// it, is a rough number.
inline constexpr std::size_t worth_sharing = EDDA_WORTH_SHARING;

/// By this the cost of an element is divided in loops that seldom run though they are short: they
/// must take longer to be shared, since other threads are asleep then, and spin for a while once
/// they are awake.
inline constexpr std::size_t seldom = 4;

/// Blocks that go through all stages of a step together, at most: so few that the results of one
/// stage are still in the cache for the next, and so many that the processor fetches the next part
/// of some fifty arrays ahead.
inline constexpr std::size_t blocks_at_once = 256;
/// How many it is in any case, and of what it is a multiple, so that parts begin at cache lines.
inline constexpr std::size_t fewest_at_once = 64;

/// Hears how long the tasks of each shared loop take, s, while these loops run on one thread
/// (bench/cores.hpp).
class LoopListener {
 public:
  virtual ~LoopListener() = default;
  virtual double now() = 0;  ///< s
  /// weights: as in share().
  virtual void shared(std::span<const double> seconds_of_tasks,
                      std::span<const std::size_t> weights) = 0;
};
inline LoopListener* loop_listener = nullptr;  ///< null: nobody listens

/// The first task of each of so many threads, and the end, where tasks in a row are shared out by
/// these weights.
inline std::vector<std::size_t> shares(std::span<const std::size_t> weights, std::size_t threads) {
  std::size_t all = 0, before = 0, thread = 0;
  for (const std::size_t w : weights) all += w;
  std::vector<std::size_t> first(threads + 1, weights.size());
  for (std::size_t q = 0; q < weights.size(); ++q) {
    const std::size_t twice_middle = 2 * before + weights[q];
    for (; thread < threads && twice_middle * threads >= 2 * all * thread; ++thread) {
      first[thread] = q;
    }
    before += weights[q];
  }
  return first;
}

/// Calls body(task) for [0, n) one after another, and tells the listener how long each took.
template <class Body>
void share_for_listener(std::size_t n, Body body, std::span<const std::size_t> weights) {
  std::vector<double> seconds(n);
  double begin = loop_listener->now();
  for (std::size_t q = 0; q < n; ++q) {
    body(q);
    const double end = loop_listener->now();
    seconds[q] = end - begin;
    begin = end;
  }
  loop_listener->shared(seconds, weights);
}

/// Calls body(task) for tasks in [0, n), in parallel. Each thread takes tasks in a row: as many as
/// the others or, with weights [n] above 0, which say how the tasks compare, as much of them.
template <class Body>
void share(std::size_t n, Body body, std::span<const std::size_t> weights = {}) {
  if (loop_listener != nullptr) return share_for_listener(n, body, weights);
  if (weights.empty()) {
#pragma omp parallel for schedule(static)
    for (std::size_t q = 0; q < n; ++q) body(q);
    return;
  }
  const std::size_t threads = static_cast<std::size_t>(omp_get_max_threads());
  const std::vector<std::size_t> first = shares(weights, threads);
#pragma omp parallel for schedule(static)
  for (std::size_t thread = 0; thread < threads; ++thread) {
    for (std::size_t q = first[thread]; q < first[thread + 1]; ++q) body(q);
  }
}

/// Calls body(chunk, begin, end) for [0, n) cut into chunks of `size`, in parallel; cost: of each
/// element, ns. body must write only what belongs to its chunk.
template <class Body>
void parallel_chunks(std::size_t n, std::size_t size, std::size_t cost, Body body) {
  const std::size_t chunks = (n + size - 1) / size;
  const auto of_chunk = [&](std::size_t c) { body(c, c * size, std::min(n, (c + 1) * size)); };
  if (n * cost < worth_sharing || chunks < 2) {
    for (std::size_t c = 0; c < chunks; ++c) of_chunk(c);
    return;
  }
  share(chunks, of_chunk);
}

/// The same for n blocks, in chunks of blocks_at_once, or of fewer where a thread would have fewer
/// than sixteen chunks.
template <class Body>
void parallel_blocks(std::size_t n, std::size_t cost, Body body) {
  const std::size_t threads = static_cast<std::size_t>(omp_get_max_threads());
  const std::size_t fair = threads == 1 ? blocks_at_once : n / (16 * threads);
  const std::size_t size = fair / fewest_at_once * fewest_at_once;
  parallel_chunks(n, std::clamp(size, fewest_at_once, blocks_at_once), cost, body);
}

/// Calls body(i) for i in [0, n), in parallel; cost: of each, ns. body must write only what belongs
/// to i.
template <class Body>
void parallel_for(std::size_t n, Body body, std::size_t cost = 4) {
  const std::size_t at_once = worth_sharing > 1 ? std::max<std::size_t>(1, 500 / cost) : 1;
  parallel_chunks(n, at_once, cost, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) body(i);
  });
}

/// Calls body(task, scratch) for tasks in [0, n), in parallel; cost: of all of them, ns. scratch:
/// working memory that no other task uses at the time. body must write only what belongs to its
/// task. weights: as in share().
template <class Scratch, class Body>
void parallel_tasks(std::size_t n, std::size_t cost, std::vector<Scratch>& scratch, Body body,
                    std::span<const std::size_t> weights = {}) {
  const std::size_t threads = static_cast<std::size_t>(omp_get_max_threads());
  const bool shared = cost >= worth_sharing && n > 1;
  scratch.resize(std::max(scratch.size(), shared ? threads : 1));
  if (!shared) {
    for (std::size_t q = 0; q < n; ++q) body(q, scratch[0]);
    return;
  }
  const auto with_scratch = [&](std::size_t q) {
    body(q, scratch[static_cast<std::size_t>(omp_get_thread_num())]);
  };
  share(n, with_scratch, weights);
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
  std::vector<double> partial((n + chunk - 1) / chunk, 0.0);
  parallel_chunks(n, chunk, 2, [&](std::size_t c, std::size_t begin, std::size_t end) {
    partial[c] = sum_of(begin, end);
  });
  double sum = 0.0;
  for (double p : partial) sum += p;
  return sum;
}

}  // namespace edda
