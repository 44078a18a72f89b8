#pragma once
// Systems of rows for the tests of chapter 10: those of chapter 04, and properties of any of them.
#include <numeric>

#include "../04_gauss_seidel/problems.hpp"
#include "10_convergence/convergence.hpp"

namespace spook::testing {

template <int Dof>
void take_bounds_off(Problem<Dof>& p) {
  for (Row<Dof>& row : p.rows) {
    row.lo = -infinity;
    row.hi = infinity;
  }
}

/// Gives some rows two bounds, some one, and some none.
inline void give_bounds(Random& random, Problem<6>& p) {
  for (Row<6>& row : p.rows) {
    const int kind = random.integer(0, 3);
    if (kind == 0) row.lo = -infinity;
    if (kind == 1) {
      row.lo = -random.uniform(0, 0.2);
      row.hi = random.uniform(0, 0.2);
    }
  }
}

template <int Dof>
Eigen::VectorXd lambdas(const Problem<Dof>& p) {
  return gathered(p.rows, &Row<Dof>::lambda);
}

/// All velocities in one vector.
template <int Dof>
Eigen::VectorXd flat(const std::vector<Twist<Dof>>& V) {
  Eigen::VectorXd all(static_cast<Eigen::Index>(V.size()) * Dof);
  for (std::size_t k = 0; k < V.size(); ++k) all.segment<Dof>(static_cast<Eigen::Index>(k) * Dof) = V[k];
  return all;
}

/// M⁻¹ Gᵀ λ, with the rows' λ.
template <int Dof>
Eigen::VectorXd moved(const Problem<Dof>& p) {
  std::vector<Twist<Dof>> V(p.V.size(), Twist<Dof>::Zero());
  for (const Row<Dof>& row : p.rows) {
    V[static_cast<std::size_t>(row.i)] += row.lambda * row.MinvGi;
    V[static_cast<std::size_t>(row.j)] += row.lambda * row.MinvGj;
  }
  return flat(V);
}

inline std::vector<double> as_std(const Eigen::VectorXd& v) {
  return {v.begin(), v.end()};
}

inline Eigen::VectorXd as_eigen(const std::vector<double>& v) {
  return Eigen::Map<const Eigen::VectorXd>(v.data(), static_cast<Eigen::Index>(v.size()));
}

inline Eigen::VectorXd as_eigen(const std::vector<int>& v) {
  Eigen::VectorXd result(static_cast<Eigen::Index>(v.size()));
  std::copy(v.begin(), v.end(), result.begin());
  return result;
}

/// Returns true if these are the numbers 0 to n - 1, each once.
inline bool has_each_once(std::vector<int> order, int n) {
  std::sort(order.begin(), order.end());
  std::vector<int> all(static_cast<std::size_t>(n));
  std::iota(all.begin(), all.end(), 0);
  return order == all;
}

inline std::vector<int> shuffled(Random& random, int n) {
  std::vector<int> order(static_cast<std::size_t>(n));
  std::iota(order.begin(), order.end(), 0);
  for (int k = n - 1; k > 0; --k)
    std::swap(order[static_cast<std::size_t>(k)], order[static_cast<std::size_t>(random.integer(0, k))]);
  return order;
}

}  // namespace spook::testing
