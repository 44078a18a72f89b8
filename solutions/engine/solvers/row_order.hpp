#pragma once
// Orders of rows, and sweeps in them: chapter 10.
#include <cstddef>
#include <vector>

#include "04_gauss_seidel/gauss_seidel.hpp"

namespace spook {

/// The order of rows in a sweep.
enum class RowOrder {
  given,   ///< order of the list
  up,      ///< by the height of a row's bodies, against gravity: Eq. (10.3)
  down,    ///< by height, along gravity
  random,  ///< a new random order in every solve: Eq. (10.4)
  /// Alternates rows of the first and the second half: consecutive rows seldom share a body, so updates need not wait
  /// for each other.
  interleaved
};

/// Returns the order 0, m, 1, m + 1, ... of n rows, with m half of n, rounded up: Eq. (14.13).
std::vector<int> interleaved_order(std::size_t n);

/// Sweeps in an order that contains every row once, with the stop rule of chapter 04's solve.
template <int Dof>
SolveReport solve_in_order(const std::vector<int>& order, std::vector<Row<Dof>>& rows,
                           std::vector<Twist<Dof>>& V, const StopRule& stop);

}  // namespace spook
