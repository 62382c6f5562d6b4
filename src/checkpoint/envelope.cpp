#include "checkpoint/envelope.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstdio>
#include <filesystem>

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

int write_all(int file, std::string_view content) {
  while (!content.empty()) {
    const ssize_t n = ::write(file, content.data(), content.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return errno;
    content.remove_prefix(static_cast<std::size_t>(n));
  }
  return 0;
}

int sync_folder(const std::string& folder) {
  const int handle = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (handle < 0) return errno;
  const int error = ::fsync(handle) == 0 ? 0 : errno;
  ::close(handle);
  return error;
}

/// The sealed image in a file, on the disk. Returns an error number, 0: none.
int write_part(const std::string& part, std::string_view image) {
  const int file = ::open(part.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (file < 0) return errno;
  int error = write_all(file, seal(image));
  if (error == 0) error = write_all(file, image);
  if (error == 0 && ::fsync(file) != 0) error = errno;
  if (::close(file) != 0 && error == 0) error = errno;
  return error;
}

/// Renames the temporary file, unless there was an error.
Trouble put_in_place(const std::string& folder, const std::string& path, const std::string& part,
                     int error) {
  if (error == 0 && std::rename(part.c_str(), path.c_str()) != 0) error = errno;
  if (error == 0) error = sync_folder(folder);
  if (error == 0) return {};
  std::remove(part.c_str());
  return cannot_write(path, error);
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
  return std::string(image.value());
}

}  // namespace

std::string seal(std::string_view image) {
  std::string block(magic);
  block += fmt::format("length {}\nsha256 {}\n", image.size(), sha256(image));
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

Trouble write_checkpoint(const std::string& folder, std::string_view image) {
  const std::string part = current(folder) + ".part";
  int error = write_part(part, image);
  if (error == 0 && ::access(current(folder).c_str(), F_OK) == 0 &&
      std::rename(current(folder).c_str(), former(folder).c_str()) != 0) {
    error = errno;
  }
  return put_in_place(folder, current(folder), part, error);
}

Trouble write_stage_checkpoint(const std::string& folder, std::size_t stage,
                               std::string_view image) {
  const std::string path = of_stage(folder, stage), part = path + ".part";
  return put_in_place(folder, path, part, write_part(part, image));
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
