#include "model/read_model.hpp"

#include <variant>

#include "model/completion/complete.hpp"
#include "model/files/document.hpp"
#include "model/files/file_text.hpp"
#include "model/files/old_names.hpp"
#include "model/files/overrides.hpp"
#include "model/files/reader.hpp"
#include "model/files/value.hpp"

namespace edda {
Result<Model> read_model_text(std::string_view text, const std::string& file_name,
                              const std::vector<std::string>& overrides, ReadFor what_for) {
  Result<Value> document =
      read_document(text, file_name, "model", "write a model; `edda example` has some");
  if (!document) return document.faults();
  Value& root = document.value();
  Reading reading;
  reading.file = file_name;
  reading.model.file = file_name;
  rename_old(root, reading);
  apply_overrides(root, overrides, reading);
  rename_old(root, reading);  // in lists that replace the file's
  read_sections(root, &reading.model, reading);
  complete(root, reading);
  const bool says =
      find(find(&root, "solver"), "duration") != nullptr ||  // even with a wrong value
      find(&root, "stage") != nullptr;
  if (what_for == ReadFor::run && !says) {
    if (auto fault = missing_duration(reading.model)) reading.faults.push_back(std::move(*fault));
  }
  if (reading.faults.empty()) return std::move(reading.model);
  sort_by_place(reading.faults);
  return std::move(reading.faults);
}

Result<Model> read_model(const std::string& path, const std::vector<std::string>& overrides,
                         ReadFor what_for) {
  const std::variant<std::string, Fault> text = file_text(path);
  if (const Fault* fault = std::get_if<Fault>(&text)) return *fault;
  return read_model_text(std::get<std::string>(text), path, overrides, what_for);
}

std::optional<Fault> missing_duration(const Model& model) {
  if (!model.stages.empty() || model.solver.duration > 0.0) return {};
  Where where = model.solver.where;
  if (where.file.empty()) where.file = model.file;
  where.key = "solver.duration";
  return Fault{where, "is missing",
               "give " + expected(*find_key(find_section("solver")->keys, "duration")) +
                   " for a run; edda fos needs none"};
}

}  // namespace edda
