#include "results/files.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <vector>

#include "results/columns.hpp"

namespace edda {
namespace {

namespace fs = std::filesystem;

Fault cannot(const std::string& what, const std::string& path, const std::string& why,
             std::string remedy) {
  Fault fault;
  fault.where.file = path;
  fault.problem = "cannot be " + what + " (" + why + ")";
  fault.remedy = std::move(remedy);
  return fault;
}

}  // namespace

Fault cannot_write(const std::string& path, int error) {
  const char* remedy = error == ENOSPC || error == EDQUOT
                           ? "free some disk space; what was written before is kept"
                           : "see that the folder may be written to";
  return cannot("written", path, std::strerror(error), remedy);
}

namespace {

/// Those that are no tables.
constexpr std::array<std::string_view, 22> other_files{"summary.json",
                                                       "blocks.pvd",
                                                       "contacts.pvd",
                                                       "model.toml",
                                                       "checkpoint.h5",
                                                       "checkpoint.previous.h5",
                                                       "mechanism.png",
                                                       "mechanism.svg",
                                                       "thrust.png",
                                                       "thrust.svg",
                                                       "keyblocks.png",
                                                       "keyblocks.svg",
                                                       "spectra.png",
                                                       "spectra.svg",
                                                       "relative.png",
                                                       "relative.svg",
                                                       "curve.png",
                                                       "curve.svg",
                                                       "mechanism_other_end.png",
                                                       "mechanism_other_end.svg",
                                                       "mechanism_other_end.csv",
                                                       "mechanism_joints_other_end.csv"};

bool starts_with_and_is(std::string_view name, std::string_view start, std::string_view end) {
  return name.size() >= start.size() + end.size() && name.starts_with(start) && name.ends_with(end);
}

bool is_result(const fs::directory_entry& entry) {
  std::string name = entry.path().filename().string();
  if (name == "frames") return entry.is_directory() && !entry.is_symlink();
  if (name.ends_with(".part")) name.resize(name.size() - 5);
  if (!entry.is_regular_file()) return false;
  return is_result_table(name) || starts_with_and_is(name, "checkpoint_", ".h5") ||
         std::find(other_files.begin(), other_files.end(), name) != other_files.end();
}

std::optional<std::size_t> number_of_frame(const std::string& name) {
  for (const std::string_view start : {"blocks_", "contacts_"}) {
    if (const auto number = number_in_name(name, start, ".vtu")) return number;
  }
  return {};
}

bool is_frame(const fs::directory_entry& entry) {
  std::string name = entry.path().filename().string();
  if (name.ends_with(".part")) name.resize(name.size() - 5);
  return entry.is_regular_file() && number_of_frame(name);
}

/// All entries of the folder, or the first one that no run has written.
struct Content {
  std::vector<fs::path> files;
  std::optional<fs::path> alien;
  std::error_code error;
};

Content content_of(const fs::path& folder) {
  Content content;
  for (fs::directory_iterator it(folder, content.error), end; it != end && !content.error;
       it.increment(content.error)) {
    if (!is_result(*it)) {
      content.alien = it->path();
      return content;
    }
    if (it->path().filename() != "frames") {
      content.files.push_back(it->path());
      continue;
    }
    for (fs::directory_iterator in(it->path(), content.error); in != end && !content.error;
         in.increment(content.error)) {
      if (!is_frame(*in)) {
        content.alien = in->path();
        return content;
      }
      content.files.push_back(in->path());
    }
  }
  return content;
}

}  // namespace

WholeFile::WholeFile(std::string path)
    : path_(std::move(path)), part_(path_ + ".part"), file_(std::fopen(part_.c_str(), "wb")) {
  if (file_ == nullptr) error_ = errno;
}

WholeFile::~WholeFile() {
  if (file_ == nullptr) return;
  std::fclose(file_);
  std::remove(part_.c_str());
}

void WholeFile::add(std::string_view bytes) {
  if (error_ != 0) return;
  if (std::fwrite(bytes.data(), 1, bytes.size(), file_) != bytes.size()) error_ = errno;
}

Trouble WholeFile::complete() {
  if (file_ == nullptr) return cannot_write(path_, error_);
  if (std::fflush(file_) != 0 && error_ == 0) error_ = errno;
  if (std::fclose(file_) != 0 && error_ == 0) error_ = errno;
  file_ = nullptr;
  if (error_ == 0 && std::rename(part_.c_str(), path_.c_str()) != 0) error_ = errno;
  if (error_ == 0) return {};
  std::remove(part_.c_str());
  return cannot_write(path_, error_);
}

std::optional<std::size_t> number_in_name(std::string_view name, std::string_view start,
                                          std::string_view end) {
  if (!starts_with_and_is(name, start, end)) return {};
  std::size_t number = 0;
  const char* const last = name.data() + name.size() - end.size();
  const auto [stop, error] = std::from_chars(name.data() + start.size(), last, number);
  return error == std::errc{} && stop == last ? std::optional(number) : std::nullopt;
}

bool is_same_file(const std::string& a, const std::string& b) {
  std::error_code error;
  return fs::equivalent(a, b, error) && !error;
}

Trouble write_file(const std::string& path, std::string_view content) {
  WholeFile file(path);
  file.add(content);
  return file.complete();
}

Result<std::string> read_file(const std::string& path) {
  std::error_code error;
  if (fs::is_directory(path, error)) {
    return cannot("read", path, "it is a folder", "name a file");
  }
  std::ifstream in(path, std::ios::binary);
  if (!in) return cannot("read", path, std::strerror(errno), "see that the path is right");
  std::string text;
  const auto size = fs::file_size(path, error);
  if (!error) text.reserve(size);
  std::vector<char> piece(1 << 16);
  while (in.read(piece.data(), static_cast<std::streamsize>(piece.size())), in.gcount() > 0) {
    text.append(piece.data(), static_cast<std::size_t>(in.gcount()));
  }
  if (in.bad()) return cannot("read", path, std::strerror(errno), "see that the disk is sound");
  return text;
}

RowFile::~RowFile() {
  if (file_ != nullptr) std::fclose(file_);
}

Trouble RowFile::open(const std::string& path) {
  path_ = path;
  file_ = std::fopen(path.c_str(), "wb");
  if (file_ == nullptr) return cannot_write(path, errno);
  return {};
}

Trouble RowFile::add(std::string_view rows) {
  if (file_ == nullptr) return {};
  if (std::fwrite(rows.data(), 1, rows.size(), file_) != rows.size() || std::fflush(file_) != 0) {
    return cannot_write(path_, errno);
  }
  bytes_ += rows.size();
  return {};
}

Trouble RowFile::reopen(const std::string& path, std::uint64_t bytes) {
  path_ = path;
  std::error_code error;
  const auto size = fs::file_size(path, error);
  if (error || size < bytes) {
    return cannot("gone on with", path,
                  error ? error.message() : "it is shorter than when the checkpoint was written",
                  "run without --resume");
  }
  fs::resize_file(path, bytes, error);
  if (error) return cannot_write(path, error.value());
  file_ = std::fopen(path.c_str(), "ab");
  if (file_ == nullptr) return cannot_write(path, errno);
  bytes_ = bytes;
  return {};
}

Trouble RowFile::sync() {
  if (file_ == nullptr) return {};
  if (std::fflush(file_) != 0 || ::fsync(::fileno(file_)) != 0) return cannot_write(path_, errno);
  return {};
}

Trouble RowFile::close() {
  if (file_ == nullptr) return {};
  const int result = std::fclose(file_);
  file_ = nullptr;
  if (result != 0) return cannot_write(path_, errno);
  return {};
}

Trouble check_folder(const std::string& folder, const std::string& input) {
  std::error_code error;
  if (!fs::exists(folder, error)) {
    fs::path above = fs::absolute(folder, error).lexically_normal();
    while (above.has_relative_path() && !fs::exists(above, error)) above = above.parent_path();
    if (::access(above.c_str(), W_OK | X_OK) == 0 && fs::is_directory(above, error)) return {};
    return cannot("made", folder, above.string() + " is no folder that may be written to",
                  "name another folder with -o");
  }
  if (!fs::is_directory(folder, error)) {
    return cannot("used for results", folder, "it is no folder", "name another with -o");
  }
  fs::path parent = fs::path(input).parent_path();
  if (parent.empty()) parent = ".";
  if (!input.empty() && fs::equivalent(parent, folder, error)) {
    return cannot("used for results", folder, "the model file lies in it",
                  "name another folder with -o");
  }
  const Content content = content_of(folder);
  if (content.error) {
    return cannot("used for results", folder, content.error.message(),
                  "name another folder with -o");
  }
  if (::access(folder.c_str(), W_OK) != 0) return cannot_write(folder, errno);
  if (content.alien) {
    return cannot("used for results", folder,
                  "it holds " + content.alien->lexically_relative(folder).string() +
                      ", which no run has written",
                  "name another folder with -o, or move that away");
  }
  return {};
}

FolderLock::~FolderLock() {
  if (handle_ >= 0) ::close(handle_);
}

Trouble FolderLock::take(const std::string& folder) {
  handle_ = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (handle_ < 0)
    return cannot("used for results", folder, std::strerror(errno), "name another with -o");
  if (::flock(handle_, LOCK_EX | LOCK_NB) == 0) return {};
  if (errno != EWOULDBLOCK) return {};  // a file system without locks
  ::close(handle_);
  handle_ = -1;
  return cannot("used for results", folder, "another run is writing to it",
                "wait for it, or name another folder with -o");
}

Trouble make_folder(const std::string& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) return cannot("made", folder, error.message(), "name another folder with -o");
  return {};
}

Trouble forget_end(const std::string& folder, std::size_t frames) {
  std::error_code error;
  for (const char* name :
       {"summary.json", "blocks.csv", "joints.csv", "bolt_summary.csv", "curve.csv"}) {
    fs::remove(fs::path(folder) / name, error);
  }
  const Content content = content_of(folder);
  for (const fs::path& file : content.files) {
    const std::string name = file.filename().string();
    if (name.ends_with(".part")) fs::remove(file, error);
    if (number_of_frame(name).value_or(0) >= frames) fs::remove(file, error);
  }
  return {};
}

Trouble clear_folder(const std::string& folder) {
  if (auto t = make_folder(folder)) return t;
  std::error_code error;
  // The summary is removed first: its presence means that a run has ended.
  fs::remove(fs::path(folder) / "summary.json", error);
  const Content content = content_of(folder);
  if (content.alien) return check_folder(folder, {});
  for (const fs::path& file : content.files) fs::remove(file, error);
  fs::create_directories(fs::path(folder) / "frames", error);
  if (error)
    return cannot("made", folder + "/frames", error.message(), "see that it may be written to");
  return {};
}

}  // namespace edda
