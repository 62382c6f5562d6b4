#include "sampling/worker_pool.hpp"

#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <thread>

extern char** environ;

namespace edda {
namespace {

namespace fs = std::filesystem;

/// In the environment of a worker: who started it, and may have ended before it looked.
constexpr const char* parent_name = "EDDA_STUDY_PARENT";

int started(const std::vector<std::string>& arguments) {
  std::vector<char*> list;
  for (const std::string& a : arguments) list.push_back(const_cast<char*>(a.c_str()));
  list.push_back(nullptr);
  // One thread a run: there are as many runs as processors.
  std::vector<char*> environment;
  for (char** e = environ; *e != nullptr; ++e) {
    if (std::string_view(*e).substr(0, 16) != "OMP_NUM_THREADS=") environment.push_back(*e);
  }
  std::string threads = "OMP_NUM_THREADS=1";
  std::string parent = fmt::format("{}={}", parent_name, ::getpid());
  environment.push_back(threads.data());
  environment.push_back(parent.data());
  environment.push_back(nullptr);
  int process = -1;
  const int error =
      ::posix_spawn(&process, list[0], nullptr, nullptr, list.data(), environment.data());
  return error == 0 ? process : -1;
}

bool is_crash(int status) {
  if (!WIFSIGNALED(status)) return false;
  const int s = WTERMSIG(status);
  return s == SIGSEGV || s == SIGABRT || s == SIGBUS || s == SIGFPE || s == SIGILL;
}

/// What the worker had begun when it crashed gets a row that says so.
void report_crash(const SampleFolder& folder, const StudyPlan& plan, int process, int status) {
  const std::string mark = fmt::format("-{}-", process);
  std::error_code error;
  for (fs::directory_iterator it(folder.file("workers"), error), end; !error && it != end;
       it.increment(error)) {
    if (it->path().filename().string().find(mark) == std::string::npos) continue;
    SampleAnswer answer;
    answer.cells.resize(answer_cells(plan));
    answer.message = fmt::format("the analysis ended with signal {} ({})", WTERMSIG(status),
                                 ::strsignal(WTERMSIG(status)));
    FolderLock lock;
    if (lock.take(it->path())) continue;
    for (const std::size_t s : samples_begun(it->path().string()))
      end_sample(it->path().string(), s, answer);
  }
}

}  // namespace

Trouble WorkerPool::look_after(const SampleFolder& folder, const StudyPlan& plan) {
  for (int& process : processes_) {
    int status = 0;
    if (process >= 0 && ::waitpid(process, &status, WNOHANG) == process) {
      if (is_crash(status)) report_crash(folder, plan, process, status);
      process = -1;
      if (Trouble t = folder.recover()) return t;
      const std::size_t rows = folder.rows(plan).size();
      ended_ = rows > rows_ ? 1 : ended_ + 1;
      rows_ = rows;
    }
    constexpr std::size_t most = 20;
    if (ended_ > most + processes_.size()) {
      return Fault{{"", folder.path(), 0, 0},
                   "workers end again and again without a result",
                   "see whether memory is short; edda study with --jobs 1 needs less"};
    }
    if (process >= 0) continue;
    process = started(arguments_);
    if (process < 0)
      return Fault{{"", arguments_.front(), 0, 0},
                   "cannot be started as a worker",
                   "start the study again with the program as it is now"};
  }
  return {};
}

void WorkerPool::end() {
  for (const int process : processes_) {
    if (process >= 0) ::kill(process, SIGKILL);
  }
  for (int& process : processes_) {
    if (process >= 0) ::waitpid(process, nullptr, 0);
    process = -1;
  }
}

Trouble work_in(const SampleFolder& folder, const StudyPlan& plan, const std::string& model_text,
                const Shard& shard) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  const char* started_by = std::getenv(parent_name);
  const pid_t parent = started_by != nullptr ? std::atoi(started_by) : ::getppid();
  Worker worker;
  if (Trouble t = worker.join(folder)) return t;
  Points points;
  while (::getppid() == parent) {
    const std::optional<std::size_t> sample = worker.take(shard);
    if (!sample) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
      continue;
    }
    if (*sample >= points.size()) {
      Result<Points> all = folder.points(plan);
      if (!all.ok()) return all.faults().front();
      points = std::move(all.value());
    }
    const SampleAnswer answer = run_sample(plan, model_text, points.at(*sample), worker.scratch());
    if (Trouble t = worker.finish(*sample, answer)) return t;
  }
  return {};
}

}  // namespace edda
