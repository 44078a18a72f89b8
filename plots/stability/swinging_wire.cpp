// The largest stable step of a swinging wire, with every step solved exactly.
//
// N links of 1/N m, points of mass m, a load of M = 1 kg in place of the last; released straight at 30°, for 1 s, in
// which the wire swings to the other side. The error is that of the load's position, compared with the same wire in
// steps of an eighth of the law's, or 1/4000 s. A run is lost if its error exceeds 5 cm.
//
// The law. A link holds its length implicitly, but the transverse force of its tension is explicit, at x_n. For
// neighbours displaced to opposite sides its stiffness is 4T/l, so h <= 2/ω, ω = √(4T/(m l)), Eq. (1.8). T is largest
// at the top, as the wire passes the vertical: at most (3 - 2 cos 30°) times the weight below.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "engine/world/world.hpp"
#include "machinery/experiment.hpp"
#include "scenes/number.hpp"
#include "stability/grid.hpp"

namespace spook::plots {
namespace {

constexpr double g = 9.81, load = 1, k = 1e9, angle = std::numbers::pi / 6, seconds = 1;

struct Wire {
  int links;
  double ratio;

  double mass() const { return load / ratio; }

  double largest_step() const {
    const double hanging = (load + (links - 1) * mass()) * g;
    return 2 / std::sqrt(4 * (3 - 2 * std::cos(angle)) * hanging * links / mass());
  }
};

struct SolverResult {
  Vec3 load;
  double residual;  // the largest residual of all steps [m/s]
};

SolverResult swing(const Wire& wire, int steps, const std::string& solver, const StopRule& stop = {}) {
  World<3> world({.gravity = Vec3(0, 0, -g),
                  .k = k,
                  .d = 3.0,
                  .solver = find_solver<3>(solver).make_on_box(),
                  .solver_limits = stop});
  const Vec3 along(std::sin(angle), 0, -std::cos(angle));
  world.add_fixed(Vec3::Zero());
  for (int point = 1; point <= wire.links; ++point) {
    world.add({.x = along * point / wire.links, .mass = point == wire.links ? load : wire.mass()});
    world.add_joint({.i = point - 1, .j = point, .length = 1.0 / wire.links});
  }
  double residual = 0;
  try {
    for (int n = 0; n < steps; ++n) {
      world.step(seconds / steps);
      residual = std::max(residual, world.report().residual);
    }
  } catch (const SimulationDiverged&) {  // as with a student's functions
    return {Vec3::Constant(infinity), residual};
  }
  return {world.x(wire.links), residual};
}

Experiment experiment(Size size) {
  const bool quick = size == Size::quick;
  Experiment e;
  e.columns = {"what", "links", "ratio", "h", "error", "lost", "largest step", "residual"};
  const std::vector<int> rates = whole_log_spaced(30, 1000, quick ? 8 : 24);
  for (const int links : quick ? std::vector<int>{10, 32} : std::vector<int>{10, 32, 100})
    for (const double ratio : log_spaced(1, quick ? 1e3 : 1e5, quick ? 7 : 21))
      e.points.push_back({"map " + std::to_string(links) + " " + exact_text(ratio), [=] {
                            const Wire wire{links, ratio};
                            const double fine = std::min(wire.largest_step() / 8, 1.0 / 4000);
                            const Vec3 right =
                                swing(wire, static_cast<int>(std::ceil(seconds / fine)), "direct").load;
                            std::vector<Row> rows;
                            for (const int rate : rates) {
                              const SolverResult found = swing(wire, rate, "direct");
                              const double error = (found.load - right).norm();
                              rows.push_back({"map", double(links), ratio, 1.0 / rate, error,
                                              double(!(error <= 0.05)), wire.largest_step(), found.residual});
                            }
                            return rows;
                          }});
  for (const int sweeps : {2500, 5000})
    e.points.push_back({"sweeps " + std::to_string(sweeps), [=]() -> std::vector<Row> {
                          const Wire wire{10, 10};
                          const int rate = 120;
                          const double away = (swing(wire, rate, "gauss_seidel", {.max_sweeps = sweeps}).load -
                                               swing(wire, rate, "direct").load)
                                                  .norm();
                          return {{"sweeps", 10.0, 10.0, 1.0 / rate, away, 0.0, wire.largest_step(), 0.0}};
                        }});
  e.check = [](const Table& table, Claims& claims) {
    const Table map = table.where("what", "map");
    const auto h = map.numbers("h"), lost = map.numbers("lost"), law = map.numbers("largest step");
    double first_lost = infinity, last_held = 0;
    for (std::size_t n = 0; n < h.size(); ++n) {
      double& edge = lost[n] != 0 ? first_lost : last_held;
      edge = lost[n] != 0 ? std::min(edge, h[n] / law[n]) : std::max(edge, h[n] / law[n]);
    }
    claims.at_least("with steps below 2/ω no swinging wire is lost", first_lost, 1);
    claims.at_most("with steps of 1.4 times 2/ω every one is lost, within a second", last_held, 1.4);
    const auto residuals = map.numbers("residual");
    claims.at_most("the solve is not the cause: no residual exceeds 1e-9 m/s",
                   *std::max_element(residuals.begin(), residuals.end()), 1e-9);
    const auto away = table.where("what", "sweeps").numbers("error");
    claims.at_most(
        "Gauss-Seidel with 2500 or 5000 sweeps moves a wire of ten links to the same position, to 1e-9 m",
        *std::max_element(away.begin(), away.end()), 1e-9);
  };
  return e;
}

}  // namespace
}  // namespace spook::plots

int main(int argc, char** argv) {
  return spook::plots::run_experiment(argc, argv, spook::plots::experiment);
}
