// What the commands of studies share: their folder, and how they print their answer.
#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <string>

#include "app/common.hpp"
#include "results/files.hpp"
#include "results/json.hpp"

namespace edda {

/// Makes or clears the folder, which has no frames, and calls write() while it is locked.
template <class Write>
Trouble fill_study_folder(const std::string& folder, const Write& write) {
  FolderLock lock;
  Trouble trouble = make_folder(folder);
  if (!trouble) trouble = lock.take(folder);
  if (!trouble) trouble = clear_folder(folder);
  std::error_code none_there;
  std::filesystem::remove(folder + "/frames", none_there);
  return trouble ? trouble : write();
}

/// The summary as one line, the message alone, or what print_all() prints.
template <class PrintAll>
void print_answer(bool json, bool quiet, const std::string& summary, const std::string& message,
                  const PrintAll& print_all) {
  say([&] {
    if (json) {
      fmt::print("{}\n", one_line(summary));
    } else if (quiet) {
      fmt::print("{}\n", message);
    } else {
      print_all();
    }
  });
}

}  // namespace edda
