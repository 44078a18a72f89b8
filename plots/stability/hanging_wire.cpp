// Stretch of a vertical wire when a step has too few sweeps, by links and load.
//
// N links of 1/N m, points of m = 1 kg, a load of ratio·m in place of the last; released straight. The stretch is a
// mean over the length of 1 m. k is so large that the wire's own stretch, Eq. (6.9), is below 1e-4 of the measured
// stretch.
//
// With 50 sweeps, wires of more than 75 links are lost under their own weight at 1/60 s, and of more than 1250 links at
// 1/1000 s. The step that holds ten thousand links has fewer cells, since one such wire takes 20,000 steps of 100,000
// row updates for each simulated second.
//
// The law. At rest λ = h T for any number of sweeps, because the gaps grow until this holds. While n sweeps are far too
// few, each sweep adds as much to λ as the first. For a B that is smooth along the wire, this is about m B in a row:
// 2/m on the diagonal and -1/m before it add to 1/m. (The last row has 1/m on its diagonal under a heavy load. The sum
// is 0 there, so this link does not stretch.) So n m B = h T. Apart from the weight, B = a g with the gap g: each link
// is a spring of stiffness
//
//   k' = n m 4/(h² (1+4d)),     that for which mΣ = 1/n, Eq. (3.6);     stretch = Σ T_i/k', i < N, as Eq. (6.9)
//
// When the sweeps begin to suffice, the wire is shorter. It is released at its unstretched length, so it oscillates up
// to twice the stretch. With a stretch above one half it exceeds twice its length, and counts as lost.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/world/world.hpp"
#include "machinery/experiment.hpp"
#include "machinery/lost.hpp"
#include "scenes/number.hpp"
#include "stability/grid.hpp"

namespace spook::plots {
namespace {

constexpr double g = 9.81, m = 1, d = 3, k = 1e16;

struct Solve {
  double h;
  int sweeps;
};

struct Wire {
  int links;
  double ratio;

  /// Sum of the tensions of all links but the last, Eq. (6.8).
  double sum_of_tensions() const { return (links - 1) * (ratio + links / 2.0) * m * g; }
};

double predicted(const Wire& wire, const Solve& with) {
  return wire.sum_of_tensions() * with.h * with.h * (1 + 4 * d) / (4 * with.sweeps * m);
}

/// Returns the mean stretch over one period if damping is small; else over the second half of 40 periods, or of 10 s.
/// Infinite if the wire is lost.
///
/// A spring k' has a damper d h k', Eq. (3.10): an oscillation of ω has the damping ratio ζ = ω d h/2. The first period
/// is the widest, and its mean has an error of ζ².
double stretch(const Wire& wire, const Solve& with) {
  World<3> world({.gravity = Vec3(0, 0, -g),
                  .k = k,
                  .d = d,
                  .solver = gauss_seidel<3>(),
                  .solver_limits = {.max_sweeps = with.sweeps}});
  world.add_fixed(Vec3::Zero());
  for (int point = 1; point <= wire.links; ++point) {
    world.add({.x = Vec3(0, 0, -double(point) / wire.links), .mass = point == wire.links ? wire.ratio * m : m});
    world.add_joint({.i = point - 1, .j = point, .length = 1.0 / wire.links});
  }
  const double omega = std::sqrt(g / predicted(wire, with));
  const bool one_swing = omega * d * with.h / 2 < 0.05;
  const double seconds = std::min(10.0, 40 * 2 * std::numbers::pi / omega);
  const int steps = static_cast<int>(std::lround(seconds / with.h));
  double sum = 0, late = 0, last = 0, largest = 0;
  for (int n = 0; n < steps; ++n) {
    world.step(with.h);
    const double longer = -world.x(wire.links).z() - 1;
    if (std::abs(longer) > 1) return infinity;
    if (one_swing && longer > last && last < largest / 2) return sum / n;  // it was up, and falls again
    sum += longer;
    if (n >= steps / 2) late += longer;
    last = longer;
    largest = std::max(largest, longer);
  }
  return late / (steps - steps / 2);
}

struct Map {
  Solve with;
  std::vector<int> links;
  std::vector<double> ratios;
};

std::vector<Map> maps(bool quick) {
  const std::vector<double> ratios = log_spaced(1, 1e8, quick ? 5 : 9);
  if (quick)
    return {{{1.0 / 60, 50}, {10, 32}, ratios},
            {{1.0 / 1000, 50}, {10, 32}, ratios},
            {{1.0 / 20'000, 10}, {10, 32}, ratios}};
  const std::vector<int> links = whole_log_spaced(10, 10'000, 7);
  return {{{1.0 / 60, 50}, links, ratios},
          {{1.0 / 1000, 50}, links, ratios},
          {{1.0 / 20'000, 10}, whole_log_spaced(10, 10'000, 4), log_spaced(1, 1e8, 5)}};
}

Experiment experiment(Size size) {
  Experiment e;
  e.columns = {"h", "sweeps", "links", "ratio", "stretch", "lost", "predicted"};
  for (const auto& [with, links, ratios] : maps(size == Size::quick))
    for (const int n : links)
      for (const double ratio : ratios)
        e.points.push_back({exact_text(with.h) + " " + std::to_string(n) + " " + exact_text(ratio),
                            [=, with = with]() -> std::vector<Row> {
                              const Wire wire{n, ratio};
                              const double found = or_infinity([&] { return stretch(wire, with); });
                              return {{with.h, double(with.sweeps), double(n), ratio, found,
                                       double(std::isinf(found)), predicted(wire, with)}};
                            }});
  // The longest points take a minute: they come first, so that all cores are busy to the end.
  std::reverse(e.points.begin(), e.points.end());
  e.check = [](const Table& table, Claims& claims) {
    const auto found = table.numbers("stretch"), law = table.numbers("predicted"), lost = table.numbers("lost");
    const auto h = table.numbers("h"), sweeps = table.numbers("sweeps");
    double off = 0, longest_kept = 0, shortest_lost = infinity;
    for (std::size_t n = 0; n < law.size(); ++n) {
      if (lost[n] != 0) {
        shortest_lost = std::min(shortest_lost, law[n]);
        continue;
      }
      longest_kept = std::max(longest_kept, law[n]);
      const double as_one = g * h[n] * h[n] * (1 + 4 * d) / 4;  // ΣT/k' for ΣT = n m g, n sweeps [m]
      if (law[n] > 20 * as_one) off = std::max(off, std::abs(found[n] / law[n] - 1));
    }
    claims.at_most(
        "with n sweeps a step each link is a spring of stiffness k' = 4 n m/(h² (1+4d)); if ΣT is above 20 n m "
        "g, the stretch is ΣT/k', within 10 per cent",
        off, 0.1);
    claims.at_least("no wire is lost if ΣT/k' is below half of its length", shortest_lost, 0.5);
    claims.at_most("every wire is lost if ΣT/k' is above 0.65 of its length", longest_kept, 0.65);
  };
  return e;
}

}  // namespace
}  // namespace spook::plots

int main(int argc, char** argv) {
  return spook::plots::run_experiment(argc, argv, spook::plots::experiment);
}
