#include "checkpoint/envelope.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <filesystem>
#include <span>
#include <utility>
#include <vector>

#include "results/sha256.hpp"

namespace edda {
namespace {

constexpr std::string_view magic = "edda checkpoint 1\n";

Fault damaged(std::string why) {
  return {{}, "is damaged: " + std::move(why), "resume from another checkpoint, or run anew"};
}

std::string current(const std::string& folder) {
  return folder + "/checkpoint.h5";
}
std::string former(const std::string& folder) {
  return folder + "/checkpoint.previous.h5";
}

std::string of_stage(const std::string& folder, std::size_t stage) {
  return fmt::format("{}/checkpoint_{}.h5", folder, stage + 1);
}

/// Removes `start` from the front.
bool take(std::string_view& text, std::string_view start) {
  if (!text.starts_with(start)) return false;
  text.remove_prefix(start.size());
  return true;
}

int sync_folder(const std::string& folder) {
  const int handle = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (handle < 0) return errno;
  const int error = ::fsync(handle) == 0 ? 0 : errno;
  ::close(handle);
  return error;
}

/// A checkpoint on its way to the disk, beside its place. Removed unless it is put there.
class Part : public ImageBytes {
 public:
  explicit Part(const std::string& path)
      : path_(path),
        part_(path + ".part"),
        file_(::open(part_.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0666)) {
    if (file_ < 0) error_ = errno;
  }
  Part(const Part&) = delete;
  Part& operator=(const Part&) = delete;
  ~Part() override {
    if (file_ >= 0) ::close(file_);
    if (!in_place_) std::remove(part_.c_str());
  }

  bool good() const noexcept override { return error_ == 0; }
  std::uint64_t size() const noexcept override { return size_; }
  bool read(std::uint64_t from, std::span<char> into) const noexcept override {
    while (!into.empty()) {
      const ssize_t n =
          ::pread(file_, into.data(), into.size(), static_cast<off_t>(envelope_size + from));
      if (n < 0 && errno == EINTR) continue;
      if (n <= 0) return false;
      from += static_cast<std::uint64_t>(n);
      into = into.subspan(static_cast<std::size_t>(n));
    }
    return true;
  }
  void write(std::uint64_t from, std::string_view bytes) noexcept override {
    size_ = std::max(size_, from + bytes.size());
    write_at(envelope_size + from, bytes);
  }
  void resize(std::uint64_t size) noexcept override {
    size_ = size;
    if (error_ == 0 && ::ftruncate(file_, static_cast<off_t>(envelope_size + size)) != 0)
      error_ = errno;
  }

  /// Puts the user block before the image, and all of it on the disk.
  void seal_and_sync() {
    const std::string hash = hash_of_image();
    write_at(0, seal(size_, hash));
    if (error_ == 0 && ::fsync(file_) != 0) error_ = errno;
    if (file_ >= 0 && ::close(file_) != 0 && error_ == 0) error_ = errno;
    file_ = -1;
  }
  /// Moves the file to its place; what was there goes to `former`, where that is not empty.
  Trouble put_in_place(const std::string& folder, const std::string& former) {
    if (error_ == 0 && !former.empty() && ::access(path_.c_str(), F_OK) == 0 &&
        std::rename(path_.c_str(), former.c_str()) != 0) {
      error_ = errno;
    }
    if (error_ == 0 && std::rename(part_.c_str(), path_.c_str()) != 0) error_ = errno;
    in_place_ = error_ == 0;
    if (error_ == 0) error_ = sync_folder(folder);
    return error_ == 0 ? Trouble{} : cannot_write(path_, error_);
  }

 private:
  /// Of the bytes as the file has them: HDF5 does not write them in their order.
  std::string hash_of_image() {
    Sha256 hash;
    std::vector<char> piece(std::size_t{1} << 20);
    for (std::uint64_t from = 0; from < size_ && error_ == 0;) {
      const std::size_t n = std::min<std::uint64_t>(piece.size(), size_ - from);
      if (!read(from, std::span(piece).first(n))) error_ = EIO;
      hash.add({piece.data(), n});
      from += n;
    }
    return hash.digits();
  }
  void write_at(std::uint64_t from, std::string_view bytes) noexcept {
    while (error_ == 0 && !bytes.empty()) {
      const ssize_t n = ::pwrite(file_, bytes.data(), bytes.size(), static_cast<off_t>(from));
      if (n < 0 && errno == EINTR) continue;
      if (n < 0) {
        error_ = errno;
        return;
      }
      from += static_cast<std::uint64_t>(n);
      bytes.remove_prefix(static_cast<std::size_t>(n));
    }
  }

  std::string path_, part_;
  int file_;
  int error_ = 0;
  std::uint64_t size_ = 0;  ///< of the image
  bool in_place_ = false;
};

/// Writes the sealed image to `path`; what was there goes to `former`, where that is not empty.
Trouble write_sealed(const std::string& folder, const std::string& path, const std::string& former,
                     const WriteImage& image) {
  Part part(path);
  if (part.good()) image(part);
  part.seal_and_sync();
  return part.put_in_place(folder, former);
}

Result<std::string> read_sealed(const std::string& path) {
  Result<std::string> file = read_file(path);
  if (!file.ok()) return file;
  const Result<std::string_view> image = open_sealed(file.value());
  if (!image.ok()) {
    Fault fault = image.faults().front();
    fault.where.file = path;
    return fault;
  }
  file.value().erase(0, envelope_size);
  return file;
}

}  // namespace

std::string seal(std::uint64_t length, const std::string& hash) {
  std::string block(magic);
  block += fmt::format("length {}\nsha256 {}\n", length, hash);
  block.resize(envelope_size, '\0');
  return block;
}

Result<std::string_view> open_sealed(std::string_view file) {
  if (!file.starts_with(magic)) return damaged("it does not begin as a checkpoint does");
  if (file.size() < envelope_size) return damaged("it ends within its first 512 bytes");
  std::string_view head = file.substr(magic.size(), envelope_size - magic.size());
  if (!take(head, "length ")) return damaged("its length is not given");
  std::size_t length = 0;
  const auto [end, error] = std::from_chars(head.data(), head.data() + head.size(), length);
  if (error != std::errc{}) return damaged("its length is no number");
  head.remove_prefix(static_cast<std::size_t>(end - head.data()));
  const std::string_view image = file.substr(envelope_size);
  if (image.size() != length) {
    return damaged(fmt::format("{} bytes are there of {}", image.size(), length));
  }
  const std::string expected = fmt::format("\nsha256 {}\n", sha256(image));
  if (!take(head, expected)) return damaged("its bytes are not those that were written");
  if (head.find_first_not_of('\0') != std::string_view::npos) {
    return damaged("its first 512 bytes are not those that were written");
  }
  return image;
}

Trouble write_checkpoint(const std::string& folder, const WriteImage& image) {
  return write_sealed(folder, current(folder), former(folder), image);
}

Trouble write_stage_checkpoint(const std::string& folder, std::size_t stage,
                               const WriteImage& image) {
  return write_sealed(folder, of_stage(folder, stage), {}, image);
}

Result<std::string> read_stage_checkpoint(const std::string& folder, std::size_t stage) {
  const std::string path = of_stage(folder, stage);
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) {
    return Fault{{{}, folder, 0, 0},
                 fmt::format("holds no checkpoint of the end of stage {}", stage + 1),
                 "name a stage that the run has ended (stages.csv lists them)"};
  }
  return read_sealed(path);
}

Result<std::string> read_checkpoint(const std::string& folder, std::string& warning) {
  namespace fs = std::filesystem;
  std::error_code ignored;
  const bool first = fs::exists(current(folder), ignored);
  const bool second = fs::exists(former(folder), ignored);
  if (!first && !second) {
    return Fault{{{}, folder, 0, 0}, "holds no checkpoint", "run without --resume"};
  }
  Faults faults;
  if (first) {
    Result<std::string> image = read_sealed(current(folder));
    if (image.ok()) return image;
    faults = image.faults();
  }
  if (!second) return faults;
  Result<std::string> image = read_sealed(former(folder));
  if (image.ok()) {
    warning = first ? faults.front().where.file + " " + faults.front().problem
                    : current(folder) + " is missing";
    warning += "; continuing from " + former(folder);
    return image;
  }
  faults.push_back(image.faults().front());
  return faults;
}

}  // namespace edda
