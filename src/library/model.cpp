// Faults, models and their blocks.
#include <omp.h>

#include <atomic>
#include <iterator>

#include "base/threads.hpp"
#include "cutting/build_polygons.hpp"
#include "library/impl.hpp"
#include "model/read_model.hpp"
#include "model/write_model.hpp"
#include "results/machine.hpp"
#include "results/version.hpp"
#include "run/size_limits.hpp"

namespace edda::api {
namespace {

/// Number of threads; OpenMP keeps it separately for each calling thread. 0: the default of OpenMP.
std::atomic<int> threads_wanted{0};

edda::Fault internal(const Fault& f) {
  return {{f.key, f.file, f.line, f.column}, f.problem, f.remedy};
}

std::string text_of(const std::vector<Fault>& faults) {
  std::string text;
  for (const Fault& f : faults) text += (text.empty() ? "" : "\n") + f.text();
  return text;
}

Model model_of(Result<edda::Model> result) {
  return Model(std::make_shared<Model::Impl>(value_or_raise(std::move(result))));
}

template <class Items>
std::vector<std::string> names_of(const Items& items) {
  std::vector<std::string> names;
  names.reserve(items.size());
  for (const auto& item : items) names.push_back(item.name);
  return names;
}

CutBlock cut_block(const BlockPolygon& b, Vec2 origin) {
  CutBlock block;
  block.name = b.name;
  block.material = b.material;
  block.fixed = b.fixed;
  block.area = moments(b.rings).area;
  for (const Ring& ring : b.rings) {
    std::vector<Point>& points = block.rings.emplace_back();
    for (const Vec2 p : ring) points.push_back({p.x + origin.x, p.y + origin.y});
  }
  for (const std::vector<Index>& joints : b.joint) {
    block.joints.emplace_back(joints.begin(), joints.end());
  }
  return block;
}

}  // namespace

std::string_view version() {
  return edda::version;
}

std::string Fault::text() const {
  return to_string(internal(*this));
}

Error::Error(std::vector<Fault> faults)
    : std::runtime_error(text_of(faults)), faults_(std::move(faults)) {}

Error::~Error() = default;

void raise(const Faults& faults) {
  std::vector<Fault> list;
  for (const edda::Fault& f : faults) {
    list.push_back({f.where.key, f.where.file, f.where.line, f.where.column, f.problem, f.remedy});
  }
  throw Error(std::move(list));
}

void raise(std::string key, std::string problem, std::string remedy) {
  throw Error({{std::move(key), {}, 0, 0, std::move(problem), std::move(remedy)}});
}

void check_memory(const edda::Model& model) {
  if (const auto fault = beyond_memory(model, memory_here())) raise(Faults{*fault});
}

Model::Model(std::shared_ptr<const Impl> impl) : impl_(std::move(impl)) {}

Model Model::read(const std::string& path, const std::vector<std::string>& overrides) {
  return model_of(read_model(path, overrides, ReadFor::no_run));
}

Model Model::parse(std::string_view toml, const std::string& name,
                   const std::vector<std::string>& overrides) {
  return model_of(read_model_text(toml, name, overrides, ReadFor::no_run));
}

std::string Model::title() const {
  return impl_->model.title;
}

std::string Model::file() const {
  return impl_->model.file;
}

double Model::duration() const {
  return impl_->model.solver.duration;
}

std::string Model::to_toml() const {
  return edda::to_toml(impl_->model);
}

std::vector<std::string> Model::materials() const {
  return names_of(impl_->model.materials);
}

std::vector<std::string> Model::joints() const {
  return names_of(impl_->model.given_joints());
}

std::vector<std::string> Model::openings() const {
  return names_of(impl_->model.openings);
}

std::vector<std::string> Model::stages() const {
  return names_of(impl_->model.stages);
}

Cut cut(const Model& model) {
  use_threads();
  check_memory(model.impl().model);
  const PolygonSet polygons = value_or_raise(build_polygons(model.impl().model));
  const CutReport& r = polygons.report;
  Cut result;
  for (const BlockPolygon& b : polygons.blocks) {
    result.blocks.push_back(cut_block(b, polygons.origin));
  }
  result.trimmed = r.dangling;
  result.merged = r.merged + r.quality_merged;
  result.smallest_area = r.smallest_area;
  result.smallest_edge = r.smallest_edge;
  result.smallest_angle = r.smallest_angle;
  result.notes = r.notes;
  result.notes.insert(result.notes.end(), r.warnings.begin(), r.warnings.end());
  return result;
}

void set_threads(int threads) {
  if (threads < 1) raise("set_threads", "less than one thread", "give 1 or more");
  threads_wanted = threads;
  report_threads(threads);
}

void use_threads() {
  if (const int threads = threads_wanted; threads > 0) omp_set_num_threads(threads);
}

}  // namespace edda::api
