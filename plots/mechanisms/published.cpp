// Mechanisms with published or independent answers: error against step and time, by leapfrog and by composed steps.
//
//   composed    five leapfrogs make a step of order four, with rigid joints: engine/integration/rattle.hpp
//   leapfrog    SPOOK with d = 1/4, five steps for one composed step, direct solver. With d = 0 oscillating gaps are
//               not damped, and the linkages and the governor are lost. Joints have 1e12 N/m, so that their deflection
//               is smaller than the error of a step. Bricard's ring and the squeezer keep their own stiffness, since
//               round-off would exceed the deflection
//
// The error is the scene's own. The energy error is the largest change of the energy since the first step, over the
// largest kinetic energy. Andrews' squeezer is driven, so its energy is not conserved. Times are medians [µs]; no claim
// depends on them.
#include <algorithm>
#include <cmath>

#include "machinery/experiment.hpp"
#include "scenes/registry.hpp"
#include "scenes/run.hpp"

namespace spook::plots {
namespace {

using Set = std::vector<std::pair<std::string, std::string>>;

struct Mechanism {
  std::string scene;
  Set set;
  double h, time;  ///< the longest step, and the duration [s]
};

const Set stiff = {{"k", "1e12"}};

const std::vector<Mechanism> mechanisms = {
    {"pendulum", stiff, 1.0 / 50, 4},  {"double_pendulum", stiff, 1.0 / 60, 2},
    {"four_bar", stiff, 1.0 / 50, 2},  {"slider_crank", stiff, 1.0 / 400, 2},
    {"governor", stiff, 1.0 / 200, 2}, {"bricard", {}, 1.0 / 100, 2},
    {"andrews", {}, 8e-5, 0.03}};

Parameters parameters(const Mechanism& mechanism, bool composed) {
  Parameters p(find_scene(mechanism.scene).parameters);
  p.set("d", composed ? "0" : "1/4");
  for (const auto& [name, value] : mechanism.set) p.set(name, value);
  return p;
}

/// The result of one run.
struct Left {
  double error, energy;
  std::string state;
};

Left left_by_a_run(const Mechanism& mechanism, const Method& method, double time) {
  const auto scene =
      find_scene(mechanism.scene).build(parameters(mechanism, method.integrator_order.has_value()), method);
  double first = 0, change = 0, largest_motion = 0;
  for (std::int64_t n = 0; n <= step_count(method.h, time); ++n) {
    if (n > 0) scene->advance(1);
    scene->observe();
    scene->judge();
    const Energy now = scene->frame().energy;
    if (n == 0) first = now.motion + now.turning + now.weight;
    change = larger(change, std::abs(now.motion + now.turning + now.weight - first));
    largest_motion = larger(largest_motion, now.motion + now.turning);
  }
  return {scene->error(), change / largest_motion, name_of(scene->verdict().state)};
}

std::vector<Row> measured(const Mechanism& mechanism, bool composed, double h, Size size) {
  Method method{.h = h, .solver = "direct"};
  if (composed) method.integrator_order = 4;
  const Left left = left_by_a_run(mechanism, method, mechanism.time / (size == Size::quick ? 4 : 1));
  double us = 0;  // the quick size measures no times
  if (size == Size::full)
    us = run(find_scene(mechanism.scene), parameters(mechanism, composed),
             {.method = method, .time = mechanism.time})
             .us_per_step.value_or(0);
  return {
      {mechanism.scene, composed ? "composed" : "leapfrog", h, left.error, left.energy, us / h, left.state}};
}

/// Returns the value that is farthest from `expected`.
double farthest(const std::vector<double>& orders, double expected) {
  return *std::max_element(orders.begin(), orders.end(),
                           [&](double a, double b) { return std::abs(a - expected) < std::abs(b - expected); });
}

void check(const Table& table, Claims& claims) {
  std::vector<double> composed, plain, gains;
  for (const Mechanism& mechanism : mechanisms) {
    const auto of = [&](const std::string& method) {
      return table.where("scene", mechanism.scene).where("method", method);
    };
    const auto order = [&](const std::string& method) {
      return last_log_log_slope(of(method).numbers("h [s]"), of(method).numbers("error"));
    };
    composed.push_back(order("composed"));
    plain.push_back(order("leapfrog"));
    gains.push_back(of("leapfrog").numbers("error").front() / of("composed").numbers("error").front());
  }
  claims.near("composed steps have order 4.0 ± 0.2 on every mechanism", farthest(composed, 4), 4, 0.2);
  claims.near("leapfrog with d = 1/4 has order 2.0 ± 0.1 on every mechanism", farthest(plain, 2), 2, 0.1);
  claims.at_least("five leapfrogs composed are more than 30 times as exact as five in a row",
                  *std::min_element(gains.begin(), gains.end()), 30);
}

Experiment experiment(Size size) {
  Experiment e;
  e.timed = true;
  e.columns = {"scene", "method", "h [s]", "error", "energy change", "us a second", "state"};
  for (const Mechanism& mechanism : mechanisms)
    for (const bool composed : {true, false})
      for (int halvings = 0; halvings < (size == Size::quick ? 2 : 4); ++halvings) {
        const double h = mechanism.h / (composed ? 1 : 5) / std::pow(2, halvings);
        e.points.push_back(
            {mechanism.scene + (composed ? " composed " : " leapfrog ") + std::to_string(halvings),
             [=] { return measured(mechanism, composed, h, size); }});
      }
  e.check = check;
  return e;
}

}  // namespace
}  // namespace spook::plots

int main(int argc, char** argv) {
  return spook::plots::run_experiment(argc, argv, spook::plots::experiment);
}
