#pragma once
// In which order the sweeps go through the rows.
//
//   up, down   by the height of what a row acts on, against gravity or along it              Eq. (10.3)
//   random     another order in every step                                                  Eq. (10.4)
#include <random>
#include <vector>

#include "engine/joints.hpp"

namespace spook {

enum class RowOrder { given, up, down, random };

/// The rows of the joints, then of the contacts with so many rows each, in that order.
template <int Dof>
std::vector<int> row_order(RowOrder order, const std::vector<Joint>& joints,
                           const std::vector<Contact>& contacts, int rows_per_contact,
                           const Bodies<Dof>& bodies, const Vec3& gravity, std::mt19937_64& random);

/// Sweeps in that order, by the rule of chapter 04's solve.
template <int Dof>
SolveReport solve_in_order(const std::vector<int>& order, std::vector<Row<Dof>>& rows,
                           std::vector<Twist<Dof>>& V, const StopRule& stop);

}  // namespace spook
