#pragma once
// Detects unreliable runs.
//
//   sound      no fault was detected
//   unsolved   the solver's error in a step is more than a hundredth of the right-hand side: constraint forces, and all
//              results that depend on them, are wrong by some per cent
//   lost       the motion is not that of the problem:
//                - the gap of a joint exceeds the joint's size, in addition to the spring's sag under its load
//                - contacts are too deep in ten steps in a row, and recover at less than half of SPOOK's rate; a thin,
//                  fast body may be deep for a moment
//                - constraints, or the steps themselves, added too much energy, or bodies without constraints lost as
//                  much: energy_balance.hpp
//                - steps are too long for a force by a formula, and bodies gain energy: long_steps.hpp
//   a note     each of these, when it is first found:
//                - springs sag by more than a hundredth of a size in ten steps in a row, longer than an impact takes: k
//                  is too small for this load
//                - a body moves through another, or into it, by more than the sizes of both in one step: tunnelling.hpp
//                - a body of points passes through another body: passing_points.hpp
//                - bodies overlap by more than the thickness of one when their contact is found, and did not before
//                - joints removed more energy than may be added, and nothing else in the world removes energy
//                - given velocities contradict joints, which took that much energy at the start
//                - nothing can move
//
//   solver's error    from the residual, Eq. (4.8), and its rate of convergence: engine/solvers/solver_result.hpp. 0 if
//                     the residual is round-off of the largest velocities so far: errors of a body at rest are not
//                     seen. Only the part that moves bodies counts, and not how redundant rows share an impulse
//   soft steps        are unsolved if this error moves bodies by more than a hundredth of the smallest size in a step
//   right-hand side   the largest of |B| and of the velocity changes h f/m; for a stepper, whose rows are unknown, of
//                     the speeds, too
//   SPOOK's rate      an overlap shrinks by the part a h = 4/(1 + 4 d) in a step, Eq. (3.4)
//
// A check costs about as much as a sweep. Runs for timing omit the check.
#include <cstdint>
#include <string>
#include <vector>

#include "engine/diagnostics/energy_balance.hpp"
#include "engine/diagnostics/long_steps.hpp"
#include "engine/world/world.hpp"

namespace spook {

enum class State { sound, unsolved, lost };

/// Returns "sound", "unsolved" or "lost".
std::string name_of(State state);

/// The worst state so far, its first step, and its reason.
struct Verdict {
  State state = State::sound;
  std::int64_t step = 0;  ///< first step in that state; 0: none
  double time = 0;        ///< at the end of that step [s]
  std::string reason;
  std::int64_t unsolved = 0;  ///< number of unsolved steps
  std::string note;  ///< what a reader should know of a sound run, too, separated by "; "; empty if nothing
};

template <int Dof>
class RunCheck {
 public:
  /// Notes where bodies are and how they move before a step, if no earlier check has: before the first step, and after
  /// bodies were moved. Then that step is checked, too. Without this call the checks begin with the step after it.
  void begin_step(const World<Dof>& world);

  /// Checks the step of `h` [s] that the world has just taken. Call it once after each step. The energy balance starts
  /// anew after a step without a check, and after begin_again.
  void look(const World<Dof>& world, double h);

  /// Sets the verdict to sound, and starts the energy balance anew.
  void begin_again() { *this = {}; }

  /// Tells the check that bodies were moved from outside. The energy balance starts anew at the next check; the verdict
  /// stays.
  void bodies_were_moved() { moved_ = true; }

  const Verdict& verdict() const { return verdict_; }

  void state(StateStream& s) {
    s(verdict_.state, verdict_.step, verdict_.time, verdict_.reason, verdict_.unsolved, verdict_.note);
    s(noted_, last_step_, moved_, deep_steps_, deepest_, overlap_, sagging_steps_, sag_, sagged_, fastest_);
    energy_.state(s);
    long_steps_.state(s);
  }

 private:
  bool has_same_bodies(const World<Dof>& world) const;
  void start(const World<Dof>& world, bool velocities_are_given);
  void find_sizes(const World<Dof>& world);
  void note_step(const World<Dof>& world);

  struct Overlap {
    double share = 0;                  ///< over the smaller size of the two bodies
    const Contact* contact = nullptr;  ///< null: none
  };
  Overlap largest_overlap(const World<Dof>& world) const;

  void look_at_solve(const World<Dof>& world, double h);
  void look_at_soft_solve(const World<Dof>& world, double residual, double asked, double h);
  void look_at_gaps(const World<Dof>& world, double h);
  void look_at_energy(const World<Dof>& world, double h);
  void look_at_motion(const World<Dof>& world, double h);
  void look_at_joints(const World<Dof>& world, double h);
  bool is_first_sag(double sag, double size) const;
  void note_sag(const std::string& what, double sag, double size, const std::string& remedy);
  enum class Note { sag, tunnelling, points, late, joints, contradiction, nothing_moves };
  bool has(Note kind) const { return (noted_ >> static_cast<unsigned>(kind) & 1u) != 0; }
  void note(Note kind, const std::string& what);
  void find(State state, const World<Dof>& world, const std::string& reason);

  Verdict verdict_;
  unsigned noted_ = 0;  // a bit for each kind of note
  std::int64_t last_step_ = -1, removals_ = 0;
  bool moved_ = false;  // bodies were moved from outside since the last check
  EnergyBalance<Dof> energy_;
  LongSteps long_steps_;
  int deep_steps_ = 0;         // consecutive steps with too deep contacts that do not recover
  double deepest_ = 0;         // the largest overlap over its size in the last step
  double overlap_ = infinity;  // the largest overlap of a contact over a size in the last step
  int sagging_steps_ = 0;      // consecutive steps with too much sag
  std::string sag_;            // the sagging spring of the last step; empty if none
  double sagged_ = 0;          // its sag over its size
  double fastest_ = 0;         // the largest products of a row with velocities so far, for round-off [m/s]
  std::vector<Shape> shapes_;  // of bodies
  std::vector<double> sizes_;  // of bodies [m]
};

}  // namespace spook
