#include "checkpoint/hdf5_image.hpp"

#include <hdf5.h>

#include <cstring>
#include <new>
#include <span>
#include <string>
#include <utility>

#include "checkpoint/image_driver.hpp"

namespace edda {
namespace {

/// Closes what HDF5 has opened.
class Handle {
 public:
  Handle(hid_t id, herr_t (*closing)(hid_t)) : id_(id), close_(closing) {}
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  hid_t id() const { return id_; }
  herr_t close() { return close_(std::exchange(id_, hid_t{-1})); }
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

/// Bytes in memory, to read.
class Given : public ImageBytes {
 public:
  explicit Given(std::string_view bytes) : bytes_(bytes) {}
  bool good() const noexcept override { return true; }
  std::uint64_t size() const noexcept override { return bytes_.size(); }
  bool read(std::uint64_t from, std::span<char> into) const noexcept override {
    if (from > bytes_.size() || into.size() > bytes_.size() - from) return false;
    std::memcpy(into.data(), bytes_.data() + from, into.size());
    return true;
  }
  void write(std::uint64_t, std::string_view) noexcept override {}
  void resize(std::uint64_t) noexcept override {}

 private:
  std::string_view bytes_;
};

template <class Values>
bool put_set(hid_t file, const std::string& name, const Values& values) {
  const hsize_t size = values.size();
  const hid_t type = type_of(typename Values::value_type{});
  const Handle space(H5Screate_simple(1, &size, nullptr), H5Sclose);
  const Handle how(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  // The same record makes the same bytes at any time of the day.
  if (!how.ok() || H5Pset_obj_track_times(how.id(), false) < 0) return false;
  const Handle set(
      H5Dcreate2(file, name.c_str(), type, space.id(), H5P_DEFAULT, how.id(), H5P_DEFAULT),
      H5Dclose);
  return set.ok() &&
         (size == 0 || H5Dwrite(set.id(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0);
}

/// Makes each entry a data set.
class IntoFile : public RecordSink {
 public:
  IntoFile(hid_t file, const ImageBytes& image) : file_(file), image_(image) {}
  bool complete() const { return complete_; }
  void put(const std::string& name, RecordView value) override {
    if (!complete_ || !image_.good()) return;
    complete_ = std::visit([&](const auto& v) { return put_set(file_, name, v); }, value);
  }

 private:
  hid_t file_;
  const ImageBytes& image_;
  bool complete_ = true;
};

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

void write_hdf5(ImageBytes& image, const std::function<void(RecordSink&)>& list) {
  be_quiet();
  const Handle access(access_to(image), H5Pclose);
  Handle file(H5Fcreate("checkpoint", H5F_ACC_TRUNC, H5P_DEFAULT, access.id()), H5Fclose);
  IntoFile sink(file.id(), image);
  if (file.ok()) list(sink);
  const bool complete = file.ok() && sink.complete() && file.close() >= 0;
  if (!complete && image.good()) throw std::bad_alloc();
}

Result<Record> from_hdf5(std::string_view image) {
  be_quiet();
  Given bytes(image);
  const Handle access(access_to(bytes), H5Pclose);
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
