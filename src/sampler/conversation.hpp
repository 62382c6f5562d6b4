// One line of JSON after another: requests on standard input, answers on standard output.
#pragma once

#include <nlohmann/json.hpp>

namespace edda::sampler {

/// Writes one line.
void answer(const nlohmann::json& line);
/// The next line; null at the end of the input.
nlohmann::json next_line();

/// The numbers of a point or a vector.
template <class Numbers>
nlohmann::json list_of(const Numbers& numbers) {
  nlohmann::json list = nlohmann::json::array();
  for (const double x : numbers) list.push_back(x);
  return list;
}

nlohmann::json points(const nlohmann::json& request);
nlohmann::json interval(const nlohmann::json& request);
nlohmann::json ranks(const nlohmann::json& request);
nlohmann::json sobol_indices(const nlohmann::json& request);
/// Asks for the values of points with answer() and next_line() as it needs them.
nlohmann::json reliability(const nlohmann::json& request);
/// The same.
nlohmann::json fit(const nlohmann::json& request);

}  // namespace edda::sampler
