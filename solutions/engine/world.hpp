#pragma once
// The world: bodies, and the step that moves them.
//
//   find contacts -> build rows -> solve -> integrate
//
//   contacts    at x_n, where gap <= 0                                             Eq. (3.1)
//   rows        S λ = B, with W = v_{n-1/2} and the forces at x_n                  Eq. (3.7), (4.4)
//   solve       λ and V = M⁻¹ Gᵀ λ                                                 Eq. (4.6), (4.7)
//   integrate   W += h M⁻¹ f + V, then x += h v and q turns by h ω                 Eq. (1.3), (1.4), (2.4)-(2.11)
//
// Each stage calls the functions of the chapters. One for which there is nothing to do returns at once: no shapes, no
// search; no contacts, no rows and no solve; point masses, nothing that turns.
#include <cstdint>
#include <vector>

#include "engine/blowup.hpp"
#include "engine/bodies.hpp"
#include "engine/contacts.hpp"
#include "engine/solvers.hpp"

namespace spook {

template <int Dof>
struct Settings {
  Vec3 gravity = Vec3(0, 0, -9.81);  ///< [m/s²]
  ForceField force = nullptr;        ///< on each body, beside its weight [N]; none unless given
  double k = 1e6;                    ///< stiffness of a contact [N/m]
  double d = 3;                      ///< relaxation of a contact [steps]
  Solver<Dof> solver = &solve<Dof>;  ///< any of solvers<Dof>()
  [[no_unique_address]] RotationRule<Dof> rotation = {};  ///< rigid bodies only: how they turn
  StopRule stop = {};                                     ///< when the solver stops
};

/// What the last step did.
struct StepReport {
  int pairs = 0;  ///< pairs of shapes that were looked at
  int contacts = 0;
  int rows = 0;
  int sweeps = 0;
  double residual = 0;  ///< how far λ is from a solution [m/s], Eq. (4.8); 0 when there are no rows
};

template <int Dof>
class World {
 public:
  /// Throws std::invalid_argument unless gravity is finite, k > 0, d >= 0, and the solver and its stop rule are sound.
  explicit World(Settings<Dof> settings);

  /// Adds a body and returns its index; see Bodies::add for what is refused.
  int add(const Body<Dof>& body);

  /// Adds a body that nothing moves, with a sphere of that radius [m], or none for 0.
  int add_fixed(const Vec3& x, double radius = 0);

  /// Adds the half-space n·x < offset as a fixed body. Throws std::invalid_argument unless |n| = 1.
  int add_plane(const Vec3& n, double offset);

  /// Takes every velocity half a step back, to where leapfrog wants it: Eq. (1.5). Once, before the first step.
  void start_half_step_back(double h);

  /// Moves the world on by `h` [s]. Throws std::invalid_argument unless h is positive and finite, and Blowup when a
  /// body is not finite afterwards.
  void step(double h);

  const Bodies<Dof>& bodies() const { return bodies_; }
  std::int64_t steps() const { return steps_; }  ///< taken so far
  double time() const { return time_; }          ///< their sum [s]

  /// Where a body's numbers are in bodies(). Throws std::invalid_argument for an index that is no body's.
  std::size_t index(int body) const;

  const Vec3& x(int body) const { return bodies_.x[index(body)]; }                     ///< [m]
  Vec3 v(int body) const { return bodies_.motion.W[index(body)].template head<3>(); }  ///< [m/s]

  /// The velocity at the time of the position, from one that is half a step of `h` behind [m/s].
  Vec3 v_beside_x(int body, double h) const;

  /// The contacts of the last step, and the impulse of each [N s].
  const std::vector<Contact>& contacts() const { return contacts_; }
  double lambda(int contact) const;

  /// What the last step did. The residual is computed here, not in the step.
  StepReport report() const;

 private:
  void find_contacts();
  void build_rows(double h);
  void solve_rows();
  void integrate(double h);

  void evaluate_forces();
  Vec3 force(std::size_t i) const;
  void require_finite_bodies() const;

  Settings<Dof> settings_;
  Bodies<Dof> bodies_;
  Shapes shapes_;
  std::vector<Vec3> forces_;       // on each body at x_n [N]
  std::vector<Contact> contacts_;  // of the last step
  std::vector<Row<Dof>> rows_;     // row c belongs to contact c
  std::vector<Twist<Dof>> V_;      // what the rows add to each velocity
  std::int64_t steps_ = 0;
  double time_ = 0;
  int pairs_ = 0;
  int sweeps_ = 0;
};

/// Orientation, and angular velocity in world coordinates [rad/s], of a rigid body.
inline const Quat& orientation(const World<6>& world, int body) {
  return world.bodies().orientations.q[world.index(body)];
}
inline Vec3 angular_velocity(const World<6>& world, int body) {
  return world.bodies().motion.W[world.index(body)].tail<3>();
}

}  // namespace spook
