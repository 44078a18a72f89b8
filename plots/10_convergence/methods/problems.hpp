#pragma once
// The rows of one step of several scenes, and their exact solution.
#include <cmath>

#include "engine/linear/velocity_system.hpp"
#include "engine/solvers/registry.hpp"

namespace spook::plots {

/// The rows of a step, as input of a solver.
template <int Dof>
struct Problem {
  std::vector<spook::Row<Dof>> rows;
  std::vector<FrictionContact> friction;
  Bodies<Dof> bodies;
  std::vector<Twist<Dof>> answer;  ///< exact velocities

  struct Solved {
    SolverResult result;
    std::vector<spook::Row<Dof>> rows;
    std::vector<Twist<Dof>> V;
  };
  Solved solve(const Solver<Dof>& solver, const StopRule& stop) const {
    Solved all{SolveReport{}, {}, std::vector<Twist<Dof>>(bodies.size(), Twist<Dof>::Zero())};
    ConstraintSet<Dof> constraints{.rows = rows, .first_contact_row = rows.size(), .friction = friction};
    const WarmStartCache none;
    all.result = solver.solve({.constraints = constraints,
                               .V = all.V,
                               .joints = {},
                               .contacts = {},
                               .bodies = bodies,
                               .last = none,
                               .gravity = Vec3::Zero(),
                               .h = 1.0 / 60,
                               .stop = stop});
    all.rows = std::move(constraints.rows);
    return all;
  }
  double energy(const std::vector<Twist<Dof>>& V) const {
    double sum = 0;
    for (std::size_t b = 0; b < V.size(); ++b)
      if (is_dynamic(bodies.motion.inverse_mass[b]))
        sum += V[b].dot(mass_of(bodies.motion.inverse_mass[b]) * V[b]);
    return sum;
  }
  double error(std::vector<Twist<Dof>> V) const {
    for (std::size_t b = 0; b < V.size(); ++b) V[b] -= answer[b];
    return std::sqrt(energy(V) / energy(answer));
  }
};

/// The problems: a stack of spheres, the top one of that mass [kg]; a wire of 20 links with 1000 kg at its end; and
/// boxes with friction, namely a tower of 20 cubes, a wall of 60 bricks, a block that slides and spins on four
/// contacts, and a pile of 60 cubes that have fallen into a box.
Problem<3> stack(double top);
Problem<3> wire();
Problem<6> tower(FrictionModel model);
Problem<6> wall(FrictionModel model);
Problem<6> block();
Problem<6> pile();

}  // namespace spook::plots
