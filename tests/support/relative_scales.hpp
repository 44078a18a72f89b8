#pragma once
// Inputs of widely different magnitudes. A relative threshold, such as `if (x < 1e-6 * y)`, does not depend on units,
// but is no better than `if (x < 1e-9)`: the dropped part may be the only one that changes, step after step. So tests
// combine large and small numbers, down to round-off.
#include <gtest/gtest.h>

#include <array>
#include <string>

#include "checks.hpp"

namespace spook::testing {

inline constexpr double relative_scales[] = {1e-1, 1e-3, 1e-5, 1e-7, 1e-9, 1e-11, 1e-13};

inline const std::string small_is_dropped =
    "Is a small term left out because another one is large, as in `if (x < 1e-6 * y)`? It is small, and it "
    "counts: there is no size below which the rule changes.";

/// Returns vectors with one coefficient of 1, along each axis in turn, and two small ones.
inline std::array<Vec3, 3> lopsided(double part) {
  return {Vec3(1, part, -part / 2), Vec3(-part / 2, 1, part), Vec3(part, -part / 2, 1)};
}

/// Expects each coefficient to be accurate to `count` rounding errors of its own size, unlike expect_near_vector.
template <class Matrix>
void expect_each_near(const std::string& what, const std::string& equation, const Matrix& got,
                      const std::type_identity_t<Matrix>& expected, double count) {
  for (int k = 0; k < expected.size() && !::testing::Test::HasFailure(); ++k) {
    const std::string place =
        expected.cols() == 1 ? std::to_string(k)
                             : std::to_string(k % expected.rows()) + ", " + std::to_string(k / expected.rows());
    const double wanted = expected.data()[k];
    expect_near(what + ", coefficient (" + place + ") of " + show(Eigen::MatrixXd(expected)), equation,
                got.data()[k], wanted, roundings(count, wanted),
                {{0, "It was treated as 0. " + small_is_dropped}}, small_is_dropped);
  }
}

}  // namespace spook::testing
