#pragma once
// Random inputs from a seed. Every failure prints the seed, and `./course check N.M --seed S` repeats its inputs. They
// are the same with every compiler if no two draws are arguments of one call or operands of one sum, since the compiler
// chooses the order of those. Initialisers in braces, and statements, have a fixed order.
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <random>
#include <string>

#include "common/types.hpp"

namespace spook::testing {

/// The length of a list longer than in most tests. It detects loops that end early, and arrays that have room for ten.
inline constexpr int many = 100;

inline const std::string ends_early = "A loop that ends early leaves the rest as they were.";

class Random {
 public:
  Random() : engine_(seed()) { used_ = true; }
  explicit Random(std::uint64_t seed) : engine_(seed) {}  ///< for a test that names the seed in its failures

  double uniform(double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(engine_); }
  int integer(int lo, int hi) { return std::uniform_int_distribution<int>(lo, hi)(engine_); }

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
  double normal() { return std::normal_distribution<double>()(engine_); }

  std::mt19937_64 engine_;
  static inline bool used_ = false;
};

}  // namespace spook::testing
