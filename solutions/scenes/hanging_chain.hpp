#pragma once
// A chain of equal links between two supports at one height, at rest under its weight.
//
//   N links of the length l and the stiffness k between N + 1 points, w the weight of each point but the ends
//
//   V_i = (i - (N+1)/2) w         how strongly link i = 1 … N pulls its left end up; left of the middle it pulls it down
//   H                             how strongly each pulls it sideways: weights have no part in that
//   T_i = √(H² + V_i²)            its tension, along it; so it is l + T_i/k long and spans (l + T_i/k)(H, V_i)/T_i
//   Σ (l/T_i + 1/k) H = span      one equation for H, whose left side rises with it
//
// As N grows it becomes the catenary; as k grows, the chain of rigid links. No weights, no shape: w must be positive.
#include <vector>

#include "common/types.hpp"

namespace spook {

struct HangingChain {
  std::vector<Vec3> x;          ///< of the N + 1 points, from (0, 0, 0) to (span, 0, 0) [m]
  std::vector<double> tension;  ///< of the N links, from the left [N]
  double sideways;              ///< H [N]
};

/// `k` may be infinite.
/// Throws std::invalid_argument, naming span, unless it is more than `length`, of one link [m], as an odd chain's
/// middle link lies level; and less than all of them together, for an infinite k.
HangingChain hanging_chain(int links, double length, double span, double weight, double k);

}  // namespace spook
