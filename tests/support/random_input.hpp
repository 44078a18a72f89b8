#pragma once
// Random inputs from a seed. Every failure prints the seed, and `./course check N.M --seed S` repeats its inputs. They
// are the same with every compiler if no two draws are arguments of one call or operands of one sum, since the compiler
// chooses the order of those. Initialisers in braces, and statements, have a fixed order. The engines of the standard
// library give the same bits everywhere; its distributions do not, and are not used.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <random>
#include <string>

#include "common/types.hpp"

namespace spook::testing {

/// The length of a list longer than in most tests. It detects loops that end early, and arrays that have room for ten.
inline constexpr int many = 100;

inline const std::string ends_early = "If the first ones are right: does a loop end too early?";

class Random {
 public:
  Random() : engine_(seed()) { used_ = true; }
  explicit Random(std::uint64_t seed) : engine_(seed) {}  ///< for a test that names the seed in its failures

  /// Draws from [lo, hi).
  double uniform(double lo, double hi) { return unit() * (hi - lo) + lo; }

  /// Draws from lo to hi, both included; all equally often, within 2⁻³².
  int integer(int lo, int hi) {
    const double numbers = static_cast<double>(hi) - lo + 1;
    return static_cast<int>(lo + std::floor(unit() * numbers));
  }

  /// Draws a number evenly distributed over magnitudes: as often between 0.01 and 0.1 as between 10 and 100.
  double log_uniform(double lo, double hi) { return std::exp(uniform(std::log(lo), std::log(hi))); }

  /// Draws a vector with coefficients in [-size, size], or in [lo, hi].
  Vec3 vector(double size = 1) { return vector(-size, size); }
  Vec3 vector(double lo, double hi) { return {uniform(lo, hi), uniform(lo, hi), uniform(lo, hi)}; }

  /// Draws a vector of whole numbers from lo to hi.
  Vec3 integers(int lo, int hi) {
    const int x = integer(lo, hi), y = integer(lo, hi), z = integer(lo, hi);
    return Vec3(x, y, z);
  }

  /// Draws the velocity and angular velocity of a body, each as vector(size).
  Twist<6> twist(double size = 1) {
    const Vec3 v = vector(size), omega = vector(size);
    return (Twist<6>() << v, omega).finished();
  }

  Vec3 unit_vector() { return Vec3{normal(), normal(), normal()}.normalized(); }

  /// Draws a vector of random direction, with a length from uniform(lo, hi).
  Vec3 vector_of_length(double lo, double hi) {
    const double length = uniform(lo, hi);
    return length * unit_vector();
  }

  Quat rotation() { return Quat{normal(), normal(), normal(), normal()}.normalized(); }

  /// The environment variable SPOOK_SEED, or 1, so that two runs of the same work get the same marks.
  static std::uint64_t seed() {
    const char* given = std::getenv("SPOOK_SEED");
    return given ? std::strtoull(given, nullptr, 10) : 1;
  }

  static bool seed_was_used() { return used_; }
  static void forget_seed() { used_ = false; }

 private:
  /// Draws from [0, 1): 64 random bits, rounded to 53.
  double unit() { return std::min(std::ldexp(static_cast<double>(engine_()), -64), std::nextafter(1.0, 0.0)); }

  /// Draws from the normal distribution. Source: Marsaglia's polar method.
  double normal() {
    for (;;) {
      const double x = uniform(-1, 1);
      const double y = uniform(-1, 1);
      const double square = x * x + y * y;
      if (square > 0 && square <= 1) return y * std::sqrt(-2 * std::log(square) / square);
    }
  }

  std::mt19937_64 engine_;
  static inline bool used_ = false;
};

}  // namespace spook::testing
