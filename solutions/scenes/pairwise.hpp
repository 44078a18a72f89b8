#pragma once
// Newton's cradle, pair by pair.
#include <vector>

namespace spook {

/// Returns the velocities of equal balls in line, all touching, after their impacts [m/s]. Pairs are resolved one after
/// another, from the first: a pair separates at `restitution` times its approach speed. This repeats until no pair
/// approaches faster than `threshold` [m/s]. With restitution 1 each impact exchanges two velocities, Eq. (7.13).
std::vector<double> pair_by_pair(std::vector<double> v, double restitution, double threshold);

}  // namespace spook
