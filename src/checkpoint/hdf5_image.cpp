#include "checkpoint/hdf5_image.hpp"

#include <hdf5.h>

#include <new>
#include <utility>

namespace edda {
namespace {

/// Closes what HDF5 has opened.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  hid_t id() const { return id_; }
  bool ok() const { return id_ >= 0; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

hid_t type_of(double) {
  return H5T_NATIVE_DOUBLE;
}
hid_t type_of(std::uint64_t) {
  return H5T_NATIVE_UINT64;
}
hid_t type_of(std::uint32_t) {
  return H5T_NATIVE_UINT32;
}
hid_t type_of(std::int32_t) {
  return H5T_NATIVE_INT32;
}
hid_t type_of(std::uint16_t) {
  return H5T_NATIVE_UINT16;
}
hid_t type_of(std::uint8_t) {
  return H5T_NATIVE_UINT8;
}
hid_t type_of(char) {
  return H5T_NATIVE_SCHAR;
}  // texts

/// HDF5 would print its own errors on stderr.
void be_quiet() {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

/// A file that lives in memory alone, growing by so many bytes at a time.
Handle in_memory(std::size_t grow) {
  const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
  H5Pset_fapl_core(access, grow, false);
  return {access, H5Pclose};
}

template <class Values>
bool put(hid_t file, const std::string& name, const Values& values) {
  const hsize_t size = values.size();
  const hid_t type = type_of(typename Values::value_type{});
  const Handle space(H5Screate_simple(1, &size, nullptr), H5Sclose);
  const Handle set(
      H5Dcreate2(file, name.c_str(), type, space.id(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
      H5Dclose);
  return set.ok() &&
         (size == 0 || H5Dwrite(set.id(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0);
}

template <class Values>
bool get(hid_t set, hid_t type, hsize_t size, RecordValue& into) {
  Values values;
  const hid_t own = type_of(typename Values::value_type{});
  if (H5Tequal(type, own) <= 0) return false;
  values.resize(size);
  if (size > 0 && H5Dread(set, own, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0) return false;
  into = std::move(values);
  return true;
}

Fault unreadable(const std::string& what) {
  return {{}, "cannot be read: " + what, "resume from another checkpoint, or run anew"};
}

struct Reading {
  Record record;
  std::string flaw;
};

/// Reads one data set; the callback of H5Literate.
herr_t read_one(hid_t file, const char* name, const H5L_info_t*, void* data) {
  auto& reading = *static_cast<Reading*>(data);
  const Handle set(H5Dopen2(file, name, H5P_DEFAULT), H5Dclose);
  if (!set.ok()) {
    reading.flaw = std::string(name) + " is no data set";
    return 1;
  }
  const Handle space(H5Dget_space(set.id()), H5Sclose), type(H5Dget_type(set.id()), H5Tclose);
  hsize_t size = 0;
  const bool flat = space.ok() && H5Sget_simple_extent_ndims(space.id()) == 1 &&
                    H5Sget_simple_extent_dims(space.id(), &size, nullptr) == 1;
  RecordValue value;
  const hid_t s = set.id(), t = type.id();
  if (!flat ||
      !(get<std::vector<double>>(s, t, size, value) ||
        get<std::vector<std::uint64_t>>(s, t, size, value) ||
        get<std::vector<std::uint32_t>>(s, t, size, value) ||
        get<std::vector<std::int32_t>>(s, t, size, value) ||
        get<std::vector<std::uint16_t>>(s, t, size, value) ||
        get<std::vector<std::uint8_t>>(s, t, size, value) || get<std::string>(s, t, size, value))) {
    reading.flaw = std::string(name) + " is of no kind that a checkpoint has";
    return 1;
  }
  reading.record.emplace(name, std::move(value));
  return 0;
}

}  // namespace

std::string to_hdf5(const Record& record) {
  be_quiet();
  std::size_t bytes = 0;
  for (const auto& [name, value] : record) {
    bytes += std::visit([](const auto& v) { return v.size() * sizeof(v[0]); }, value);
  }
  const Handle access = in_memory(std::max<std::size_t>(1 << 16, bytes / 8));
  const Handle file(H5Fcreate("checkpoint", H5F_ACC_TRUNC, H5P_DEFAULT, access.id()), H5Fclose);
  bool good = file.ok();
  for (const auto& entry : record) {
    good = good &&
           std::visit([&](const auto& v) { return put(file.id(), entry.first, v); }, entry.second);
  }
  good = good && H5Fflush(file.id(), H5F_SCOPE_GLOBAL) >= 0;
  const ssize_t size = good ? H5Fget_file_image(file.id(), nullptr, 0) : -1;
  if (size < 0) throw std::bad_alloc();
  std::string image(static_cast<std::size_t>(size), '\0');
  if (H5Fget_file_image(file.id(), image.data(), image.size()) < 0) throw std::bad_alloc();
  return image;
}

Result<Record> from_hdf5(std::string_view image) {
  be_quiet();
  const Handle access = in_memory(1 << 16);
  // The library only copies the image. NOLINTNEXTLINE(cppcoreguidelines-pro-type-const-cast)
  if (H5Pset_file_image(access.id(), const_cast<char*>(image.data()), image.size()) < 0) {
    return unreadable("it is no HDF5 file");
  }
  const Handle file(H5Fopen("checkpoint", H5F_ACC_RDONLY, access.id()), H5Fclose);
  if (!file.ok()) return unreadable("it is no HDF5 file");
  Reading reading;
  const herr_t end =
      H5Literate(file.id(), H5_INDEX_NAME, H5_ITER_NATIVE, nullptr, read_one, &reading);
  if (!reading.flaw.empty()) return unreadable(reading.flaw);
  if (end != 0) return unreadable("its data sets cannot be listed");
  return std::move(reading.record);
}

}  // namespace edda
