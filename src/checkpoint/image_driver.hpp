// The driver by which the HDF5 library reads and writes ImageBytes.
#pragma once

#include <hdf5.h>

#include "checkpoint/image_bytes.hpp"

namespace edda {

/// Access properties for H5Fcreate() and H5Fopen() of a file of any name whose bytes are these;
/// they must outlive it. To be closed by H5Pclose(). Negative: memory has come to an end.
hid_t access_to(ImageBytes& bytes);

}  // namespace edda
