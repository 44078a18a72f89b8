#pragma once
// A step in two halves, with a solver of the engine between them: step_rows of chapter 09 makes impacts and rows, any
// solver of chapters 04 to 14 finds the impulses, and finish_step moves the bodies.
#include <vector>

#include "09_better_friction/better_friction.hpp"
#include "engine/world/world.hpp"
#include "scenes/method.hpp"

namespace spook {

/// Tells whether any joint is one of chapter 13, whose rows no chapter's step makes.
bool has_mechanisms(const std::vector<Joint>& joints);

template <int Dof>
class SolverBetween {
 public:
  /// The solver is make_solver(method), with a warm start if the method has one.
  explicit SolverBetween(const Method& method)
      : solver_(make_solver<Dof>(method)), warm_start_(method.warm_start) {}

  /// Makes a step of `h` [s]: moves the bodies of `simulation`, and sets the motion of `bodies` for the solver. Returns
  /// the solver's report. Throws std::invalid_argument if a student's step_rows has left out rows.
  SolveReport step(const World<Dof>& world, const std::vector<Contact>& contacts, double h,
                   Simulation& simulation, Bodies<Dof>& bodies);

 private:
  void set_friction_bounds(ConstraintSet<Dof>& constraints) const;

  Solver<Dof> solver_;
  bool warm_start_;
  WarmStartCache last_;
};

}  // namespace spook
