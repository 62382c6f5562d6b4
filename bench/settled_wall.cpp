#include "settled_wall.hpp"
#include "step/changes.hpp"
#include "step/step.hpp"
#include "step/tile_step.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <unordered_map>

#include "blocks/kinematics.hpp"
#include "contacts/face_reading.hpp"
#include "contacts/tile_trials.hpp"
#include "step/contact_search.hpp"
#include "step/faces_now.hpp"
#include "wall.hpp"

namespace edda {
namespace {

/// Of a brick: by how far its centroid has gone, m, its deformation, and what its corners, in their
/// order, deviate from that, m.
struct Placed {
  double ux, uy, xx, xy, yx, yy;
  Vec2 bent[8];
};

/// Elastic slip of a face at its two ends, m.
struct Touch {
  double slip_a, slip_b;
};

/// A brick by where it was drawn, in quarters of a brick from the left, and rows from below; the
/// base block is in row -1.
struct Place {
  int quarter = 0, row = -1;
  bool is_brick() const { return row >= 0; }
};

Place place_of(const BlockSet& b, std::size_t i) {
  if (b.fixed[i]) return {};
  return {static_cast<int>(std::lround(4.0 * (b.centroid_x[i] + b.origin.x))),
          static_cast<int>(std::floor(2.0 * (b.centroid_y[i] + b.origin.y)))};
}

/// Corner of its brick, 0 to 3 counter-clockwise from the lower left.
int corner_of(const BlockSet& b, std::size_t v) {
  const std::size_t i = b.vertex_block[v];
  const bool right = b.vertex_x[v] > b.centroid_x[i], above = b.vertex_y[v] > b.centroid_y[i];
  return above ? (right ? 2 : 3) : (right ? 1 : 0);
}

std::uint64_t key_of(Place p) {
  return static_cast<std::uint64_t>(p.row + 1) << 32 | static_cast<std::uint32_t>(p.quarter);
}

/// The bricks on either side of a face; the base comes second.
struct Sides {
  Place first, second;
  int corner_of_first, corner_of_second;
};
Sides sides_of(const BlockSet& b, const FaceSet& c, std::size_t k) {
  const Place e = place_of(b, block_of_edge(b, c, k)), f = place_of(b, block_of_facing(b, c, k));
  const int of_e = corner_of(b, c.edge[k]), of_f = corner_of(b, c.facing[k]);
  return e.is_brick() ? Sides{e, f, of_e, of_f} : Sides{f, e, of_f, of_e};
}

/// Of a face by where its other side lies from the first, so that it is found again wherever the
/// brick is put. The base lies beneath all.
std::uint64_t key_of(const Sides& s, Place from) {
  const Place i = s.first, j = s.second;
  const int aside = j.is_brick() ? j.quarter - i.quarter + 8 : 0, up = j.row - i.row + 1;
  const int corners = 4 * s.corner_of_first + s.corner_of_second;
  return key_of(from) << 12 | static_cast<std::uint64_t>((aside * 3 + up) * 16 + corners);
}

/// The state of a wall at rest.
struct Equilibrium {
  int columns = 0;
  std::unordered_map<std::uint64_t, Placed> bricks;
  std::unordered_map<std::uint64_t, Touch> touches;
};

bool between_neighbours(const Sides& s) {
  const Place i = s.first, j = s.second;
  return i.is_brick() && std::abs(j.row - i.row) <= 1 &&
         (!j.is_brick() || std::abs(j.quarter - i.quarter) <= 8);
}

Equilibrium rest_of(Simulation& s, int columns) {
  const BlockSet& b = s.scene->blocks;
  const FaceSet& c = s.motion.contacts;
  Equilibrium rest;
  rest.columns = columns;
  for (std::size_t i = 0; i < b.size(); ++i) {
    const Place place = place_of(b, i);
    if (!place.is_brick()) continue;
    const Deformation f = deformation(b, s.motion.state.position, i);
    const Vec2 u = centroid(s.motion.state.position, i) - Vec2{b.centroid_x[i], b.centroid_y[i]};
    Placed placed{u.x, u.y, f.xx, f.xy, f.yx, f.yy, {}};
    const BlockModes modes = b.modes(i);
    for (std::size_t at = 0; modes.count > 0 && at < std::min<std::size_t>(modes.corners, 8); ++at)
      placed.bent[at] = modes.at(s.motion.state.position.modes, at);
    rest.bricks[key_of(place)] = placed;
  }
  for (std::size_t k = 0; k < c.size(); ++k) {
    const Sides sides = sides_of(b, c, k);
    if (!between_neighbours(sides) || !is_closed_now(s, k)) continue;
    const FaceFields face = face_row(s, k).state;
    rest.touches[key_of(sides, sides.first)] = {face.slip_a, face.slip_b};
  }
  return rest;
}

/// The brick of the short wall that stands for one of the long wall; `drifts`: with what it has
/// gone sideways.
struct Source {
  Place place;
  bool drifts;
};

Source stands_for(Place p, int short_columns, int columns) {
  const int half = 2 * short_columns, right = 4 * (columns - short_columns);
  if (p.quarter <= half) return {p, true};
  if (p.quarter >= right + half) return {{p.quarter - right, p.row}, true};
  // Whole bricks all of them: those of every other row lie half a brick aside.
  const int middle = half + ((p.quarter - half) % 4 + 4) % 4;
  return {{middle, p.row}, false};
}

/// The amplitudes of the modes of brick i at which its corners deviate so.
void bend(Simulation& s, const Placed& p, std::size_t i) {
  const BlockModes modes = s.scene->blocks.modes(i);
  if (modes.count == 0) return;
  Eigen::MatrixXd shape(modes.corners, modes.count), bent(modes.corners, 2);
  for (std::size_t at = 0; at < modes.corners; ++at) {
    const auto row = static_cast<Eigen::Index>(at);
    const Vec2 by = at < 8 ? p.bent[at] : Vec2{};
    bent.row(row) << by.x, by.y;
    for (std::size_t a = 0; a < modes.count; ++a)
      shape(row, static_cast<Eigen::Index>(a)) = modes.of(a, at);
  }
  const Eigen::MatrixXd q = shape.householderQr().solve(bent);
  for (std::size_t a = 0; a < modes.count; ++a) {
    const auto row = static_cast<Eigen::Index>(a);
    s.motion.state.position.modes.set(modes[a], {q(row, 0), q(row, 1)});
  }
}

void put(Simulation& s, const Equilibrium& rest, int columns) {
  const BlockSet& b = s.scene->blocks;
  for (std::size_t i = 0; i < b.size(); ++i) {
    const Place place = place_of(b, i);
    if (!place.is_brick()) continue;
    const Source from = stands_for(place, rest.columns, columns);
    const Placed& p = rest.bricks.at(key_of(from.place));
    const Vec2 c{b.centroid_x[i], b.centroid_y[i]};
    for (std::size_t k = 0; k < 3; ++k) {
      const double ax = b.node_x[k][i] - c.x, ay = b.node_y[k][i] - c.y;
      s.motion.state.position.x[k][i] = c.x + (from.drifts ? p.ux : 0.0) + p.xx * ax + p.xy * ay;
      s.motion.state.position.y[k][i] = c.y + p.uy + p.yx * ax + p.yy * ay;
    }
    bend(s, p, i);
    place_vertices(b, s.motion.state.position, i, s.motion.pose.x, s.motion.pose.y);
  }
  s.motion.pose.x1 = s.motion.pose.x;
  s.motion.pose.y1 = s.motion.pose.y;
}

/// As at the start of a run, and then what the faces of the short wall remember.
void touch(Simulation& s, const Equilibrium& rest, int columns) {
  const BlockSet& b = s.scene->blocks;
  put_faces(s, take_faces(s));  // where the blocks are
  reevaluate_at_n(s, 1.0);
  end_at_rest(s.motion.contacts, s.motion.tiled.tiles, b, s.motion.pose);
  FaceStates states = take_faces(s);
  const FaceSet& c = s.motion.contacts;
  for (std::size_t k = 0; k < c.size(); ++k) {
    const Sides sides = sides_of(b, c, k);
    if (!between_neighbours(sides)) continue;
    const Source from = stands_for(sides.first, rest.columns, columns);
    const auto found = rest.touches.find(key_of(sides, from.place));
    if (found == rest.touches.end()) continue;
    states.before[k].slip_a = found->second.slip_a;
    states.before[k].slip_b = found->second.slip_b;
  }
  put_faces(s, states);
}

/// So many steps under `damping`, with the step that it allows.
void damp(Simulation& s, const Damping& damping, long steps) {
  change_damping(s, damping, true);
  fit_step_to(s, 1000.0);
  take_steps(s, steps);
}

/// So many times the period of its slowest wave, damped where it is stiff, and so that this wave
/// does not swing, either.
void settle(Simulation& s, int rows, double periods) {
  const double height = 0.5 * rows, speed = std::sqrt(20e9 / 2600.0), period = 4.0 * height / speed;
  Damping damping;
  damping.local = 0.8;
  damping.mass = 2.0 * speed / height;
  damp(s, damping, std::lround(periods * period / (0.7 * s.motion.state.step)));
}

/// A wall as drawn, with what another at rest can lend it.
Simulation saved_bond(int columns, int rows, const Equilibrium& rest) {
  Simulation s = built_wall(columns, rows);
  put(s, rest, columns);
  touch(s, rest, columns);
  start(s, 1000.0);
  return s;
}

template <class Map>
void write_map(std::ofstream& out, const Map& map) {
  const std::uint64_t n = map.size();
  out.write(reinterpret_cast<const char*>(&n), sizeof n);
  for (const auto& entry : map) {
    out.write(reinterpret_cast<const char*>(&entry.first), sizeof entry.first);
    out.write(reinterpret_cast<const char*>(&entry.second), sizeof entry.second);
  }
}

template <class Map>
bool read_map(std::ifstream& in, Map& map) {
  std::uint64_t n = 0;
  in.read(reinterpret_cast<char*>(&n), sizeof n);
  for (std::uint64_t i = 0; in && i < n; ++i) {
    std::uint64_t key = 0;
    typename Map::mapped_type value{};
    in.read(reinterpret_cast<char*>(&key), sizeof key);
    in.read(reinterpret_cast<char*>(&value), sizeof value);
    map[key] = value;
  }
  return static_cast<bool>(in);
}

/// Begins a file: another model, or another way to its rest, does not fit.
std::string title_of(int columns, int rows) {
  const bool corners =
      deformation_of_scenes.value_or(Model{}.deformation) == BlockDeformation::corners;
  return std::string("at rest, 4") + (corners ? " corners" : "") + wall_model(columns, rows);
}

bool read_rest(const std::filesystem::path& path, const std::string& title, Equilibrium& rest) {
  std::ifstream in(path, std::ios::binary);
  std::string begins(title.size(), ' ');
  in.read(begins.data(), static_cast<std::streamsize>(begins.size()));
  return in && begins == title && read_map(in, rest.bricks) && read_map(in, rest.touches);
}

void write_rest(const std::filesystem::path& path, const std::string& title,
                const Equilibrium& rest) {
  std::filesystem::create_directories(path.parent_path());
  const std::filesystem::path beside = path.string() + ".part";
  std::ofstream out(beside, std::ios::binary);
  out << title;
  write_map(out, rest.bricks);
  write_map(out, rest.touches);
  out.close();
  if (out) std::filesystem::rename(beside, path);
}

/// Ends feel each other up to about two heights away, in a hundredth of what they are off by.
int short_columns(int rows) {
  return std::max(4 * rows + 7, 20);
}

/// The same where a millionth counts: at the top of the wall sides press on each other with next to
/// nothing.
int long_columns(int rows) {
  return std::max(12 * rows + 7, 60);
}

/// Settles the wall, or reads what it came to when it did before.
Equilibrium rest_from(int columns, int rows, const std::string& cache) {
  const std::string name = "wall-" + std::to_string(columns) + "x" + std::to_string(rows) + ".rest";
  const std::filesystem::path path = std::filesystem::path(cache) / name;
  Equilibrium rest;
  rest.columns = columns;
  if (!cache.empty() && read_rest(path, title_of(columns, rows), rest)) return rest;
  const bool as_drawn = columns <= short_columns(rows);
  Simulation s = as_drawn ? wall(columns, rows)
                          : saved_bond(columns, rows, rest_from(short_columns(rows), rows, cache));
  settle(s, rows, as_drawn ? 12.0 : 4.0);
  rest = rest_of(s, columns);
  if (!cache.empty()) write_rest(path, title_of(columns, rows), rest);
  return rest;
}

}  // namespace

Simulation settled_wall(int columns, int rows, const std::string& cache) {
  Simulation s =
      saved_bond(columns, rows, rest_from(std::min(columns, long_columns(rows)), rows, cache));
  // What friction and the joins between ends and middle are still off by.
  Damping damping;
  damping.local = 0.8;
  damp(s, damping, 200);
  damp(s, {}, 50);
  return s;
}

double error_of_row_forces(const Simulation& s) {
  const BlockSet& b = s.scene->blocks;
  const FaceSet& c = s.motion.contacts;
  std::map<int, double, std::greater<>> weight;  // by row, from above
  std::map<int, double> force;                   // of the joint beneath the row
  for (std::size_t i = 0; i < b.size(); ++i) {
    if (!b.fixed[i]) weight[place_of(b, i).row] += b.mass[i] * -s.scene->model.gravity.y;
  }
  for (std::size_t k = 0; k < c.size(); ++k) {
    const Sides sides = sides_of(b, c, k);
    const int i = sides.first.row, j = sides.second.row;
    if (i != j) force[std::max(i, j)] += normal_force(face_row(s, k));
  }
  double above = 0.0, error = 0.0;
  for (const auto& [row, of_row] : weight) {
    above += of_row;
    error = std::max(error, std::abs(force[row] - above));
  }
  return error / above;
}

}  // namespace edda
