// edda-sampler: the sampling and the reliability methods of `edda study`, by OpenTURNS, in a
// program of its own: OpenTURNS is linked with a hundred libraries, some of them under the GPL,
// which would take a tenth of a second to load for every other command.
//
// It reads requests and writes answers, each one line of JSON, until its input ends. A request that
// cannot be answered gives { "fault": "..." }.
#include <iostream>
#include <string>

#include <openturns/OT.hxx>

#include "sampler/conversation.hpp"

namespace edda::sampler {

void answer(const nlohmann::json& line) {
  std::cout << line.dump() << std::endl;
}

nlohmann::json next_line() {
  std::string text;
  return std::getline(std::cin, text) ? nlohmann::json::parse(text) : nlohmann::json();
}

}  // namespace edda::sampler

namespace {

nlohmann::json answer_to(const nlohmann::json& request) {
  using namespace edda::sampler;
  const std::string task = request.at("task");
  if (task == "points") return points(request);
  if (task == "interval") return interval(request);
  if (task == "ranks") return ranks(request);
  if (task == "sobol-indices") return sobol_indices(request);
  if (task == "reliability") return reliability(request);
  if (task == "fit") return fit(request);
  return {{"fault", "there is no task " + task}};
}

}  // namespace

int main() {
  using edda::sampler::answer;
  OT::Log::Show(OT::Log::NONE);
  while (true) {
    try {
      const nlohmann::json request = edda::sampler::next_line();
      if (request.is_null()) return 0;
      answer(answer_to(request));
    } catch (const OT::Exception& error) {
      answer({{"fault", error.what()}});
    } catch (const nlohmann::json::exception& error) {
      answer({{"fault", error.what()}});
    }
  }
}
