// The file around the image: an HDF5 user block of 512 bytes with the type of the file, its length
// and a hash of the rest, which is checked before anything else is read. HDF5's own tools skip the
// block.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include "base/fault.hpp"
#include "checkpoint/image_bytes.hpp"
#include "results/files.hpp"

namespace edda {

inline constexpr std::size_t envelope_size = 512;

/// The user block for an image of this length and hash (sha256()).
std::string seal(std::uint64_t length, const std::string& hash);

/// The image inside a whole file, or what is wrong with the file. A view into `file`.
Result<std::string_view> open_sealed(std::string_view file);

/// Writes an image.
using WriteImage = std::function<void(ImageBytes&)>;

/// Writes the sealed image to `folder`/checkpoint.h5, through a temporary file that is flushed to
/// the disk; the previous one becomes checkpoint.previous.h5. At any time one of them is complete.
/// The image goes straight into the file. If `image` throws, nothing has changed.
Trouble write_checkpoint(const std::string& folder, const WriteImage& image);

/// The same for the end of a stage: `folder`/checkpoint_`stage`.h5.
Trouble write_stage_checkpoint(const std::string& folder, std::size_t stage,
                               const WriteImage& image);
/// Its image. Faults: it does not exist, or is damaged.
Result<std::string> read_stage_checkpoint(const std::string& folder, std::size_t stage);

/// The image of `folder`/checkpoint.h5, or where that is damaged or missing of
/// checkpoint.previous.h5; `warning` then says so. Faults: neither can be used.
Result<std::string> read_checkpoint(const std::string& folder, std::string& warning);

}  // namespace edda
