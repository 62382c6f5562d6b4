// edda-sampler (src/sampler) as a child process.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "base/fault.hpp"

namespace edda {

/// Starts the program that lies beside this one, or in ../lib/edda, on its first use. One line of
/// JSON is sent, one comes back.
class SamplerProcess {
 public:
  SamplerProcess() = default;
  SamplerProcess(const SamplerProcess&) = delete;
  SamplerProcess& operator=(const SamplerProcess&) = delete;
  ~SamplerProcess();
  /// The answer to a request; a fault where it cannot be answered, or the program is missing.
  Result<nlohmann::json> ask(const nlohmann::json& line);

 private:
  std::string start();
  int to_ = -1, from_ = -1, process_ = -1;
  std::string unread_;  ///< bytes of the next line
};

}  // namespace edda
