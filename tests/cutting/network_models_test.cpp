// Baecher's discs and Veneziano's lines, by what their theory says of the traces.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "cutting/line_models.hpp"
#include "cutting/random_lines.hpp"

namespace edda::network_models_test {
namespace {

using namespace test;

FractureNetwork network_of(NetworkModel model, LengthKind kind, double mean) {
  FractureNetwork network;
  network.model = model;
  network.angle = {0.0, 90.0, Spread::uniform};
  network.length.distribution = kind;
  network.length.mean = mean;
  network.where = {"fracture_network.0", "test.toml", 1, 1};
  return network;
}

LineWork drawn(const FractureNetwork& network, double side) {
  LineWork work;
  work.outline = box(-0.5 * side, -0.5 * side, 0.5 * side, 0.5 * side);
  const Faults faults = add_network(work, network, 0, {0, 0}, 1e-9, 1e7);
  EXPECT_TRUE(faults.empty());
  return work;
}

double length_of(const LineString& line) {
  return norm(line.points[1] - line.points[0]);
}

/// Mean and mean square of the traces whose middles lie well inside.
std::pair<double, double> moments_of(const LineWork& work, double side) {
  double n = 0.0, sum = 0.0, squares = 0.0;
  for (const LineString& line : work.lines) {
    const Vec2 middle = 0.5 * (line.points[0] + line.points[1]);
    if (std::max(std::abs(middle.x), std::abs(middle.y)) > 0.3 * side) continue;
    n += 1.0;
    sum += length_of(line);
    squares += length_of(line) * length_of(line);
  }
  return {sum / n, squares / n};
}

/// Chords of discs of diameter D: E[l] = pi/4 E[D^2]/E[D], E[l^2] = 2/3 E[D^3]/E[D].
TEST(NetworkModels, BaechersTracesAreChordsOfDiscs) {
  const double side = 100.0, pi = std::numbers::pi;
  struct Case {
    LengthKind kind;
    double mean, second, third;  ///< E[D], E[D^2], E[D^3]
  };
  const double s2 = std::log(1.25);  // deviation half the mean
  for (const Case& c :
       {Case{LengthKind::constant, 2.0, 4.0, 8.0}, Case{LengthKind::exponential, 1.0, 2.0, 6.0},
        Case{LengthKind::lognormal, 2.0, 4.0 * std::exp(s2), 8.0 * std::exp(3 * s2)}}) {
    FractureNetwork network = network_of(NetworkModel::baecher, c.kind, c.mean);
    if (c.kind == LengthKind::lognormal) network.length.deviation = 0.5 * c.mean;
    network.p21 = 2.0;
    const auto [mean, square] = moments_of(drawn(network, side), side);
    EXPECT_NEAR(mean / (0.25 * pi * c.second / c.mean), 1.0, 0.03);
    EXPECT_NEAR(square / (2.0 / 3.0 * c.third / c.mean), 1.0, 0.06);
  }
}

/// A power law of the diameters with the exponent 3 from 1 to 4: E[D^n] by its density.
TEST(NetworkModels, BaechersDiscsOfAPowerLaw) {
  FractureNetwork network = network_of(NetworkModel::baecher, LengthKind::power, 1.0);
  network.length = {LengthKind::power, {}, 0.0, 3.0, 1.0, 4.0};
  network.p21 = 2.0;
  const auto [mean, square] = moments_of(drawn(network, 100.0), 100.0);
  const double first = 1.0 - 1.0 / 4.0, second = std::log(4.0), third = 4.0 - 1.0;
  EXPECT_NEAR(mean / (0.25 * std::numbers::pi * second / first), 1.0, 0.03);
  EXPECT_NEAR(square / (2.0 / 3.0 * third / first), 1.0, 0.05);
}

/// On each line fractures and rock alternate; the part that is fracture is the persistence, and
/// lengths of fracture are exponential: E[l^2] = 2 E[l]^2.
TEST(NetworkModels, VenezianosLines) {
  const double side = 120.0, mean = 1.5;
  FractureNetwork network = network_of(NetworkModel::veneziano, LengthKind::exponential, mean);
  network.persistence = 0.7;
  network.angle = {90.0, 0.0, Spread::normal};
  network.p21 = 1.0;
  const LineWork work = drawn(network, side);
  const auto [length, square] = moments_of(work, side);
  EXPECT_NEAR(length / mean, 1.0, 0.04);
  EXPECT_NEAR(square / (2.0 * mean * mean), 1.0, 0.08);
  std::map<double, std::pair<double, int>> on_line;  // all are upright
  double whole = 0.0;
  for (const LineString& line : work.lines) {
    auto& [open, count] = on_line[std::round(line.points[0].x * 1e6)];
    open += length_of(line);
    ++count;
    whole += length_of(line);
  }
  EXPECT_NEAR(whole / (side * side), 1.0, 0.01);
  double persistence = 0.0;
  for (const auto& [x, line] : on_line) {
    persistence += line.first / side / static_cast<double>(on_line.size());
    EXPECT_GT(line.second, 20);
  }
  EXPECT_NEAR(persistence, 0.7, 0.03);
}

}  // namespace
}  // namespace edda::network_models_test
