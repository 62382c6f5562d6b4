#include "model/files/document.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

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

}  // namespace

Result<Value> read_document(std::string_view text, const std::string& file, std::string_view kind,
                            const std::string& if_empty) {
  if (const int line = not_utf8(text); line > 0) {
    return file_fault(file, line, "is not UTF-8 text",
                      fmt::format("save it as UTF-8, if it is a {} file", kind));
  }
  Result<Value> document = parse_toml(text, file);
  if (document.ok() && std::get<Table>(document.value().content).empty())
    return file_fault(file, 0, "is empty", if_empty);
  return document;
}

void sort_by_place(Faults& faults) {
  std::stable_sort(faults.begin(), faults.end(), [](const Fault& a, const Fault& b) {
    const auto order = [](const Where& where) {
      return std::tuple(where.file == "--set", where.line, where.column);
    };
    return order(a.where) < order(b.where);
  });
}

}  // namespace edda
