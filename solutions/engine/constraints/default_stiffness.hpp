#pragma once
// Default stiffness k of contacts and joints, from forces and masses.
//
//   contacts   k = 10⁴ F/s       all forces of a step together compress one contact by s/10⁴
//   joints     k = 2·10⁶ M/h²    the whole mass at an acceleration a stretches one joint by a h²/(2·10⁶). The load of
//                                a joint of whirling bodies is unknown beforehand, and a large k costs nothing
//   angles     k ℓ²              for the k of an angle, with ℓ the longest arm of a joint or radius of gyration
//
//   F   sum of |f| over all dynamic bodies, and of the forces of motors  M   their mass [kg]
//       and springs, the largest so far [N]
//   s   least distance from a body's centre to its surface [m]           h   step [s]
//
// If F or s is unknown, contacts are as stiff as joints. Both rules hold in any units.
#include <cmath>

namespace spook {

/// Returns the default k of joints [N/m], from the mass of all dynamic bodies [kg] and a step of `h` [s].
inline double joint_stiffness(double mass, double h) {
  return 2e6 * mass / (h * h);
}

/// Returns the default k of contacts [N/m], from the sum of all forces [N], the smallest size [m] (infinite without
/// shapes), and the k of joints.
inline double contact_stiffness(double load, double smallest, double of_joints) {
  return load > 0 && std::isfinite(smallest) ? 1e4 * load / smallest : of_joints;
}

}  // namespace spook
