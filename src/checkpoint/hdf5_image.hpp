// The entries of a checkpoint as the bytes of an HDF5 file, and back.
#pragma once

#include <functional>
#include <string_view>

#include "base/fault.hpp"
#include "checkpoint/image_bytes.hpp"
#include "checkpoint/record.hpp"

namespace edda {

/// Makes an HDF5 file of `image`, with one data set per entry that `list` passes on; none of them
/// is kept in memory. Throws std::bad_alloc where memory ends; ImageBytes::good() tells whether the
/// bytes could be written.
void write_hdf5(ImageBytes& image, const std::function<void(RecordSink&)>& list);

/// The entries of such a file. Precondition: the bytes are as write_hdf5() made them (the HDF5
/// library may crash on others); the envelope ensures this by a hash. A fault reports what could
/// not be read.
Result<Record> from_hdf5(std::string_view image);

}  // namespace edda
