#pragma once
// Newton's cradle, pair by pair.
#include <vector>

namespace spook {

/// The velocities of equal balls in line, all touching, after their impacts [m/s]. Pair after pair, from the
/// first on, is made to part at `restitution` times its approach, again and again until none approaches faster
/// than `threshold` [m/s]. With restitution 1 each impact is an exchange of velocities, Eq. (7.13).
std::vector<double> pair_by_pair(std::vector<double> v, double restitution, double threshold);

}  // namespace spook
