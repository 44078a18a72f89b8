// The texts of failed checks: two different numbers look different, in as few digits as possible.
#include "checks.hpp"

#include <gtest/gtest-spi.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "contract.hpp"
#include "random_input.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

TEST(Digits, AreTenWhereTheseTellTwoNumbersApart) {
  EXPECT_EQ(digits_apart(0.327, 0.654), 10);
  EXPECT_EQ(digits_apart(1, std::nan("")), 10);
  EXPECT_EQ(digits_apart(Eigen::Vector2d(1, 2), Eigen::Vector2d(1, 3)), 10);
  EXPECT_EQ(show(1.0 / 3, 10), "0.3333333333");
}

TEST(Digits, AreNoMoreThanItTakes) {
  EXPECT_EQ(digits_apart(1, 1 + 1e-12), 13);
  EXPECT_EQ(digits_apart(1, 1 + epsilon), 17);
  EXPECT_EQ(digits_apart(Eigen::Vector2d(0.6, 0.8), Eigen::Vector2d(0.6, 0.8 + 1e-13)), 13);
}

TEST(Digits, TellNeighboursApart) {
  Random random;
  for (int trial = 0; trial < 10000; ++trial) {
    const double a = random.log_uniform(1e-300, 1e300), b = std::nextafter(a, HUGE_VAL);
    const int digits = digits_apart(a, b);
    ASSERT_NE(show(a, digits), show(b, digits)) << "seed " << Random::seed();
    ASSERT_LE(digits, 17);
  }
}

TEST(Failures, ShowWhereTwoNumbersDiffer) {
  const double more = 1 + 1e-12;
  EXPECT_NONFATAL_FAILURE(expect_near("x", "", more, 1, {0, "exact"}),
                          "expected  1\n  got       1.000000000001\n");
  EXPECT_NONFATAL_FAILURE(expect_near_vector("x", "", Vec3(0.6, 0, more), Vec3(0.6, 0, 1), {0, "exact"}),
                          "expected  (0.6, 0, 1)\n  got       (0.6, 0, 1.000000000001)\n");
  EXPECT_NONFATAL_FAILURE(expect_at_most("x", "", more, 1, "one"),
                          "at most 1 (one)\n  got       1.000000000001\n");
  EXPECT_NONFATAL_FAILURE(expect_at_least("x", "", 1, more, "a little more"),
                          "at least 1.000000000001 (a little more)\n  got       1\n");
}

TEST(Failures, AskAboutANaN) {
  const double nan = std::nan("");
  const std::string asks = "It is NaN. Does a number, or a block";
  EXPECT_NONFATAL_FAILURE(expect_near("x", "", nan, 1, {0, "exact"}), asks);
  EXPECT_NONFATAL_FAILURE(expect_near_vector("x", "", Vec3(0, nan, 0), Vec3(1, 0, 0), {0, "exact"}), asks);
  EXPECT_NONFATAL_FAILURE(expect_at_most("x", "", nan, 1, "one"), asks);
}

TEST(Failures, ShowWhereItDiffersInOtherUnits) {
  const auto drifts = [](double x) { return x < 1e-9 ? x * (1 + 1e-11) : x; };
  EXPECT_NONFATAL_FAILURE(expect_same_in_any_units("", drifts, units::m, 1.0 * units::m),
                          "expected  1 m\n  got       1.00000000001 m");
}

}  // namespace
