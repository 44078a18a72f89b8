#pragma once
// The residual of a row is a sum of four terms, Eq. (4.6): B - G_i V_i - G_j V_j - Σ λ. Here each pair of terms in turn
// has a large and a small one.
#include <string>
#include <vector>

#include "04_gauss_seidel/gauss_seidel.hpp"
#include "relative_scales.hpp"

namespace spook::testing {

/// A row with S_kk = 3/kg and no bounds, between two bodies of 1 kg.
struct CancellationCase {
  Row<3> row;
  std::vector<Twist<3>> V;
  double lacks;  ///< residual [m/s]
  std::string text;
};

/// Returns rows in which one term is 1 m/s, another is a fraction of that, and the other two are 0.
inline std::vector<CancellationCase> cancellation_cases(double part) {
  const std::string names[] = {"B", "G_i V_i", "G_j V_j", "Σ λ"};
  const Twist<3> up(0, 0, 1);
  std::vector<CancellationCase> all;
  for (int large = 0; large < 4; ++large)
    for (int small = 0; small < 4; ++small) {
      if (large == small) continue;
      double term[4] = {0, 0, 0, 0};
      term[large] = 1, term[small] = part;
      all.push_back({.row = {.i = 0,
                             .j = 1,
                             .Gi = -up,
                             .Gj = up,
                             .MinvGi = -up,
                             .MinvGj = up,
                             .B = term[0],
                             .Sigma = 1,
                             .diagonal = 3,
                             .lo = -infinity,
                             .hi = infinity,
                             .lambda = term[3]},
                     .V = {-term[1] * up, term[2] * up},
                     .lacks = term[0] - term[1] - term[2] - term[3],
                     .text = names[large] + " = 1 m/s, " + names[small] + " = " + show(part) + " m/s"});
    }
  return all;
}

}  // namespace spook::testing
