// Water in a network of pipes: networks by hand, free surfaces, and the conditions that any
// solution holds, in random networks.
#include "flow/seepage.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace edda {
namespace {

using Kind = NodeCondition::Kind;
constexpr double gamma = 9810.0;

FlowNetwork network_of(const std::vector<Vec2>& places,
                       const std::vector<std::tuple<Id, Id, double>>& pipes) {
  FlowNetwork net;
  for (const Vec2 p : places) net.nodes.push_back({p, 0.0});
  for (const auto& [from, to, conductance] : pipes) {
    const double length = norm(places[from] - places[to]);
    net.pipes.push_back({0, from, to, 0.0, 1.0, length, conductance, {}, {}});
    net.nodes[from].conductance += conductance;
    net.nodes[to].conductance += conductance;
  }
  return net;
}

std::vector<NodeWater> solved(const FlowNetwork& net, const std::vector<NodeCondition>& given) {
  std::vector<NodeWater> water(net.nodes.size());
  EXPECT_TRUE(solve_seepage(net, given, gamma, water));
  return water;
}

TEST(Seepage, ConductanceOfPlates) {
  // h^3/(12 mu l), and of a tapered one by quadrature.
  EXPECT_DOUBLE_EQ(conductance_of(1e-3, 1e-3, 2.0, 1e-3), 1e-9 / (12.0 * 1e-3 * 2.0));
  double resistance = 0.0;
  constexpr int parts = 100000;
  for (int k = 0; k < parts; ++k) {
    const double h = 1e-3 + (k + 0.5) / parts * (4e-3 - 1e-3);
    resistance += 12.0 * 1e-3 / (h * h * h) * 2.0 / parts;
  }
  EXPECT_NEAR(conductance_of(1e-3, 4e-3, 2.0, 1e-3) * resistance, 1.0, 1e-8);
}

TEST(Seepage, PotentialAlongATaperedPipe) {
  // By quadrature of f = Int h^-3 / its whole; uniform pipes have 1/6 and 1/3.
  EXPECT_NEAR(parts_of_end(1e-3, 1e-3).a, 1.0 / 6.0, 1e-15);
  EXPECT_NEAR(parts_of_end(1e-3, 1e-3).b, 1.0 / 3.0, 1e-15);
  for (const double ratio : {0.02, 0.5, 0.899, 0.901, 0.999, 1.3, 40.0}) {
    constexpr int parts = 200000;
    double passed = 0.0, of_a = 0.0, of_b = 0.0;
    for (int k = 0; k < parts; ++k) {
      const double s = (k + 0.5) / parts, part = std::pow(1.0 + (ratio - 1.0) * s, -3.0) / parts;
      of_a += (passed + 0.5 * part) * (1.0 - s) / parts;
      of_b += (passed + 0.5 * part) * s / parts;
      passed += part;
    }
    const FaceEnds found = parts_of_end(1e-4, ratio * 1e-4);
    EXPECT_NEAR(found.a, of_a / passed, 1e-7) << ratio;
    EXPECT_NEAR(found.b, of_b / passed, 1e-7) << ratio;
  }
}

TEST(Seepage, WhatIsInjectedFlowsToTheAir) {
  // 2e-6 m2/s at the middle of three pipes in a row whose ends are in the air.
  const FlowNetwork net =
      network_of({{0, 0}, {1, 0}, {3, 0}, {4, 0}}, {{0, 1, 1e-9}, {1, 2, 1e-9}, {2, 3, 1e-9}});
  std::vector<NodeCondition> given(4);
  given[0].kind = given[3].kind = Kind::air;
  given[1].source = 2e-6;
  const std::vector<NodeWater> water = solved(net, given);
  EXPECT_NEAR(water[1].pressure, 2e-6 / 1.5e-9, 1e-5);
  EXPECT_NEAR(water[2].pressure, 1e-6 / 1.5e-9, 1e-5);
  // From where none can leave, none goes in.
  given[0].kind = given[3].kind = Kind::inside;
  EXPECT_EQ(solved(net, given)[1].pressure, 0.0);
}

TEST(Seepage, WheatstoneBridgeByHand) {
  // All at one level. Conductances 1, 2 | 3, 4 and the bridge 5 between the middles:
  // 8 p1 ... from Kirchhoff's law by hand: (1+2+5) p1 - 5 p2 = p0, (3+4+5) p2 - 5 p1 = 3 p0.
  const FlowNetwork net =
      network_of({{0, 0}, {1, 0}, {2, 0}, {3, 0}},
                 {{0, 1, 1e-9}, {1, 3, 2e-9}, {0, 2, 3e-9}, {2, 3, 4e-9}, {1, 2, 5e-9}});
  const double p0 = 1e5;
  const std::vector<NodeWater> w =
      solved(net, {{Kind::pressure, p0, 0}, {}, {}, {Kind::air, 0.0, none}});
  const double p1 = (12.0 * p0 + 15.0 * p0) / (8.0 * 12.0 - 25.0);
  const double p2 = (8.0 * 3.0 * p0 + 5.0 * p0) / (8.0 * 12.0 - 25.0);
  EXPECT_NEAR(w[1].pressure / p1, 1.0, 1e-11);
  EXPECT_NEAR(w[2].pressure / p2, 1.0, 1e-11);
  const double in =
      discharge_of(net, net.pipes[0], gamma, w) + discharge_of(net, net.pipes[2], gamma, w);
  EXPECT_NEAR(in, 1e-9 * (p0 - p1) + 3e-9 * (p0 - p2), 1e-17);
}

TEST(Seepage, StillWaterIsHydrostatic) {
  // A loop that reaches above the level of the only water.
  const FlowNetwork net = network_of({{0, 0}, {0, 4}, {3, 8}, {3, 2}},
                                     {{0, 1, 1e-9}, {1, 2, 2e-9}, {2, 3, 1e-9}, {3, 0, 4e-9}});
  const std::vector<NodeWater> w = solved(net, {{Kind::pressure, 5.0 * gamma, 0}, {}, {}, {}});
  EXPECT_NEAR(w[1].pressure, gamma, 1e-8);
  EXPECT_NEAR(w[3].pressure, 3.0 * gamma, 1e-8);
  EXPECT_EQ(w[2].pressure, 0.0);
  EXPECT_EQ(w[2].filled, 0.0);
  for (const FlowPipe& pipe : net.pipes) {
    EXPECT_NEAR(discharge_of(net, pipe, gamma, w), 0.0, 1e-16);
    // In pipes that reach above it, too.
    EXPECT_NEAR(levels_of(net, pipe, gamma, w).from, 5.0, 1e-11);
    EXPECT_NEAR(levels_of(net, pipe, gamma, w).to, 5.0, 1e-11);
  }
}

TEST(Seepage, WaterFallsFromACrossing) {
  // A level pipe feeds a crossing, from which a wide pipe falls to the air: the crossing is at
  // atmospheric pressure, and the water that comes fills a part of the wide pipe.
  const FlowNetwork net = network_of({{0, 10}, {5, 10}, {5, 0}}, {{0, 1, 1e-9}, {1, 2, 8e-9}});
  const double p0 = 2.0 * gamma;
  const std::vector<NodeWater> w =
      solved(net, {{Kind::pressure, p0, 0}, {}, {Kind::air, 0.0, none}});
  EXPECT_EQ(w[1].pressure, 0.0);
  EXPECT_NEAR(w[1].filled, 1e-9 * p0 / (8e-9 * 10.0 * gamma), 1e-11);
  EXPECT_NEAR(discharge_of(net, net.pipes[1], gamma, w), 1e-9 * p0, 1e-16);
}

TEST(Seepage, JointsTakeInRainAsFarAsTheyCan) {
  // Down two joints one after the other: gravity alone drives 5 gamma C of them.
  const double C = 1e-9, most = 5.0 * gamma * C;
  const FlowNetwork net = network_of({{0, 10}, {0, 5}, {0, 0}}, {{0, 1, C}, {1, 2, C}});
  for (const double rain : {0.3 * most, 0.999 * most, 4.0 * most}) {
    const std::vector<NodeWater> w =
        solved(net, {{Kind::rain, 0.0, 1, rain}, {}, {Kind::air, 0.0, none}});
    const double in = std::min(rain, most);
    EXPECT_EQ(w[0].pressure, 0.0);
    EXPECT_NEAR(w[0].filled, in / most, 1e-8);
    EXPECT_NEAR(discharge_of(net, net.pipes[0], gamma, w), in, 1e-8 * most);
    EXPECT_NEAR(discharge_of(net, net.pipes[1], gamma, w), in, 1e-8 * most);
  }
}

TEST(Seepage, NoAirFeedsWater) {
  // An outcrop above, one below: nothing flows from the upper to the lower.
  const FlowNetwork net = network_of({{0, 10}, {0, 5}, {0, 0}}, {{0, 1, 1e-9}, {1, 2, 1e-9}});
  const std::vector<NodeWater> w =
      solved(net, {{Kind::air, 0.0, none}, {}, {Kind::air, 0.0, none}});
  EXPECT_EQ(w[1].pressure, 0.0);
  EXPECT_EQ(w[1].filled, 0.0);
}

/// A grid of crossings with random apertures, lifted at random.
FlowNetwork random_network(std::mt19937& draw, Id wide, Id high) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::vector<Vec2> places;
  for (Id j = 0; j < high; ++j) {
    for (Id i = 0; i < wide; ++i) places.push_back({i + 0.6 * unit(draw), j + 0.6 * unit(draw)});
  }
  std::vector<std::tuple<Id, Id, double>> pipes;
  const auto add = [&](Id a, Id b) {
    if (unit(draw) < 0.85) pipes.emplace_back(a, b, 1e-9 * std::pow(10.0, 3.0 * unit(draw)));
  };
  for (Id j = 0; j < high; ++j) {
    for (Id i = 0; i < wide; ++i) {
      if (i + 1 < wide) add(j * wide + i, j * wide + i + 1);
      if (j + 1 < high) add(j * wide + i, (j + 1) * wide + i);
    }
  }
  return network_of(places, pipes);
}

TEST(Seepage, RandomNetworksHoldTheirConditions) {
  std::mt19937 draw(7);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int trial = 0; trial < 500; ++trial) {
    constexpr Id wide = 12, high = 9;
    const FlowNetwork net = random_network(draw, wide, high);
    std::vector<NodeCondition> given(net.nodes.size());
    for (Id j = 0; j < high; ++j) {
      const Id left = j * wide, right = left + wide - 1;
      const double p = gamma * (6.5 - net.nodes[left].place.y);
      given[left] = p > 0.0 ? NodeCondition{Kind::pressure, p, 0} : NodeCondition{};
      // Half of the trials have rain on the top.
      if (j + 1 == high && trial % 2 == 1) {
        for (Id i = 1; i + 1 < wide; ++i)
          given[left + i] = {Kind::rain, 0.0, 2, gamma * 1e-9 * std::pow(10.0, 3.0 * unit(draw))};
      }
      const double q = gamma * (2.0 - net.nodes[right].place.y);
      given[right] =
          q > 0.0 ? NodeCondition{Kind::pressure, q, 1} : NodeCondition{Kind::air, 0.0, none};
    }
    const std::vector<NodeWater> w = solved(net, given);
    std::vector<double> gain(net.nodes.size(), 0.0), size(net.nodes.size(), 1e-16);
    for (const FlowPipe& pipe : net.pipes) {
      const double q = discharge_of(net, pipe, gamma, w);
      gain[pipe.from] -= q;
      gain[pipe.to] += q;
      size[pipe.from] += std::abs(q);
      size[pipe.to] += std::abs(q);
    }
    for (std::size_t n = 0; n < w.size(); ++n) {
      if (given[n].kind == Kind::inside) {
        EXPECT_LE(std::abs(gain[n]),
                  1e-8 * size[n] + 1e-8 * gamma * 1e-3 * net.nodes[n].conductance + 1e-15)
            << trial << ": node " << n;
        EXPECT_GE(w[n].pressure, 0.0);
        EXPECT_GE(w[n].filled, 0.0);
        EXPECT_LE(w[n].filled, 1.0);
        EXPECT_TRUE(w[n].pressure == 0.0 || w[n].filled == 1.0);
      } else if (given[n].kind == Kind::air) {
        EXPECT_GE(gain[n], -1e-15) << "no water comes out of the air";
      } else if (given[n].kind == Kind::rain) {
        const double more = given[n].source + gain[n], off = 1e-8 * (size[n] + given[n].source);
        EXPECT_EQ(w[n].pressure, 0.0);
        EXPECT_GE(more, -off) << "no more than the rain";
        if (w[n].filled < 1.0) {
          EXPECT_LE(more, off + 1e-8 * gamma * 1e-3 * net.nodes[n].conductance) << trial;
        }
      }
      // No pressure anywhere above that of the higher water, or of water that stands up to rain.
      const double top = trial % 2 == 1 ? 9.0 : 6.5;
      EXPECT_LE(w[n].pressure,
                gamma * (top - net.nodes[n].place.y) * (w[n].pressure > 0 ? 1 : 0) + 1e-6);
    }
  }
}

/// What walls that part draw to a node is what its pressure presses on them.
TEST(Seepage, VolumesOfTaperedPipesFollowTheWorkOfTheirPressures) {
  const FlowPipe pipe{0, 0, 1, 0.0, 1.0, 3.0, 1e-9, parts_of_end(2e-4, 3e-5), {}};
  EXPECT_NEAR(volume_at(pipe, 0.0, 1.0) + drawn_to(pipe, {1.0, 0.0}), 3.0 * pipe.of_to.a, 1e-15);
  EXPECT_NEAR(volume_at(pipe, 1.0, 0.0) + drawn_to(pipe, {0.0, 1.0}), 3.0 * pipe.of_to.b, 1e-15);
  EXPECT_NEAR(volume_at(pipe, 1.0, 0.0) - drawn_to(pipe, {1.0, 0.0}), 3.0 * (0.5 - pipe.of_to.a),
              1e-15);
}

/// Apertures some of which are at their bounds, and walls that pressures part.
void add_walls(std::mt19937& draw, FlowNetwork& net, Storage& storage) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (std::size_t q = 0; q < net.pipes.size(); ++q) {
    FlowPipe& pipe = net.pipes[q];
    for (Aperture& a : pipe.aperture) a = {4e-4 * (unit(draw) - 0.2), 2e-5, 3e-4};
    pipe.of_to = parts_of_end(pipe.aperture[0].value(), pipe.aperture[1].value());
    for (Id e = 0; e < 2; ++e) {
      storage.before.push_back(pipe.aperture[e].value() * (0.5 + unit(draw)));
      const double to = e == 0 ? pipe.of_to.a : pipe.of_to.b, compliance = 1e-9 * unit(draw);
      storage.gives.push_back({static_cast<Id>(2 * q + e), pipe.from, compliance * (0.5 - to)});
      storage.gives.push_back({static_cast<Id>(2 * q + e), pipe.to, compliance * to});
    }
  }
}
/// What nodes contain: V (s + p/K), and what the walls have drawn there since the beginning.
std::vector<double> contents(const FlowNetwork& net, const Storage& storage,
                             const std::vector<NodeWater>& w, std::vector<double>& volumes) {
  std::vector<double> apertures;
  for (const FlowPipe& pipe : net.pipes) {
    for (Aperture a : pipe.aperture) {
      for (const Storage::Give& g : storage.gives) {
        if (g.end == apertures.size())
          a.walls += g.compliance * (w[g.node].pressure - storage.acting[g.node]);
      }
      apertures.push_back(a.value());
    }
  }
  std::vector<double> found(w.size(), 0.0);
  volumes.assign(w.size(), 0.0);
  for (std::size_t q = 0; q < net.pipes.size(); ++q) {
    const FlowPipe& pipe = net.pipes[q];
    const double a = apertures[2 * q], b = apertures[2 * q + 1];
    volumes[pipe.from] += pipe.length * (2.0 * a + b) / 6.0;
    volumes[pipe.to] += pipe.length * (a + 2.0 * b) / 6.0;
    const double drawn = w[pipe.from].filled * w[pipe.to].filled *
                         drawn_to(pipe, {a - storage.before[2 * q], b - storage.before[2 * q + 1]});
    found[pipe.from] -= drawn;
    found[pipe.to] += drawn;
  }
  for (std::size_t n = 0; n < w.size(); ++n)
    found[n] += volumes[n] * (w[n].filled + w[n].pressure / storage.bulk_modulus);
  return found;
}

/// What nodes contain changes by what flows, whatever the time that passes.
TEST(Seepage, NoWaterIsLostInTime) {
  std::mt19937 draw(11);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  int partly = 0;
  for (int trial = 0; trial < 200; ++trial) {
    constexpr Id wide = 8, high = 6;
    FlowNetwork net = random_network(draw, wide, high);
    const std::size_t count = net.nodes.size();
    std::vector<NodeCondition> given(count);
    given[wide - 1] = {Kind::air, 0.0, none};
    for (Id j = 0; j < high; ++j) {
      const double p = gamma * (2.0 + 4.0 * unit(draw) - net.nodes[j * wide].place.y);
      if (p > 0.0) given[j * wide] = {Kind::pressure, p, 0};
    }
    Storage storage;
    storage.bulk_modulus = 2e9;
    storage.passed = std::pow(10.0, 6.0 * unit(draw) - 1.0);
    std::vector<NodeWater> w(count);
    for (std::size_t n = 0; n < count; ++n) {
      w[n] = unit(draw) < 0.5 ? NodeWater{1e5 * unit(draw), 1.0} : NodeWater{0.0, unit(draw)};
      storage.acting.push_back(w[n].pressure);
    }
    add_walls(draw, net, storage);
    std::vector<double> volumes;
    storage.content = contents(net, storage, w, volumes);
    for (std::size_t n = 0; n < count; ++n)
      storage.content[n] = volumes[n] * (w[n].filled + w[n].pressure / 2e9) * (0.6 + unit(draw));
    ASSERT_TRUE(solve_seepage(net, given, gamma, w, &storage)) << trial;
    std::vector<double> out(count, 0.0);
    for (const FlowPipe& pipe : net.pipes) {
      const double q = discharge_of(net, pipe, gamma, w);
      out[pipe.from] += q;
      out[pipe.to] -= q;
    }
    const std::vector<double> now = contents(net, storage, w, volumes);
    for (std::size_t n = 0; n < count; ++n) {
      if (given[n].kind != Kind::inside) continue;
      EXPECT_NEAR(
          now[n] - storage.content[n] + storage.passed * out[n], 0.0,
          1e-7 * volumes[n] + 1e-8 * storage.passed * gamma * 10.0 * net.nodes[n].conductance)
          << trial << ": node " << n;
      EXPECT_TRUE(w[n].pressure == 0.0 || w[n].filled == 1.0);
      if (w[n].filled > 0.0 && w[n].filled < 1.0) ++partly;
    }
  }
  EXPECT_GT(partly, 500);
}

TEST(Seepage, WhatNoWaterReachesIsDry) {
  const FlowNetwork net =
      network_of({{0, 0}, {5, 0}, {9, -5}, {9, -9}}, {{0, 1, 1e-9}, {2, 3, 1e-9}});
  std::vector<NodeWater> w(4, {1e5, 1.0});
  EXPECT_TRUE(solve_seepage(net, {{Kind::pressure, 2e4, 0}, {}, {}, {}}, gamma, w));
  EXPECT_NEAR(w[1].pressure, 2e4, 1e-6);
  EXPECT_EQ(w[2].pressure, 0.0);
  EXPECT_EQ(w[3].filled, 0.0);
}

}  // namespace
}  // namespace edda
