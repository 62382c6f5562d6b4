#include "model/read_model.hpp"

#include <algorithm>
#include <tuple>
#include <variant>

#include "model/completion/complete.hpp"
#include "model/files/file_text.hpp"
#include "model/files/old_names.hpp"
#include "model/files/overrides.hpp"
#include "model/files/reader.hpp"
#include "model/files/value.hpp"

namespace edda {
namespace {

Fault file_fault(const std::string& path, int line, std::string problem, std::string remedy) {
  return {{"", path, line, line > 0 ? 1 : 0}, std::move(problem), std::move(remedy)};
}

/// Length of the UTF-8 sequence that starts at text[i], 0 if it is not one.
std::size_t utf8_length(std::string_view text, std::size_t i) {
  const auto byte = [&](std::size_t k) {
    return k < text.size() ? static_cast<unsigned char>(text[k]) : 0U;
  };
  const auto follows = [&](std::size_t k) { return (byte(k) & 0xC0U) == 0x80U; };
  const unsigned lead = byte(i), next = byte(i + 1);
  if (lead < 0x80U) return 1;
  if (lead >= 0xC2U && lead <= 0xDFU) return follows(i + 1) ? 2 : 0;
  if (!follows(i + 1) || !follows(i + 2)) return 0;
  const bool surrogate = lead == 0xEDU && next >= 0xA0U;
  if (lead >= 0xE0U && lead <= 0xEFU) {
    return (lead == 0xE0U && next < 0xA0U) || surrogate ? 0 : 3;
  }
  if (!follows(i + 3) || (lead == 0xF0U && next < 0x90U) || (lead == 0xF4U && next > 0x8FU)) {
    return 0;
  }
  return lead >= 0xF0U && lead <= 0xF4U ? 4 : 0;
}

/// Line of the first byte that is not UTF-8, 0 if there is none.
int not_utf8(std::string_view text) {
  int line = 1;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = utf8_length(text, i);
    if (length == 0) return line;
    if (text[i] == '\n') ++line;
    i += length;
  }
  return 0;
}

void sort_by_place(Faults& faults) {
  std::stable_sort(faults.begin(), faults.end(), [](const Fault& a, const Fault& b) {
    const auto order = [](const Where& where) {
      return std::tuple(where.file == "--set", where.line, where.column);
    };
    return order(a.where) < order(b.where);
  });
}

}  // namespace

Result<Model> read_model_text(std::string_view text, const std::string& file_name,
                              const std::vector<std::string>& overrides, ReadFor what_for) {
  if (const int line = not_utf8(text); line > 0) {
    return file_fault(file_name, line, "is not UTF-8 text",
                      "save it as UTF-8, if it is a model file");
  }
  Result<Value> document = parse_toml(text, file_name);
  if (!document) return document.faults();
  Value& root = document.value();
  if (std::get<Table>(root.content).empty()) {
    return file_fault(file_name, 0, "is empty", "write a model; `edda example` has some");
  }
  Reading reading;
  reading.file = file_name;
  reading.model.file = file_name;
  rename_old(root, reading);
  apply_overrides(root, overrides, reading);
  rename_old(root, reading);  // in lists that replace the file's
  read_sections(root, reading);
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
