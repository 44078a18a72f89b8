#pragma once
// Systems on which this chapter's steps are tested.
#include <cmath>

#include "01_leapfrog/leapfrog.hpp"
#include "random_input.hpp"

namespace spook::testing {

/// A mass of 1 kg on a spring of 1 N/m, from 1 m: ω = 1 rad/s, x = cos t.
inline const ForceField spring = [](std::size_t i, const std::vector<Vec3>& x) -> Vec3 { return -x[i]; };
inline Particles oscillator() {
  return {{Vec3(1, 0, 0)}, {Vec3::Zero()}, {1}};
}

/// An orbit around the origin, GM = 1 m³/s², semi-major axis 1 m: period 2π s. Starts at its nearest point.
inline constexpr double eccentricity = 0.3;
inline const ForceField sun = [](std::size_t i, const std::vector<Vec3>& x) -> Vec3 {
  return -x[i] / std::pow(x[i].norm(), 3);
};
inline Particles orbit() {
  return {
      {Vec3(1 - eccentricity, 0, 0)}, {Vec3(0, std::sqrt((1 + eccentricity) / (1 - eccentricity)), 0)}, {1}};
}

/// Three bodies of different masses on springs to each other.
inline const ForceField web = [](std::size_t i, const std::vector<Vec3>& x) -> Vec3 {
  Vec3 f = Vec3::Zero();
  for (const Vec3& other : x) f += 4 * (other - x[i]);
  return f;
};
inline Particles three_bodies(Random& random) {
  Particles p;
  for (int i = 0; i < 3; ++i) {
    p.x.push_back(random.vector());
    p.v.push_back(random.vector());
    p.inverse_mass.push_back(1 / random.uniform(1, 3));
  }
  return p;
}

}  // namespace spook::testing
