#include "imports/dxf_groups.hpp"

#include <algorithm>
#include <charconv>

#include "base/text.hpp"
#include "imports/file_words.hpp"

namespace edda {

const DxfGroup* DxfEntity::find(int code) const {
  for (const DxfGroup& g : groups) {
    if (g.code == code) return &g;
  }
  return nullptr;
}

bool DxfFault::add(int line, std::string problem, std::string remedy) {
  if (!fault_) fault_ = Fault{{"", path_, line, 1}, std::move(problem), std::move(remedy)};
  return false;
}

std::string in_capitals(std::string_view text) {
  std::string capitals(text);
  for (char& c : capitals) {
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  }
  return capitals;
}

std::string dxf_handle(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of('0'), text.size()));
  return in_capitals(text);
}

std::optional<int> whole_number(std::string_view text) {
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::optional<DxfGroup> DxfGroups::next() {
  while (!fault_.found() && !rest_.empty()) {
    DxfGroup group;
    group.line = line_ + 1;
    const std::string_view code = trimmed(take());
    const auto number = whole_number(code);
    if (!number) {
      DxfFault here(fault_.path());
      here.add(group.line, '"' + for_message(code) + "\" is not a group code");
      if (!any_ || !find_next_entity()) {
        fault_ = here;
        return std::nullopt;
      }
      if (!damage_) damage_ = here.found();
      continue;
    }
    any_ = true;
    if (rest_.empty() && code_is_last_) return std::nullopt;
    group.code = *number;
    group.value = trimmed(take());
    constexpr int comment = 999;
    if (group.code == 0 && group.value == "EOF") rest_ = {};
    if (group.code != comment) return group;
  }
  return std::nullopt;
}

/// Leaves a line "0" before a name in capitals as the next to be read.
bool DxfGroups::find_next_entity() {
  while (!rest_.empty()) {
    std::string_view ahead = rest_;
    const std::string_view code = trimmed(next_line(ahead)), name = trimmed(next_line(ahead));
    if (code == "0" && !name.empty() && name.front() >= 'A' && name.front() <= 'Z') return true;
    take();
  }
  return false;
}

std::string_view DxfGroups::take() {
  ++line_;
  code_is_last_ = rest_.empty();
  return next_line(rest_);
}

std::optional<DxfEntity> DxfSection::next() {
  while (!begun_ || !is_end(*begun_)) {
    const auto group = file_.next();
    auto damage = file_.take_damage();
    if (damage && begun_ && !begun_->fault) begun_->fault = std::move(damage);
    if (!group) return std::nullopt;
    if (group->code != 0) {
      if (begun_) begun_->groups.push_back(*group);
      continue;
    }
    std::optional<DxfEntity> whole = std::move(begun_);
    begun_ = DxfEntity{group->value, group->line, {}, {}};
    if (whole && !whole->name.empty()) return whole;
  }
  return std::exchange(begun_, std::nullopt);
}

}  // namespace edda
