#pragma once
// The signature of a solver: a function from the rows of a step to a result.
//
//   SolverInput    rows, the joints and contacts of the rows, and the stop rule
//   Solver         solves S λ = B within bounds, with V = M⁻¹ Gᵀ λ
//
// A solver may call an inner solver with a changed input: engine/solvers/registry.hpp.
#include <functional>
#include <memory>

#include "engine/bodies/bodies.hpp"
#include "engine/constraints/constraint_set.hpp"
#include "engine/constraints/contact_rows.hpp"
#include "engine/constraints/joints.hpp"
#include "engine/constraints/warm_start_cache.hpp"
#include "engine/solvers/solver_result.hpp"

namespace spook {

/// The input of a solver in one step. A solver changes the λ of the rows, V, and, in friction models other than the
/// box, the bounds of friction rows. It only reads all other members.
template <int Dof>
struct SolverInput {
  ConstraintSet<Dof>& constraints;   ///< the rows of `joints` and `contacts`; λ is the initial guess
  std::vector<Twist<Dof>>& V;        ///< velocity change of each body by the initial λ
  const std::vector<Joint>& joints;  ///< with k and d
  const std::vector<Contact>& contacts;
  const Bodies<Dof>& bodies;   ///< current positions, and the motion from which the rows were built
  const WarmStartCache& last;  ///< impulses of the last step, if wants_last is set
  Vec3 gravity;                ///< [m/s²]
  double h;                    ///< [s]
  StopRule stop;
  int threads = 1;  ///< worker threads; the result is the same for any number

  std::vector<Row<Dof>>& rows() const { return constraints.rows; }
};

/// A solver, which may keep caches for the next step. A copy has its own state: copies of a world share nothing.
template <int Dof>
struct Solver {
  using Function = std::function<SolverResult(const SolverInput<Dof>& system)>;

  Function solve;
  /// The friction model of the solver, which defines the limits of friction rows, and the residual.
  FrictionModel friction = FrictionModel::box;
  bool wants_last = false;  ///< the solver reads SolverInput::last
  /// Writes or reads the numbers on which `solve` bases its next results; caches are left out. Default: there are none.
  void (*state_of_solve)(Function& solve, StateStream& s) = nullptr;

  void state(StateStream& s) {
    if (state_of_solve) state_of_solve(solve, s);
  }
};

/// The `state_of_solve` of a solver whose `solve` is a Method, which has a member state(s).
template <int Dof, class Method>
void state_of_method(typename Solver<Dof>::Function& solve, StateStream& s) {
  if (Method* method = solve.template target<Method>()) method->state(s);
}

/// A cache of a solver; a copy of the solver starts with an empty cache, and so does a solver that another is assigned
/// to.
template <class T>
class ScratchCache {
 public:
  ScratchCache() = default;
  ScratchCache(const ScratchCache&) {}
  ScratchCache(ScratchCache&&) noexcept = default;
  ScratchCache& operator=(const ScratchCache&) {
    kept_.reset();
    return *this;
  }
  ScratchCache& operator=(ScratchCache&&) noexcept = default;
  ~ScratchCache() = default;

  T& operator*() {
    if (!kept_) kept_ = std::make_unique<T>();
    return *kept_;
  }

 private:
  std::unique_ptr<T> kept_;
};

}  // namespace spook
