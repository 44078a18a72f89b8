#pragma once
// How stiff contacts and joints are unless somebody says: k by what they carry and what there is.
//
//   contacts   k = 10⁴ F/s       all forces of a step together compress one contact by a ten-thousandth of the smallest size
//   joints     k = 2·10⁶ M/h²    the whole mass at an acceleration a stretches one joint by a h²/(2·10⁶): what holds
//                                whirled bodies knows no load beforehand, and pays nothing for being stiff
//   turning    k ℓ²              for a k about an angle, with ℓ the longest arm of a joint or radius of gyration
//
//   F   sum of |f| over all dynamic bodies, the largest so far [N]       M   their mass [kg]
//   s   least distance from a body's centre to its surface [m]           h   step [s]
//
// Where nothing says F or s, contacts are as stiff as joints. Both rules hold in any units.
#include <cmath>

namespace spook {

/// Returns the k of joints [N/m], for the mass of all dynamic bodies [kg] and a step of `h` [s].
inline double joint_stiffness(double mass, double h) {
  return 2e6 * mass / (h * h);
}

/// Returns the k of contacts [N/m], for the sum of all forces [N], the smallest size [m], infinite without any, and
/// the k of joints.
inline double contact_stiffness(double load, double smallest, double of_joints) {
  return load > 0 && std::isfinite(smallest) ? 1e4 * load / smallest : of_joints;
}

}  // namespace spook
