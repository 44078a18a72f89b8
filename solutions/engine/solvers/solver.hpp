#pragma once
// What a solver is: a function from a step's system of rows to what it did about it.
//
//   System   rows, what they are about, and when to stop: all that any solver may want to look at
//   Solver   brings λ to S λ = B within its bounds, and V to M⁻¹ Gᵀ λ
//
// A solver may take another one to solve with (engine/solvers/registry.hpp): it is handed a system and hands it on.
#include <functional>
#include <memory>

#include "engine/bodies/bodies.hpp"
#include "engine/constraints/contact_rows.hpp"
#include "engine/constraints/joints.hpp"
#include "engine/constraints/warm_start_cache.hpp"
#include "engine/solvers/solver_result.hpp"

namespace spook {

/// One step's. The λ of the rows, their bounds of friction where those follow what presses, and V are the solver's to
/// change; all else is to be looked at.
template <int Dof>
struct SolverInput {
  std::vector<Row<Dof>>& rows;  ///< of the joints, then of the contacts; λ where to begin
  std::vector<Twist<Dof>>& V;   ///< velocity change of each body by these λ
  /// Contacts whose friction follows the normal impulse, in the order of their rows.
  const std::vector<FrictionContact>& rubbing;
  const std::vector<Joint>& joints;      ///< with k and d
  const std::vector<Contact>& contacts;  ///< each with as many rows as the others
  std::size_t first_contact_row;
  const Bodies<Dof>& bodies;   ///< where they are, and the motion that the rows were made of
  const WarmStartCache& last;  ///< impulses of the last step, if the solver wants them
  Vec3 gravity;                ///< [m/s²]
  double h;                    ///< [s]
  StopRule stop;
  int threads = 1;  ///< that a solver may use; its result does not depend on it
};

/// May keep what helps it in the next step. A copy has a state of its own: copies of a world share nothing.
template <int Dof>
struct Solver {
  std::function<SolverResult(const SolverInput<Dof>& system)> solve;
  /// The friction model that it solves: it decides the limits of friction rows, and what the residual is.
  FrictionModel friction = FrictionModel::box;
  bool wants_last = false;  ///< it looks at SolverInput::last
};

/// A cache of a solver: a copy of the solver begins without it.
template <class T>
class ScratchCache {
 public:
  ScratchCache() = default;
  ScratchCache(const ScratchCache&) {}
  ScratchCache(ScratchCache&&) noexcept = default;
  ScratchCache& operator=(const ScratchCache&) = delete;
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
