// What the checks of a study's file share.
#pragma once

#include "model/completion/complete_tools.hpp"
#include "model/study/study_plan.hpp"

namespace edda {

/// The plan with the file's values, where faults can be placed.
struct Completing {
  StudyPlan& plan;
  const Value& root;
  Reading& reading;

  void fault(const Value* table, std::string_view key, const std::string& path, std::string problem,
             std::string remedy) const {
    const Place place = table == nullptr ? Place{1, 1, false} : place_of(table, key);
    add_fault(reading, place, path + '.' + std::string(key), std::move(problem), std::move(remedy));
  }
};

/// Fills in and checks the [vary] tables.
void complete_vary(const Completing& c);
/// Checks [map].
void complete_map(const Completing& c);

}  // namespace edda
