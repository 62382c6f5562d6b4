// Files that are complete or do not exist, and the results folder.
#pragma once

#include <cstddef>
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
  /// After an error nothing more is written; complete() reports it.
  void add(std::string_view bytes);
  Trouble complete();

 private:
  std::string path_, part_;
  std::FILE* file_;
  int error_ = 0;
};

/// The number in the name of one of several files: 12 of contacts_000012.vtu for the start
/// "contacts_" and the end ".vtu". Nothing where the name has another form.
std::optional<std::size_t> number_in_name(std::string_view name, std::string_view start,
                                          std::string_view end);

/// Whether both paths lead to the same existing file.
bool is_same_file(const std::string& a, const std::string& b);

/// Writes a whole file at once.
Trouble write_file(const std::string& path, std::string_view content);

/// Reads a whole file, or returns a fault.
Result<std::string> read_file(const std::string& path);

/// A file that grows row by row; every row is on its way to the disk when add() returns.
class RowFile {
 public:
  RowFile() = default;
  RowFile(const RowFile&) = delete;
  RowFile& operator=(const RowFile&) = delete;
  ~RowFile();

  Trouble open(const std::string& path);
  /// Opens an existing file, truncated to its first `bytes`.
  Trouble reopen(const std::string& path, std::uint64_t bytes);
  /// Flushes all rows to the disk.
  Trouble sync();
  std::uint64_t bytes() const { return bytes_; }
  Trouble add(std::string_view rows);
  Trouble close();

 private:
  std::FILE* file_ = nullptr;
  std::string path_;
  std::uint64_t bytes_ = 0;  ///< written so far
};

/// Whether `folder` may take results: it does not exist, is empty, or contains only files of an
/// earlier run. `input` is the model file; a folder in which it would be overwritten is refused. It
/// is empty where a run is continued, which may have been read from its model.toml.
Trouble check_folder(const std::string& folder, const std::string& input);

/// Locks a folder for one run until the end of this object, also where the program is killed.
class FolderLock {
 public:
  FolderLock() = default;
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;
  ~FolderLock();
  /// Returns a fault where another run has locked it.
  Trouble take(const std::string& folder);

 private:
  int handle_ = -1;
};

/// Makes the folder if it does not exist.
Trouble make_folder(const std::string& folder);

/// Removes from it what a run writes at its end, the frames from number `frames` on, and unfinished
/// files.
Trouble forget_end(const std::string& folder, std::size_t frames);

/// Makes the folder, or removes an earlier run's files from it (those that check_folder() accepts).
Trouble clear_folder(const std::string& folder);

}  // namespace edda
