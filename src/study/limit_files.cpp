// Table and summary of rigid limit analysis.
#include "results/columns.hpp"
#include "results/json.hpp"
#include "results/version.hpp"
#include "study/limit_analysis.hpp"

namespace edda {
namespace {

void add_value(Json& j, std::string_view name, const LimitValue& value) {
  j.key(name).open_object().pair("status", limit_end_name(value.status));
  if (value.status == LimitEnd::found) {
    j.pair("lower", value.lower).pair("upper", value.upper);
  } else {
    j.key("lower").null();
    j.key("upper").null();
  }
  j.close();
}

}  // namespace

std::string limit_joints_csv(const LimitResult& r) {
  Csv csv = begin_table(ResultFile::limit_joints);
  for (const ContactRecord& c : r.forces) {
    csv.add(c.block_i).add(c.block_j).add(c.joint).add(c.position.x).add(c.position.y);
    csv.add(c.normal_force).add(c.shear_force).add(c.force.x).add(c.force.y).add(c.mobilised);
    csv.add(c.a.x).add(c.a.y).add(c.b.x).add(c.b.y).end();
  }
  return csv.text();
}

std::string limit_summary(const Model& model, const LimitResult& r) {
  Json j;
  j.open_object().pair("version", version).pair("title", model.title);
  j.pair("status", limit_end_name(r.largest.status)).pair("message", r.message);
  j.pair("vary", r.vary);
  add_value(j, "limit", r.largest);
  if (r.smallest) add_value(j, "other_end", *r.smallest);
  j.pair("without_dilation", r.without_dilation);
  j.pair("residual", r.residual);
  if (r.without_pebbles) add_value(j, "without_pebbles", *r.without_pebbles);
  j.pair("flow_rule_violation", r.violation);
  j.pair("crushing", model.limit && model.limit->crushing);
  j.pair("blocks", r.blocks).pair("joints", r.joints);
  j.key("mechanism_found").value(r.mechanism.has_value());
  if (r.mechanism) {
    j.key("mechanism").open_object().pair("text", r.mechanism->text);
    j.pair("blocks", r.mechanism->blocks.size()).pair("joints", r.mechanism->joints.size());
    j.close();
  }
  j.key("warnings").open_list();
  for (const std::string& w : r.warnings) j.value(w);
  j.close();
  j.pair("wall_seconds", r.seconds);
  return j.close().text();
}

}  // namespace edda
