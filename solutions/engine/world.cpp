#include "engine/world.hpp"

#include <cmath>

#include "common/require.hpp"
#include "engine/rows.hpp"

namespace spook {

template <int Dof>
void World<Dof>::step(double h) {
  require_positive("h", h);
  find_contacts();
  evaluate_forces();
  build_rows(h);
  solve_rows();
  integrate(h);
}

template <int Dof>
void World<Dof>::find_contacts() {
  if (shapes_.spheres.empty()) return;
  pairs_ = spook::find_contacts(shapes_, bodies_.x, contacts_);
}

template <int Dof>
void World<Dof>::evaluate_forces() {
  forces_.resize(bodies_.size());
  for (std::size_t i = 0; i < bodies_.size(); ++i) forces_[i] = force(i);
}

template <int Dof>
void World<Dof>::build_rows(double h) {
  rows_.clear();
  if (contacts_.empty()) return;
  Motion<Dof>& motion = bodies_.motion;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    // W_f = h M⁻¹ f, the kick of a body at rest.
    motion.Wf[i].template head<3>() = kick(Vec3::Zero(), forces_[i], motion.inverse_mass[i].linear, h);
    if constexpr (Dof == 6) {
      const Vec3 omega = motion.W[i].template tail<3>();
      motion.Wf[i].template tail<3>() =
          gyroscopic_change(settings_.rotation, bodies_.orientations, i, omega, h);
      motion.inverse_mass[i].angular = bodies_.orientations.inverse_inertia(i);
    }
  }
  build_contact_rows(contacts_, spook_parameters(h, settings_.k, settings_.d), motion, rows_);
}

template <int Dof>
void World<Dof>::solve_rows() {
  sweeps_ = 0;
  if (rows_.empty()) return;
  V_.assign(bodies_.size(), Twist<Dof>::Zero());
  sweeps_ = static_cast<int>(settings_.solver(rows_, V_, settings_.stop).history.size());
}

template <int Dof>
void World<Dof>::integrate(double h) {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (bodies_.is_fixed(i)) continue;
    Twist<Dof>& W = bodies_.motion.W[i];
    // W <- W + h M⁻¹ f + V
    Vec3 v = kick(W.template head<3>(), forces_[i], bodies_.motion.inverse_mass[i].linear, h);
    if (!rows_.empty()) v += V_[i].template head<3>();
    W.template head<3>() = v;
    bodies_.x[i] = drift(bodies_.x[i], v, h);
    if constexpr (Dof == 6) {
      Vec3 omega = W.template tail<3>();
      omega += gyroscopic_change(settings_.rotation, bodies_.orientations, i, omega, h);
      if (!rows_.empty()) omega += V_[i].template tail<3>();
      rotate(settings_.rotation, bodies_.orientations, i, omega, h);
      W.template tail<3>() = omega;
    }
  }
  ++steps_;
  time_ += h;
  require_finite_bodies();
}

template <int Dof>
void World<Dof>::require_finite_bodies() const {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    // One number that is not finite makes the sum so.
    double sum = bodies_.x[i].sum() + bodies_.motion.W[i].sum();
    if constexpr (Dof == 6) sum += bodies_.orientations.q[i].coeffs().sum();
    if (!std::isfinite(sum)) throw Blowup(steps_, time_, static_cast<int>(i));
  }
}

template class World<3>;
template class World<6>;

}  // namespace spook
