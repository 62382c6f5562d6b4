// The keys of a study's file.
#include <array>

#include "model/study/study_keys.hpp"
#include "model/table/key_reference.hpp"
#include "model/table/rules.hpp"
#include "model/table/slots.hpp"
#include "model/write_model.hpp"

namespace edda {
namespace {

using namespace rules;

// clang-format off
constexpr std::array root_keys{
    Key{"title", at<&StudyPlan::title>, text, initial, "Title of the report."},
    Key{"model", at<&StudyPlan::model>, file, required, "The model file, relative to the study's."},
};

constexpr std::array sampling_keys{
    Key{"method", at<&Sampling::method>, choice, initial, "Independent draws (monte-carlo), draws spread evenly over each quantity (latin-hypercube) or over all (sobol), every combination of the values (grid), the rows of a file (table); the most likely failure by first- or second-order reliability (form, sorm), subset simulation for small probabilities (subset), Saltelli's design for the sensitivity indices of Sobol (sobol-indices); or a search for the values with which the answers are those that were measured (fit, edda fit)."},
    Key{"samples", at<&Sampling::samples>, whole(1, 10'000'000), otherwise("required unless method is grid, table, form, sorm or fit"), "Number of samples; of subset: per level; of sobol-indices: this many times the number of quantities plus two."},
    Key{"seed", at<&Sampling::seed>, whole(0, 4'000'000'000), initial, "Another seed, other draws."},
    Key{"table", at<&Sampling::table>, file, otherwise("required of method table"), "CSV file with a column for each quantity, named as in [vary]."},
    Key{"confidence", at<&Sampling::confidence>, number(D::plain, between(0.5, 1)), initial, "Confidence of all intervals."},
    Key{"half_width", at<&Sampling::half_width>, number(D::plain, between(0, 0.5)), or_none("all samples are run"), "The study ends once the interval of the probability of failure is no wider than plus or minus this."},
    Key{"difference", at<&Sampling::difference>, number(D::plain, above_to(0, 1)), initial, "Step of the derivatives: of form and sorm in standard deviations, of fit a tenth of this as a part of the range from low to high."},
    Key{"tolerance", at<&Sampling::tolerance>, number(D::plain, above_to(0, 0.1)), initial, "Methods form and sorm: how exactly the most likely failure is found, in standard deviations."},
};

constexpr std::array vary_keys{
    Key{"key", at<&Vary::key>, naming, otherwise("none; either this or keys"), "Key of the model that gets the value, as --set names it."},
    Key{"keys", at<&Vary::keys>, name_list, otherwise("none; either this or key"), "Several keys of the model that all get the value."},
    Key{"distribution", at<&Vary::distribution>, choice, otherwise("required unless method is grid, table or fit"), "What the value is drawn from."},
    Key{"mean", at<&Vary::mean>, number(D::plain), otherwise("required of normal, lognormal, exponential, weibull, beta, von-mises and fisher"), "Mean, before truncation."},
    Key{"sd", at<&Vary::sd>, number(D::plain, above(0)), otherwise("required of normal, lognormal, weibull and beta unless cv is given"), "Standard deviation, before truncation."},
    Key{"cv", at<&Vary::cv>, number(D::plain, above(0)), otherwise("none; in place of sd"), "Coefficient of variation: standard deviation over mean."},
    Key{"low", at<&Vary::low>, number(D::plain), otherwise("required of uniform, triangular and beta, and of method fit; of lognormal, exponential and weibull 0; of seed 1"), "Smallest value."},
    Key{"high", at<&Vary::high>, number(D::plain), otherwise("required of uniform, triangular and beta, and of method fit"), "Largest value."},
    Key{"mode", at<&Vary::mode>, number(D::plain), otherwise("required of triangular"), "Most likely value."},
    Key{"concentration", at<&Vary::concentration>, number(D::plain, above(0)), otherwise("required of von-mises, and of the dip of fisher"), "Concentration kappa of the von Mises or the Fisher distribution, the mean of which is in degrees."},
    Key{"start", at<&Vary::start>, number(D::plain), otherwise("midway between low and high"), "Method fit: where the search begins, between its bounds low and high."},
    Key{"scale", at<&Vary::scale>, choice, initial, "Method fit: log where a value may be several times as large or small, such as a stiffness."},
    Key{"with", at<&Vary::with>, text, otherwise("none: it is a dip"), "Distribution fisher: of a dip direction the name of the [vary] that is its dip; both are drawn together."},
    Key{"at_least", at<&Vary::at_least>, number(D::plain), otherwise("not truncated"), "The distribution is truncated below this value."},
    Key{"at_most", at<&Vary::at_most>, number(D::plain), otherwise("not truncated"), "The distribution is truncated above this value."},
    Key{"values", at<&Vary::values>, number_list, otherwise("required of choice and of method grid"), "The values of which each sample has one."},
    Key{"weights", at<&Vary::weights>, number_list, otherwise("all alike"), "How often each of the values comes, in any unit."},
    Key{"unit", at<&Vary::unit>, text, otherwise("that of the key: SI units and degrees"), "Unit of all of these, such as \"kPa\"."},
};

constexpr std::array correlated_keys{
    Key{"between", at<&Correlated::between>, name_list, required, "Two names of [vary]."},
    Key{"copula", at<&Correlated::copula>, choice, initial, "How they depend on each other."},
    Key{"rank", at<&Correlated::rank>, number(D::plain, between(-1, 1)), otherwise("required of copula normal"), "Spearman's coefficient of rank correlation."},
    Key{"theta", at<&Correlated::theta>, number(D::plain), otherwise("required of copula clayton, gumbel and frank"), "Parameter of the copula."},
};

constexpr std::array ask_keys{
    Key{"of", at<&Ask::of>, choice, required, "The analysis made of each sample: a run in time, the factor of safety, rigid limit analysis, or block theory."},
    Key{"value", at<&Ask::value>, naming, otherwise("of fos \"factor_of_safety\", of limit \"limit.lower\", of keyblocks \"key_area\"; required of run"), "What is asked of it: a value of its summary.json, with the names of the tables around it before (\"energy.friction\"), or of a run a column of history.csv (\"history.crest.ux\") or of reactions.csv (\"reactions.base.fy\")."},
    Key{"take", at<&Ask::take>, choice, initial, "Of a column: its last, largest or smallest value."},
    Key{"at", at<&Ask::at>, number(D::time), otherwise("none"), "In place of take: the column's value at this time, linear between its rows."},
    Key{"measured", at<&Ask::measured>, number(D::plain), otherwise("none"), "Method fit: what was measured."},
    Key{"error", at<&Ask::error>, number(D::plain, above(0)), otherwise("required with measured"), "Method fit: standard deviation of the measurement."},
};

constexpr std::array failure_keys{
    Key{"ask", at<&FailureCriterion::ask>, naming, otherwise("may be left out where one is asked"), "Name of [ask] that decides whether a sample fails."},
    Key{"below", at<&FailureCriterion::below>, number(D::plain), otherwise("none; either this or above"), "A sample fails where the value is smaller."},
    Key{"above", at<&FailureCriterion::above>, number(D::plain), otherwise("none; either this or below"), "A sample fails where the value is larger."},
};

constexpr std::array map_keys{
    Key{"spacing", at<&StudyMap::spacing>, number(D::length, above(0)), required, "Distance of neighbouring places."},
    Key{"region", at<&StudyMap::region>, polygon, required, "The places lie inside this polygon."},
    Key{"generations", at<&StudyMap::generations>, whole(1, 1000), initial, "Generations of key blocks that count: 1 those that leave first, 2 also those that then can."},
};

constexpr std::array all_sections{
    root_section(root_keys, "The study as a whole."),
    section<&StudyPlan::sampling>("sampling", Shape::table, sampling_keys, "Which samples, and how many."),
    section<&StudyPlan::vary>("vary", Shape::named, vary_keys, "A quantity that varies."),
    section<&StudyPlan::correlated>("correlated", Shape::list, correlated_keys, "Two quantities that depend on each other."),
    section<&StudyPlan::ask>("ask", Shape::named, ask_keys, "What is asked of every sample."),
    section<&StudyPlan::failure>("failure", Shape::table, failure_keys, "When a sample counts as a failure."),
    section<&StudyPlan::map>("map", Shape::table, map_keys, "Where it is counted how often a place belongs to a key block; one [ask] must be of = \"keyblocks\"."),
};
// clang-format on

}  // namespace

std::span<const Section> study_sections() {
  return all_sections;
}

std::string to_toml(const StudyPlan& plan) {
  StudyPlan copy = plan;
  return to_toml(study_sections(), &copy, Model{});
}

std::string study_key_reference() {
  std::string page =
      "# Keys of a study's file\n\n"
      "A study is a TOML 1.0 file, read as a model file is. `edda keys --study` prints this "
      "page.\n";
  StudyPlan plan;
  for (const Section& section : study_sections()) page += '\n' + key_reference(section, &plan);
  return page;
}

}  // namespace edda
