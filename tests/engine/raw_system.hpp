#pragma once
// Rows that belong to no world, as a solver gets them.
#include <cmath>
#include <random>

#include "engine/solvers/registry.hpp"

namespace spook {

/// Bodies of given masses and rows between them, with random velocities, Jacobians and gaps.
template <int Dof>
class RandomSystem {
 public:
  Motion<Dof> motion;
  std::vector<Row<Dof>> rows;
  std::vector<Twist<Dof>> V;

 protected:
  static constexpr double h = 1.0 / 60;

  explicit RandomSystem(unsigned seed) : random_(seed) {}

  double uniform() { return std::uniform_real_distribution<double>(-1, 1)(random_); }
  /// Draws one of the numbers 0 to n - 1.
  int index(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)); }

  void add_body(const InverseMass<Dof>& inverse) {
    motion.inverse_mass.push_back(inverse);
    motion.W.push_back(twist());
    motion.Wf.push_back(h * twist());
  }

  /// Adds bodies of masses from e⁻³ to e³, the first of which are static, and sets V to any velocities.
  void add_light_and_heavy(int bodies, int fixed) {
    for (int b = 0; b < bodies; ++b) {
      InverseMass<Dof> inverse{};
      if (b >= fixed) {
        inverse.linear = std::exp(3 * uniform());
        if constexpr (Dof == 6) inverse.angular = 6 * inverse.linear * Mat3::Identity();
      }
      add_body(inverse);
    }
    V.assign(motion.W.size(), Twist<Dof>::Constant(7));
  }

  void add_row(int i, int j, const SpookParameters& spook, double lo, double hi) {
    const Twist<Dof> Gi = twist(), Gj = twist();
    const double gap = 0.01 * uniform();
    rows.push_back(make_row<Dof>(
        {.i = i, .j = j, .Gi = Gi, .Gj = Gj, .gap = gap, .spook = spook, .lo = lo, .hi = hi}, motion));
  }

 private:
  Twist<Dof> twist() {
    Twist<Dof> any;
    for (double& component : any) component = uniform();
    return any;
  }

  std::mt19937 random_;
};

/// Returns the largest |Δλ| of two results, over the largest |λ| of the second.
template <int Dof>
double difference(const std::vector<Row<Dof>>& some, const std::vector<Row<Dof>>& others) {
  double most = 0, largest = 0;
  for (std::size_t k = 0; k < some.size(); ++k) {
    most = std::max(most, std::abs(some[k].lambda - others[k].lambda));
    largest = std::max(largest, std::abs(others[k].lambda));
  }
  return most / largest;
}

template <int Dof>
SolverResult solve_by(const Solver<Dof>& solver, const Motion<Dof>& motion, std::vector<Row<Dof>>& rows,
                      std::vector<Twist<Dof>>& V, const StopRule& stop = {},
                      const std::vector<FrictionContact>& friction = {}) {
  Bodies<Dof> bodies;
  bodies.motion = motion;
  const WarmStartCache none;
  ConstraintSet<Dof> constraints{.rows = rows, .first_contact_row = rows.size(), .friction = friction};
  const SolverResult result = solver.solve({.constraints = constraints,
                                            .V = V,
                                            .joints = {},
                                            .contacts = {},
                                            .bodies = bodies,
                                            .last = none,
                                            .gravity = Vec3::Zero(),
                                            .h = 1,
                                            .stop = stop});
  rows = constraints.rows;
  return result;
}

}  // namespace spook
