#include "implicit/assemble.hpp"

#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"
#include "contacts/face_reading.hpp"
#include "implicit/body_forces.hpp"

namespace edda {
namespace {

/// Tolerance of the residual of a single block,
constexpr double single = 10.0;  // times that of all blocks together (root of the sum of squares)

/// Corner forces of a face as generalised forces on the block of this row and on its partner: a
/// spring of stiffness p adds p u u^T and p u w^T to the row.
struct Directions {
  BodyColumn own, other;
};

Directions on_both(const BlockSet& b, const FaceSet& c, std::size_t k, const CornerForces& f,
                   bool of_edge) {
  const BodyColumn edge = at_corner(b, c.edge[k], f.p1) + at_corner(b, c.edge_end[k], f.p2);
  const BodyColumn facing = at_corner(b, c.facing[k], f.q1) + at_corner(b, c.facing_end[k], f.q2);
  return of_edge ? Directions{edge, facing} : Directions{facing, edge};
}

/// Closed, or so near that it may well close before the list is renewed. A contact from further
/// away requires a new pattern.
bool may_carry(const FaceRow& r) {
  const double near = r.of.reach / 6.0;
  return is_closed(r) || (r.state.length > 0.0 && closure_of(r) > -near);
}

/// Whether the matrix has a place for all of `columns`, and few more than these.
bool serves(const BlockMatrix& matrix, const std::vector<std::vector<Id>>& columns) {
  if (matrix.rows() != columns.size()) return false;
  std::size_t wanted = 0;
  for (std::size_t r = 0; r < columns.size(); ++r) {
    wanted += columns[r].size();
    for (const Id c : columns[r]) {
      if (matrix.slot(static_cast<Id>(r), c) == no_id) return false;
    }
  }
  return 4 * matrix.blocks() <= 5 * wanted;
}

bool assemble_row(ImplicitSolver& s, const ImplicitScene& scene, const ImplicitSettings& settings,
                  const State& state, const Pose& pose, const FaceSet& c, Id row) {
  const BlockSet& b = scene.blocks;
  const Id i = s.block_of[row];
  const double h = settings.step;
  const Rotation r = rotation(deformation(b, state.position, i));
  const Rotation none{1.0, 0.0, 2.0, 0.5};
  BodyMatrix own = rotated(s.elastic[i], r);
  if (settings.dynamic && !scene.masses.viscosity.empty()) {
    const Deformation f = deformation(b, state.position, i);
    own += (1.0 / h) * of_body(viscous_matrix(b, scene.masses, i, f),
                               rotated(viscosity_of_modes(b, scene.masses, i), r));
  }
  if (scene.springs.block_begin[i] != scene.springs.block_begin[i + 1]) {
    own += boundary_of_body(b, scene.springs, none, i);
  }
  s.matrix.clear_row(row);
  bool known = true;
  Id partner = no_id, slot = no_id;
  c.for_faces(b.vertex_begin[i], b.vertex_begin[i + 1], [&](Id k, bool of_edge) {
    const FaceStiffness spring = springs_of(s.springs, c, scene.faces(pose), h, k);
    if (!spring.any()) return;
    const Id other = b.vertex_block[of_edge ? c.facing[k] : c.edge[k]];
    if (other != partner) {
      partner = other;
      slot = s.row_of[other] == no_id ? no_id : s.matrix.slot(row, s.row_of[other]);
    }
    known = known && (s.row_of[other] == no_id || slot != no_id);
    const Directions na = on_both(b, c, k, spring.normal_a, of_edge),
                     nb = on_both(b, c, k, spring.normal_b, of_edge),
                     sa = on_both(b, c, k, spring.along_a, of_edge),
                     sb = on_both(b, c, k, spring.along_b, of_edge);
    const auto add = [&](const Directions& u, const Directions& v, double stiffness) {
      if (stiffness == 0.0) return;
      const BodyColumn force = stiffness * u.own;
      own.noalias() += force * v.own.transpose();
      if (slot != no_id) s.matrix.at(row, slot).noalias() += force * v.other.transpose();
    };
    add(na, na, spring.normal.aa);
    add(na, nb, spring.normal.ab);
    add(nb, na, spring.normal.ab);
    add(nb, nb, spring.normal.bb);
    add(sa, sa, spring.shear_a);
    add(sb, sb, spring.shear_b);
  });
  s.stiffest[row] = own.diagonal().maxCoeff();
  s.mass[i].add_to(own, 2.0 / (h * h) + 2.0 * settings.mass_damping(scene.masses, i) / h);
  s.matrix.at(row, s.matrix.slot(row, row)) += own;
  return known;
}

}  // namespace

void set_pattern(ImplicitSolver& s, const ImplicitScene& scene, const State& state,
                 const Pose& pose, const TrialFaces& of) {
  const FaceSet& c = of.faces;
  const BlockSet& b = scene.blocks;
  const std::vector<Id> rows_before = std::move(s.block_of);
  s.row_of.assign(b.size(), no_id);
  s.block_of.clear();
  for (std::size_t i = 0; i < b.size(); ++i) {
    if (!is_free(b, state, i)) continue;
    s.row_of[i] = static_cast<Id>(s.block_of.size());
    s.block_of.push_back(static_cast<Id>(i));
  }
  std::vector<std::vector<Id>> columns(s.block_of.size());
  parallel_for(columns.size(), [&](std::size_t row) {
    const Id i = s.block_of[row];
    std::vector<Id>& list = columns[row];
    list.push_back(static_cast<Id>(row));
    c.for_faces(b.vertex_begin[i], b.vertex_begin[i + 1], [&](Id k, bool of_edge) {
      const Id other = s.row_of[b.vertex_block[of_edge ? c.facing[k] : c.edge[k]]];
      if (other != no_id && may_carry(face_row(of, b, pose, k))) list.push_back(other);
    });
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  });
  // The order of the rows, and with it the factor, remains valid if the list changes nothing here.
  if (s.block_of != rows_before || !serves(s.matrix, columns)) lay_out(s, scene, columns);
}

void lay_out(ImplicitSolver& s, const ImplicitScene& scene,
             const std::vector<std::vector<Id>>& columns) {
  const BlockSet& b = scene.blocks;
  std::vector<Eigen::Index> lines;
  for (const Id i : s.block_of) lines.push_back(components_of(b, i));
  s.matrix.set_pattern(columns, lines);
  s.linear.forget_pattern();
  s.stiffest.assign(columns.size(), 0.0);
  s.elastic.resize(b.size());
  s.mass.resize(b.size());
  parallel_for(s.block_of.size(), [&](std::size_t row) {
    const Id i = s.block_of[row];
    s.elastic[i] = of_body(elastic_matrix(b, i), stiffness_of_modes(b, i));
    s.mass[i] = body_mass(b, scene.masses, i);
  });
}

bool assemble(ImplicitSolver& s, const ImplicitScene& scene, const ImplicitSettings& settings,
              const State& state, const Pose& pose, const FaceSet& c) {
  std::vector<std::uint8_t> known(s.block_of.size());
  parallel_for(known.size(), [&](std::size_t row) {
    known[row] = assemble_row(s, scene, settings, state, pose, c, static_cast<Id>(row)) ? 1 : 0;
  });
  return std::all_of(known.begin(), known.end(), [](std::uint8_t k) { return k != 0; });
}

double measure_residual(ImplicitSolver& s, const ImplicitScene& scene,
                        const ImplicitSettings& settings, const State& state,
                        const TiledFaces& faces, const BodyVectors& forces) {
  const BlockSet& b = scene.blocks;
  s.by_faces.assign(b.size(), 0.0);
  add_sizes_of_forces(faces, b, s.by_faces);
  const double h = settings.step, balance = settings.balance;
  const double gravity = norm(scene.gravity);
  s.residual.resize(s.matrix.lines());
  s.error.assign(s.block_of.size(), 0.0);
  s.carried.resize(s.block_of.size());
  parallel_for(s.block_of.size(), [&](std::size_t row) {
    const Id i = s.block_of[row];
    const double a = settings.mass_damping(scene.masses, i);
    BodyColumn moved = (2.0 / (h * h) + 2.0 * a / h) * s.matrix.part(s.moved, row);
    if (settings.dynamic) moved -= (2.0 / h + a) * column_of(b, state.velocity, i);
    const BodyColumn force = column_of(b, forces, i), inertia = s.mass[i] * moved;
    const BodyColumn left = force + viscous_force(s, scene, settings, state, row) - inertia;
    s.matrix.part(s.residual, row) = left;
    const double carried = b.mass[i] * gravity + force.norm() + inertia.norm() + s.by_faces[i];
    const double place = norm(centroid(state.position, i)) + b.radius[i];
    const double rounding = 1e-14 * place * s.stiffest[row];
    s.error[row] = left.norm() / (single * balance * carried + rounding + 1e-300);
    s.carried[row] = carried + rounding / balance;
  });
  double squares = 0.0;
  for (const double f : s.carried) squares += f * f;
  double worst = s.residual.norm() / (balance * std::sqrt(squares) + 1e-300);
  for (const double e : s.error) {
    if (!(e <= worst)) worst = e;
    if (std::isnan(e)) return e;
  }
  return worst;
}

}  // namespace edda
