// The same number of row updates in a step of 1/60 s: n sweeps, or n substeps of a sweep each; cold, or warm.
//
//   wire    9 points of 1 kg on a wire of ten links and 1 m, and 100 kg at its end
//   stack   10 point masses of 1 kg, one on the other
//
// k = 1e8, d = 3. Two other methods of substeps are those of methods/small_steps.hpp: XPBD and relaxed substeps. The
// latter update each row twice, so there are half as many. The error is that of the worst gap: its mean over the second
// half of 10 s, less T/k or N/k, over the length of a link; 1e6 if the run is lost. (A link that has swung up past the
// point above it is upside down, and at rest with a gap of -2 lengths. So a lost wire need not have a larger error.)
// "needed" is the number of sweeps that a warm start needs by Eq. (10.12), with the final rate of a long solve.
#include <cmath>

#include "10_convergence/convergence.hpp"
#include "engine/world/world.hpp"
#include "machinery/experiment.hpp"
#include "machinery/lost.hpp"
#include "methods/small_steps.hpp"

namespace spook::plots {
namespace {

constexpr double d = Chain::d, link = Chain::link, seconds = 10, lost = 1e6;

Chain wire() {
  return {true, {1, 1, 1, 1, 1, 1, 1, 1, 1, 100}};
}
Chain stack() {
  return {false, {1, 1, 1, 1, 1, 1, 1, 1, 1, 1}};
}

/// The step of a method with so many updates of each row in 1/60 s.
struct Method {
  std::string name;
  bool substeps, warm;
};

/// Returns the error of the worst gap: its mean over the second half, over the length of a link.
template <class Step>
double error_of(const Chain& chain, const World<3>& world, double h, const Step& step) {
  const int n = static_cast<int>(chain.mass.size()), steps = static_cast<int>(std::lround(seconds / h));
  std::vector<double> sums(chain.mass.size(), 0);
  for (int now = 0; now < steps; ++now) {
    if (now >= steps / 2)
      for (int body = 1; body <= n; ++body) sums[body - 1] += chain.gap(world, body);
    step(h);
  }
  double worst = 0;
  for (int body = 1; body <= n; ++body) {
    const double off = std::abs(sums[body - 1] / (steps - steps / 2) - chain.right(body)) / link;
    if (!(off <= worst)) worst = off;  // a NaN, too
  }
  return worst;
}

double error_of(const Chain& chain, const Method& method, int updates) {
  if (method.name == "relaxed substeps") {
    Relaxed relaxed(chain);
    return error_of(chain, relaxed.world(), 1.0 / 60 / (updates / 2), [&](double h) { relaxed.step(h); });
  }
  const bool is_xpbd = method.name == "XPBD";
  World<3> world =
      chain.world({.d = is_xpbd ? 0.75 : d,
                   .solver = is_xpbd ? xpbd() : gauss_seidel<3>(),
                   .warm_start = method.warm,
                   .solver_limits = {.max_sweeps = method.substeps ? 1 : updates, .tolerance = 0}});
  return error_of(chain, world, 1.0 / 60 / (method.substeps ? updates : 1), [&](double h) { world.step(h); });
}

/// Returns the difference of XPBD with positions and xpbd() in a second of 16 substeps to the 1/60 s, over a link.
double positions_apart(const Chain& chain) {
  World<3> world =
      chain.world({.d = 0.75, .solver = xpbd(), .solver_limits = {.max_sweeps = 1, .tolerance = 0}});
  Positions positions(chain);
  double most = 0;
  for (int step = 0; step < 16 * 60; ++step) {
    world.step(1.0 / 60 / 16);
    positions.step(1.0 / 60 / 16);
    for (int body = 1; body <= static_cast<int>(chain.mass.size()); ++body)
      most = std::max(most, std::abs(positions.z(body) - world.x(body).z()) / link);
  }
  return most;
}

/// Returns the number of sweeps by the rate of a solver's history.
double needed(const Chain& chain) {
  std::vector<double> history;
  World<3> world = chain.world({.solver = {.solve = [&](const SolverInput<3>& s) {
                                  const SolveReport report =
                                      solve(s.rows(), s.V, {.max_sweeps = 20000, .tolerance = 1e-10});
                                  history = report.history;
                                  return report;
                                }}});
  world.step(1.0 / 60);
  return std::log(1 - 1 / (1 + d)) / std::log(observed_rate(history));
}

void check(const Table& table, Claims& claims) {
  const auto error = [&](const std::string& scene, const std::string& method, double updates) {
    return table.where("scene", scene).where("method", method).where("updates", updates).number("error");
  };
  const auto slope = [&](const std::string& method) {
    return log_log_slope({16, 64}, {error("wire", method, 16), error("wire", method, 64)});
  };
  claims.near("with n sweeps in a step the error of the wire is proportional to 1/n: slope -1.0 ± 0.1",
              slope("sweeps"), -1, 0.1);
  claims.near("with n substeps of one sweep each it is proportional to 1/n²: slope -2.0 ± 0.05",
              slope("substeps"), -2, 0.05);
  claims.near("64 substeps leave an error 60 ± 5 times smaller than 64 sweeps",
              error("wire", "sweeps", 64) / error("wire", "substeps", 64), 60, 5);
  claims.at_most("with 16 warm sweeps the error of the stack is at most 1e-6",
                 error("stack", "warm sweeps", 16), 1e-6);
  claims.at_least("with 8 warm sweeps the stack hops, with an error above 1e-3",
                  error("stack", "warm sweeps", 8), 1e-3);
  claims.near("for the stack Eq. (10.12) requires at least 11.6 ± 0.1 sweeps",
              table.where("scene", "stack").where("method", "needed").number("updates"), 11.6, 0.1);
  claims.at_least("with 128 warm sweeps the links of the wire turn over, with errors above 0.5",
                  error("wire", "warm sweeps", 128), 0.5);
  claims.at_most("with 512 warm sweeps the error of the wire is at most 1e-9",
                 error("wire", "warm sweeps", 512), 1e-9);
  claims.near("for the wire Eq. (10.12) requires at least 264 ± 5 sweeps",
              table.where("scene", "wire").where("method", "needed").number("updates"), 264, 5);
  claims.at_most("XPBD with positions equals a sweep of rows with b = 1 and d = 3/4, to 1e-11",
                 std::max(error("wire", "positions", 16), error("stack", "positions", 16)), 1e-11);
  const auto stiffer = [&](const std::string& scene) {
    return error(scene, "substeps", 64) / error(scene, "XPBD", 64);
  };
  claims.near("by Eq. (10.13) XPBD makes the wire 13/4 ± 0.1 times as stiff as substeps with d = 3",
              stiffer("wire"), 3.25, 0.1);
  claims.near("it makes the stack 13/4 ± 0.1 times as stiff, too", stiffer("stack"), 3.25, 0.1);
  // With warm ones the stack hops there, so that round-off changes their error by half.
  claims.at_least(
      "with 32 updates relaxed substeps leave the stack an error at least 3 times smaller than warm ones",
      error("stack", "warm substeps", 32) / error("stack", "relaxed substeps", 32), 3);
  claims.at_least("with 32 updates XPBD leaves the stack a smaller error than either",
                  error("stack", "relaxed substeps", 32) / error("stack", "XPBD", 32), 1);
  claims.at_least("with 64 updates the wire is lost by relaxed substeps, as by warm ones",
                  error("wire", "relaxed substeps", 64), 0.5);
}

Experiment experiment(Size size) {
  Experiment e;
  e.columns = {"scene", "method", "updates", "error"};
  const std::vector<Method> methods = {{"sweeps", false, false},     {"substeps", true, false},
                                       {"warm sweeps", false, true}, {"warm substeps", true, true},
                                       {"XPBD", true, false},        {"relaxed substeps", true, true}};
  for (const std::string scene : {"wire", "stack"}) {
    const Chain chain = scene == "wire" ? wire() : stack();
    for (const Method& method : methods)
      for (int updates = method.name == "relaxed substeps" ? 2 : 1;
           updates <= (size == Size::quick && method.substeps ? 64 : 512); updates *= 2)
        e.points.push_back(
            {scene + " " + method.name + " " + std::to_string(updates), [=]() -> std::vector<Row> {
               const double error = or_infinity([&] { return error_of(chain, method, updates); });
               return {{scene, method.name, double(updates), error < lost ? error : lost}};
             }});
    e.points.push_back({scene + " needed", [=]() -> std::vector<Row> {
                          return {{scene, "needed", needed(chain), 0.0}};
                        }});
    e.points.push_back({scene + " positions", [=]() -> std::vector<Row> {
                          return {{scene, "positions", 16.0, positions_apart(chain)}};
                        }});
  }
  e.check = check;
  return e;
}

}  // namespace
}  // namespace spook::plots

int main(int argc, char** argv) {
  return spook::plots::run_experiment(argc, argv, spook::plots::experiment);
}
