#include "model/files/file_text.hpp"

#include <cstdio>
#include <filesystem>
#include <memory>
#include <system_error>

namespace edda {

static constexpr std::size_t largest_file = std::size_t{64} << 20U;  // bytes

std::variant<std::string, Fault> file_text(const std::string& path) {
  auto fault = [&](std::string problem, std::string remedy) {
    return Fault{{"", path, 0, 0}, std::move(problem), std::move(remedy)};
  };
  std::error_code error;
  if (path.empty() || !std::filesystem::exists(path, error)) {
    const bool ending_lacks = !path.empty() && std::filesystem::exists(path + ".toml", error);
    return fault("no such file", ending_lacks ? "did you mean " + path + ".toml?"
                                              : std::string("check the name of the file"));
  }
  if (std::filesystem::is_directory(path, error)) {
    const bool ending_lacks = std::filesystem::exists(path + ".toml", error);
    return fault("is a folder, not a file", ending_lacks ? "did you mean " + path + ".toml?"
                                                         : std::string("give a file in it"));
  }
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"),
                                                             &std::fclose);
  if (file == nullptr) {
    return fault("cannot be opened", "check that you may read it");
  }
  std::string text;
  std::string chunk(std::size_t{1} << 16U, '\0');
  while (const std::size_t n = std::fread(chunk.data(), 1, chunk.size(), file.get())) {
    text.append(chunk, 0, n);
    if (text.size() > largest_file) {
      return fault("is larger than 64 MiB", "is this the right file?");
    }
  }
  if (std::ferror(file.get()) != 0) {
    return fault("cannot be read to its end", "check the disk it is on");
  }
  return text;
}

std::string beside_model(const std::string& path, const std::string& model_file) {
  const std::filesystem::path found = std::filesystem::path(model_file).parent_path() / path;
  std::error_code error;
  const std::filesystem::path whole = std::filesystem::absolute(found, error);
  return (error ? found : whole).string();
}

}  // namespace edda
