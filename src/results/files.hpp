// Files that are there whole or not at all, and the folder that holds them.
#pragma once

#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>
#include <string_view>

#include "base/fault.hpp"

namespace edda {

/// Nothing, or why a file could not be written.
using Trouble = std::optional<Fault>;

/// Why a file could not be written, with what to do.
Fault cannot_write(const std::string& path, int error);

/// A file written piece by piece beside its path and moved there once it is complete, so that a
/// full disk never leaves half a file and an earlier file stays until the new one is complete.
class WholeFile {
 public:
  explicit WholeFile(std::string path);
  WholeFile(const WholeFile&) = delete;
  WholeFile& operator=(const WholeFile&) = delete;
  ~WholeFile();
  /// After trouble nothing more is written; complete() tells.
  void add(std::string_view bytes);
  Trouble complete();

 private:
  std::string path_, part_;
  std::FILE* file_;
  int error_ = 0;
};

/// Whether both paths lead to one file that there is.
bool is_same_file(const std::string& a, const std::string& b);

/// A whole file at once.
Trouble write_file(const std::string& path, std::string_view content);

/// The whole of a file, or a fault.
Result<std::string> read_file(const std::string& path);

/// A file that grows row by row; every row is on its way to the disk when add() returns.
class RowFile {
 public:
  RowFile() = default;
  RowFile(const RowFile&) = delete;
  RowFile& operator=(const RowFile&) = delete;
  ~RowFile();

  Trouble open(const std::string& path);
  /// Opens a file that is there, cut to its first `bytes`.
  Trouble reopen(const std::string& path, std::uint64_t bytes);
  /// Brings all rows to the disk itself.
  Trouble sync();
  std::uint64_t bytes() const { return bytes_; }
  Trouble add(std::string_view rows);
  Trouble close();

 private:
  std::FILE* file_ = nullptr;
  std::string path_;
  std::uint64_t bytes_ = 0;  ///< written so far
};

/// Whether `folder` may take results: it does not exist, is empty, or holds nothing but an earlier
/// run's files. `input` is the model file; a folder in which it would be overwritten is refused.
/// Empty where a run goes on, which may have been read from its model.toml.
Trouble check_folder(const std::string& folder, const std::string& input);

/// Holds a folder for one run, from opening to the end of this object, whatever ends the program.
class FolderLock {
 public:
  FolderLock() = default;
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;
  ~FolderLock();
  /// A fault where another run has it.
  Trouble take(const std::string& folder);

 private:
  int handle_ = -1;
};

/// Makes the folder if it is not there.
Trouble make_folder(const std::string& folder);

/// Takes out of it what a run wrote at its end, the frames from number `frames` on, and files that
/// were never finished.
Trouble forget_end(const std::string& folder, std::size_t frames);

/// Makes the folder, or takes an earlier run's files out of it (those that check_folder() accepts).
Trouble clear_folder(const std::string& folder);

}  // namespace edda
