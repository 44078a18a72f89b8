#pragma once
// How small one thing may be beside another. A threshold that is a part of something, such as `if (x < 1e-6 * y)`, is
// the same in any units, and no better than `if (x < 1e-9)`: what it drops may be all that changes, step after step.
// So tests put small things beside large ones, down to what roundings let through.
#include <array>
#include <string>

#include "checks.hpp"

namespace spook::testing {

inline constexpr double relative_scales[] = {1e-1, 1e-3, 1e-5, 1e-7, 1e-9, 1e-11, 1e-13};

inline const std::string small_is_dropped =
    "Has something been left out because it is small beside something else, as in `if (x < 1e-6 * y)`? It is "
    "small, "
    "and it counts: there is no size below which the rule is another.";

/// Vectors with one coefficient of 1, along each axis, and two that are a part of it.
inline std::array<Vec3, 3> lopsided(double part) {
  return {Vec3(1, part, -part / 2), Vec3(-part / 2, 1, part), Vec3(part, -part / 2, 1)};
}

/// As expect_near_vector, but of each coefficient its own digits are asked for, `count` roundings of it: of small ones
/// as many as of large ones.
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
                {{0, "It has been taken for zero. " + small_is_dropped}}, small_is_dropped);
  }
}

}  // namespace spook::testing
