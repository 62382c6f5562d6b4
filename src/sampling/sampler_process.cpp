#include "sampling/sampler_process.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>

extern char** environ;

namespace edda {
namespace {

namespace fs = std::filesystem;

Fault sampler_fault(const std::string& problem, const std::string& remedy) {
  return {{"", "edda-sampler", 0, 0}, problem, remedy};
}

/// Beside the program as it is built, in ../lib/edda as it is installed; or where EDDA_SAMPLER
/// says.
fs::path sampler_path() {
  if (const char* given = std::getenv("EDDA_SAMPLER"); given != nullptr) return given;
  std::error_code error;
  const fs::path here = fs::read_symlink("/proc/self/exe", error).parent_path();
  for (const fs::path& path : {here / "edda-sampler", here / "../lib/edda/edda-sampler",
                               fs::path("/usr/lib/edda/edda-sampler")}) {
    if (fs::is_regular_file(path, error)) return path;
  }
  return {};
}

}  // namespace

SamplerProcess::~SamplerProcess() {
  if (process_ < 0) return;
  ::close(to_);  // the end of its input ends it
  ::close(from_);
  ::waitpid(process_, nullptr, 0);
}

/// Empty, or why it could not be started.
std::string SamplerProcess::start() {
  const fs::path path = sampler_path();
  if (path.empty()) return "is not there";
  std::array<int, 2> in{}, out{};
  if (::pipe2(in.data(), O_CLOEXEC) != 0) return std::strerror(errno);
  if (::pipe2(out.data(), O_CLOEXEC) != 0) return std::strerror(errno);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, in[0], STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, out[1], STDOUT_FILENO);
  // Ctrl-C is for this program alone, which then ends the other.
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  std::string name = path.string();
  char* const arguments[] = {name.data(), nullptr};
  const int error =
      ::posix_spawn(&process_, name.c_str(), &actions, &attributes, arguments, environ);
  posix_spawn_file_actions_destroy(&actions);
  posix_spawnattr_destroy(&attributes);
  ::close(in[0]);
  ::close(out[1]);
  to_ = in[1];
  from_ = out[0];
  if (error != 0) process_ = -1;
  return error == 0 ? std::string() : std::strerror(error);
}

Result<nlohmann::json> SamplerProcess::ask(const nlohmann::json& line) {
  if (process_ < 0) {
    if (const std::string why = start(); !why.empty()) {
      return sampler_fault(
          why, "edda study draws its samples with it; build it with libopenturns-dev installed");
    }
  }
  const std::string text = line.dump() + '\n';
  for (std::size_t sent = 0; sent < text.size();) {
    const ssize_t n = ::write(to_, text.data() + sent, text.size() - sent);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return sampler_fault("has ended", "start the study again; it goes on");
    sent += static_cast<std::size_t>(n);
  }
  std::array<char, 65536> buffer{};
  std::size_t end = unread_.find('\n');
  while (end == std::string::npos) {
    const ssize_t n = ::read(from_, buffer.data(), buffer.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return sampler_fault("has ended", "start the study again; it goes on");
    const std::size_t before = unread_.size();
    unread_.append(buffer.data(), static_cast<std::size_t>(n));
    end = unread_.find('\n', before);
  }
  nlohmann::json answer = nlohmann::json::parse(unread_.substr(0, end), nullptr, false);
  unread_.erase(0, end + 1);
  if (answer.is_discarded())
    return sampler_fault("gave no JSON", "report this as an error of edda");
  if (answer.contains("fault")) {
    return sampler_fault(answer["fault"].get<std::string>(),
                         "change [vary], [[correlated]] or [sampling]");
  }
  return answer;
}

}  // namespace edda
