#pragma once
// Random inputs from a seed that every failure prints, and that `./course check N.M --seed S` gives back.
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <random>

#include "common/types.hpp"

namespace spook::testing {

class Random {
 public:
  Random() : engine_(seed()) { used_ = true; }
  explicit Random(std::uint64_t seed) : engine_(seed) {}  ///< of one's own, which a failure has to name

  double uniform(double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(engine_); }
  int integer(int lo, int hi) { return std::uniform_int_distribution<int>(lo, hi)(engine_); }

  /// Evenly spread over magnitudes: as often between 0.01 and 0.1 as between 10 and 100.
  double log_uniform(double lo, double hi) { return std::exp(uniform(std::log(lo), std::log(hi))); }

  /// Coefficients in [-size, size].
  Vec3 vector(double size = 1) { return {uniform(-size, size), uniform(-size, size), uniform(-size, size)}; }

  Vec3 unit_vector() { return Vec3{normal(), normal(), normal()}.normalized(); }
  Quat rotation() { return Quat{normal(), normal(), normal(), normal()}.normalized(); }

  /// SPOOK_SEED, or 1: two runs of the same work get the same marks.
  static std::uint64_t seed() {
    const char* given = std::getenv("SPOOK_SEED");
    return given ? std::strtoull(given, nullptr, 10) : 1;
  }

  static bool seed_was_used() { return used_; }
  static void forget_seed() { used_ = false; }

 private:
  // Braces around its calls keep their order, and so the inputs, the same on every compiler.
  double normal() { return std::normal_distribution<double>()(engine_); }

  std::mt19937_64 engine_;
  static inline bool used_ = false;
};

}  // namespace spook::testing
