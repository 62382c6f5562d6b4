#include "model/table/nearest.hpp"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <limits>
#include <utility>

namespace edda {
namespace {

constexpr std::size_t longest_word = 64;  // an edit distance costs the product of the lengths

std::string lowered(std::string_view word) {
  std::string lower(word.substr(0, longest_word));
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return lower;
}

}  // namespace

std::string clipped(std::string_view text) {
  constexpr std::size_t longest = 40;
  std::size_t end = text.size();
  if (end > longest) {
    end = longest;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;
  }
  std::string line(text.substr(0, end));
  for (char& c : line) {
    if (is_control(c)) c = '?';
  }
  return end < text.size() ? line + "..." : line;
}

int edit_distance(std::string_view first, std::string_view second) {
  const std::string a = lowered(first), b = lowered(second);
  std::vector<int> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = static_cast<int>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = static_cast<int>(i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const int replace = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, replace});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        row[j] = std::min(row[j], before[j - 2] + 1);
      }
    }
    before.swap(last);
    last.swap(row);
  }
  return last[b.size()];
}

namespace {

int distance(std::string_view word, std::string_view candidate) {
  constexpr std::size_t shortest_part = 4;
  const std::string a = lowered(word), b = lowered(candidate);
  const std::string& part = a.size() < b.size() ? a : b;
  const std::string& whole = a.size() < b.size() ? b : a;
  const int edits = edit_distance(a, b);
  const bool holds = part.size() >= shortest_part && whole.find(part) != std::string::npos;
  return holds ? std::min(edits, likely_edits) : edits;
}

}  // namespace

std::string_view nearest(std::string_view word, std::span<const std::string_view> known) {
  std::string_view best;
  int fewest = std::numeric_limits<int>::max();
  for (const std::string_view candidate : known) {
    const int edits = distance(word, candidate);
    if (edits >= fewest) continue;
    fewest = edits;
    best = candidate;
  }
  return best;
}

std::vector<std::string_view> nearest_first(std::string_view word,
                                            std::span<const std::string_view> known) {
  std::vector<std::pair<int, std::string_view>> by_edits;
  for (const std::string_view candidate : known) {
    by_edits.emplace_back(distance(word, candidate), candidate);
  }
  std::stable_sort(by_edits.begin(), by_edits.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<std::string_view> words;
  for (const auto& [edits, candidate] : by_edits) words.push_back(candidate);
  return words;
}

std::string quoted_list(std::span<const std::string_view> words) {
  constexpr std::size_t most = 12;
  std::string list;
  for (std::size_t i = 0; i < std::min(words.size(), most); ++i) {
    list += (i == 0 ? "\"" : ", \"") + clipped(words[i]) + '"';
  }
  if (words.size() > most) list += " and " + std::to_string(words.size() - most) + " more";
  return list;
}

bool is_likely(std::string_view word, std::span<const std::string_view> known) {
  // A few edits turn any short word into any other.
  const int most = word.size() < 2 ? 0 : word.size() < 4 ? 1 : likely_edits;
  return !known.empty() && distance(word, nearest(word, known)) <= most;
}

std::string suggestion(std::string_view word, std::span<const std::string_view> known) {
  if (known.empty()) return "the model has none";
  const std::string best = '"' + clipped(nearest(word, known)) + '"';
  if (is_likely(word, known)) return "did you mean " + best + "?";
  if (known.size() == 1) return "the only known one is " + best;
  return "known are " + quoted_list(nearest_first(word, known));
}

}  // namespace edda
