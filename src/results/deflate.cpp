#include "results/deflate.hpp"

#include <libdeflate.h>

#include <memory>
#include <new>

namespace edda {

std::string deflated(std::string_view bytes, bool fastest) {
  const std::unique_ptr<libdeflate_compressor, void (*)(libdeflate_compressor*)> with(
      libdeflate_alloc_compressor(fastest ? 1 : 6), &libdeflate_free_compressor);
  if (!with) throw std::bad_alloc();
  std::string packed(libdeflate_zlib_compress_bound(with.get(), bytes.size()), '\0');
  packed.resize(libdeflate_zlib_compress(with.get(), bytes.data(), bytes.size(), packed.data(),
                                         packed.size()));
  return packed;
}

std::optional<std::string> inflated(std::string_view packed, std::size_t size) {
  const std::unique_ptr<libdeflate_decompressor, void (*)(libdeflate_decompressor*)> with(
      libdeflate_alloc_decompressor(), &libdeflate_free_decompressor);
  if (!with) throw std::bad_alloc();
  std::string bytes(size, '\0');
  const libdeflate_result outcome = libdeflate_zlib_decompress(
      with.get(), packed.data(), packed.size(), bytes.data(), size, nullptr);
  if (outcome != LIBDEFLATE_SUCCESS) return std::nullopt;
  return bytes;
}

}  // namespace edda
