#pragma once
// Random numbers from -1 to 1 that are the same on every machine, unlike those of std::uniform_real_distribution.
#include <cmath>
#include <random>

namespace spook {

class Jitter {
 public:
  explicit Jitter(unsigned seed) : engine_(seed) {}
  double next() { return std::ldexp(static_cast<double>(engine_() >> 11), -52) - 1; }

 private:
  std::mt19937_64 engine_;
};

}  // namespace spook
