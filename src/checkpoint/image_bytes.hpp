// The bytes of an HDF5 file, wherever they are.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace edda {

/// Bytes that are written in any order, and read back. None of this throws: the HDF5 library, which
/// calls it, is written in C.
class ImageBytes {
 public:
  ImageBytes() = default;
  ImageBytes(const ImageBytes&) = delete;
  ImageBytes& operator=(const ImageBytes&) = delete;
  virtual ~ImageBytes() = default;
  virtual bool good() const noexcept = 0;
  virtual std::uint64_t size() const noexcept = 0;
  /// False where they cannot be read.
  virtual bool read(std::uint64_t from, std::span<char> into) const noexcept = 0;
  /// After an error nothing more is written, and good() is false; whoever asked for the image
  /// reports it.
  virtual void write(std::uint64_t from, std::string_view bytes) noexcept = 0;
  /// Cuts the bytes off, or adds zeros.
  virtual void resize(std::uint64_t size) noexcept = 0;
};

}  // namespace edda
