#pragma once
// Chapter 13 · Mechanisms: hinges, sliders, welds, their limits and motors
//
// A joint holds some coordinates of two bodies at zero, by rows of two signs, and leaves others free. Limits and motors
// are rows on what it leaves free. Each body has a frame of the joint: a point p and axes P = q c, third axis along the
// hinge or the slider.
//
//   how j's frame is turned in i's   Q = P_i* P_j = (w, v)                                    Eq. (13.1)
//   its rate                         dQ/dt = ½ u Q,  u = P_i* (ω_j - ω_i)                     Eq. (13.2)
//   turned apart                     g_k = 2 v_k                                              Eq. (13.3)
//   their rows                       G = (0, -a_k, 0, a_k),  a_k = P_i (w e_k + v × e_k)      Eq. (13.4)
//   shift along n, fixed to i        g = n·d,  d = p_j - p_i                                  Eq. (13.5)    notes (21)
//   its row                          G = (-n, -(r_i + d)×n, n, r_j×n)                         Eq. (13.6)    notes (22)
//   angle of a hinge                 θ = 2 atan2(v_3, w), within half a turn of the last one  Eq. (13.8), (13.9)
//   limit                            g = s - lower or upper - s, as a contact                 Eq. (13.10), (13.11)
//   motor                            B = w - G W - G W_f,  a = 0, b = 1, |λ| <= h T           Eq. (13.12), (13.13)
//
//   c   axes of the joint in a body's own axes, a quaternion; of a motor its viscosity [N m s/rad, N s/m]
//   w   scalar part of Q; of a motor the wanted speed [rad/s, m/s]
//   d   shift p_j - p_i [m], and not SPOOK's relaxation
//   e_k unit vectors          s   angle [rad] or shift [m]          T   largest torque or force of a motor [N m, N]
//
// Differs from the notes: the second term of their (22) is kept. It is linear in ω, so that no Jacobian contains
// velocities: it moves i's lever arm to j's point.
#include <array>

#include "06_distance/distance.hpp"

namespace spook {

/// A joint's frame on a body: where it is, and how its axes are turned in the world.
struct JointFrame {
  Attachment at;
  Quat axes;  ///< joint to world, P = q c
};

/// A number that tells how one body stands to another, and how it changes: ds/dt = Gi·W_i + Gj·W_j.
struct Coordinate {
  int i, j;
  Twist<6> Gi, Gj;
  double value;  ///< an angle [rad] or a length [m]
};

/// Exercise 13.1. Angles of j's frame from i's, about each axis of the joint: Eq. (13.1)-(13.4). All three are
/// zero where the two are turned alike; a hinge holds the first two there, a slider and a weld hold all.
std::array<Coordinate, 3> turned_apart(const JointFrame& i, const JointFrame& j);

/// Exercise 13.2. Shift of j's point from i's along the joint's axis 0, 1 or 2 as i has it: Eq. (13.5), (13.6).
/// A slider holds the first two at zero.
Coordinate shift_along(const JointFrame& i, const JointFrame& j, int axis);

/// Exercise 13.3. The angle of a hinge, of as many turns as it has made: Eq. (13.8), (13.9). `last` is the angle some
/// steps ago [rad]; since then it has turned by less than half a turn.
Coordinate hinge_angle(const JointFrame& i, const JointFrame& j, double last);

/// The range of a hinge or slider. Either may be infinite, and lower = upper holds it where it is.
struct JointLimits {
  double lower = -infinity;  ///< [rad] or [m]
  double upper = infinity;
};

/// Exercise 13.4. The row of the limit with the smaller gap, so of the one that is passed, if one is; λ >= 0 [N m s or
/// N s]: Eq. (13.10), (13.11). Before the limit it allows, within one step of `h` [s], motion up to the limit;
/// beyond, a and Σ are those of `spook`. Either way it takes all of the speed, b = 1.
Constraint<6> limit_constraint(const Coordinate& free, const JointLimits& limits, const SpookParameters& spook,
                               double h);

/// A motor of a joint. Torques are about the hinge, forces along the slider.
struct Motor {
  double speed = 0;            ///< wanted of j, as i sees it [rad/s or m/s]
  double strength = infinity;  ///< the largest torque or force [N m or N]
  double viscosity = 1e12;     ///< torque or force per speed that is lacking [N m s/rad or N s/m]
};

/// Exercise 13.5. The row of a motor: Eq. (13.12), (13.13).
/// Throws std::invalid_argument, naming the parameter, unless h is positive and finite, the motor's speed is finite, its
/// strength is at least 0 and its viscosity positive; the last two may be infinite.
Row<6> motor_row(const Coordinate& free, const Motor& motor, double h, const Motion<6>& motion);

}  // namespace spook
