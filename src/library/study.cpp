#include "library/study.hpp"

#include <omp.h>

#include "library/impl.hpp"
#include "sampling/sample_folder.hpp"

namespace edda::api {
namespace {

StudyPlan plan_in_text(const std::string& study) {
  return value_or_raise(read_study_text(study, "study.toml", {}));
}

void raise_if(const Trouble& trouble) {
  if (trouble) raise(Faults{*trouble});
}

}  // namespace

StudyAnswer study_sample(const std::string& study, const std::string& model,
                         const std::vector<double>& point, const std::string& scratch) {
  const StudyPlan plan = plan_in_text(study);
  if (point.size() != plan.vary.size())
    raise("study_sample", "the point has another number of values than the study",
          "give one for each [vary]");
  omp_set_num_threads(1);  // as every worker: there are as many runs as processors
  SampleAnswer answer = run_sample(plan, model, point, scratch);
  return {std::move(answer.cells), std::move(answer.message)};
}

struct StudyWorker::Impl {
  explicit Impl(const std::string& path) : folder(path) {}
  SampleFolder folder;
  Worker worker;
  StudyPlan plan;
  std::string study, model;
  Points points;
};

StudyWorker::StudyWorker(const std::string& folder) : impl_(std::make_unique<Impl>(folder)) {
  impl_->plan = value_or_raise(SampleFolder::plan_in(folder));
  impl_->study = to_toml(impl_->plan);
  impl_->model = value_or_raise(impl_->folder.model_text());
  raise_if(impl_->worker.join(impl_->folder));
}

StudyWorker::~StudyWorker() = default;

const std::string& StudyWorker::study() const {
  return impl_->study;
}

const std::string& StudyWorker::model() const {
  return impl_->model;
}

std::optional<StudySample> StudyWorker::take() {
  const std::optional<std::size_t> number = impl_->worker.take({});
  if (!number) return {};
  if (*number >= impl_->points.size())
    impl_->points = value_or_raise(impl_->folder.points(impl_->plan));
  return StudySample{*number, impl_->points.at(*number)};
}

void StudyWorker::finish(std::size_t number, const StudyAnswer& answer) {
  raise_if(impl_->worker.finish(number, {answer.cells, answer.message}));
}

}  // namespace edda::api
