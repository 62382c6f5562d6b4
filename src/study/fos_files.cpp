// Tables and summary of a search for the factor of safety.
#include <cmath>

#include "results/columns.hpp"
#include "results/json.hpp"
#include "results/version.hpp"
#include "study/fos.hpp"

namespace edda {
namespace {

void add_criterion(Json& j, const FosResult& r) {
  const Criterion& c = r.criterion;
  j.key("criterion").open_object();
  j.pair("fails_displacement", c.displacement.value_or(c.allowed * r.size));
  j.pair("fails_velocity", c.velocity);
  j.pair("fails_part", std::isfinite(c.allowed) ? std::optional(c.allowed) : std::nullopt);
  j.pair("little_part", moved_little).pair("rest_part", rest_part);
  j.pair("block_size", r.size).pair("acceleration", r.acceleration);
  j.pair("trial", r.duration).pair("shaking", r.shaking);
  j.pair("text",
         "a trial fails where a set of blocks moves by more than fails_part of its size as seen "
         "from the blocks beside it (little_part at factors at which rigid blocks have no "
         "equilibrium), a part of a meshed block by three times what its rock strains until it "
         "yields, or a corner by more than fails_displacement where that is given; it holds "
         "where no block would move by more than rest_part of its size within 5 sqrt(size/g)");
  j.close();
}

void add_mechanism(Json& j, const Mechanism& m) {
  j.key("mechanism").open_object().pair("text", m.text);
  j.pair("blocks", m.blocks.size()).pair("joints", m.joints.size());
  j.pair("sliding", m.sliding).pair("toppling", m.toppling).pair("falling", m.falling);
  j.pair("hinging", m.hinging).pair("yielding", m.yielding);
  j.pair("brittle_length", m.brittle_length);
  j.pair("cohesion_lost_length", m.cohesion_lost_length).close();
}

}  // namespace

std::string fos_csv(const std::vector<Trial>& trials) {
  Csv csv = begin_table(ResultFile::fos);
  for (const Trial& t : trials) {
    csv.add(t.factor).add(trial_end_name(t.end)).add(t.displacement);
    if (t.block == no_id) {
      csv.add("");
    } else {
      csv.add(t.block);
    }
    csv.add(t.time).add(t.velocity).add(t.unbalanced).add(t.steps).add(t.reason).end();
  }
  return csv.text();
}

std::string fos_summary(const Model& model, const FosResult& r, int threads) {
  const Fos fos = model.fos.value_or(Fos{});
  Json j;
  j.open_object().pair("version", version).pair("title", model.title);
  j.pair("status", fos_status_name(r.status)).pair("message", r.message);
  j.pair("factor_of_safety", r.factor);
  j.pair("holds", r.holds);
  j.pair("fails", r.fails);
  j.pair("proof", r.proof);
  j.pair("vary", fos.vary).pair("stage", fos.stage).pair("tolerance", fos.tolerance);
  j.key("exclude").open_list();
  for (const std::string& name : fos.exclude) j.value(name);
  j.close();
  add_criterion(j, r);
  if (r.rigid) {
    j.key("rigid_limits").open_object();
    j.pair("least", r.rigid->least).pair("most", r.rigid->most).pair("text", r.rigid->text);
    j.pair("taken_from_rigid_limit", r.rigid->trials_hold.has_value());
    j.pair("trials_hold", r.rigid->trials_hold);
    j.close();
    j.key("checks").open_list().open_object();
    j.pair("name", "factor at most that of rigid blocks")
        .pair("value", r.factor ? r.factor : r.holds);
    j.pair("limit", r.rigid->most).pair("pass", r.rigid->below_most);
    j.close().close();
  }
  j.key("sets").open_list();
  for (const FailedSet& s : r.sets) {
    j.open_object().pair("holds", s.holds).pair("fails", s.fails).pair("area", s.area);
    j.pair("blocks", s.blocks.size()).pair("text", s.text).close();
  }
  j.close();
  j.pair("holds_where_a_tenth_is_too_far", r.holds_wide);
  j.pair("fails_where_a_tenth_is_too_far", r.fails_wide);
  j.pair("trials", r.trials.size()).pair("blocks", r.blocks);
  j.key("mechanism_found").value(r.mechanism.has_value());
  if (r.mechanism) add_mechanism(j, *r.mechanism);
  j.key("warnings").open_list();
  for (const std::string& w : r.warnings) j.value(w);
  j.close();
  j.pair("wall_seconds", r.seconds).pair("threads", threads);
  return j.close().text();
}

}  // namespace edda
