#include "sampling/sample_folder.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <set>
#include <thread>

#include "results/csv.hpp"
#include "results/read_table.hpp"

namespace edda {
namespace {

namespace fs = std::filesystem;

std::string token_name(std::size_t sample) {
  return fmt::format("{:07}", sample);
}

/// Names of a folder's entries; none where it does not exist.
std::vector<std::string> names_in(const std::string& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error))
    names.push_back(it->path().filename().string());
  return names;
}

std::optional<std::size_t> sample_of(const std::string& token) {
  return number_in_name(token + '.', "", ".");
}

std::vector<std::size_t> tokens_in(const std::string& folder) {
  std::vector<std::size_t> samples;
  for (const std::string& name : names_in(folder)) {
    if (const auto sample = sample_of(name)) samples.push_back(*sample);
  }
  std::sort(samples.begin(), samples.end());
  return samples;
}

bool moved(const std::string& from, const std::string& to) {
  std::error_code error;
  fs::rename(from, to, error);
  return !error;
}

/// Adds the rows of a file; the last one is left out where it is incomplete.
void add_rows(const StudyPlan& plan, const std::string& path, Rows& rows) {
  const Result<std::string> text = read_file(path);
  if (!text.ok()) return;
  std::string header = "sample";
  for (const Ask& a : plan.ask) header += ',' + Csv().add(a.name).text();
  if (plan.map) header += ",places";
  const Result<Table> table = table_of(header + ",message\n" + text.value(), path);
  if (!table.ok()) return;
  const std::vector<Column>& columns = table.value().columns;
  for (std::size_t i = 0; i < table.value().rows(); ++i) {
    SampleAnswer answer;
    for (std::size_t k = 0; k < answer_cells(plan); ++k)
      answer.cells.push_back(columns[k + 1].text(i));
    answer.message = columns.back().text(i);
    rows[static_cast<std::size_t>(columns.front().values[i])] = std::move(answer);
  }
}

/// Takes the lock of the folder's setting up and tidying, which others hold for moments.
Trouble wait_for(FolderLock& lock, const std::string& folder) {
  Trouble trouble;
  for (int i = 0; i < 600; ++i) {
    trouble = lock.take(folder);
    if (!trouble) return trouble;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  return trouble;
}

/// Without the path of the model, whose text is compared.
StudyPlan without_model(StudyPlan plan) {
  plan.model.clear();
  return plan;
}

/// The plan but for what a study may be gone on with.
std::string kept(const StudyPlan& plan) {
  StudyPlan copy = without_model(plan);
  copy.title.clear();
  copy.sampling.samples.reset();
  copy.sampling.half_width = 0.0;
  return to_toml(copy);
}

std::string rows_text(const Rows& rows) {
  std::string text;
  for (const auto& [sample, answer] : rows) text += row_text(sample, answer);
  return text;
}

Fault other_study(const std::string& folder, const std::string& what) {
  return {{"", folder, 0, 0},
          fmt::format("holds a study with {}", what),
          "name another folder with -o, or remove this one"};
}

}  // namespace

std::string row_text(std::size_t sample, const SampleAnswer& answer) {
  Csv csv;
  csv.add(sample);
  for (const std::string& cell : answer.cells) csv.add(cell);
  return csv.add(answer.message).end().text();
}

std::vector<std::size_t> samples_begun(const std::string& own) {
  return tokens_in(own);
}

void end_sample(const std::string& own, std::size_t sample, const SampleAnswer& answer) {
  std::ofstream rows(own + "/rows.csv", std::ios::app);
  rows << row_text(sample, answer) << std::flush;
  std::error_code error;
  if (rows) fs::remove(own + '/' + token_name(sample), error);
}

Result<StudyPlan> SampleFolder::plan_in(const std::string& path) {
  return read_study(path + "/study.toml", {});
}

bool SampleFolder::is_someone_elses() const {
  const std::vector<std::string> names = names_in(path_);
  return std::any_of(names.begin(), names.end(), [](const std::string& name) {
    return name != "free" && name != "workers" && !name.starts_with("model.toml") &&
           !name.starts_with("points.csv") && !name.starts_with("study.toml");
  });
}

Trouble SampleFolder::open(const StudyPlan& plan, const std::string& model_text, const Shard& shard,
                           SamplerProcess& sampler) {
  std::error_code error;
  const bool is_new = !fs::exists(file("study.toml"), error);
  if (is_new && is_someone_elses()) {
    return Fault{
        {"", path_, 0, 0}, "holds something other than a study", "name another folder with -o"};
  }
  Points first;
  if (is_new) {
    if (!chooses_as_it_goes(plan.sampling.method)) {
      Result<Points> drawn = points_of(plan, 0, sampler);
      if (!drawn.ok()) return drawn.faults().front();
      first = std::move(drawn.value());
    }
    if (Trouble t = no_sample_can_be_read(plan, model_text, first)) return t;
  }
  if (Trouble t = make_folder(path_)) return t;
  FolderLock lock;
  if (Trouble t = wait_for(lock, path_)) return t;
  for (const char* name : {"free", "workers"}) {
    if (Trouble t = make_folder(file(name))) return t;
  }
  // Another process may have begun it meanwhile.
  return fs::exists(file("study.toml"), error) ? join(plan, model_text, shard, sampler)
                                               : begin(plan, model_text, shard, first);
}

Trouble SampleFolder::join(const StudyPlan& plan, const std::string& model_text, const Shard& shard,
                           SamplerProcess& sampler) {
  const Result<StudyPlan> there = plan_in(path_);
  if (!there.ok()) return there.faults().front();
  if (kept(there.value()) != kept(plan)) return other_study(path_, "another plan");
  const Result<std::string> text = this->model_text();
  if (!text.ok()) return text.faults().front();
  if (text.value() != model_text) return other_study(path_, "another model");
  const Result<Points> known = points(plan);
  if (!known.ok()) return known.faults().front();
  give_back();
  if (chooses_as_it_goes(plan.sampling.method))
    return free_missing(plan, known.value().size(), shard);
  if (Trouble t = widen(plan, known.value(), sampler)) return t;
  const Result<Points> all = points(plan);
  if (!all.ok()) return all.faults().front();
  return free_missing(plan, all.value().size(), shard);
}

Trouble SampleFolder::merge(const std::vector<std::string>& parts) {
  if (!names_in(path_).empty())
    return Fault{{"", path_, 0, 0}, "is there already", "name a new folder to merge into"};
  const Result<StudyPlan> plan = plan_in(parts.front());
  if (!plan.ok()) return plan.faults().front();
  std::vector<std::string> first;
  Rows all;
  for (const std::string& part : parts) {
    const Result<StudyPlan> other = plan_in(part);
    if (!other.ok()) return other.faults().front();
    std::vector<std::string> texts{to_toml(without_model(other.value()))};
    for (const char* name : {"/model.toml", "/points.csv"}) {
      Result<std::string> text = read_file(part + name);
      if (!text.ok()) return text.faults().front();
      texts.push_back(std::move(text.value()));
    }
    if (first.empty()) first = texts;
    if (texts != first)
      return Fault{{"", part, 0, 0},
                   "is no part of the study in " + parts.front(),
                   "merge parts of one study, of the same number of samples"};
    all.merge(SampleFolder(part).rows(plan.value()));
  }
  if (Trouble t = make_folder(path_)) return t;
  if (Trouble t = write_file(file("model.toml"), first[1])) return t;
  if (Trouble t = write_file(file("points.csv"), first[2])) return t;
  if (Trouble t = write_file(file("rows.csv"), rows_text(all))) return t;
  return write_file(file("study.toml"), to_toml(plan.value()));
}

Trouble SampleFolder::begin(const StudyPlan& plan, const std::string& model_text,
                            const Shard& shard, const Points& first) {
  if (Trouble t = write_file(file("model.toml"), model_text)) return t;
  if (Trouble t = write_file(file("points.csv"), points_csv(plan, first))) return t;
  if (Trouble t = free_missing(plan, first.size(), shard)) return t;
  return write_file(file("study.toml"), to_toml(plan));
}

Trouble SampleFolder::widen(const StudyPlan& plan, const Points& known, SamplerProcess& sampler) {
  const auto samples = static_cast<std::size_t>(plan.sampling.samples.value_or(0));
  const bool counted = is_random(plan.sampling.method);
  if (counted && samples > known.size()) {
    const Result<Points> more = points_of(plan, known.size(), sampler);
    if (!more.ok()) return more.faults().front();
    Points all = known;
    all.insert(all.end(), more.value().begin(), more.value().end());
    if (Trouble t = write_file(file("points.csv"), points_csv(plan, all))) return t;
  } else if (plan.sampling.method == SamplingMethod::sobol_indices &&
             known.size() != samples * (plan.vary.size() + 2)) {
    return other_study(path_,
                       "another number of samples, and the indices of Sobol need all at once");
  }
  return write_file(file("study.toml"), to_toml(plan));
}

Trouble SampleFolder::make_free(std::size_t sample) const {
  const std::string path = file("free/" + token_name(sample));
  const std::ofstream made(path);
  return made ? Trouble{} : Trouble{cannot_write(path, errno)};
}

/// Makes those free that are neither finished nor begun, of the shard. In the order in which
/// samples move on, so that none is missed on its way.
Trouble SampleFolder::free_missing(const StudyPlan& plan, std::size_t count,
                                   const Shard& shard) const {
  std::set<std::size_t> there;
  for (const std::size_t s : free_samples()) there.insert(s);
  for (const std::string& name : names_in(file("workers"))) {
    for (const std::size_t s : tokens_in(file("workers/" + name))) there.insert(s);
  }
  for (const auto& [s, answer] : rows(plan)) there.insert(s);
  for (std::size_t s = 0; s < count; ++s) {
    if (!shard.has(s) || there.contains(s)) continue;
    if (Trouble t = make_free(s)) return t;
  }
  return {};
}

Trouble SampleFolder::issue(const StudyPlan& plan, const Points& all, std::size_t first) {
  if (Trouble t = write_file(file("points.csv"), points_csv(plan, all))) return t;
  for (std::size_t s = first; s < all.size(); ++s) {
    if (Trouble t = make_free(s)) return t;
  }
  return {};
}

Rows SampleFolder::rows(const StudyPlan& plan) const {
  Rows all;
  for (const std::string& name : names_in(file("workers")))
    add_rows(plan, file("workers/" + name + "/rows.csv"), all);
  add_rows(plan, file("rows.csv"), all);
  return all;
}

/// With the study's lock.
void SampleFolder::give_back() const {
  for (const std::string& name : names_in(file("workers"))) {
    const std::string own = file("workers/" + name);
    FolderLock lock;
    if (lock.take(own)) continue;  // it is at work
    for (const std::size_t s : tokens_in(own))
      moved(own + '/' + token_name(s), file("free/" + token_name(s)));
  }
}

Trouble SampleFolder::recover() const {
  FolderLock lock;
  if (Trouble t = wait_for(lock, path_)) return t;
  give_back();
  return {};
}

void SampleFolder::withdraw() const {
  std::error_code error;
  for (const std::size_t s : free_samples()) fs::remove(file("free/" + token_name(s)), error);
}

Trouble SampleFolder::tidy(const StudyPlan& plan, const std::function<Trouble()>& write) const {
  FolderLock lock;
  if (Trouble t = wait_for(lock, path_)) return t;
  if (Trouble t = write_file(file("rows.csv"), rows_text(rows(plan)))) return t;
  std::error_code error;
  for (const std::string& name : names_in(file("workers"))) {
    const std::string own = file("workers/" + name);
    FolderLock alone;
    if (!alone.take(own)) fs::remove_all(own, error);
  }
  fs::remove(file("workers"), error);  // unless somebody is at work there
  fs::remove(file("free"), error);
  return write();
}

std::vector<std::size_t> SampleFolder::free_samples() const {
  return tokens_in(file("free"));
}

Trouble Worker::join(const SampleFolder& folder) {
  folder_ = &folder;
  char host[256] = "host";
  ::gethostname(host, sizeof host - 1);
  for (int i = 0; i < 1000; ++i) {
    own_ = folder.file(fmt::format("workers/{}-{}-{}", host, ::getpid(), i));
    std::error_code error;
    if (!fs::create_directories(own_, error)) continue;
    if (Trouble t = lock_.take(own_)) continue;
    if (!fs::exists(own_, error)) continue;  // it was taken for an abandoned one and removed
    return rows_.open(own_ + "/rows.csv");
  }
  return Fault{{"", own_, 0, 0}, "cannot be made", "make room on the disk, or name another folder"};
}

std::optional<std::size_t> Worker::take(const Shard& shard) {
  for (int looked = 0; looked < 2; ++looked) {
    while (!seen_.empty()) {
      const std::size_t sample = seen_.back();
      seen_.pop_back();
      const std::string name = token_name(sample);
      if (shard.has(sample) && moved(folder_->file("free/" + name), own_ + '/' + name))
        return sample;
    }
    seen_ = folder_->free_samples();
    std::reverse(seen_.begin(), seen_.end());
  }
  return {};
}

Trouble Worker::finish(std::size_t sample, const SampleAnswer& answer) {
  if (Trouble t = rows_.add(row_text(sample, answer))) return t;
  std::error_code error;
  fs::remove(own_ + '/' + token_name(sample), error);
  return {};
}

}  // namespace edda
