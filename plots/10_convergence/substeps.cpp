// The same number of row updates in a step of 1/60 s: n sweeps, or n substeps of a sweep each; cold, or warm.
//
//   wire    9 points of 1 kg on a wire of ten links and 1 m, and 100 kg at its end
//   stack   10 point masses of 1 kg, one on the other
//
// k = 1e8, d = 3. The error is that of the worst gap, its mean over the second half of 10 s against T/k or N/k, over
// the length of a link; a million when it is lost. (A link that swings up past the point above it has turned over, and
// is as long as it should be with a gap of -2 lengths: a wire that is lost need not be off by more.) "needed" are the
// sweeps that a warm start needs by Eq. (10.12), with the rate that a long solve has at its end.
#include <cmath>

#include "10_convergence/convergence.hpp"
#include "engine/world.hpp"
#include "machinery/experiment.hpp"
#include "machinery/lost.hpp"

namespace spook::plots {
namespace {

constexpr double g = 9.81, k = 1e8, d = 3, link = 0.1, seconds = 10, lost = 1e6;

/// Point masses in a line, body 0 is fixed; each is joined to the one before: by a link below it, or by a contact above
/// it, where it is a sphere.
struct Chain {
  bool hangs;
  std::vector<double> mass;  ///< of bodies 1, 2 ...

  World<3> world(Settings<3> settings) const {
    settings.gravity = Vec3(0, 0, -g);
    settings.k = k;
    settings.d = d;
    settings.margin = link / 2;  // what hops by less is the same contact when it lands
    World<3> world(std::move(settings));
    if (hangs)
      world.add_fixed(Vec3::Zero());
    else
      world.add_plane(Vec3::UnitZ(), link / 2);
    for (const double each : mass) {
      const int last = static_cast<int>(world.bodies().size()) - 1;
      const double z = (hangs ? -link : link) * (last + 1);
      const int next = world.add({.x = Vec3(0, 0, z), .mass = each, .radius = hangs ? 0 : link / 2});
      if (hangs) world.add_joint({.i = last, .j = next, .length = link});
    }
    return world;
  }

  double gap(const World<3>& world, int n) const {
    const double below = n == 1 ? 0 : world.x(n - 1).z(), z = world.x(n).z();
    return (hangs ? below - z : z - below) - link;
  }

  /// What a gap is at rest, from what it carries.
  double right(int n) const {
    double load = 0;
    for (std::size_t above = static_cast<std::size_t>(n) - 1; above < mass.size(); ++above)
      load += mass[above] * g;
    return (hangs ? load : -load) / k;
  }
};

Chain wire() {
  return {true, {1, 1, 1, 1, 1, 1, 1, 1, 1, 100}};
}
Chain stack() {
  return {false, {1, 1, 1, 1, 1, 1, 1, 1, 1, 1}};
}

struct Method {
  std::string name;
  bool substeps, warm;
};

double error_of(const Chain& chain, const Method& method, int updates) {
  const double h = 1.0 / 60 / (method.substeps ? updates : 1);
  World<3> world = chain.world({.solver = gauss_seidel<3>(),
                                .warm_start = method.warm,
                                .stop = {.max_sweeps = method.substeps ? 1 : updates, .tolerance = 0}});
  const int n = static_cast<int>(chain.mass.size()), steps = static_cast<int>(std::lround(seconds / h));
  std::vector<double> sums(chain.mass.size(), 0);
  for (int step = 0; step < steps; ++step) {
    if (step >= steps / 2)
      for (int body = 1; body <= n; ++body) sums[body - 1] += chain.gap(world, body);
    world.step(h);
  }
  double worst = 0;
  for (int body = 1; body <= n; ++body) {
    const double off = std::abs(sums[body - 1] / (steps - steps / 2) - chain.right(body)) / link;
    if (!(off <= worst)) worst = off;  // a NaN, too
  }
  return worst;
}

/// By the rate of a solver that tells what its sweeps returned.
double needed(const Chain& chain) {
  std::vector<double> history;
  World<3> world = chain.world({.solver = {.solve = [&](const System<3>& s) {
                                  const SolveReport report =
                                      solve(s.rows, s.V, {.max_sweeps = 20000, .tolerance = 1e-10});
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
  claims.near("n sweeps in a step leave the wire an error that goes with 1/n: slope -1.0 ± 0.1",
              slope("sweeps"), -1, 0.1);
  claims.near("n substeps of a sweep each, with 1/n²: slope -2.0 ± 0.05", slope("substeps"), -2, 0.05);
  claims.near("with 64 of either the substeps' error is 60 ± 5 times smaller",
              error("wire", "sweeps", 64) / error("wire", "substeps", 64), 60, 5);
  claims.at_most("a warm stack is right with 16 sweeps, to 1e-6 of a link", error("stack", "warm sweeps", 16),
                 1e-6);
  claims.at_least("with 8 it hops, off by more than 1e-3", error("stack", "warm sweeps", 8), 1e-3);
  claims.near("the least by Eq. (10.12) is 11.6 ± 0.1",
              table.where("scene", "stack").where("method", "needed").number("updates"), 11.6, 0.1);
  claims.at_least(
      "a warm wire is lost with 128 sweeps: its links turn over, off by more than half their length",
      error("wire", "warm sweeps", 128), 0.5);
  claims.at_most("with 512 it is right, to 1e-9 of a link", error("wire", "warm sweeps", 512), 1e-9);
  claims.near("the least by Eq. (10.12) is 264 ± 5",
              table.where("scene", "wire").where("method", "needed").number("updates"), 264, 5);
}

Experiment experiment(Size size) {
  Experiment e;
  e.columns = {"scene", "method", "updates", "error"};
  const std::vector<Method> methods = {{"sweeps", false, false},
                                       {"substeps", true, false},
                                       {"warm sweeps", false, true},
                                       {"warm substeps", true, true}};
  for (const std::string scene : {"wire", "stack"}) {
    const Chain chain = scene == "wire" ? wire() : stack();
    for (const Method& method : methods)
      for (int updates = 1; updates <= (size == Size::quick && method.substeps ? 64 : 512); updates *= 2)
        e.points.push_back(
            {scene + " " + method.name + " " + std::to_string(updates), [=]() -> std::vector<Row> {
               const double error = or_infinity([&] { return error_of(chain, method, updates); });
               return {{scene, method.name, double(updates), error < lost ? error : lost}};
             }});
    e.points.push_back({scene + " needed", [=]() -> std::vector<Row> {
                          return {{scene, "needed", needed(chain), 0.0}};
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
