#pragma once
// Steps that are too long for a force given by a formula. Leapfrog is unstable if h ω > 2: chapter 01.
//
//   (h ω)² = -h² Δf·Δx/(m |Δx|²)     of the forces at two successive positions, summed over bodies
#include <cmath>
#include <vector>

#include "engine/bodies/conserved_quantities.hpp"
#include "engine/world/world.hpp"

namespace spook {

class LongSteps {
 public:
  /// Looks at the step of `h` [s] that the world has just taken from positions `x`. Without a formula,
  /// `Settings::force`, it costs nothing.
  template <int Dof>
  void look(const World<Dof>& world, const std::vector<Vec3>& x, double h) {
    const Settings<Dof>& settings = world.settings();
    if (!settings.force || settings.stepper || settings.integrator_order == 4) return;
    if (world.parts() > 1) {  // their forces and positions between are not known
      *this = {};
      return;
    }
    const Bodies<Dof>& bodies = world.bodies();
    double pull = 0, inertia = 0;
    for (std::size_t i = 0; i < f_before_.size(); ++i) {
      if (bodies.is_fixed(i)) continue;
      const Vec3 way = x[i] - x_before_[i];
      pull -= h * h * way.dot(world.forces()[i] - f_before_[i]);
      inertia += bodies.mass[i] * way.squaredNorm();
    }
    f_before_ = world.forces();
    x_before_ = x;
    steps_ = pull > 4 * inertia ? steps_ + 1 : 0;
    const double T = kinetic_energy(bodies);
    if (steps_ == 1) T_before_ = T;
    grows_ = T > least_growth * T_before_;
    too_long_ = std::sqrt(pull / inertia) / 2;
  }

  /// Tells whether h ω exceeded 2 in ten steps in a row, in which bodies gained kinetic energy.
  bool are_unstable() const { return steps_ >= least_steps && grows_; }

  /// The last step over the longest stable one.
  double too_long() const { return too_long_; }

  void state(StateStream& s) { s(steps_, T_before_, f_before_, x_before_); }

 private:
  static constexpr int least_steps = 10;
  static constexpr double least_growth = 1.1;

  int steps_ = 0;                          // consecutive steps with h ω > 2
  double T_before_ = 0;                    // kinetic energy after the first of them [J]
  std::vector<Vec3> f_before_, x_before_;  // of the step before [N, m]
  bool grows_ = false;
  double too_long_ = 0;
};

}  // namespace spook
