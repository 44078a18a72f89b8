#pragma once
// A chain of equal links between two supports of the same height, at rest under its weight.
//
//   N links of length l and stiffness k between N + 1 points; w is the weight of each point except the ends
//
//   V_i = (i - (N+1)/2) w         upward force of link i = 1 … N on its left end; negative left of the middle
//   H                             horizontal force, the same for all links
//   T_i = √(H² + V_i²)            tension of a link; its length is l + T_i/k, and it spans (l + T_i/k)(H, V_i)/T_i
//   Σ (l/T_i + 1/k) H = span      an equation for H, whose left-hand side increases with H
//
// For large N the shape is a catenary; for large k it is a chain of rigid links. Without weight it is undetermined, so
// w must be positive.
#include <vector>

#include "common/types.hpp"

namespace spook {

struct HangingChain {
  std::vector<Vec3> x;          ///< positions of the N + 1 points, from (0, 0, 0) to (span, 0, 0) [m]
  std::vector<double> tension;  ///< tensions of the N links, from the left [N]
  double sideways;              ///< H [N]
};

/// Returns the shape of the chain; `k` may be infinite. Throws std::invalid_argument, naming span, unless span is more
/// than `length`, the length of one link [m], since the middle link of an odd chain is level. For an infinite k, span
/// must also be less than the length of all links.
HangingChain hanging_chain(int links, double length, double span, double weight, double k);

}  // namespace spook
