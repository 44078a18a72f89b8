#pragma once
// Scenes drawn at random, each within sane ranges, and properties that hold in all of them.
//
//   bodies       1 to 8 balls, capsules and boxes of 0.06 to 0.25 m across, 200 to 5000 kg/m³, up to 1 m/s and 4 rad/s;
//                or balls that do not turn
//   around them  a floor, or nothing at all; with gravity, or without
//   joints       of each kind between neighbours, perhaps to a static point: chains, loops, or none; hinges and sliders
//                with limits, springs and motors, or without. Velocities at the start contradict them
//   numbers      friction to 1, restitution to 0.8; in half of the scenes the default k and d, with h from 1/480 to
//                1/30 s, in the others h from 1/480 to 1/120 s, k from 1e5 to 1e9 N/m, and in half of these d from 1 to 5
//
// Checked after each step:
//
//   numbers      finite, and no SimulationDiverged
//   bounds       lo <= λ <= hi, of every row
//   solve        m Δv = h f + Gᵀ λ, up to round-off, of every body without an impact; with a given k, and
//                undivided steps
//   momentum     Σ m v = Σ m (v₀ + g t), up to round-off, if no body is static; impacts included, and divided steps
//                without gravity
//   angular      Σ x × m v + I ω = L₀ + Σ h x × m g, up to round-off, if each impulse acts at one point of both bodies;
//                with a given k
//   state        sound, by engine/diagnostics/run_check.hpp
//   energy       T - T₀ - Σ h f·v - the work of drives - ½ k gap₀² <= a fraction of the total: constraints and impacts
//                only dissipate; with motors or springs after the fifth step
#include <cstdint>
#include <map>
#include <string>

namespace spook::testing {

/// The failures of one scene, by kind, each with an explanation; empty if there are none. `worst` has the largest value
/// of each check, over its bound.
struct Findings {
  std::map<std::string, std::string> wrong;
  std::map<std::string, double> worst;
};

/// Draws the scene of that seed, the same on every machine with the same standard library, and runs it.
Findings run_random_scene(std::uint64_t seed);

}  // namespace spook::testing
