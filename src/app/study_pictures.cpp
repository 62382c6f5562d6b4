#include "app/study_pictures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "app/map_picture.hpp"
#include "base/text.hpp"
#include "model/study/study_keys.hpp"
#include "report/study_plots.hpp"
#include "report/study_report.hpp"
#include "results/version.hpp"

namespace edda {
namespace {

constexpr std::size_t most_points = 1000;  // of scatter plots: more are a cloud, and megabytes

/// A name as part of a file's.
std::string file_name(const std::string& name) {
  std::string file = name;
  for (char& c : file) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '-' && c != '_') c = '_';
  }
  return file;
}

std::string label_of(const Vary& v) {
  return v.unit.empty() ? v.name : v.name + " (" + v.unit + ")";
}

class Drawing {
 public:
  Drawing(const StudyPlan& plan, const StudyResults& results, const SampleFolder& folder,
          SamplerProcess& sampler)
      : plan_(plan), r_(results), folder_(folder), sampler_(sampler) {}

  Trouble all() {
    for (const AskedNumbers& a : r_.asked) {
      if (Trouble t = histogram(a)) return t;
    }
    if (Trouble t = convergence()) return t;
    if (Trouble t = tornado()) return t;
    if (Trouble t = sobol()) return t;
    if (Trouble t = scatter()) return t;
    if (Trouble t = map()) return t;
    return report();
  }

 private:
  /// Draws the picture as PNG and SVG, and notes it for the report.
  template <class Picture>
  Trouble draw(const std::string& name, const Picture& picture,
               Trouble (*plot)(const Picture&, const std::string&), const std::string& heading,
               const std::string& note) {
    for (const char* ending : {".png", ".svg"}) {
      if (Trouble t = plot(picture, folder_.file(name + ending))) return t;
    }
    page_.figures.push_back({heading, note, folder_.file(name + ".svg")});
    return {};
  }
  Trouble histogram(const AskedNumbers& a);
  Trouble convergence();
  Trouble tornado();
  Trouble sobol();
  Trouble scatter();
  Trouble map();
  Trouble report();
  void add_fit();
  std::vector<std::string> quantities() const {
    std::vector<std::string> names;
    for (const Vary& v : plan_.vary) names.push_back(v.name);
    return names;
  }
  std::vector<std::string> row_of(std::size_t sample) const;

  const StudyPlan& plan_;
  const StudyResults& r_;
  const SampleFolder& folder_;
  SamplerProcess& sampler_;
  ReportPage page_{};
};

Trouble Drawing::histogram(const AskedNumbers& a) {
  if (a.values.size() < 2 || chooses_as_it_goes(plan_.sampling.method)) return {};
  HistogramPicture picture{{a.name, "", a.values}};
  const bool decides = plan_.failure && plan_.failure->ask == a.name;
  if (decides) {
    picture.fails_below = plan_.failure->below.has_value();
    picture.threshold = plan_.failure->below ? plan_.failure->below : plan_.failure->above;
  }
  return draw("histogram_" + file_name(a.name), picture, plot_histogram,
              "Distribution of " + a.name,
              decides ? "Samples on the red side fail. The line is the part of the samples below."
                      : "The line is the part of the samples below.");
}

/// After some forty numbers of samples.
Trouble Drawing::convergence() {
  if (!r_.probability || r_.run.reliability || r_.run.samples < 20) return {};
  ConvergencePicture picture;
  picture.axis = "probability of failure";
  const std::size_t every = std::max<std::size_t>(1, r_.run.samples / 40);
  std::size_t failures = 0, answers = 0;
  for (std::size_t s = 0; s < r_.run.samples; ++s) {
    const std::optional<bool> failed = has_failed(plan_, r_.run.rows.at(s));
    answers += failed.has_value();
    failures += failed.value_or(false);
    if ((s + 1) % every != 0 || answers == 0) continue;
    const Result<Interval> i = interval_of(failures, answers, plan_.sampling.confidence, sampler_);
    if (!i.ok()) return i.faults().front();
    picture.samples.push_back(static_cast<double>(s + 1));
    picture.probability.push_back(static_cast<double>(failures) / static_cast<double>(answers));
    picture.low.push_back(i.value().low);
    picture.high.push_back(i.value().high);
  }
  return draw("convergence", picture, plot_convergence, "Probability of failure",
              fmt::format("As samples were added, with its {:.3g} % interval.",
                          100.0 * plan_.sampling.confidence));
}

Trouble Drawing::tornado() {
  const AskedNumbers& a = main_of(plan_, r_);
  if (a.rank_correlation.empty() || chooses_as_it_goes(plan_.sampling.method)) return {};
  return draw(
      "tornado",
      TornadoPicture{"rank correlation with " + a.name, quantities(), a.rank_correlation, {}, {}},
      plot_tornado, "What it depends on",
      "Spearman's rank correlation: 1 where the value always grows with the quantity, -1 "
      "where it always falls.");
}

Trouble Drawing::sobol() {
  if (!r_.sobol) return {};
  const SobolIndices& s = *r_.sobol;
  if (Trouble t = draw(
          "sobol_first",
          TornadoPicture{"first-order index", quantities(), s.first, s.first_low, s.first_high},
          plot_tornado, "Indices of Sobol, first order",
          "The part of the variance that the quantity explains alone."))
    return t;
  return draw("sobol_total",
              TornadoPicture{"total index", quantities(), s.total, s.total_low, s.total_high},
              plot_tornado, "Indices of Sobol, total",
              "The part of the variance in which the quantity has any share.");
}

Trouble Drawing::scatter() {
  if (chooses_as_it_goes(plan_.sampling.method)) return {};
  std::vector<std::size_t> shown;
  for (std::size_t s = 0; s < r_.run.samples && shown.size() < most_points; ++s) {
    const std::vector<std::string>& cells = r_.run.rows.at(s).cells;
    if (std::all_of(cells.begin(), cells.begin() + std::ssize(plan_.ask),
                    [](const std::string& c) { return number_in(c).has_value(); }))
      shown.push_back(s);
  }
  if (shown.size() < 2 || plan_.vary.size() + plan_.ask.size() > 10) return {};
  ScatterPicture picture;
  for (std::size_t q = 0; q < plan_.vary.size(); ++q) {
    SampledColumn column{plan_.vary[q].name, plan_.vary[q].unit, {}};
    for (const std::size_t s : shown) column.values.push_back(r_.run.points[s][q]);
    picture.columns.push_back(std::move(column));
  }
  for (std::size_t k = 0; k < plan_.ask.size(); ++k) {
    SampledColumn column{plan_.ask[k].name, "", {}};
    for (const std::size_t s : shown)
      column.values.push_back(number_in(r_.run.rows.at(s).cells[k]).value_or(0.0));
    picture.columns.push_back(std::move(column));
  }
  for (const std::size_t s : shown)
    picture.failed.push_back(has_failed(plan_, r_.run.rows.at(s)).value_or(false));
  const std::string some = shown.size() == most_points && r_.run.samples > most_points
                               ? fmt::format(" The first {} samples are shown.", most_points)
                               : "";
  return draw("scatter", picture, plot_scatter, "Quantities and answers against each other",
              "Red samples fail. Above the diagonal: rank correlation." + some);
}

Trouble Drawing::map() {
  if (!r_.map || r_.map->samples == 0) return {};
  if (Trouble t = draw_map(plan_.title, *plan_.map, *r_.map, folder_.path())) return t;
  page_.figures.push_back({"Key blocks",
                           "How often each place belongs to a key block. White: there is no rock.",
                           folder_.file("key_block_map.svg")});
  return {};
}

std::vector<std::string> Drawing::row_of(std::size_t sample) const {
  std::vector<std::string> row{std::to_string(sample)};
  for (const double x : r_.run.points[sample]) row.push_back(number_text(x, 5));
  for (std::size_t k = 0; k < plan_.ask.size(); ++k) {
    const std::string& cell = r_.run.rows.at(sample).cells[k];
    const std::optional<double> number = number_in(cell);
    row.push_back(number ? number_text(*number, 5) : cell);
  }
  return row;
}

/// Values found, and what is left of the measurements.
void Drawing::add_fit() {
  const Fitted& f = *r_.run.fitted;
  ReportTable values{"Values",
                     "With their standard errors, and the correlation of these.",
                     {{"", "value", "error"}}};
  for (const Vary& v : plan_.vary) values.rows[0].push_back(v.name);
  for (std::size_t q = 0; q < plan_.vary.size(); ++q) {
    std::vector<std::string> row{label_of(plan_.vary[q]), number_text(f.values[q], 5),
                                 number_text(f.errors[q], 2)};
    for (const double c : f.correlation[q]) row.push_back(number_text(c, 2));
    values.rows.push_back(std::move(row));
  }
  ReportTable rest{"Measurements",
                   "The difference is that of computed and measured, over the error.",
                   {{"", "measured", "error", "computed", "difference"}}};
  for (std::size_t k = 0; k < plan_.ask.size(); ++k) {
    const Ask& a = plan_.ask[k];
    rest.rows.push_back({a.name, number_text(*a.measured, 5), number_text(*a.error, 2),
                         number_text(*a.measured + f.differences[k] * *a.error, 5),
                         number_text(f.differences[k], 2)});
  }
  page_.before.push_back(std::move(values));
  page_.before.push_back(std::move(rest));
}

Trouble Drawing::report() {
  page_.title = plan_.title.empty() ? "Study" : plan_.title;
  page_.answer = r_.message;
  page_.plan = to_toml(plan_);
  page_.version = version;
  ReportTable asked{"Answers",
                    "",
                    {{"", "mean", "standard deviation", "least", "5 %", "median", "95 %", "most",
                      "no equilibrium", "no answer"}}};
  for (const AskedNumbers& a : r_.asked) {
    std::vector<std::string> row{a.name};
    for (const double x : {a.mean, a.sd, a.least, a.quantile_05, a.median, a.quantile_95, a.most})
      row.push_back(number_text(x, 5));
    row.push_back(std::to_string(a.unstable));
    row.push_back(std::to_string(a.none));
    asked.rows.push_back(std::move(row));
  }
  if (!chooses_as_it_goes(plan_.sampling.method)) page_.before.push_back(std::move(asked));
  if (r_.run.reliability && !r_.run.reliability->design_point.empty()) {
    ReportTable point{"Most likely failure",
                      "The point of failure nearest to the means, counted in standard deviations, "
                      "and the part that each quantity has in that distance.",
                      {{"", "value", "importance"}}};
    const Reliability& found = *r_.run.reliability;
    for (std::size_t k = 0; k < found.drawn.size(); ++k) {
      const Vary& v = plan_.vary[found.drawn[k]];
      point.rows.push_back({label_of(v), number_text(found.design_point[k], 5),
                            number_text(found.importance[k], 3)});
    }
    page_.before.push_back(std::move(point));
  }
  if (r_.run.fitted) {
    add_fit();
    return write_report(page_, folder_.file("report.html"));
  }
  ReportTable worst{"Worst samples",
                    "edda study show FOLDER --run NUMBER writes the model of one of them.",
                    {{"sample"}}};
  for (const Vary& v : plan_.vary) worst.rows[0].push_back(label_of(v));
  for (const Ask& a : plan_.ask) worst.rows[0].push_back(a.name);
  for (const std::size_t s : worst_samples(plan_, r_, 10)) worst.rows.push_back(row_of(s));
  page_.after.push_back(std::move(worst));
  return write_report(page_, folder_.file("report.html"));
}

}  // namespace

Trouble draw_study(const StudyPlan& plan, const StudyResults& results, const SampleFolder& folder,
                   SamplerProcess& sampler) {
  return Drawing(plan, results, folder, sampler).all();
}

}  // namespace edda
