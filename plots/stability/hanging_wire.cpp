// How far a vertical wire stretches when each step has only 50 sweeps, by its links and its load.
//
// N links of 1/N m, points of m = 1 kg, a load of ratio·m in place of the last; let go straight, for 10 s. The stretch
// is the mean of the second half, over the length of 1 m. k is so large that the wire's own stretch, Eq. (6.9), is
// below 1e-4 of what is found.
//
// The law. At rest λ = h T after however few sweeps: the gaps grow until it is. As long as n sweeps are far too few,
// each finds as much as the first, and that is about m B in a row, where B is smooth along the wire: 2/m on the diagonal
// and -1/m before it make 1/m. (The last row has 1/m on its diagonal under a heavy load: 0, it does not give.) So
// n m B = h T, and B = a g, but for the weight: each link gives way as a spring of
//
//   k' = n m 4/(h² (1+4d)),     that for which mΣ = 1/n, Eq. (3.6);     stretch = Σ T_i/k', i < N, as Eq. (6.9)
//
// When the sweeps begin to suffice the wire is shorter. It is let go at its first length, so it swings to twice the
// stretch: with a stretch above one half it gets longer than twice its length. That is lost.
#include <algorithm>

#include "engine/world.hpp"
#include "machinery/experiment.hpp"
#include "scenes/number.hpp"
#include "stability/grid.hpp"

namespace spook::plots {
namespace {

constexpr double g = 9.81, m = 1, d = 3, k = 1e16, seconds = 10;
constexpr int sweeps = 50;

struct Wire {
  int links;
  double ratio;

  /// Of all but the last, Eq. (6.8).
  double sum_of_tensions() const { return (links - 1) * (ratio + links / 2.0) * m * g; }
};

double predicted(const Wire& wire, double h) {
  return wire.sum_of_tensions() * h * h * (1 + 4 * d) / (4 * sweeps * m);
}

/// Infinite when it is lost.
double stretch(const Wire& wire, double h) {
  World<3> world({.gravity = Vec3(0, 0, -g), .k = k, .d = d, .stop = {.max_sweeps = sweeps}});
  world.add_fixed(Vec3::Zero());
  for (int point = 1; point <= wire.links; ++point) {
    world.add({.x = Vec3(0, 0, -double(point) / wire.links), .mass = point == wire.links ? wire.ratio * m : m});
    world.add_joint({.i = point - 1, .j = point, .length = 1.0 / wire.links});
  }
  const int steps = static_cast<int>(std::lround(seconds / h));
  double sum = 0;
  for (int n = 0; n < steps; ++n) {
    world.step(h);
    const double longer = -world.x(wire.links).z() - 1;
    if (longer > 1) return infinity;
    if (n >= steps / 2) sum += longer;
  }
  return sum / (steps - steps / 2);
}

Experiment experiment(Size size) {
  const bool quick = size == Size::quick;
  Experiment e;
  e.columns = {"h", "links", "ratio", "stretch", "lost", "predicted"};
  const std::vector<int> links = quick ? std::vector<int>{10, 32} : whole_log_spaced(10, 1000, 7);
  const std::vector<double> ratios = log_spaced(1, 1e8, quick ? 5 : 13);
  for (const double h : {1.0 / 60, 1.0 / 1000})
    for (const int n : links)
      e.points.push_back(
          {exact_text(h) + " " + std::to_string(n), [=] {
             std::vector<Row> rows;
             for (const double ratio : ratios) {
               const Wire wire{n, ratio};
               const double found = stretch(wire, h);
               rows.push_back({h, double(n), ratio, found, double(std::isinf(found)), predicted(wire, h)});
             }
             return rows;
           }});
  e.check = [](const Table& table, Claims& claims) {
    const auto found = table.numbers("stretch"), law = table.numbers("predicted"), lost = table.numbers("lost");
    const auto h = table.numbers("h");
    double off = 0, longest_kept = 0, shortest_lost = infinity;
    for (std::size_t n = 0; n < law.size(); ++n) {
      if (lost[n] != 0) {
        shortest_lost = std::min(shortest_lost, law[n]);
        continue;
      }
      longest_kept = std::max(longest_kept, law[n]);
      const double as_one = g * h[n] * h[n] * (1 + 4 * d) / 4;  // ΣT/k' for ΣT = n m g [m]
      if (law[n] > 20 * as_one) off = std::max(off, std::abs(found[n] / law[n] - 1));
    }
    claims.at_most(
        "n sweeps make each link a spring of k' = 4 n m/(h² (1+4d)): where ΣT is above 20 n m g the stretch is "
        "ΣT/k', to 10 per cent",
        off, 0.1);
    claims.at_least("no wire is lost, longer than twice its length, for which ΣT/k' is below one half of it",
                    shortest_lost, 0.5);
    claims.at_most("every one is for which it is above 0.65", longest_kept, 0.65);
  };
  return e;
}

}  // namespace
}  // namespace spook::plots

int main(int argc, char** argv) {
  return spook::plots::run_experiment(argc, argv, spook::plots::experiment);
}
