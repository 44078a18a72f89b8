#pragma once
// Detects unreliable runs.
//
//   sound      it is, as far as can be seen
//   unsolved   what the solver left of a step is more than a hundredth of what the step asked for: forces of constraints
//              are wrong by some per cent, and what follows from them is
//   lost       what happened has no cause in the problem:
//                a joint is off by more than its own size, beyond what its spring gives under its load; or contacts are, in
//                  ten steps in a row: what is thin and fast may be so for a moment
//                constraints, or the steps themselves, brought in energy: more than a tenth of the largest kinetic energy
//                  so far, and of what it takes to lift every body by a size
//   a note     springs give by more than a hundredth of a size, in ten steps in a row: k is too soft for this load, whoever
//              chose it; an impact is over before
//
//   what was left   of the residual, Eq. (4.8), and the rate at which it fell: engine/solvers/solver_result.hpp
//   asked for       the largest of |B| and of the kicks h f/m
//   energy          T - T₀ - Σ h (f·v + τ·ω), of what constraints and impacts did; ½ k gap² of the first step is theirs to give,
//                   and the work of motors
//
// A look costs about as much as a sweep; a run that is only timed takes none.
#include <cstdint>
#include <string>
#include <vector>

#include "engine/world/world.hpp"

namespace spook {

enum class State { sound, unsolved, lost };

/// "sound", "unsolved", "lost".
std::string name_of(State state);

/// The worst so far, when that began, and why.
struct Verdict {
  State state = State::sound;
  std::int64_t step = 0;  ///< the first that was so; 0: none
  double time = 0;        ///< at its end [s]
  std::string reason;
  std::int64_t unsolved = 0;  ///< how many steps were not solved
  std::string note;           ///< what else there is to say, of the first spring that gives too much
};

template <int Dof>
class RunCheck {
 public:
  /// Looks at the step of `h` [s] that the world has just taken, once. Without a look between two steps, or after
  /// begin_again, the account of energy begins anew.
  void look(const World<Dof>& world, double h);

  /// Forgets everything: the account of energy begins anew, and the verdict is sound.
  void begin_again() { *this = {}; }

  /// Bodies were moved from outside since the last look: the account of energy begins anew with the next one. The verdict
  /// stays.
  void bodies_were_moved() { moved_ = true; }

  const Verdict& verdict() const { return verdict_; }

 private:
  void look_at_solve(const World<Dof>& world, double h);
  void look_at_gaps(const World<Dof>& world, double h);
  void look_at_energy(const World<Dof>& world, double h, double T);
  void look_at_joints(const World<Dof>& world, double h);
  void note_sag(const std::string& what, double sag, double size, double k);
  void find(State state, const World<Dof>& world, const std::string& reason);

  Verdict verdict_;
  std::int64_t last_step_ = -1;
  bool first_ = true;               // of the account of energy
  bool moved_ = false;              // from outside, since the last look
  bool had_rows_ = false;           // since the account began
  int deep_steps_ = 0;              // steps in a row in which contacts were too deep
  int sagging_steps_ = 0;           // steps in a row in which a spring gave too much
  std::string sag_;                 // what did so in the last step; empty if nothing
  double started_ = 0;              // with that kinetic energy [J]
  double given_ = 0;                // by forces since then, and by springs that were tight [J]
  double most_ = 0;                 // the largest kinetic energy so far [J]
  std::vector<Twist<Dof>> before_;  // velocities at the last look
  std::vector<Vec3> x_before_;      // positions, where there are joints
  std::vector<double> sizes_;       // of bodies [m]
};

}  // namespace spook
