// Large arrays on large pages, and smaller ones from the start of a cache line on: eight numbers
// that are loaded at once then lie in one line and not in two.
//
// A step reads all of them in sequence. With pages of 4 KiB the processor spends a tenth of a large
// model's time on looking up page addresses. Larger arrays are therefore allocated on the
// boundaries of large pages, and the system is advised to use them; where it cannot, nothing
// changes.
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

// Replaces the allocation functions. NOLINTBEGIN(cppcoreguidelines-no-malloc)
namespace {

constexpr std::size_t page = std::size_t{2} << 20;
constexpr std::size_t large = 2 * page;

constexpr std::size_t line = 64, array = 8 * line;  // smaller allocations are not arrays of loops

void* aligned(std::size_t boundary, std::size_t size) {
  if (size > SIZE_MAX - boundary) return nullptr;
  return std::aligned_alloc(boundary, (size + boundary - 1) / boundary * boundary);
}

void* find_memory(std::size_t size) {
  if (size < array) return std::malloc(size > 0 ? size : 1);
  if (size < large) return aligned(line, size);
  void* const memory = aligned(page, size);
  if (memory != nullptr) madvise(memory, (size + page - 1) / page * page, MADV_HUGEPAGE);
  return memory;
}

template <class Find>
void* memory_or_throw(Find find) {
  for (;;) {
    if (void* const memory = find()) return memory;
    const std::new_handler handler = std::get_new_handler();
    if (handler == nullptr) throw std::bad_alloc();
    handler();
  }
}

}  // namespace

void* operator new(std::size_t size) {
  return memory_or_throw([size] { return find_memory(size); });
}

void* operator new(std::size_t size, std::align_val_t boundary) {
  const auto least = static_cast<std::size_t>(boundary);
  return memory_or_throw(
      [=] { return size < large || least > page ? aligned(least, size) : find_memory(size); });
}

void operator delete(void* memory) noexcept {
  std::free(memory);
}

void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}

void operator delete(void* memory, std::align_val_t) noexcept {
  std::free(memory);
}
// NOLINTEND(cppcoreguidelines-no-malloc)
#endif
