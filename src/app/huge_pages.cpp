// Large arrays on large pages.
//
// A step streams through some forty arrays. With pages of 4 KiB the processor spends a tenth of a
// large model's time looking up where the next ones are. Memory of some size is therefore asked for
// on the boundaries of large pages, and the system told that it may use them; where it may not,
// nothing changes.
#if defined(__linux__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define EDDA_HUGE_PAGES 1
#endif
#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#undef EDDA_HUGE_PAGES
#endif
#endif

#ifdef EDDA_HUGE_PAGES
#include <sys/mman.h>

#include <cstdint>
#include <cstdlib>
#include <new>

// This is where memory comes from. NOLINTBEGIN(cppcoreguidelines-no-malloc)
namespace {

constexpr std::size_t page = std::size_t{2} << 20;
constexpr std::size_t large = 2 * page;

void* find_memory(std::size_t size) {
  if (size < large) return std::malloc(size > 0 ? size : 1);
  if (size > SIZE_MAX - page) return nullptr;
  const std::size_t whole = (size + page - 1) / page * page;
  void* const memory = std::aligned_alloc(page, whole);
  if (memory != nullptr) madvise(memory, whole, MADV_HUGEPAGE);
  return memory;
}

}  // namespace

void* operator new(std::size_t size) {
  for (;;) {
    if (void* const memory = find_memory(size)) return memory;
    const std::new_handler handler = std::get_new_handler();
    if (handler == nullptr) throw std::bad_alloc();
    handler();
  }
}

void operator delete(void* memory) noexcept {
  std::free(memory);
}

void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
// NOLINTEND(cppcoreguidelines-no-malloc)
#endif
