#pragma once
// Scenes that nobody thought of, each within sane ranges, and what must hold in all of them.
//
//   bodies       1 to 8 balls and boxes of 0.12 to 0.25 m across, 200 to 5000 kg/m³, up to 1 m/s and 4 rad/s; or balls
//                that do not turn
//   around them  a floor, or nothing at all; with weight, or without
//   joints       distances and ball joints between neighbours, perhaps to a fixed point: chains, loops, or none
//   numbers      friction to 1, restitution to 0.8, h from 1/480 to 1/120 s, k from 1e5 to 1e9 N/m, d from 1 to 5
//
// Looked at after each step:
//
//   numbers      finite, and no SimulationDiverged
//   bounds       lo <= λ <= hi, of every row
//   solve        m Δv = h f + Gᵀ λ of every body, where no impact had a part in it: V is what λ says; to roundings
//   momentum     Σ m v = Σ m (v₀ + g t) where nothing is fixed, impacts included; to roundings
//   angular      and Σ x × m v + I ω = L₀ + Σ h x × m g, where all that acts has one point on both bodies; to roundings
//   state        sound, by engine/diagnostics/run_check.hpp
//   energy       T - T₀ - Σ h f·v - ½ k gap₀² <= a share of what there is: constraints and impacts only take
#include <cstdint>
#include <map>
#include <string>

namespace spook::testing {

/// What was found in one scene: by what was wrong, in which words; empty: nothing. `worst` are the largest of each
/// number that was looked at, over what is allowed.
struct Findings {
  std::map<std::string, std::string> wrong;
  std::map<std::string, double> worst;
};

/// Draws the scene of that seed, the same on every machine with the same standard library, and runs it.
Findings run_random_scene(std::uint64_t seed);

}  // namespace spook::testing
