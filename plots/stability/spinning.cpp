// Energy and angular momentum of a freely spinning body under the rotation updates, after 10 s, by spin and step.
//
// Moments (1, 2, 3) kg m², ω along (1, 2, -2) at first. Errors are the largest of |T/T₀ - 1| and |L - L₀|/|L₀|.
// A run is lost if it ended in a SimulationDiverged.
//
// The law of the explicit torque, Eq. (2.9). With τ = -ω × Iω a step ω += h I⁻¹τ changes, exactly,
//
//   T by ½ h² τᵀ I⁻¹ τ,     |L|² by h² |τ|²
//
// for ω·τ = 0 and L·τ = 0: both can only grow. τ is proportional to ω², so dT/dt is proportional to h T². T becomes
// infinite in a finite time,
//
//   h |ω|² t = C
//
// with a constant C of the body and of the axis of rotation. Here C comes from one run with h |ω| = 0.01 rad.
#include <algorithm>
#include <cmath>

#include "engine/bodies/conserved_quantities.hpp"
#include "engine/world/world.hpp"
#include "machinery/experiment.hpp"
#include "scenes/number.hpp"
#include "stability/grid.hpp"

namespace spook::plots {
namespace {

constexpr double seconds = 10;

World<6> top(double spin, RotationUpdate update) {
  World<6> world({.gravity = Vec3::Zero(), .rotation = {update}});
  world.add({.omega = spin * Vec3(1, 2, -2) / 3, .principal = Vec3(1, 2, 3)});
  return world;
}

struct Errors {
  double T = 0, L = 0;
};

Errors spin_on(double spin, RotationUpdate update, double h) {
  World<6> world = top(spin, update);
  const double T = kinetic_energy(world.bodies());
  const Vec3 L = angular_momentum(world.bodies());
  Errors errors;
  try {
    for (int n = 0; n < seconds / h; ++n) {
      world.step(h);
      errors.T = std::max(errors.T, std::abs(kinetic_energy(world.bodies()) / T - 1));
      errors.L = std::max(errors.L, (angular_momentum(world.bodies()) - L).norm() / L.norm());
    }
  } catch (const SimulationDiverged&) {
    return {infinity, infinity};
  }
  return errors;
}

/// Returns h |ω|² t of the SimulationDiverged for small h; infinite if there is none, as with a student's wrong torque.
double constant_of_blowup() {
  const double h = 0.01;
  World<6> world = top(1, RotationUpdate::exponential);
  try {
    while (h * world.time() < 1000) world.step(h);
  } catch (const SimulationDiverged& blowup) {
    return h * blowup.time();
  }
  return infinity;
}

Experiment experiment(Size size) {
  const bool quick = size == Size::quick;
  const std::vector<std::pair<std::string, RotationUpdate>> updates = {
      {"first order", RotationUpdate::first_order},
      {"exponential", RotationUpdate::exponential},
      {"splitting", RotationUpdate::splitting}};
  Experiment e;
  e.columns = {"update", "h", "spin", "energy error", "momentum error", "lost"};
  for (const auto& [name, update] : updates)
    for (const int rate : whole_log_spaced(30, 1000, quick ? 4 : 16))
      e.points.push_back(
          {name + " " + std::to_string(rate), [name = name, update = update, rate, quick] {
             std::vector<Row> rows;
             for (const double spin : log_spaced(1, 200, quick ? 8 : 24)) {
               const Errors found = spin_on(spin, update, 1.0 / rate);
               rows.push_back({name, 1.0 / rate, spin, found.T, found.L, double(std::isinf(found.T))});
             }
             return rows;
           }});
  e.points.push_back({"law", []() -> std::vector<Row> {
                        return {{"law", 0.0, 0.0, constant_of_blowup(), 0.0, 0.0}};
                      }});
  e.check = [](const Table& table, Claims& claims) {
    const double C = table.where("update", "law").number("energy error");
    double first_lost = infinity, last_held = 0;
    for (const std::string update : {"first order", "exponential"}) {
      const Table some = table.where("update", update);
      const auto h = some.numbers("h"), spin = some.numbers("spin"), lost = some.numbers("lost");
      for (std::size_t n = 0; n < h.size(); ++n) {
        const double over = h[n] * spin[n] * spin[n] * seconds / C;
        if (lost[n] != 0)
          first_lost = std::min(first_lost, over);
        else
          last_held = std::max(last_held, over);
      }
    }
    claims.at_least("with the explicit torque no run diverges in a time t with h |ω|² t below 0.9 C",
                    first_lost, 0.9);
    claims.at_most("every run diverges above 1.2 C", last_held, 1.2);
    const Table splitting = table.where("update", "splitting");
    const auto h = splitting.numbers("h"), spin = splitting.numbers("spin");
    const auto T = splitting.numbers("energy error"), L = splitting.numbers("momentum error");
    double band = 0;
    for (std::size_t n = 0; n < h.size(); ++n) band = std::max(band, T[n] / std::pow(h[n] * spin[n], 2));
    claims.at_most("the splitting is stable for every step and spin, and keeps L to 1e-11",
                   *std::max_element(L.begin(), L.end()), 1e-11);
    claims.at_most("the error of its energy is at most (h |ω|)²", band, 1);
  };
  return e;
}

}  // namespace
}  // namespace spook::plots

int main(int argc, char** argv) {
  return spook::plots::run_experiment(argc, argv, spook::plots::experiment);
}
