#pragma once
// Rows that belong to no world, as a solver gets them.
#include "engine/solvers/registry.hpp"

namespace spook {

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
