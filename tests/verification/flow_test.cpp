// Water that flows through joints, against closed-form solutions: validation.md rows 92 to 98.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "contacts/face_softening.hpp"
#include "step/changes.hpp"
#include "step/faces_now.hpp"
#include "verification/record.hpp"
#include "verification/scene.hpp"
#include "verification/settled.hpp"

namespace edda::flow_verification {
namespace {

using std::numbers::pi;

constexpr double gamma = 9810.0, viscosity = 1e-3;

std::string rock(const std::string& joint) {
  return "[materials.rock]\ndensity = 2400\nyoung = 20e9\npoisson = 0.2\n[joints.j]\n"
         "friction_angle = 45\n" +
         joint + "[flow]\n";
}
std::string block(const std::string& polygon, const std::string& more = "") {
  return "[[block]]\npolygon = " + polygon + "\n" + more;
}
std::string table(const std::string& points) {
  return "[[water]]\ntable = " + points + "\n";
}
const std::string to_rest = "[[stage]]\nuntil = 'equilibrium'\nratio = 1e-8\n";

/// A dam 20 m high and wide on one joint, 15 m of water before it and 3 m behind it.
std::string dam(const std::string& more) {
  return rock("aperture = 5e-4\nresidual_aperture = 5e-4\nlargest_aperture = 5e-4\n") +
         block("[[-10, -5], [30, -5], [30, 0], [-10, 0]]", "fixed = true\n") +
         block("[[0, 0], [20, 0], [20, 20], [0, 20]]") + table("[[-10, 15], [0, 15]]") +
         table("[[20, 3], [30, 3]]") + more + to_rest;
}
double normal_force(const Simulation& sim) {
  double sum = 0.0;
  for (std::size_t k = 0; k < sim.motion.contacts.size(); ++k) sum += normal_force_now(sim, k);
  return sum;
}

constexpr double weight = 400.0 * 2400.0 * 9.81;

TEST(Flow, UpliftUnderADam) {
  const PreparedRun run = settled(dam(""));
  expect_relative({92, "no drains", "force on the joint", "N"}, normal_force(run.sim),
                  weight - gamma * 20.0 * 0.5 * (15.0 + 3.0), 1e-5);
}

TEST(Flow, UpliftUnderADamWithDrains) {
  // Drain holes 4 m behind the heel, open to a gallery at the level of 4 m.
  const PreparedRun run =
      settled(dam("[[water]]\nname = 'drains'\nlevel = 4\nalong = [[4, 4], [4, -4]]\n"));
  const double uplift = gamma * (4.0 * 0.5 * (15.0 + 4.0) + 16.0 * 0.5 * (4.0 + 3.0));
  expect_relative({92, "drains", "force on the joint", "N"}, normal_force(run.sim), weight - uplift,
                  1e-5);
  // What comes from the reservoir: h^3/(12 mu l) (15 - 4) gamma, of which the tailwater gets none.
  const std::vector<double>& inflow = run.sim.attached.joint_water.inflow;
  EXPECT_GT(inflow[0], 0.0);
  EXPECT_LT(inflow[1], 0.0);
  EXPECT_NEAR(inflow[0] + inflow[1] + inflow[2] + inflow[3], 0.0, 1e-12 * inflow[0]);
}

TEST(Flow, DischargeFallsAsAJointCloses) {
  // A joint with kn under the weight of a block and still heads of 6 and 4 m at its ends: its
  // normal stress less the water pressure closes it.
  const double height = 50.0, kn = 5e9, drawn = 5e-4;
  const PreparedRun run =
      settled(rock("aperture = 5e-4\nkn = 5e9\nresidual_aperture = 1e-5\n") +
              block("[[-5, -5], [15, -5], [15, 0], [-5, 0]]", "fixed = true\n") +
              block("[[0, 0], [10, 0], [10, 50], [0, 50]]") + table("[[-5, 6], [0, 6]]") +
              table("[[10, 6], [15, 6]]") + to_rest);
  const double stress = height * 2400.0 * 9.81 - 6.0 * gamma;
  const auto& faces = run.sim.attached.joint_water.rows;
  ASSERT_EQ(faces.size(), 1u);
  expect_relative({93, "closed by its weight", "hydraulic aperture", "m"}, faces[0].aperture,
                  drawn - stress / kn, 1e-3);
}

TEST(Flow, RadialFlowToATunnel) {
  // Two sets of joints 1 m apart: K = gamma h^3/(12 mu s), Q = 2 pi K (H - h)/ln(R/r).
  constexpr double radius = 4.0, far = 16.0, spacing = 1.0, aperture = 5e-4;
  const auto ring = [](double r, int parts, double turned) {
    std::string points = "[";
    for (int k = 0; k < parts; ++k) {
      const double a = 2.0 * pi * (k + turned) / parts;
      points +=
          (k == 0 ? "[" : ", [") + number(r * std::cos(a)) + ", " + number(r * std::sin(a)) + "]";
    }
    return points;
  };
  const std::string circle = ring(far, 180, 0.0) + ", [" + number(far) + ", 0]]";
  const std::string joints =
      "[[joint_set]]\nangle = 0\nspacing = 1\njoint = 'j'\n[[joint_set]]\nangle = 90\nspacing = 1\n"
      "joint = 'j'\n";
  const Simulation sim = scene(
      rock("aperture = 5e-4\n") + "[solver]\nduration = 1\n" +
      "[domain]\noutline = [[-20, -20], [20, -20], [20, 20], [-20, 20]]\nmaterial = 'rock'\n" +
      joints + "[[opening]]\nname = 'tunnel'\npolygon = " + ring(radius, 48, 0.5) + "]\n" +
      "[[boundary]]\nsides = ['left', 'right', 'top', 'bottom']\n" +
      "[[water]]\nlevel = 50\nalong = " + circle + "\n" +
      "[[water]]\nflooded = ['tunnel']\ntable = [[-20, 30], [20, 30]]\n");
  const double conductivity = gamma * aperture * aperture * aperture / (12.0 * viscosity * spacing);
  const double exact = 2.0 * pi * conductivity * 20.0 / std::log(far / radius);
  const std::vector<double>& inflow = sim.attached.joint_water.inflow;
  expect_relative({94, "from the ring", "discharge", "m2/s"}, inflow[0], exact, 1e-2);
  expect_relative({94, "into the tunnel", "discharge", "m2/s"}, -inflow[1], exact, 1e-2);
}

/// Part of a step of pressure at x = 0 that is left to come at x, of a length that ends there in an
/// impermeable wall: the part of it at the time T = c t/L^2 (Carslaw & Jaeger 1959, section 3.3).
double to_come(double x_over_length, double T) {
  double sum = 0.0;
  for (int m = 0; m < 200; ++m) {
    const double k = (m + 0.5) * pi;
    sum += 2.0 / k * std::sin(k * x_over_length) * std::exp(-k * k * T);
  }
  return sum;
}

TEST(Flow, DiffusionAlongAJoint) {
  // Rigid walls: c = h^2 K/(12 mu).
  constexpr int pipes = 100, increments = 400;
  constexpr double h = 2e-4, K = 2.2e9, length = 50.0, p0 = 1e5;
  constexpr double c = h * h * K / (12.0 * viscosity);
  FlowNetwork net;
  net.nodes.resize(pipes + 1);
  constexpr double part = length / pipes;
  for (Id n = 0; n <= pipes; ++n) net.nodes[n].place = {n * part, 0.0};
  for (Id n = 0; n < pipes; ++n) {
    const double conductance = conductance_of(h, h, part, viscosity);
    const Aperture rigid{h, h, h};
    net.pipes.push_back(
        {0, n, n + 1, 0.0, 1.0, part, conductance, parts_of_end(h, h), {rigid, rigid}});
    for (const Id end : {n, n + 1}) net.nodes[end].conductance += conductance;
  }
  std::vector<NodeCondition> given(net.nodes.size());
  given[0] = {NodeCondition::Kind::pressure, p0, 0};
  std::vector<NodeWater> water(net.nodes.size(), {0.0, 1.0});
  Storage storage;
  storage.bulk_modulus = K;
  storage.before.assign(2 * pipes, h);
  storage.passed = 0.5 * length * length / c / increments;
  FurthestOff middle, end;
  for (int k = 1; k <= increments; ++k) {
    storage.content.clear();
    storage.acting.clear();
    for (std::size_t n = 0; n < net.nodes.size(); ++n) {
      const double volume = (n == 0 || n == pipes ? 0.5 : 1.0) * part * h;
      storage.content.push_back(volume * (water[n].filled + water[n].pressure / K));
      storage.acting.push_back(water[n].pressure);
    }
    ASSERT_TRUE(solve_seepage(net, given, gamma, water, &storage));
    const double T = 0.5 * k / increments;
    if (k < 2 * increments / 5) continue;
    middle.see(water[pipes / 2].pressure, p0 * (1.0 - to_come(0.5, T)));
    end.see(water[pipes].pressure, p0 * (1.0 - to_come(1.0, T)));
  }
  middle.expect({95, "in the middle", "pressure", "Pa"}, 1e-2);
  end.expect({95, "at the closed end", "pressure", "Pa"}, 1e-2);
}

/// A time in which nothing changes changes nothing: a dam with drains, which cross its joint
/// between two crossings.
TEST(Flow, TimeAloneChangesNothing) {
  const std::string drained =
      dam("[[water]]\nname = 'drains'\nlevel = 4\nalong = [[4, 4], [4, -4]]\n");
  const double steady = normal_force(settled(drained).sim);
  const PreparedRun in_time = settled(drained + "[[stage]]\nramp = { flow = [0, 1], steps = 1 }\n");
  EXPECT_NEAR(normal_force(in_time.sim) / steady, 1.0, 1e-6);
}

/// Water stays while a ramp begins: one that changes nothing moves nothing.
TEST(Flow, ARampOfNothingMovesNothing) {
  const auto dissipated = [](const std::string& more) {
    double sum = 0.0;
    for (const double joules : settled(dam("") + more).sim.accounts.damping_work.joules)
      sum += joules;
    return sum;
  };
  const double at_first = dissipated("");
  EXPECT_GT(at_first, 100.0);
  const std::string ramp = "[[stage]]\nratio = 1e-8\nramp = { strength = [1, 1.01], steps = 3 }\n";
  EXPECT_NEAR(dissipated(ramp), at_first, 1e-6 * at_first);
}

/// Columns of 0.5 m side by side on a joint that drains to the left, loaded by 10 kPa more. They
/// neither hold each other nor bend.
std::string columns(const std::string& flow, const std::string& time) {
  return "gravity = [0, 0]\n[materials.rock]\ndensity = 2500\nyoung = 1e12\npoisson = 0.2\n"
         "[joints.base]\nfriction_angle = 30\nkn = 1e12\naperture = 1e-4\n"
         "[joints.side]\nfriction_angle = 0\nkn = 1e10\naperture = 0\n[flow]\n" +
         flow +
         "[domain]\noutline = [[0, 0], [10, 0], [10, 2], [0, 2]]\nmaterial = 'rock'\n"
         "[[trace]]\npoints = [[0, 1], [10, 1]]\njoint = 'base'\n"
         "[[joint_set]]\nangle = 90\nspacing = 0.5\norigin = [0, 0]\njoint = 'side'\n"
         "region = [[0, 1], [10, 1], [10, 2], [0, 2]]\n"
         "[[boundary]]\nsides = ['bottom']\ntype = 'fixed'\n"
         "[[boundary]]\nsides = ['left', 'right']\ntype = 'roller'\n"
         "[[water]]\nlevel = 1.01\nsides = ['left']\n"
         "[[load]]\nname = 'dead'\nalong = [[0, 2], [10, 2]]\npressure = 15e3\n"
         "[[load]]\nname = 'more'\nalong = [[0, 2], [10, 2]]\npressure = 10e3\n"
         "[[stage]]\nuntil = 'equilibrium'\n[[stage]]\nactivate = ['more']\nramp = " +
         time + "\n";
}
/// Pressure above that of the water on the left, by the place along the joint.
std::vector<std::pair<double, double>> excess_pressures(const Simulation& sim) {
  std::vector<std::pair<double, double>> found;
  const BlockSet& b = sim.scene->blocks;
  for (Id v = 0; v < b.vertex_count(); ++v) {
    const Vec2 place = b.vertex(v) + b.origin;
    if (std::abs(place.y - 1.0) < 1e-6 && sim.attached.joint_water.filled[v] > 0.0)
      found.emplace_back(place.x, sim.attached.joint_water.pressure[v] - gamma * 0.01);
  }
  return found;
}

TEST(Flow, ConsolidationOfAJoint) {
  const PreparedRun run = settled(columns("", "{ flow = [0, 0.6], steps = 100 }"));
  constexpr double stored = 1e-12 + 1e-4 / 2.2e9;  // m/Pa: 1/kn + h/K
  constexpr double c = 1e-12 / (12.0 * viscosity) / stored, T = c * 0.6 / 100.0;
  constexpr double at_first = 1e4 * 1e-12 / stored;
  FurthestOff far;
  for (const auto& [x, p] : excess_pressures(run.sim)) {
    if (x > 5.0) far.see(p, at_first * to_come(x / 10.0, T));
  }
  far.expect({96, "after 0.6 s", "excess pressure", "Pa"}, 1e-2);
}

TEST(Flow, WaterThatIsShutIn) {
  // K = kn h: water takes half of a load that comes while it has no time to flow.
  const PreparedRun run =
      settled(columns("bulk_modulus = 1e8\n", "{ flow = [0, 1e-9], steps = 1 }"));
  FurthestOff far;
  for (const auto& [x, p] : excess_pressures(run.sim)) {
    if (x > 2.5 && x < 7.5) far.see(p, 5e3);
  }
  far.expect({97, "K = kn h", "pressure that the load causes", "Pa"}, 1e-3);
}

TEST(Flow, LinesThatComeAndGoMoveNoWater) {
  // A line of the head that there is, across the joint between two crossings, is activated and
  // deactivated before any time passes.
  std::string text = columns("", "{ flow = [0, 1e-9], steps = 1 }");
  text.replace(text.find("pressure = 10e3"), 15, "pressure = 1e-3");
  text +=
      "[[water]]\nname = 'line'\nlevel = 1.01\nalong = [[5.2, 0.5], [5.2, 1.5]]\n"
      "[[stage]]\nactivate = ['line']\nramp = { flow = [0, 1e-9], steps = 1 }\n"
      "[[stage]]\ndeactivate = ['line']\nramp = { flow = [0, 1e-9], steps = 1 }\n";
  for (const auto& [x, p] : excess_pressures(settled(text).sim)) EXPECT_NEAR(p, 0.0, 0.1) << x;
}

TEST(Flow, AChangedApertureKeepsThePressure) {
  std::string text = columns("", "{ flow = [0, 1e-9], steps = 1 }");
  text.replace(text.find("pressure = 10e3"), 15, "pressure = 1e-3");
  text +=
      "change = [{ joints = 'base', to = 'grout', region = [[5, 0], [9, 0], [9, 2], [5, 2]] }]\n"
      "[joints.grout]\nfriction_angle = 30\nkn = 1e12\naperture = 2e-5\n";
  for (const auto& [x, p] : excess_pressures(settled(text).sim)) EXPECT_NEAR(p, 0.0, 0.1) << x;
}

/// Upper right quarter of a plane fracture that a borehole opens, in zones of 1 m: half of its
/// aperture w, so that a quarter of the injection Q and of the viscosity flow as in the whole.
constexpr double Q = 1e-2, t = 4.0, E = 30e9 / 0.96;  // E' = E/(1 - nu^2)
std::string quarter_of_fracture(const std::string& joint, double quarter_of_viscosity, int steps) {
  return "gravity = [0, 0]\n"
         "[materials.far]\ndensity = 2500\nyoung = 30e9\npoisson = 0.2\nzone_size = 8\n"
         "[materials.near]\ndensity = 2500\nyoung = 30e9\npoisson = 0.2\nzone_size = 1\n"
         "[joints.plane]\nfriction_angle = 0\nlargest_aperture = 1e-2\n" +
         joint +
         "[joints.none]\ntype = 'glued'\n[contact]\njoint = 'none'\n"
         "[domain]\noutline = [[0, -10], [240, -10], [240, 240], [0, 240]]\nmaterial = 'far'\n"
         "[[trace]]\npoints = [[0, 0], [240, 0]]\njoint = 'plane'\n"
         "[[region]]\npolygon = [[0, 0], [28, 0], [28, 10], [0, 10]]\nmaterial = 'near'\n"
         "[[fixed]]\npoint = [100, -5]\n[initial_stress]\nstress = [-5e6, -5e6, 0]\n"
         "[[boundary]]\nsides = ['left', 'right', 'top']\ntype = 'roller'\n[zones]\n"
         "[flow]\nviscosity = " +
         fmt::format("{:g}", quarter_of_viscosity) +
         "\n[[water]]\nname = 'borehole'\ninjection = 0.25e-2\nat = [0, 0]\n"
         "[[stage]]\nuntil = 'equilibrium'\n[[stage]]\nactivate = ['borehole']\nramp = { flow = "
         "[0, 4], steps = " +
         std::to_string(steps) + " }\n";
}
/// Of one side of the fracture, by the place of the middles of its parts.
struct Opened {
  double pressure;  // the largest, less the stress
  std::vector<double> x, aperture;
  std::vector<double> damage;
};
Opened opened(const Simulation& sim) {
  const BlockSet& b = sim.scene->blocks;
  Opened found{0.0, {}, {}, {}};
  std::vector<std::array<double, 3>> parts;
  const FaceSet& faces = sim.motion.contacts;
  for (std::size_t k = 0; k < faces.size(); ++k) {
    const FlowRow* row = row_of(sim.attached.joint_water, faces.edge[k], faces.facing[k]);
    if (row == nullptr) continue;
    const Id edge = b.edge_length[row->edge] < b.edge_length[row->facing] ? row->edge : row->facing;
    parts.push_back({0.5 * (b.vertex(edge).x + b.vertex(b.next[edge]).x) + b.origin.x,
                     row->aperture, damage_of(faces, sim.motion.laws, k).a});
  }
  std::sort(parts.begin(), parts.end());
  for (const auto& [x, aperture, damage] : parts) {
    found.x.push_back(x);
    found.aperture.push_back(aperture);
    found.damage.push_back(damage);
  }
  for (const double p : sim.attached.joint_water.pressure)
    found.pressure = std::max(found.pressure, p - 5e6);
  return found;
}
/// Of the whole fracture at the borehole.
double width(const Opened& of) {
  const double slope = (of.aperture[0] - of.aperture[1]) / (of.x[1] - of.x[0]);
  return 2.0 * (of.aperture[0] + slope * of.x[0]);
}

TEST(Flow, ABoreholeOpensAJoint) {
  const PreparedRun run = settled(quarter_of_fracture(
      "kn = 1e12\naperture = 2e-6\nresidual_aperture = 1e-6\n", 0.25 * viscosity, 32));
  const Opened of = opened(run.sim);
  // Geertsma and de Klerk's fracture without toughness and lag (Adachi & Detournay 2002): constants
  // of the self-similar solution, mu' = 12 mu.
  constexpr double mu = 12.0 * viscosity;
  const double length = std::pow(E * Q * Q * Q * t * t * t * t / mu, 1.0 / 6.0);
  const double small = std::cbrt(mu / (E * t));
  expect_relative({103, "zero toughness", "pressure at the borehole less the stress", "Pa"},
                  of.pressure, 0.5445 * small * E, 0.05);
  expect_relative({103, "zero toughness", "aperture at the borehole", "m"}, width(of),
                  1.1254 * small * length, 0.05);
  // Near its end w^(3/2) falls linearly to 0: from the last two parts wider than a tenth.
  std::size_t last = 0;
  while (of.aperture[last + 1] > 0.1 * of.aperture[0]) ++last;
  const auto power = [&](std::size_t k) { return std::pow(of.aperture[k], 1.5); };
  const double end =
      of.x[last] + power(last) / (power(last - 1) - power(last)) * (of.x[last] - of.x[last - 1]);
  expect_relative({103, "zero toughness", "half length", "m"}, end, 0.6158 * length, 0.05);
}

TEST(Flow, ABoreholeSplitsRock) {
  // Nearly without viscosity the pressure is uniform: w = 4 p l/E', K = p sqrt(pi l), and the
  // volume pi l w/2 is what has been injected. Of the energy of the fracture each side has a half.
  constexpr double energy = 2.0 * 338.56, thin = 1e-5;
  const double K = std::sqrt(energy * E);
  const PreparedRun run = settled(quarter_of_fracture(
      "kn = 5e11\nks = 1e6\naperture = 5e-7\nresidual_aperture = 2e-7\ntensile_strength = 2.5e6\n"
      "cohesion = 25e6\nfracture_energy = 338.56\nshear_fracture_energy = 10e3\n",
      0.25 * thin, 16));
  const Opened of = opened(run.sim);
  const double half = std::pow(E * Q * t / (2.0 * std::sqrt(std::numbers::pi) * K), 2.0 / 3.0);
  const double pressure = K / std::sqrt(std::numbers::pi * half);
  expect_relative({104, "nearly no viscosity", "pressure at the borehole less the stress", "Pa"},
                  of.pressure, pressure, 0.05);
  expect_relative({104, "nearly no viscosity", "aperture at the borehole", "m"}, width(of),
                  4.0 * pressure * half / E, 0.05);
  // That of the ellipse on which the aperture lies before the process zone.
  std::size_t last = 0;
  while (of.damage[last + 1] == 1.0) ++last;
  const double end = of.x[last] / std::sqrt(1.0 - std::pow(2.0 * of.aperture[last] / width(of), 2));
  expect_relative({104, "nearly no viscosity", "half length", "m"}, end, half, 0.05);
}

TEST(Flow, TimeEnoughIsSteadyFlow) {
  // A slope whose groundwater rises: after a long time the water is that of a stage without time.
  const PreparedRun run = settled(
      rock("kn = 1e10\naperture = 2e-4\ncohesion = 1e6\n") +
      "[slope]\ntoe = [0, 0]\nheight = 20\nface_angle = 60\nbase_y = -10\nextent = [-20, 40]\n"
      "[domain]\nmaterial = 'rock'\n[[joint_set]]\nangle = 20\nspacing = 6\n"
      "[[joint_set]]\nangle = -70\nspacing = 6\n"
      "[[boundary]]\nsides = ['left', 'right', 'bottom']\ntype = 'roller'\n"
      "[[water]]\nname = 'dry'\nlevel = 2\nsides = ['right']\n"
      "[[water]]\nname = 'wet'\nlevel = 15\nsides = ['right']\n"
      "[[stage]]\nuntil = 'equilibrium'\n"
      "[[stage]]\nactivate = ['wet']\ndeactivate = ['dry']\n"
      "ramp = { flow = ['0 h', '100 h'], steps = 10 }\n");
  const std::vector<double> in_time = run.sim.attached.joint_water.pressure;
  Simulation steady = run.sim;
  steady.attached.loads.flow = JointFlow::steady;
  update_flow(steady);
  const std::vector<double>& at_once = steady.attached.joint_water.pressure;
  double most = 0.0, off = 0.0;
  for (std::size_t v = 0; v < at_once.size(); ++v) {
    most = std::max(most, at_once[v]);
    off = std::max(off, std::abs(at_once[v] - in_time[v]));
  }
  EXPECT_GT(most, 1e5);
  expect_at_most({98, "after 100 h", "largest difference of pressure over the largest", ""},
                 off / most, 1e-6);
}

}  // namespace
}  // namespace edda::flow_verification
