#include "verification/record.hpp"

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>

namespace edda {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// JSON has no infinity and no NaN.
std::string json(double v) {
  if (!std::isfinite(v)) return "null";
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", v);
  return text;
}

std::string json(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + "\"";
}

template <class Values>
std::string json_list(const Values& values) {
  std::string out = "[";
  for (const auto& v : values) out += (out.size() > 1 ? "," : "") + json(v);
  return out + "]";
}

/// One line, {"kind":..., "row":..., "which":..., FIELDS}, into a file of the test's own, so that
/// tests may run side by side.
void write(const char* kind, int row, const std::string& which, const std::string& fields) {
  const testing::TestInfo* test = testing::UnitTest::GetInstance()->current_test_info();
  const std::string name =
      test == nullptr ? "study" : std::string(test->test_suite_name()) + "." + test->name();
  std::string file = name;
  for (char& c : file) {
    if (c == '/') c = '-';
  }
  std::ofstream out(std::string(std::getenv("EDDA_VERIFICATION_OUT")) + "/" + file + ".jsonl",
                    std::ios::app);
  out << "{\"kind\":\"" << kind << "\",\"row\":" << row << ",\"which\":" << json(which)
      << ",\"test\":" << json(name)
      << ",\"file\":" << json(std::string(test == nullptr ? "" : test->file())) << "," << fields
      << "}\n";
  if (!out.flush()) ADD_FAILURE() << "cannot write the records of " << name;
}

/// The bounds low and high are those of `error`.
void check(const Quantity& q, const char* measure, double computed, double exact, double error,
           double low, double high) {
  if (recording()) {
    write("check", q.row, q.which,
          "\"what\":" + json(q.what) + ",\"unit\":" + json(q.unit) + ",\"measure\":\"" + measure +
              "\",\"computed\":" + json(computed) + ",\"exact\":" + json(exact) +
              ",\"error\":" + json(error) + ",\"low\":" + json(low) + ",\"high\":" + json(high));
  }
  EXPECT_TRUE(error >= low && error <= high)
      << "row " << q.row << ", " << q.which << ": " << q.what << " is " << computed << ' ' << q.unit
      << (std::isnan(exact) ? std::string() : " (exact " + json(exact) + ")") << ", error " << error
      << " outside of " << low << " to " << high;
}

std::string outlines(const Simulation& sim, const std::vector<double>& x,
                     const std::vector<double>& y) {
  const BlockSet& b = sim.scene->blocks;
  std::string out = "[";
  for (std::size_t i = 0; i < b.size(); ++i) {
    std::string ring;
    for (Id v = b.vertex_begin[i]; v < b.vertex_begin[i + 1]; ++v) {
      ring += (ring.empty() ? "[" : ",[") + json(x[v] + b.origin.x) + "," +
              json(y[v] + b.origin.y) + "]";
    }
    out += (i > 0 ? ",[" : "[") + ring + "]";
  }
  return out + "]";
}

}  // namespace

void expect_relative(const Quantity& q, double computed, double exact, double bound) {
  expect_relative(q, computed, exact, -bound, bound);
}

void expect_relative(const Quantity& q, double computed, double exact, double low, double high) {
  check(q, "relative", computed, exact, computed / exact - 1.0, low, high);
}

void expect_at_most(const Quantity& q, double computed, double limit) {
  check(q, "limit", computed, std::nan(""), computed, -infinity, limit);
}

void expect_at_least(const Quantity& q, double computed, double limit) {
  check(q, "limit", computed, std::nan(""), computed, limit, infinity);
}

bool recording() {
  const char* folder = std::getenv("EDDA_VERIFICATION_OUT");
  return folder != nullptr && *folder != '\0';
}

void record_model(int row, const std::string& which, const Simulation& sim) {
  if (!recording()) return;
  const Model& m = sim.scene->model;
  const BlockSet& b = sim.scene->blocks;
  std::vector<double> densities, moduli, ratios, angles, fixed;
  for (const Material& rock : m.materials) {
    densities.push_back(rock.density);
    moduli.push_back(rock.young);
    ratios.push_back(rock.poisson);
  }
  for (const JointLaw& joint : m.joints) angles.push_back(joint.peak.friction_angle);
  for (const std::uint8_t f : b.fixed) fixed.push_back(f);
  const ContactSprings springs = contact_springs(m);
  write("model", row, which,
        "\"gravity\":" + json_list(std::vector<double>{m.gravity.x, m.gravity.y}) +
            ",\"plane\":\"" + (m.plane == Plane::stress ? "stress" : "strain") +
            "\",\"density\":" + json_list(densities) + ",\"young\":" + json_list(moduli) +
            ",\"poisson\":" + json_list(ratios) + ",\"friction\":" + json_list(angles) +
            ",\"normal_stiffness\":" + json(springs.normal) + ",\"shear_stiffness\":" +
            json(springs.shear) + ",\"time\":" + json(sim.motion.state.time) + ",\"steps\":" +
            std::to_string(sim.motion.state.steps) + ",\"fixed\":" + json_list(fixed) +
            ",\"start\":" + outlines(sim, b.vertex_x, b.vertex_y) +
            ",\"end\":" + outlines(sim, sim.motion.pose.x, sim.motion.pose.y));
}

Series::Series(int row, std::string which, std::vector<std::string> columns)
    : row_(row), which_(std::move(which)), columns_(std::move(columns)) {}

void Series::add(std::initializer_list<double> line) {
  if (recording()) lines_.emplace_back(line);
}

Series::~Series() {
  if (!recording()) return;
  std::string lines;
  for (const std::vector<double>& line : lines_)
    lines += (lines.empty() ? "" : ",") + json_list(line);
  write("series", row_, which_,
        "\"columns\":" + json_list(columns_) + ",\"lines\":[" + lines + "]");
}

}  // namespace edda
