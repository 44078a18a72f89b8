#pragma once
// Rows that belong to no world, as a solver is handed them.
#include "engine/solvers.hpp"

namespace spook {

template <int Dof>
Outcome solve_by(const Solver<Dof>& solver, std::vector<Row<Dof>>& rows, std::vector<Twist<Dof>>& V,
                 const StopRule& stop = {}, const std::vector<Rubbing>& rubbing = {}) {
  const Bodies<Dof> no_bodies;
  const StartImpulses none;
  return solver.solve({.rows = rows,
                       .V = V,
                       .rubbing = rubbing,
                       .joints = {},
                       .contacts = {},
                       .first_contact_row = rows.size(),
                       .bodies = no_bodies,
                       .last = none,
                       .gravity = Vec3::Zero(),
                       .h = 1,
                       .stop = stop});
}

}  // namespace spook
