// Fill against closed-form solutions: a column built in lifts, and fill between walls that close:
// validation.md rows 86 and 87.
#include <string>

#include "step/energy_balance.hpp"
#include "verification/record.hpp"
#include "verification/scene.hpp"
#include "verification/settled.hpp"

namespace edda::fill_test {
namespace {

constexpr double young = 1e9, weight = 2000.0 * 9.81, stiffness = 1e10, lift = 1.0;
constexpr int lifts = 10;

/// The y of the upper right corner of a lift less where it was placed, m.
double settlement_of(const Simulation& sim, const std::string& name) {
  const BlockSet& b = sim.scene->blocks;
  for (std::size_t i = 0; i < b.size(); ++i) {
    if (b.name(i) != name) continue;
    Id top = b.vertex_begin[i];
    for (Id v = top; v < b.vertex_begin[i + 1]; ++v) {
      const Vec2 p = b.vertex(v), best = b.vertex(top);
      if (p.x + p.y > best.x + best.y) top = v;
    }
    return corner_at(b, sim.motion.state.reference, top).y - sim.motion.pose.y[top];
  }
  ADD_FAILURE() << "no block is called " << name;
  return 0.0;
}

std::string column(const std::string& fills) {
  return R"([materials.rock]
density = 2500
young = 5e9
poisson = 0
[materials.concrete]
density = 2000
young = 1e9
poisson = 0
zone_size = 0.25
[joints.j]
friction_angle = 40
kn = 1e10
[[block]]
fixed = true
polygon = [[-1, -1], [2, -1], [2, 0], [-1, 0]]
material = "rock"
)" + fills;
}
const std::string to_rest = "[[stage]]\nuntil = 'equilibrium'\nratio = 1e-7\n";

/// Each lift settles by its own weight and by what comes after it,
///   u_i = gamma h^2/E (1/2 + (i - 1) + (N - i) i) + gamma h/kn (1 + N - i) i,
/// the last one least; built at once, gamma/E (H z - z^2/2) and the joints under the weight above.
TEST(Fill, ColumnInTenLiftsAndAtOnce) {
  std::string fills, stages;
  for (int i = 1; i <= lifts; ++i) {
    const std::string name = "lift " + std::to_string(i), y = number(i - 1), top = number(i);
    fills += "[[fill]]\nname = '" + name + "'\nmaterial = 'concrete'\npolygon = [[0, " + y +
             "], [1, " + y + "], [1, " + top + "], [0, " + top + "]]\n";
    stages += to_rest + "fill = ['" + name + "']\n";
  }
  const PreparedRun rising = settled(column(fills + stages));
  const PreparedRun at_once =
      settled(column("[[fill]]\nname = 'all'\nmaterial = 'concrete'\nlift = 1\npolygon = [[0, 0], "
                     "[1, 0], [1, 10], [0, 10]]\n" +
                     to_rest + "fill = ['all']\n"));
  FurthestOff in_lifts, whole;
  double joints = 0.0;
  for (int i = 1; i <= lifts; ++i) {
    const double after = lifts - i, z = i * lift, height = lifts * lift;
    const double u = weight * lift * lift / young * (0.5 + (i - 1) + after * i) +
                     weight * lift / stiffness * (1.0 + after) * i;
    in_lifts.see(settlement_of(rising.sim, "lift " + std::to_string(i)), u);
    joints += weight * lift / stiffness * (after + 1.0);
    whole.see(settlement_of(at_once.sim, "all." + std::to_string(i - 1)),
              weight / young * (height * z - 0.5 * z * z) + joints);
  }
  in_lifts.expect({86, "in lifts", "settlement", "m"}, 1e-3);
  whole.expect({86, "at once", "settlement", "m"}, 1e-3);
  for (const PreparedRun* run : {&rising, &at_once})
    EXPECT_LT(std::abs(energy_balance(run->sim).error), 1e-9);
}

/// Two walls close by 5 mm before there is fill of 10 m length between them, and by 2 mm after.
/// What closed before is no strain of the fill:
///   s = d/(L/E + 2/kn + 2 w/E + 2 A/2k),  w the width of a wall, k the springs at its two corners.
TEST(Fill, CarriesOnlyWhatComesAfter) {
  const std::string slowly = "[[stage]]\nduration = 0.6\ndamping = { local = 0.5 }\n";
  const PreparedRun run = settled(R"(gravity = [0, 0]
[materials.concrete]
density = 2000
young = 1e9
poisson = 0
zone_size = 1
[joints.j]
friction_angle = 40
kn = 1e10
[[block]]
polygon = [[-1, 0], [0, 0], [0, 2], [-1, 2]]
[[block]]
polygon = [[10, 0], [11, 0], [11, 2], [10, 2]]
[[fill]]
name = 'paste'
polygon = [[0, 0], [10, 0], [10, 2], [0, 2]]
[[boundary]]
along = [[-1, 0], [-1, 2]]
stiffness = 1e12
[[boundary]]
name = 'before'
along = [[11, 0], [11, 2]]
type = 'displacement'
displacement = [-0.005, 0]
stiffness = 1e12
[[boundary]]
name = 'after'
along = [[11, 0], [11, 2]]
type = 'displacement'
displacement = [-0.002, 0]
stiffness = 1e12
)" + slowly + slowly + "fill = ['paste']\n" +
                                  slowly + "deactivate = ['before']\nactivate = ['after']\n");
  const Simulation& sim = run.sim;
  const BlockSet& b = sim.scene->blocks;
  const double exact = 0.002 / ((9.995 + 2.0) / young + 2.0 / stiffness + 2.0 / 1e12);
  for (std::size_t i = 0; i < b.size(); ++i) {
    if (!b.is_fill(i)) continue;
    const double stress = -mean_stress(b, sim.scene->zones, sim.motion.zones, i)[0];
    expect_relative({87, "", "stress in the fill", "Pa"}, stress, exact, 1e-3);
  }
  EXPECT_LT(std::abs(energy_balance(sim).error), 1e-9);
}

}  // namespace
}  // namespace edda::fill_test
