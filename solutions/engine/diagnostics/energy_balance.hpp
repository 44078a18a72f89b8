#pragma once
// The energy that a run gains or loses without a cause.
//
//   gained      T - T₀ - Σ (f·Δx + h τ·ω) - the work of motors and moving bodies - what springs had at the start
//   lost        the same with the other sign, without the springs
//   too much    a tenth of the largest of three: the kinetic energy so far, the forces times the largest size, and the
//               energy of a motion by 1e-8 of the largest size and 1e-8 rad in a step, which is too slow to be seen
//
// Δx is a body's way, so that the energy which lifts it out of an overlap counts. Springs are joints with a gap, and
// closed contacts.
//
// Velocities that are given may contradict joints. What joints without a k of their own take from them in the first
// five steps is counted apart, unless a contact, an impact, a limit or a rope may have taken it: a step leaves 1/(1 +
// 4d) of such a velocity, Eq. (3.5), and five steps with d = 1/4 a thousandth of its energy. Meanwhile the work of
// motors and springs is not known: what they seem to bring in is no gain. Joints with a k of their own store energy,
// and give it back.
#include <vector>

#include "engine/world/world.hpp"

namespace spook {

template <int Dof>
class EnergyBalance {
 public:
  /// Begins with the world as it is. Its velocities are given from outside, or else left by the step before.
  void start(const World<Dof>& world, bool velocities_are_given);

  /// Adds the step of `h` [s] that the world has just taken. `largest_size` is that of its bodies and joints [m].
  void add_step(const World<Dof>& world, double h, double largest_size);

  double gained() const { return T_ - started_ - given_ + contradicted_ - springs_; }  ///< [J]
  double lost() const { return started_ + given_ - T_ - contradicted_ - stored_; }     ///< [J]
  bool gained_too_much() const { return !may_bring_in_ && gained() > too_much_; }
  bool lost_too_much() const { return settling_ == 0 && lost() > too_much_; }

  /// The energy that joints took from given velocities which contradicted them [J]; 0 until five steps have passed.
  double contradicted() const { return contradicted_; }
  bool contradicted_too_much() const { return contradicted_ > too_much_; }

  /// Tells whether there have been rows since the start, and whether something else than joints could take energy.
  bool had_rows() const { return had_rows_; }
  bool may_dissipate() const { return may_dissipate_; }

  /// The positions after the last step, or at the start; and the number of bodies then.
  const std::vector<Vec3>& x_before() const { return x_before_; }
  std::size_t bodies() const { return x_before_.size(); }

  void state(StateStream& s) {
    s(first_, settling_, had_rows_, may_dissipate_, may_bring_in_, stopped_, T_, started_, given_, springs_,
      stored_, contradicted_, gaps_, most_, too_much_, lag_, W_before_, x_before_);
  }

 private:
  void note(const World<Dof>& world);
  void settle(const World<Dof>& world);

  static constexpr int steps_to_settle = 5;

  bool first_ = true;  // the next step is the first one
  int settling_ = 0;   // remaining steps in which joints may take given velocities
  bool had_rows_ = false;
  bool may_dissipate_ = false;
  bool may_bring_in_ = false;         // motors or springs of a stepper, whose work is not known
  bool stopped_ = false;              // while settling, something else than joints may have taken energy
  double T_ = 0;                      // kinetic energy now [J]
  double started_ = 0;                // at the start [J]
  double given_ = 0;                  // work of forces since the start [J]
  double springs_ = 0;                // energy of springs at the start [J]
  double stored_ = 0;                 // energy of joints with a k of their own now [J]
  double contradicted_ = 0;           // what joints took from velocities at the start [J]
  std::vector<double> gaps_;          // of each joint at the start: of its points, and of its angles, squared
  double most_ = 0;                   // the largest kinetic energy so far [J]
  double too_much_ = 0;               // [J]
  double lag_ = 0;                    // from velocities to positions in the last step [s]
  std::vector<Twist<Dof>> W_before_;  // velocities after the last step
  std::vector<Vec3> x_before_;        // positions after the last step
};

}  // namespace spook
