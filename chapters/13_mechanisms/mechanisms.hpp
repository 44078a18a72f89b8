#pragma once
// Chapter 13 · Mechanisms: hinges, sliders, welds, their limits and motors
//
// A joint holds some relative coordinates of two bodies at zero, by rows whose impulse may have either sign. It leaves
// the other coordinates free; limits and motors are rows on a free coordinate. On each body the joint has a frame: a
// point p and axes P = q c. The third axis lies along the hinge or the slider.
//
//   orientation of j's frame in i's  Q = P_i* P_j = (w, v)                                    Eq. (13.1)
//   rate of Q                        dQ/dt = ½ u Q,  u = P_i* (ω_j - ω_i) P_i                 Eq. (13.2)
//   relative angles                  g_k = 2 v_k                                              Eq. (13.3)
//   rows of the angles               G = (0, -a_k, 0, a_k),  a_k = P_i (w e_k + v × e_k) P_i*  Eq. (13.4)
//   shift along n, fixed to i        g = n·d,  d = p_j - p_i                                  Eq. (13.5)    notes (21)
//   row of the shift                 G = (-n, -(r_i + d)×n, n, r_j×n)                         Eq. (13.6)    notes (22)
//   angle of a hinge                 θ = 2 atan2(v_3, w), within half a turn of the last one  Eq. (13.8), (13.9)
//   limit                            g = min(s - lower, upper - s),  λ >= 0                   Eq. (13.10), (13.11)
//   motor                            B = w - G W - G W_f,  a = 0, b = 1, |λ| <= h T           Eq. (13.12), (13.13)
//
//   c   axes of the joint in a body's own axes, a quaternion; of a motor its viscosity [N m s/rad, N s/m]
//   w   scalar part of Q; of a motor the target speed [rad/s, m/s]
//   d   shift p_j - p_i [m], not SPOOK's relaxation
//   e_k unit vectors          s   angle [rad] or shift [m]          T   largest torque or force of a motor [N m, N]
//
// Differs from the notes: the second term of their (22) is kept. This term moves i's lever arm to j's point. It is
// linear in ω, so the Jacobian contains no velocities.
#include <array>

#include "06_distance/distance.hpp"

namespace spook {

/// The frame of a joint on a body: its point, and its axes.
struct JointFrame {
  Attachment at;
  Quat axes;  ///< joint to world, P = q c
};

/// Relative coordinate of two bodies, and its rate of change: ds/dt = Gi·W_i + Gj·W_j.
struct Coordinate {
  int i, j;
  Twist<6> Gi, Gj;
  double value;  ///< an angle [rad] or a length [m]
};

/// Exercise 13.1. Angles of j's frame in i's frame, about each axis of the joint: Eq. (13.1)-(13.4). All three are zero
/// where the two frames have the same orientation. A hinge holds the first two at zero; a slider and a weld hold all
/// three.
std::array<Coordinate, 3> turned_apart(const JointFrame& i, const JointFrame& j);

/// Exercise 13.2. Shift of j's point from i's along axis 0, 1 or 2 of the joint's frame on i: Eq. (13.5), (13.6). A
/// slider holds the first two shifts at zero.
Coordinate shift_along(const JointFrame& i, const JointFrame& j, int axis);

/// Exercise 13.3. The angle of a hinge, full turns included: Eq. (13.8), (13.9). `last` is an earlier angle [rad], from
/// which the hinge has turned by less than half a turn.
Coordinate hinge_angle(const JointFrame& i, const JointFrame& j, double last);

/// The range of a hinge or slider. Either end may be infinite. The engine refuses lower = upper: to lock a joint, use a
/// weld.
struct JointLimits {
  double lower = -infinity;  ///< [rad] or [m]
  double upper = infinity;
};

/// Exercise 13.4. The row of the limit with the smaller gap, λ >= 0 [N m s or N s]: Eq. (13.10), (13.11). At any
/// gap b = 1, so that the row removes the whole speed towards the limit, and Σ is that of `spook`. For g > 0, a is 1/h:
/// the row allows motion up to the limit within one step of `h` [s]. For g <= 0, a is that of `spook`.
Constraint<6> limit_constraint(const Coordinate& free, const JointLimits& limits, const SpookParameters& spook,
                               double h);

/// A motor of a joint: a torque about the hinge, or a force along the slider.
struct Motor {
  double speed = 0;            ///< target speed of j relative to i [rad/s or m/s]
  double strength = infinity;  ///< largest torque or force [N m or N]
  double viscosity = 1e12;     ///< torque or force per unit of missing speed [N m s/rad or N s/m]
};

/// Exercise 13.5. The row of a motor: Eq. (13.12), (13.13). Throws std::invalid_argument, naming the parameter, unless
/// h is positive and finite, the motor's speed is finite, its strength is at least 0, and its viscosity is positive.
/// Strength and viscosity may be infinite.
Row<6> motor_row(const Coordinate& free, const Motor& motor, double h, const Motion<6>& motion);

}  // namespace spook
