// Worker processes of this machine.
#pragma once

#include <string>
#include <vector>

#include "sampling/sample_folder.hpp"

namespace edda {

class WorkerPool {
 public:
  /// arguments: the command of a worker, the path of its program first.
  WorkerPool(std::vector<std::string> arguments, std::size_t count)
      : arguments_(std::move(arguments)), processes_(count, -1) {}
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;
  ~WorkerPool() { end(); }

  /// Starts workers that are missing. A sample with which one has crashed gets that as its row.
  /// Trouble where workers end again and again without finishing anything.
  Trouble look_after(const SampleFolder& folder, const StudyPlan& plan);
  /// Ends them; what they had begun is free again once the folder is recovered.
  void end();

 private:
  std::vector<std::string> arguments_;
  std::vector<int> processes_;  ///< -1: none
  std::size_t ended_ = 0;       ///< one after the other, none of which finished a sample
  std::size_t rows_ = 0;
};

/// The loop of a worker: until its parent ends, or this is killed.
Trouble work_in(const SampleFolder& folder, const StudyPlan& plan, const std::string& model_text,
                const Shard& shard);

}  // namespace edda
