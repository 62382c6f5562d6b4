#include "limit/force_program.hpp"

#include <algorithm>
#include <cmath>

namespace edda {
namespace {

constexpr std::size_t rows_per_body = 3;

int first_row(std::size_t body) {
  return static_cast<int>(rows_per_body * body);
}

}  // namespace

ForceProgram::ForceProgram(const LimitProblem& problem,
                           const std::vector<CompressionTangent>& tangents, Asks asks)
    : p_(problem), rigid_(*problem.rigid), asks_(asks) {
  find_free_directions();
  add_equilibrium_rows();
  rays_.resize(rigid_.joints.size());
  std::size_t next = 0;
  for (std::size_t k = 0; k < rigid_.joints.size(); ++k) {
    rows_.clear();
    for (; next < tangents.size() && tangents[next].joint == k; ++next) add_rows(tangents[next]);
    add_joint(k);
  }
  add_ties();
}

/// Supports take whatever force comes along them, so that equilibrium is asked across them alone:
/// of the unit vectors what is left by those that came before.
void ForceProgram::find_free_directions() {
  constexpr double independent = 1e-6;
  std::vector<std::vector<const RigidSupport*>> supports(rigid_.bodies());
  for (const RigidSupport& s : rigid_.supports) {
    if (const Id r = rigid_.body[s.block]; r != no_id) supports[r].push_back(&s);
  }
  for (std::size_t r = 0; r < rigid_.bodies(); ++r) {
    Free free{};
    double basis[2 * rows_per_body][rows_per_body];
    std::size_t known = 0, kept = 0;
    const auto take = [&](double x, double y, double turn) {
      double v[rows_per_body] = {x, y, turn};
      for (int twice = 0; twice < 2; ++twice) {
        for (std::size_t b = 0; b < known; ++b) {
          const double along = v[0] * basis[b][0] + v[1] * basis[b][1] + v[2] * basis[b][2];
          for (std::size_t q = 0; q < rows_per_body; ++q) v[q] -= along * basis[b][q];
        }
      }
      const double rest = std::hypot(v[0], v[1], v[2]);
      if (rest < independent || known == rows_per_body) return false;
      for (std::size_t q = 0; q < rows_per_body; ++q) basis[known][q] = v[q] / rest;
      ++known;
      return true;
    };
    for (const RigidSupport* s : supports[r])
      take(s->direction.x, s->direction.y,
           cross(s->place - rigid_.centroid[r], s->direction) / rigid_.extent[r]);
    for (std::size_t q = 0; q < rows_per_body; ++q) {
      if (!take(q == 0 ? 1.0 : 0.0, q == 1 ? 1.0 : 0.0, q == 2 ? 1.0 : 0.0)) continue;
      std::copy_n(basis[known - 1], rows_per_body, free.along[kept++]);
    }
    free_.push_back(free);
  }
}

/// A tension of this size (N) at each end of a joint.
void ForceProgram::add_pulls(RigidForces& sums, const RigidJoint& joint, double size) const {
  const auto add = [&](Id block, Vec2 place, Vec2 force) {
    const Id r = rigid_.body[block];
    if (r == no_id) return;
    sums[r].force += force;
    sums[r].moment += cross(place - rigid_.centroid[r], force);
  };
  for (std::size_t end = 0; end < ends_of(joint); ++end) {
    add(joint.block_b, joint.ends[end], -size * joint.n);
    add(joint.block_a, joint.ends[end], size * joint.n);
  }
}

/// Equilibrium of each body: the forces of joints and loads are minus the dead ones, among which is
/// the tension from which all joints are counted.
void ForceProgram::add_equilibrium_rows() {
  RigidForces dead = p_.dead;
  for (std::size_t k = 0; k < rigid_.joints.size(); ++k)
    add_pulls(dead, rigid_.joints[k], p_.strength[k].tension);
  for (std::size_t r = 0; r < dead.size(); ++r) {
    const double parts[rows_per_body] = {dead[r].force.x, dead[r].force.y,
                                         dead[r].moment / rigid_.extent[r]};
    for (const auto& along : free_[r].along) {
      double sum = 0.0;
      for (std::size_t q = 0; q < rows_per_body; ++q) sum += along[q] * parts[q];
      program.add_row(-sum / rigid_.weight[r], -sum / rigid_.weight[r]);
    }
  }
}

void ForceProgram::add_body_force(std::size_t body, const RigidForce& f, double in_unit) {
  const double by = in_unit / rigid_.weight[body];
  const double parts[rows_per_body] = {by * f.force.x, by * f.force.y,
                                       by * f.moment / rigid_.extent[body]};
  for (std::size_t row = 0; row < rows_per_body; ++row) {
    const double* const along = free_[body].along[row];
    const double sum = along[0] * parts[0] + along[1] * parts[1] + along[2] * parts[2];
    const double size = std::abs(along[0] * parts[0]) + std::abs(along[1] * parts[1]) +
                        std::abs(along[2] * parts[2]);
    constexpr double rounding = 1e-15;
    if (std::abs(sum) > rounding * size)
      program.add_entry(first_row(body) + static_cast<int>(row), sum);
  }
}

void ForceProgram::add_force(Id block, Vec2 place, Vec2 force, double in_unit) {
  const Id r = rigid_.body[block];
  if (r != no_id) add_body_force(r, {force, cross(place - rigid_.centroid[r], force)}, in_unit);
}

void ForceProgram::add_pair(const RigidJoint& joint, std::size_t end, Vec2 force, double in_unit) {
  add_force(joint.block_b, joint.ends[end], force, in_unit);
  add_force(joint.block_a, joint.ends[end], -force, in_unit);
}

double ForceProgram::unit_of(Id a, Id b) const {
  double least = no_bound;
  for (const Id block : {a, b}) {
    if (const Id r = rigid_.body[block]; r != no_id) least = std::min(least, rigid_.weight[r]);
  }
  return least < no_bound ? least : rigid_.force;
}

/// Unit of the rays of a joint: programs are solved in a third of the rounds where it is what the
/// joint is likely to carry, which is the weight of the heavier body where that is not much
/// heavier.
double ForceProgram::expected(const RigidJoint& joint) const {
  constexpr double much = 1e3;
  double most = 0.0;
  for (const Id block : {joint.block_a, joint.block_b}) {
    if (const Id r = rigid_.body[block]; r != no_id) most = std::max(most, rigid_.weight[r]);
  }
  return std::min(most, much * unit_of(joint.block_a, joint.block_b));
}

std::size_t ForceProgram::end_column(double from, double to, double worth, double in_unit) {
  unit.push_back(in_unit);
  return program.add_column(from, to, worth);
}

std::size_t ForceProgram::add_asked(double worth) {
  if (asks_ == Asks::multiplier) {
    for (std::size_t r = 0; r < p_.live.size(); ++r) add_body_force(r, p_.live[r], 1.0);
    return end_column(-no_bound, no_bound, worth, 1.0);
  }
  RigidForces pulls(rigid_.bodies());
  for (const RigidJoint& joint : rigid_.joints)
    add_pulls(pulls, joint, unit_of(joint.block_a, joint.block_b));
  for (std::size_t r = 0; r < pulls.size(); ++r) add_body_force(r, pulls[r], 1.0);
  for (const Widening& w : widening_) program.add_entry(w.row, -w.by);
  return end_column(-1.0, no_bound, worth, no_bound);
}

/// The two rows of a tangent: N_end - (N0/fL) N >= -N0^2/(2 fL), without the constant tension.
void ForceProgram::add_rows(const CompressionTangent& tangent) {
  const RigidStrength& s = p_.strength[tangent.joint];
  const RigidJoint& joint = rigid_.joints[tangent.joint];
  const double slope = tangent.at / s.compression, pull = s.tension;
  const double least = -0.5 * slope * tangent.at + pull - 2.0 * slope * pull;
  const double in_unit = unit_of(joint.block_a, joint.block_b);
  for (std::size_t end = 0; end < ends_of(joint); ++end)
    rows_.push_back({program.add_row(least / in_unit, no_bound), slope, end});
}

void ForceProgram::add_joint(std::size_t k) {
  const RigidJoint& joint = rigid_.joints[k];
  const RigidStrength& s = p_.strength[k];
  for (std::size_t end = 0; end < ends_of(joint); ++end) {
    add_ray(k, end, s.friction);
    if (s.friction > 0.0) add_ray(k, end, -s.friction);
  }
  add_shear(k);
}

/// What does not depend on the normal force; the constant tension takes its part of it. Where there
/// is hardly any friction, tension would not add to it: |T| <= s + m widens by itself, as
/// T = P - Q with P, Q >= 0 and P + Q = s + m.
void ForceProgram::add_shear(std::size_t k) {
  constexpr double hardly = 0.1;
  const RigidJoint& joint = rigid_.joints[k];
  const RigidStrength& s = p_.strength[k];
  const double ends = static_cast<double>(ends_of(joint));
  const double in_unit = unit_of(joint.block_a, joint.block_b);
  const double most = (s.shear - ends * s.friction * s.tension) / in_unit;
  if (asks_ == Asks::tension && s.friction < hardly) {
    const int row = program.add_row(std::max(most, 0.0), std::max(most, 0.0));
    widening_.push_back({row, ends});
    for (const double way : {1.0, -1.0}) {
      add_pair(joint, 0, way * joint.t, in_unit);
      program.add_entry(row, 1.0);
      rays_[k].push_back({end_column(0.0, no_bound, 0.0, in_unit), {0.0, 0.0}, way});
    }
  } else if (most > 0.0) {
    add_pair(joint, 0, joint.t, in_unit);
    rays_[k].push_back({end_column(-most, most, 0.0, in_unit), {0.0, 0.0}, 1.0});
  }
}

void ForceProgram::add_ray(std::size_t k, std::size_t end, double shear) {
  const RigidJoint& joint = rigid_.joints[k];
  const double in_unit = expected(joint);
  add_pair(joint, end, joint.n + shear * joint.t, in_unit);
  const double in_rows = in_unit / unit_of(joint.block_a, joint.block_b);
  for (const TangentRow& r : rows_)
    program.add_entry(r.row, in_rows * ((r.end == end ? 1.0 : 0.0) - r.slope));
  const double cost = p_.thrust_cost * in_unit / rigid_.force;
  rays_[k].push_back({end_column(0.0, no_bound, -cost, in_unit),
                      {end == 0 ? 1.0 : 0.0, end == 1 ? 1.0 : 0.0},
                      shear});
}

void ForceProgram::add_ties() {
  const auto bound = [](double force, double in_unit) {
    return std::abs(force) < no_bound ? force / in_unit : force;
  };
  const auto unit_at = [&](std::size_t q) {
    return q == RigidGrout::no_tie ? 0.0 : unit_of(rigid_.ties[q].block_a, rigid_.ties[q].block_b);
  };
  // Rows of the bonds before and behind each tie, and the units in which they count.
  struct Bond {
    int row = -1;
    double in_unit = 1.0;
  };
  std::vector<Bond> behind(rigid_.ties.size()), ahead(rigid_.ties.size());
  for (const RigidGrout& g : rigid_.grout) {
    const double larger = std::max(unit_at(g.before), unit_at(g.after));
    const double in_unit = larger > 0.0 ? larger : rigid_.force;
    const double most = bound(g.strength, in_unit);
    const Bond bond{program.add_row(-most, most), in_unit};
    if (g.after != RigidGrout::no_tie) behind[g.after] = bond;
    if (g.before != RigidGrout::no_tie) ahead[g.before] = bond;
  }
  first_tie_ = program.columns();
  for (std::size_t q = 0; q < rigid_.ties.size(); ++q) {
    const RigidTie& tie = rigid_.ties[q];
    const double in_unit = unit_at(q);
    add_force(tie.block_a, tie.place_a, tie.direction, in_unit);
    add_force(tie.block_b, tie.place_b, -tie.direction, in_unit);
    if (behind[q].row >= 0) program.add_entry(behind[q].row, in_unit / behind[q].in_unit);
    if (ahead[q].row >= 0) program.add_entry(ahead[q].row, -in_unit / ahead[q].in_unit);
    end_column(bound(tie.least, in_unit), bound(tie.most, in_unit), 0.0, in_unit);
  }
}

std::vector<RigidJointForce> ForceProgram::forces(const std::vector<double>& value) const {
  std::vector<RigidJointForce> all(rigid_.joints.size());
  for (std::size_t k = 0; k < all.size(); ++k) {
    RigidJointForce& f = all[k];
    const RigidJoint& joint = rigid_.joints[k];
    const double asked =
        asks_ == Asks::tension ? value.back() * unit_of(joint.block_a, joint.block_b) : 0.0;
    for (std::size_t end = 0; end < ends_of(joint); ++end)
      f.normal[end] = -p_.strength[k].tension - asked;
    for (const Ray& ray : rays_[k]) {
      const double size = unit[ray.column] * value[ray.column];
      for (std::size_t end = 0; end < 2; ++end) f.normal[end] += ray.normal[end] * size;
      f.shear += ray.shear * size;
    }
  }
  return all;
}

double ForceProgram::thrust(const std::vector<double>& value) const {
  double sum = 0.0;
  for (const std::vector<Ray>& rays : rays_) {
    for (const Ray& ray : rays)
      sum += (ray.normal[0] + ray.normal[1]) * unit[ray.column] * value[ray.column];
  }
  return p_.thrust_cost * sum / rigid_.force;
}

std::vector<double> ForceProgram::ties(const std::vector<double>& value) const {
  std::vector<double> all;
  for (std::size_t q = 0; q < rigid_.ties.size(); ++q)
    all.push_back(unit[first_tie_ + q] * value[first_tie_ + q]);
  return all;
}

std::vector<RigidMotion> ForceProgram::motion(const std::vector<double>& price, double sign) const {
  std::vector<RigidMotion> all(rigid_.bodies());
  for (std::size_t r = 0; r < all.size(); ++r) {
    double v[rows_per_body] = {};
    for (std::size_t row = 0; row < rows_per_body; ++row) {
      const double y = sign * price[rows_per_body * r + row] / rigid_.weight[r];
      for (std::size_t q = 0; q < rows_per_body; ++q) v[q] += y * free_[r].along[row][q];
    }
    all[r] = {{v[0], v[1]}, v[2] / rigid_.extent[r]};
  }
  return all;
}

}  // namespace edda
