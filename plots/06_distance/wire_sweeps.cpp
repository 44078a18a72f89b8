// A hanging wire under Gauss-Seidel: the number of sweeps needed, Eq. (6.12), and the stretch with fewer.
//
//   tension   one step of a straight wire at rest, Σ nearly 0, λ from 0: the largest error of a tension over that of the
//             top, against sweeps
//   stretch   relative stretch of the same wire after some seconds, against sweeps in each step
//
// N links of 1/N m, points of m = 1 kg, a load of ratio·m in place of the last. Rows from the top down.
#include <cmath>
#include <numbers>

#include "engine/world/world.hpp"
#include "machinery/experiment.hpp"
#include "machinery/lost.hpp"

namespace spook::plots {
namespace {

constexpr double g = 9.81, h = 1.0 / 60, m = 1;

struct Wire {
  int links;
  double ratio;

  double load(int point) const { return point == links ? ratio * m : m; }
  double tension(int link) const { return (ratio * m + (links - link) * m) * g; }  // Eq. (6.8), 1 at the top

  /// The stretch at rest by Eq. (6.9).
  double stretch(double k) const {
    double sum = 0;
    for (int link = 1; link <= links; ++link) sum += tension(link);
    return sum / k;
  }
};

World<3> hang(const Wire& wire, double k, const StopRule& stop) {
  World<3> world(
      {.gravity = Vec3(0, 0, -g), .k = k, .d = 3.0, .solver = gauss_seidel<3>(), .solver_limits = stop});
  world.add_fixed(Vec3::Zero());
  for (int point = 1; point <= wire.links; ++point) {
    world.add({.x = Vec3(0, 0, -static_cast<double>(point) / wire.links), .mass = wire.load(point)});
    world.add_joint({.i = point - 1, .j = point, .length = 1.0 / wire.links});
  }
  return world;
}

double tension_error(const Wire& wire, int sweeps) {
  World<3> world = hang(wire, 1e15, {.max_sweeps = sweeps});
  world.step(h);
  double worst = 0;
  for (int link = 1; link <= wire.links; ++link)
    worst = std::max(worst, std::abs(-world.joint_lambda(link - 1) / h - wire.tension(link)));
  return worst / wire.tension(1);
}

double stretch_after(const Wire& wire, double k, int sweeps, double seconds) {
  World<3> world = hang(wire, k, {.max_sweeps = sweeps});
  // The wire swings up and down for a while; the mean of the second half is where it hangs.
  const int steps = static_cast<int>(seconds / h);
  double sum = 0;
  for (int n = 0; n < steps; ++n) {
    world.step(h);
    if (n >= steps / 2) sum += -world.x(wire.links).z() - 1;
  }
  return sum / (steps - steps / 2);
}

std::string text(const Wire& wire) {
  return std::to_string(wire.links) + " links " + std::to_string(static_cast<int>(wire.ratio));
}

Experiment experiment(Size size) {
  const bool quick = size == Size::quick;
  Experiment e;
  e.columns = {"what", "links", "ratio", "sweeps", "value"};
  for (const Wire wire : {Wire{10, 1}, Wire{20, 1}, Wire{40, 1}, Wire{10, 100}})
    e.points.push_back({"tension " + text(wire), [=] {
                          std::vector<Row> rows;
                          const double most = quick ? 1e4 : 3e4;
                          for (double sweeps = 1; sweeps < most;
                               sweeps = std::ceil(sweeps * (quick ? 1.5 : 1.15))) {
                            const double error = tension_error(wire, static_cast<int>(sweeps));
                            if (error < 1e-7) break;
                            rows.push_back({"tension", double(wire.links), wire.ratio, sweeps, error});
                          }
                          return rows;
                        }});
  const std::vector<Wire> hung =
      quick ? std::vector<Wire>{{10, 10}, {10, 100}} : std::vector<Wire>{{10, 10}, {10, 100}, {100, 1000}};
  for (const Wire wire : hung)
    for (int sweeps = 10; sweeps <= (quick ? 1000 : 10000); sweeps *= 10)
      for (const int times : {1, 2, 5}) {
        if (times * sweeps > (quick ? 1000 : 10000)) continue;
        e.points.push_back(
            {"stretch " + text(wire) + " " + std::to_string(times * sweeps), [=]() -> std::vector<Row> {
               const double found =
                   or_infinity([&] { return stretch_after(wire, 1e8, times * sweeps, quick ? 5 : 10); });
               return {{"stretch", double(wire.links), wire.ratio, double(times * sweeps), found}};
             }});
      }
  e.check = [](const Table& table, Claims& claims) {
    const auto rate = [&](int links, double ratio) {
      const Table some = table.where("what", "tension").where("links", links).where("ratio", ratio);
      const auto n = some.numbers("sweeps"), error = some.numbers("value");
      std::size_t from = 0;
      while (error[from] > 1e-2) ++from;
      return std::log(error[from] / error.back()) / (n.back() - n[from]);
    };
    // D^(-1/2) S D^(-1/2) has ones on its diagonal and -1/2 beside them, but for the -1/√2 of the top: the zeros of a
    // Chebyshev polynomial. Its logarithm is that of Eq. (6.12) for long wires.
    const auto predicted = [](int links) { return -2 * std::log(std::cos(std::numbers::pi / (2 * links))); };
    double worst = 0;
    for (const int links : {10, 20, 40})
      worst = std::max(worst, std::abs(rate(links, 1) / predicted(links) - 1));
    claims.at_most(
        "in a wire of N equal links each sweep multiplies the error by cos²(π/(2N)): the logarithms agree to 1 "
        "per cent",
        worst, 0.01);
    claims.near("twice as many links need four times as many sweeps: 4.0 ± 0.1 times from 20 links to 40",
                rate(20, 1) / rate(40, 1), 4, 0.1);
    const Table rubber = table.where("what", "stretch").where("links", 10).where("ratio", 100);
    claims.near(
        "with too few sweeps in a step, ten links with a load of 100:1 stretch in proportion to one over the "
        "sweeps: slope -1.0 ± 0.1",
        log_log_slope({20, 200}, {rubber.where("sweeps", 20).number("value"),
                                  rubber.where("sweeps", 200).number("value")}),
        -1, 0.1);
    claims.near(
        "with a load of 100:1 on ten links each sweep removes the part m/((N-1) M) of the error, Eq. (6.12), "
        "to 5 per cent",
        rate(10, 100) * 9 * 100, 1, 0.05);
  };
  return e;
}

}  // namespace
}  // namespace spook::plots

int main(int argc, char** argv) {
  return spook::plots::run_experiment(argc, argv, spook::plots::experiment);
}
