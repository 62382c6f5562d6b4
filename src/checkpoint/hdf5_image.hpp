// A Record as the bytes of an HDF5 file, and back. Nothing touches the disk here.
#pragma once

#include <string>
#include <string_view>

#include "base/fault.hpp"
#include "checkpoint/record.hpp"

namespace edda {

/// The bytes of an HDF5 file with one data set per entry. Throws std::bad_alloc where memory ends.
std::string to_hdf5(const Record& record);

/// The entries of such a file. Precondition: the bytes are as to_hdf5() made them (the HDF5 library
/// may crash on others); the envelope ensures this by a hash. A fault reports what could not be
/// read.
Result<Record> from_hdf5(std::string_view image);

}  // namespace edda
