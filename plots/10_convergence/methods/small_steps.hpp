#pragma once
// Substeps of one sweep by two methods of games, on a line of bodies.
//
//   XPBD      each row once, from zero, at predicted positions: M. Macklin, M. Müller, N. Chentanez, XPBD:
//             position-based simulation of compliant constrained dynamics, Motion in Games 2016; M. Macklin and others, Small
//             steps in physics simulation, SCA 2019
//   relaxed   each row once, warm; and again without its gap after bodies have moved: E. Catto, Solver2D, 2024
//
// XPBD moves by Δx = M⁻¹ Gᵀ λ h with λ h = -C/(G M⁻¹ Gᵀ + 1/(k h²)), C the gap at x + h (v + h f/m): to first order
// C = g + h G (W + W_f + V). Divided by h that is Eq. (4.6) with a = 1/h, b = 1 and Σ = 1/(h² k). SPOOK has this a and this Σ at
// d = 3/4, and b = 4d/(1 + 4d) = 3/4. So XPBD is a sweep from λ = 0 of rows with d = 3/4 and B less by G W/4; its Jacobians are
// those of the predicted positions, which are the same on a line. (With its damping γ it is d = 3/4 + γ, and b = 1 still.)
#include "engine/world/world.hpp"

namespace spook::plots {

/// Point masses in a line; body 0 is static. Each is connected to the one before: by a link if it hangs below, or by a
/// contact of spheres if it lies above.
struct Chain {
  static constexpr double g = 9.81, k = 1e8, d = 3, link = 0.1;  ///< [m/s², N/m, steps, m]

  bool hangs;
  std::vector<double> mass;  ///< of bodies 1, 2 ...

  World<3> world(Settings<3> settings) const {
    settings.gravity = Vec3(0, 0, -g);
    settings.k = k;
    if (!settings.d) settings.d = d;
    settings.contact_margin = link / 2;  // keeps contacts that open by less than this
    World<3> world(std::move(settings));
    if (hangs)
      world.add_fixed(Vec3::Zero());
    else
      world.add_plane(Vec3::UnitZ(), link / 2);
    for (const double each : mass) {
      const int last = static_cast<int>(world.bodies().size()) - 1;
      const double z = (hangs ? -link : link) * (last + 1);
      const int next = world.add({.x = Vec3(0, 0, z), .mass = each, .radius = hangs ? 0 : link / 2});
      if (hangs) world.add_joint({.i = last, .j = next, .length = link});
    }
    return world;
  }

  double gap(const World<3>& world, int n) const {
    const double below = n == 1 ? 0 : world.x(n - 1).z(), z = world.x(n).z();
    return (hangs ? below - z : z - below) - link;
  }

  /// Returns a gap at rest, from its load.
  double right(int n) const {
    double load = 0;
    for (std::size_t above = static_cast<std::size_t>(n) - 1; above < mass.size(); ++above)
      load += mass[above] * g;
    return (hangs ? load : -load) / k;
  }
};

/// Converts rows of d = 3/4 without friction to XPBD's rows.
Solver<3> xpbd();

/// XPBD with positions, as published, on a chain: heights and velocities along the chain.
class Positions {
 public:
  explicit Positions(const Chain& chain);

  void step(double h);
  double z(int body) const { return z_[static_cast<std::size_t>(body)]; }

 private:
  Chain chain_;
  std::vector<double> z_, v_;
};

/// A chain with relaxed substeps.
class Relaxed {
 public:
  explicit Relaxed(const Chain& chain);
  Relaxed(const Relaxed&) = delete;
  Relaxed& operator=(const Relaxed&) = delete;

  void step(double h);
  const World<3>& world() const { return world_; }

 private:
  std::size_t joints_;
  WarmStartCache impulses_;
  World<3> world_;
};

}  // namespace spook::plots
