#include "observe/wave_sources.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/spectrum.hpp"
#include "step/labels.hpp"

namespace edda {
namespace {

constexpr std::size_t most_rays = 5;

double dominant_of(const std::vector<double>& time, const std::vector<double>& value) {
  std::vector<Vec2> plane;
  plane.reserve(value.size());
  for (const double v : value) plane.push_back({v, 0.0});
  return dominant_frequency(time, plane);
}

/// Of a history that swings for some cycles its own frequency, of a pulse that of its rise and
/// fall, of one that only rises 0.
double frequency_of(const TimeHistory& h) {
  if (h.time.size() < 3) return 0.0;
  constexpr double cycles = 3.0;
  const double own = dominant_of(h.time, h.value);
  if (own * (h.time.back() - h.time.front()) >= cycles) return own;
  std::vector<double> middle, rate;
  for (std::size_t k = 1; k < h.time.size(); ++k) {
    middle.push_back(0.5 * (h.time[k - 1] + h.time[k]));
    rate.push_back((h.value[k] - h.value[k - 1]) / (h.time[k] - h.time[k - 1]));
  }
  const auto [low, high] = std::minmax_element(rate.begin(), rate.end());
  return *low * *high < 0.0 ? dominant_of(middle, rate) : 0.0;
}

WaveCurve curve_of(const TimeHistory& h) {
  return {frequency_of(h), h.time, h.value};
}

/// The component of a record in which it moves most, and its direction.
WaveCurve curve_of(const Shaking& q, Vec2& direction) {
  if (q.acceleration.file.empty()) {
    direction = unit(q.acceleration.direction);
    return {q.acceleration.frequency.value_or(0.0), {}, {}};
  }
  double of_x = 0.0, of_y = 0.0;
  for (const Vec2 a : q.record.acceleration) {
    of_x += a.x * a.x;
    of_y += a.y * a.y;
  }
  direction = of_x >= of_y ? Vec2{1.0, 0.0} : Vec2{0.0, 1.0};
  WaveCurve curve{dominant_frequency(q.record.time, q.record.acceleration), q.record.time, {}};
  for (const Vec2 a : q.record.acceleration) curve.value.push_back(dot(a, direction));
  return curve;
}

/// Upright lines from below the free blocks, that is, from what the ground moves.
std::vector<WaveRay> upright(const Simulation& sim, Vec2 motion) {
  const BlockSet& b = sim.scene->blocks;
  double left = std::numeric_limits<double>::infinity(), right = -left, low = left;
  for (std::size_t v = 0; v < b.vertex_count(); ++v) {
    if (b.fixed[b.vertex_block[v]] != 0) continue;
    left = std::min(left, b.vertex_x[v]);
    right = std::max(right, b.vertex_x[v]);
    low = std::min(low, b.vertex_y[v]);
  }
  std::vector<WaveRay> rays;
  for (std::size_t k = 0; k < most_rays; ++k) {
    // Not through the corners of regular blocks.
    const double part = (static_cast<double>(k) + 0.5137) / static_cast<double>(most_rays);
    rays.push_back({{left + part * (right - left), low - 1e-6 * (right - left)}, {0, 1}, motion});
  }
  return rays;
}

/// Some of the rays, evenly.
std::vector<WaveRay> some_of(const std::vector<WaveRay>& all) {
  if (all.size() <= most_rays) return all;
  std::vector<WaveRay> some;
  for (std::size_t k = 0; k < most_rays; ++k) {
    some.push_back(all[(2 * k + 1) * all.size() / (2 * most_rays)]);
  }
  return some;
}

std::vector<WaveRay> through_dashpots(const Simulation& sim, Index boundary, Vec2 motion) {
  const BlockSet& b = sim.scene->blocks;
  std::vector<WaveRay> rays;
  for (const Dashpot& d : sim.attached.dashpots.points) {
    if (d.boundary != boundary) continue;
    Vec2 at;
    for (std::size_t k = 0; k < nodes_per_block; ++k) {
      at += d.weight[k] * Vec2{b.node_x[k][d.block], b.node_y[k][d.block]};
    }
    rays.push_back({at, -1.0 * d.normal, motion});
  }
  return some_of(rays);
}

/// Into the block from the middle of an edge.
WaveRay into_block(const BlockSet& b, Id edge, double part, Vec2 motion) {
  const Vec2 p = b.vertex(edge), q = b.vertex(b.next[edge]);
  return {p + part * (q - p), -1.0 * outward_normal(unit(q - p)), motion};
}

/// From where a load acts; `row` as EdgeLoad::load.
std::vector<WaveRay> from_load(const Simulation& sim, Index row) {
  const BlockSet& b = sim.scene->blocks;
  std::vector<WaveRay> rays;
  for (const EdgeLoad& e : sim.attached.loads.edges) {
    if (e.load != row) continue;
    WaveRay ray = into_block(b, e.edge, 0.5 * (e.from + e.to), {});
    const Vec2 force = e.traction + e.pressure * ray.along;
    if (!(dot(force, force) > 0.0)) continue;
    ray.motion = unit(force);
    rays.push_back(ray);
  }
  for (const PointLoad& p : sim.attached.loads.points) {
    if (p.load != row || !(dot(p.force, p.force) > 0.0)) continue;
    const std::size_t i = p.at.block;
    const Vec2 at = weighted(p.at.nodes, b.node_x, b.node_y, i);
    const Vec2 to_centre = Vec2{b.centroid_x[i], b.centroid_y[i]} - at;
    const Vec2 along = unit(p.force);
    rays.push_back({at, dot(to_centre, along) < 0.0 ? -1.0 * along : along, along});
  }
  return some_of(rays);
}

std::vector<WaveRay> from_boundary(const Simulation& sim, Index boundary, Vec2 motion) {
  const BlockSet& b = sim.scene->blocks;
  const BoundarySprings& s = sim.attached.springs;
  std::vector<std::uint8_t> on(b.vertex_count(), 0);
  for (std::size_t q = 0; q < s.size(); ++q) {
    if (s.boundary[q] == boundary) on[s.vertex[q]] = 1;
  }
  std::vector<WaveRay> rays;
  for (Id v = 0; v < b.vertex_count(); ++v) {
    if (on[v] != 0 && on[b.next[v]] != 0) rays.push_back(into_block(b, v, 0.4137, motion));
  }
  return some_of(rays);
}

WaveOrigin origin_of(const Simulation& sim, std::size_t row, const Shaking& q) {
  Vec2 motion;
  WaveCurve curve = curve_of(q, motion);
  const bool enters = q.apply == ShakingKind::upgoing;
  return {row_label("shaking", q.name, row), q.name,
          enters ? WaveSource::incoming : WaveSource::motion, std::move(curve),
          enters ? through_dashpots(sim, q.enters, motion) : upright(sim, motion)};
}

WaveOrigin origin_of(const Simulation& sim, std::size_t row, const Boundary& q) {
  const auto index = static_cast<Index>(row);
  const bool moves = q.velocity || q.displacement;
  const auto loads = static_cast<Index>(sim.scene->model.loads.size());
  return {row_label("boundary", q.name, row), q.name,
          moves ? WaveSource::motion : WaveSource::force, curve_of(q.factor),
          moves ? from_boundary(sim, index, unit(q.velocity ? *q.velocity : *q.displacement))
                : from_load(sim, loads + index)};
}

}  // namespace

std::vector<WaveOrigin> wave_origins(const Simulation& sim) {
  const Model& m = sim.scene->model;
  std::vector<WaveOrigin> origins;
  for (std::size_t q = 0; q < m.shakings.size(); ++q)
    origins.push_back(origin_of(sim, q, m.shakings[q]));
  for (std::size_t q = 0; q < m.loads.size(); ++q) {
    origins.push_back({row_label("load", m.loads[q].name, q), m.loads[q].name, WaveSource::force,
                       curve_of(m.loads[q].factor), from_load(sim, static_cast<Index>(q))});
  }
  for (std::size_t q = 0; q < m.boundaries.size(); ++q)
    origins.push_back(origin_of(sim, q, m.boundaries[q]));
  std::erase_if(origins, [](const WaveOrigin& o) { return !(o.curve.frequency > 0.0); });
  return origins;
}

WaveSignal signal_on(const WaveCurve& curve, double longest, double travel_time) {
  constexpr double pi2 = 6.283185307179586, cycles = 20.0, fewest_cycles = 3.0, per_cycle = 24.0;
  constexpr std::size_t fewest = 1U << 10U, most = 1U << 14U;
  const bool sine = curve.time.empty();
  const double begin = sine ? 0.0 : curve.time.front();
  const double lasts = !sine ? curve.time.back() - begin
                             : std::max(longest > 0.0 ? longest : cycles / curve.frequency,
                                        fewest_cycles / curve.frequency + 2.0 * travel_time);
  const double window = 2.0 * (lasts + 4.0 * travel_time);
  const double points =
      sine ? lasts * curve.frequency * per_cycle : 2.0 * static_cast<double>(curve.time.size());
  std::size_t count = fewest;
  while (count < most && static_cast<double>(count) < points * window / lasts) count *= 2;
  WaveSignal signal{std::vector<double>(count, 0.0), window / static_cast<double>(count),
                    sine ? lasts : window, curve.frequency};
  std::size_t k = 1;
  for (std::size_t q = 0; q < count; ++q) {
    const double t = signal.interval * static_cast<double>(q);
    if (t > lasts) break;
    if (sine) {
      signal.value[q] = std::sin(pi2 * curve.frequency * t);
      continue;
    }
    while (k + 1 < curve.time.size() && curve.time[k] - begin < t) ++k;
    const double part = (begin + t - curve.time[k - 1]) / (curve.time[k] - curve.time[k - 1]);
    signal.value[q] = curve.value[k - 1] + part * (curve.value[k] - curve.value[k - 1]);
  }
  return signal;
}

}  // namespace edda
