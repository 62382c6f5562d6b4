#include "checkpoint/image_driver.hpp"

#include <limits>
#include <new>
#include <type_traits>

namespace edda {
namespace {

/// What an access property list holds of the driver.
struct Access {
  ImageBytes* bytes;
};

/// An open file, as HDF5 sees it: it knows the first member, and hands back the whole.
struct OpenImage {
  H5FD_t known_to_hdf5;
  ImageBytes* bytes;
  haddr_t allocated;  ///< bytes that HDF5 has given to its objects so far
};
static_assert(std::is_standard_layout_v<OpenImage>);

OpenImage& whole(H5FD_t* file) {
  return *reinterpret_cast<OpenImage*>(file);
}
const OpenImage& whole(const H5FD_t* file) {
  return *reinterpret_cast<const OpenImage*>(file);
}

H5FD_t* open_image(const char*, unsigned flags, hid_t access, haddr_t) {
  const auto* info = static_cast<const Access*>(H5Pget_driver_info(access));
  if (info == nullptr) return nullptr;
  auto* file = new (std::nothrow) OpenImage{{}, info->bytes, 0};
  if (file == nullptr) return nullptr;
  if ((flags & H5F_ACC_TRUNC) != 0) file->bytes->resize(0);
  return &file->known_to_hdf5;
}

herr_t close_image(H5FD_t* file) {
  delete &whole(file);
  return 0;
}

/// As HDF5's own drivers of single files: small pieces are collected before they are written.
herr_t query_image(const H5FD_t*, unsigned long* flags) {
  *flags = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_DATA_SIEVE |
           H5FD_FEAT_AGGREGATE_SMALLDATA;
  return 0;
}

haddr_t allocated_in(const H5FD_t* file, H5FD_mem_t) {
  return whole(file).allocated;
}

herr_t allocate_in(H5FD_t* file, H5FD_mem_t, haddr_t end) {
  whole(file).allocated = end;
  return 0;
}

haddr_t end_of(const H5FD_t* file, H5FD_mem_t) {
  return whole(file).bytes->size();
}

herr_t read_image(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t from, std::size_t size, void* into) {
  return whole(file).bytes->read(from, {static_cast<char*>(into), size}) ? 0 : -1;
}

/// Succeeds always: ImageBytes keeps the error. A file that HDF5 could not write it could not close
/// either, and would try again at the end of the program.
herr_t write_image(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t from, std::size_t size,
                   const void* values) {
  whole(file).bytes->write(from, {static_cast<const char*>(values), size});
  return 0;
}

/// A file ends where what has been allocated does, written or not.
herr_t truncate_image(H5FD_t* file, hid_t, hbool_t) {
  OpenImage& image = whole(file);
  if (image.bytes->size() != image.allocated) image.bytes->resize(image.allocated);
  return 0;
}

hid_t registered() {
  H5FD_class_t driver{};
#if H5_VERSION_GE(1, 13, 0)
  constexpr int any_number = 600;  // from 512 on they are free
  driver.version = H5FD_CLASS_VERSION;
  driver.value = static_cast<H5FD_class_value_t>(any_number);
#endif
  driver.name = "edda";
  driver.maxaddr = std::numeric_limits<std::int64_t>::max();
  driver.fc_degree = H5F_CLOSE_WEAK;
  driver.fapl_size = sizeof(Access);
  driver.open = open_image;
  driver.close = close_image;
  driver.query = query_image;
  driver.get_eoa = allocated_in;
  driver.set_eoa = allocate_in;
  driver.get_eof = end_of;
  driver.read = read_image;
  driver.write = write_image;
  driver.truncate = truncate_image;
  constexpr H5FD_mem_t one_space_for_each[] = H5FD_FLMAP_DICHOTOMY;
  std::size_t kind = 0;
  for (const H5FD_mem_t space : one_space_for_each) driver.fl_map[kind++] = space;
  return H5FDregister(&driver);
}

}  // namespace

hid_t access_to(ImageBytes& bytes) {
  static const hid_t driver = registered();
  const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
  const Access info{&bytes};
  if (access < 0 || H5Pset_driver(access, driver, &info) >= 0) return access;
  H5Pclose(access);
  return -1;
}

}  // namespace edda
