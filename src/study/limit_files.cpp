// Table and summary of rigid limit analysis.
#include "results/columns.hpp"
#include "results/json.hpp"
#include "results/version.hpp"
#include "study/limit_analysis.hpp"

namespace edda {
namespace {

/// Opens an object, which is left open.
void open_value(Json& j, const LimitValue& value) {
  j.open_object().pair("status", limit_end_name(value.status));
  if (value.status == LimitEnd::found) {
    j.pair("lower", value.lower).pair("upper", value.upper);
  } else {
    j.key("lower").null();
    j.key("upper").null();
  }
}

void add_motion(Json& j, const std::optional<Mechanism>& mechanism) {
  j.key("mechanism_found").value(mechanism.has_value());
  if (!mechanism) return;
  j.key("mechanism").open_object().pair("text", mechanism->text);
  j.pair("blocks", mechanism->blocks.size()).pair("joints", mechanism->joints.size());
  j.close();
}

void add_mechanisms(Json& j, const LimitResult& r) {
  j.key("mechanisms").open_list();
  for (const LimitMechanism& m : r.mechanisms) {
    open_value(j, m.value);
    j.pair("text", m.text).pair("area", m.area).pair("left_out", m.left_out);
    j.key("blocks").open_list();
    for (const Id i : m.blocks) j.value(static_cast<std::size_t>(i));
    j.close();
    j.close();
  }
  j.close();
}

}  // namespace

std::string limit_joints_csv(const LimitResult& r) {
  Csv csv = begin_table(ResultFile::limit_joints);
  for (const ContactRecord& c : r.forces) {
    csv.add(c.block_i).add(c.block_j).add(c.joint).add(c.position.x).add(c.position.y);
    csv.add(c.normal_force).add(c.shear_force).add(c.force.x).add(c.force.y).add(c.mobilised);
    csv.add(c.a.x).add(c.a.y).add(c.b.x).add(c.b.y).add(c.table).end();
  }
  return csv.text();
}

std::string limit_summary(const Model& model, const LimitResult& r) {
  Json j;
  j.open_object().pair("version", version).pair("title", model.title);
  j.pair("status", limit_end_name(r.largest.status)).pair("message", r.message);
  j.pair("vary", r.vary);
  open_value(j.key("limit"), r.largest);
  j.close();
  if (r.smallest) {
    open_value(j.key("other_end"), *r.smallest);
    add_motion(j, r.other_motion ? std::optional(r.other_motion->mechanism) : std::nullopt);
    j.pair("governs", r.other_governs).close();
  }
  j.pair("without_dilation", r.without_dilation);
  j.pair("residual", r.residual);
  j.pair("bolts_as_now", r.bolts_as_now);
  j.pair("flow_rule_violation", r.violation);
  j.pair("crushing", model.limit && model.limit->crushing);
  j.pair("blocks", r.blocks).pair("joints", r.joints);
  add_motion(j, r.mechanism);
  add_mechanisms(j, r);
  j.key("warnings").open_list();
  for (const std::string& w : r.warnings) j.value(w);
  j.close();
  j.pair("wall_seconds", r.seconds);
  return j.close().text();
}

}  // namespace edda
