#include "step/energy_balance.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>

#include "base/parallel.hpp"
#include "contacts/face_energy.hpp"
#include "forces/bending_forces.hpp"
#include "step/simulation.hpp"

namespace edda {
namespace {

double block_gravity_energy(const BlockSet& b, const State& s, double h, Vec2 gravity,
                            std::size_t i) {
  const Vec2 half_back = 0.5 * h * centroid(s.velocity, i);
  const Vec2 moved = centroid(s.position, i) - half_back - Vec2{b.centroid_x[i], b.centroid_y[i]};
  return -b.mass[i] * dot(gravity, moved);
}

}  // namespace

double rounding_energy(const BlockSet& b, const FaceSet& c, Vec2 gravity) {
  double size = 0.0, stiffness = 0.0, mass = 0.0;
  for (const double x : b.vertex_x) size = std::max(size, std::abs(x));
  for (const double y : b.vertex_y) size = std::max(size, std::abs(y));
  for (std::size_t i = 0; i < b.size(); ++i) {
    mass += b.mass[i];
    stiffness =
        std::max(stiffness, (b.lame_lambda[i] + 2.0 * b.lame_mu[i]) * b.volume[i] / b.area[i]);
  }
  for (std::size_t k = 0; k < c.size(); ++k) {
    const double shorter = std::min(b.edge_length[c.edge[k]], b.edge_length[c.facing[k]]);
    stiffness = std::max(stiffness, 0.5 * c.stiffness[k] * shorter);
  }
  const double stretch = 1e4 * std::numeric_limits<double>::epsilon() * size;
  return 0.5 * static_cast<double>(b.size()) * stiffness * stretch * stretch +
         mass * norm(gravity) * stretch;
}

EnergyBalance energy_balance(const Simulation& sim) {
  return energy_balance(sim, measure_faces(sim));
}

EnergyBalance energy_balance(const Simulation& sim, const FaceMeasures& faces) {
  const BlockSet& b = sim.scene->blocks;
  const State& s = sim.motion.state;
  const FaceSet& c = sim.motion.contacts;
  const Bolts& bolts = sim.attached.bolts;
  const PointSet& points = sim.point_contacts;
  const Accounts& accounts = sim.accounts;
  // Time by which positions go back: 0 where velocities belong to the same instant as positions
  // (and pose.x1 = pose.x).
  const double behind = 2.0 * sim.stepper->velocity_lag * sim.control.step_before;
  const auto over_free = [&](auto&& term) {
    return ordered_sum(b.size(), [&](std::size_t i) { return is_free(b, s, i) ? term(i) : 0.0; });
  };
  const auto over_faces = [&](double FaceWork::*taken) {
    return ordered_sum(c.size(), [&](std::size_t k) { return faces.work[k].*taken; });
  };
  const auto in_faces = [&](std::size_t k) { return faces.energy[k]; };
  const std::vector<double>& damped = accounts.damping_work.joules;
  EnergyBalance l;
  l.kinetic =
      over_free([&](std::size_t i) { return kinetic_energy(sim.motion.masses, b, s.velocity, i); });
  l.strain = over_free([&](std::size_t i) { return stored_energy(b, s, rock_of(sim), behind, i); });
  l.gravity = over_free([&](std::size_t i) {
    return block_gravity_energy(b, s, behind, sim.scene->model.gravity, i);
  });
  l.contact =
      ordered_sum(c.size(), in_faces) + boundary_energy(sim.attached.springs, sim.motion.pose);
  l.friction = c.removed_friction + over_faces(&FaceWork::friction);
  l.fracture = c.removed_fracture + over_faces(&FaceWork::fracture);
  l.damping = c.removed_damping + over_faces(&FaceWork::damping) +
              over_faces(&FaceWork::damping_due) +
              ordered_sum(damped.size(), [&](std::size_t i) { return damped[i]; }) +
              damped_in_zones(sim.motion.zones);
  l.transfer = c.removed_transfer + over_faces(&FaceWork::transfer);
  l.step_change = -accounts.step_change_energy;
  l.external = accounts.external_work + work_of_pores(sim.motion.zones);
  l.contact += bolt_energy(bolts) + points.energy;
  l.friction += bolts.slipped + points.friction + dissipated_in_zones(sim.motion.zones);
  l.fracture += bolts.fractured;
  return l;
}

double energy_scale(const Simulation& sim, const EnergyBalance& l) {
  return std::max(
      {sim.accounts.largest_energy, l.scale(),
       rounding_energy(sim.scene->blocks, sim.motion.contacts, sim.scene->model.gravity)});
}

EnergyBalance account_energy(Simulation& sim) {
  return account_energy(sim, measure_faces(sim));
}

EnergyBalance account_energy(Simulation& sim, const FaceMeasures& faces) {
  Accounts& accounts = sim.accounts;
  EnergyBalance l = energy_balance(sim, faces);
  if (!accounts.start_energy) accounts.start_energy = l.balance();
  accounts.largest_energy = energy_scale(sim, l);
  l.error = (l.balance() - *accounts.start_energy) / accounts.largest_energy;
  return l;
}

double total_energy(const Simulation& sim) {
  return energy_balance(sim).balance();
}

AsExternalWork::AsExternalWork(Simulation& sim)
    : sim_(sim), energy_(total_energy(sim)), thrown_(std::uncaught_exceptions()) {}

AsExternalWork::~AsExternalWork() noexcept(false) {
  if (std::uncaught_exceptions() == thrown_) end();
}

void AsExternalWork::end() {
  if (!ended_) sim_.accounts.external_work += total_energy(sim_) - energy_;
  ended_ = true;
}

}  // namespace edda
