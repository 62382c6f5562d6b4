// Pictures and the report of a study.
#pragma once

#include "sampling/study_results.hpp"

namespace edda {

/// histogram_NAME, scatter, tornado, sobol and convergence, each .png and .svg, and report.html, in
/// the study's folder; those for which there is anything to draw.
Trouble draw_study(const StudyPlan& plan, const StudyResults& results, const SampleFolder& folder,
                   SamplerProcess& sampler);

}  // namespace edda
