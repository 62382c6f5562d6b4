// What the commands of edda study share: the end of a study, and its subcommands.
#pragma once

#include "app/commands.hpp"
#include "sampling/lead_study.hpp"

namespace edda {

struct AnswerStyle {
  bool json = false, quiet = false;
  double seconds = 0.0;  ///< of wall time
};

/// Writes the results of a study that is complete, and prints the answer. Returns the exit code.
int answer_study(const StudyPlan& plan, StudyRun run, const SampleFolder& folder,
                 SamplerProcess& sampler, const AnswerStyle& style);

void add_study_show(CLI::App& study, int& code);
void add_study_merge(CLI::App& study, int& code);

}  // namespace edda
