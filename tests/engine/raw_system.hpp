#pragma once
// Rows that belong to no world, as a solver gets them.
#include "engine/solvers/registry.hpp"

namespace spook {

template <int Dof>
SolverResult solve_by(const Solver<Dof>& solver, const Motion<Dof>& motion, std::vector<Row<Dof>>& rows,
                      std::vector<Twist<Dof>>& V, const StopRule& stop = {},
                      const std::vector<FrictionContact>& rubbing = {}) {
  Bodies<Dof> bodies;
  bodies.motion = motion;
  const WarmStartCache none;
  return solver.solve({.rows = rows,
                       .V = V,
                       .rubbing = rubbing,
                       .joints = {},
                       .contacts = {},
                       .first_contact_row = rows.size(),
                       .bodies = bodies,
                       .last = none,
                       .gravity = Vec3::Zero(),
                       .h = 1,
                       .stop = stop});
}

}  // namespace spook
