// Any bytes as a model file: a model or faults, never a crash; and what is written reads back.
#include <cstdint>
#include <cstdlib>
#include <string>

#include "model/read_model.hpp"
#include "model/write_model.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  const edda::Result<edda::Model> model = edda::read_model_text(text, "fuzz.toml", {});
  if (!model.ok()) {
    for (const edda::Fault& fault : model.faults()) {
      if (fault.problem.empty() || edda::to_string(fault).empty()) std::abort();
    }
    return 0;
  }
  const std::string written = edda::to_toml(model.value());
  const edda::Result<edda::Model> again = edda::read_model_text(written, "again.toml", {});
  if (!again.ok() || edda::to_toml(again.value()) != written) std::abort();
  return 0;
}
