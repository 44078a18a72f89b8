// Stability limits of a mass on a spring: leapfrog with the spring's force, and SPOOK with a distance of the same k.
//
// m = 1 kg, from rest, 1 m from the spring's equilibrium. The error is the largest |x - cos ωt| over one period, or ten
// steps if those are longer.
//
//   force       stable up to h = 2/ω, Eq. (1.8). Below, x_n = cos nθ with nθ = ωt (1 + (hω)²/24): the error grows as
//               ωt |sin ωt| (hω)²/24. It is largest at ωt = 4.91: 0.2006 (hω)².
//   distance    stable for any k and h. It is a damped spring, Eq. (3.14): the amplitude of a soft spring decreases by
//               d (hω)²/2 in a step, π d hω in a period; a stiff spring closes its gap at once.
//
// A run is lost if it diverged, or exceeded 1 m, within 1000 steps or a period.
#include <algorithm>
#include <numbers>

#include "engine/world/world.hpp"
#include "machinery/experiment.hpp"
#include "scenes/number.hpp"
#include "stability/grid.hpp"

namespace spook::plots {
namespace {

constexpr double d = 3, length = 10;
constexpr int steps = 1000;

World<3> by_force(double k, double h) {
  const ForceField spring = [k](std::size_t, const std::vector<Vec3>& x) -> Vec3 { return -k * x[0]; };
  World<3> world({.gravity = Vec3::Zero(), .force = spring});
  world.add({.x = Vec3::UnitX()});
  world.start_half_step_back(h);
  return world;
}

/// Returns a distance of `length` to an anchor; along its line it is as linear as the spring.
World<3> by_distance(double k) {
  World<3> world({.gravity = Vec3::Zero(),
                  .k = k,
                  .d = d,
                  .solver = gauss_seidel<3>(),
                  .solver_limits = {.max_sweeps = 1}});
  world.add({.x = Vec3::UnitX()});
  world.add_fixed(Vec3(-length, 0, 0));
  world.add_joint({.i = 1, .j = 0, .length = length});
  return world;
}

struct SolverResult {
  double error = 0, farthest = 0;  // the second in the 1000 steps, or a period if that is longer
};

SolverResult swing(World<3> world, double k, double h) {
  const double omega = std::sqrt(k), period = 2 * std::numbers::pi / omega;
  SolverResult outcome;
  for (int n = 1; n <= steps || n * h <= period; ++n) {
    try {
      world.step(h);
    } catch (const SimulationDiverged&) {
      return {infinity, infinity};
    }
    const double x = world.x(0).x();
    outcome.farthest = std::max(outcome.farthest, std::abs(x));
    if (n <= 10 || n * h <= period)
      outcome.error = std::max(outcome.error, std::abs(x - std::cos(omega * n * h)));
  }
  return outcome;
}

Experiment experiment(Size size) {
  const bool quick = size == Size::quick;
  Experiment e;
  e.columns = {"what", "h", "k", "error", "farthest", "lost"};
  const std::vector<double> stiffnesses = log_spaced(1, 1e8, quick ? 17 : 49);
  for (const double h : log_spaced(1.0 / 1000, 1.0 / 30, quick ? 6 : 24))
    e.points.push_back({exact_text(h), [=] {
                          std::vector<Row> rows;
                          for (const double k : stiffnesses)
                            for (const bool force : {true, false}) {
                              const SolverResult found = swing(force ? by_force(k, h) : by_distance(k), k, h);
                              rows.push_back({force ? "force" : "distance", h, k, found.error, found.farthest,
                                              double(!(found.farthest <= 1 + 1e-9))});
                            }
                          return rows;
                        }});
  e.check = [](const Table& table, Claims& claims) {
    const Table force = table.where("what", "force"), distance = table.where("what", "distance");
    const auto h = force.numbers("h"), k = force.numbers("k"), lost = force.numbers("lost");
    const auto force_error = force.numbers("error"), distance_error = distance.numbers("error");
    double wrong = 0, off = 0, damped = 0;
    for (std::size_t n = 0; n < h.size(); ++n) {
      const double turn = h[n] * std::sqrt(k[n]);
      if ((turn > 2) != (lost[n] != 0)) ++wrong;
      if (turn > 0.1) continue;
      off = std::max(off, std::abs(force_error[n] / (0.2006 * turn * turn) - 1));
      damped = std::max(damped, distance_error[n] / (std::numbers::pi * d * turn));
    }
    claims.near("leapfrog on a spring is lost in every cell with h > 2/ω, and in no other", wrong, 0, 0);
    claims.at_most("below hω = 0.1 its error in a period is 0.2006 (hω)², to 1 per cent", off, 0.01);
    const auto farthest = distance.numbers("farthest");
    claims.at_most("with a distance of the same k the amplitude never grows, for any k and h",
                   *std::max_element(farthest.begin(), farthest.end()), 1);
    claims.at_most("it is a damped spring: the error of a soft one is at most π d hω after a period", damped,
                   1);
  };
  return e;
}

}  // namespace
}  // namespace spook::plots

int main(int argc, char** argv) {
  return spook::plots::run_experiment(argc, argv, spook::plots::experiment);
}
