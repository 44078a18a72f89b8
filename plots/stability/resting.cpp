// A ball at rest on the floor: how well its depth and its impulse are right, for any k and d.
//
// m = 1 kg, radius 0.5 m, h = 1/60 s; let go where it touches, for as many steps as the roots of Eq. (3.14) want to
// forget that to 1e-17, and 1000 more. Errors are relative: |gap + mg/k| over mg/k, |λ - h m g| over h m g, Eq. (3.13).
//
// The law. Nothing but roundings is left. x just below 0.5 m is a multiple of u = 2⁻⁵⁴ m. A ball whose gap is wrong by δ
// comes back at v = δ/(dh), since -aδ - bv = 0, Eq. (3.10). If h v = δ/d is less than u/2, x + h v rounds to x again: the
// ball stays where it is, with v ≠ 0. So the gap may be off by
//
//   |δ| <= d u/2 + u,     over mg/k
//
// (the second u for the place that is wanted, which is no multiple of u). While the ball is stuck λ is right; a ball that
// still hops by u now and then has λ off by a u, over h g: 2.7e-14 for d = 1/2, and less for more.
#include <algorithm>
#include <cmath>
#include <complex>

#include "engine/world.hpp"
#include "machinery/experiment.hpp"
#include "scenes/number.hpp"
#include "stability/grid.hpp"

namespace spook::plots {
namespace {

constexpr double g = 9.81, h = 1.0 / 60, radius = 0.5;
const double u = std::ldexp(1, -54);

/// The larger root of Eq. (3.14), m = 1 kg.
double decay(double k, double d) {
  const double sigma = 1 / (1 + spook_parameters(h, k, d).Sigma);
  const double beta = 1 - 2 * (d + 1) * sigma / (1 + 4 * d), alpha = 1 - 4 * d * sigma / (1 + 4 * d);
  const std::complex<double> root = std::sqrt(std::complex<double>(beta * beta - alpha));
  return std::max(std::abs(beta + root), std::abs(beta - root));
}

Row rest(double k, double d) {
  World<3> world({.gravity = Vec3(0, 0, -g), .k = k, .d = d, .stop = {.max_sweeps = 1}});
  world.add_plane(Vec3::UnitZ(), 0);
  const int ball = world.add({.x = Vec3(0, 0, radius), .radius = radius});
  const int steps = 1000 + static_cast<int>(std::log(1e-17) / std::log(decay(k, d)));
  for (int n = 0; n < steps; ++n) world.step(h);
  const double gap = world.x(ball).z() - radius, lambda = world.contacts().empty() ? 0 : world.lambda(0);
  return {k, d, std::abs(gap * k / g + 1), std::abs(lambda / (h * g) - 1), (d / 2 + 1) * u * k / g};
}

Experiment experiment(Size size) {
  const bool quick = size == Size::quick;
  Experiment e;
  e.columns = {"k", "d", "gap error", "impulse error", "rounding"};
  for (const double k : log_spaced(1e2, 1e12, quick ? 6 : 31))
    e.points.push_back({exact_text(k), [=] {
                          std::vector<Row> rows;
                          for (const double d : log_spaced(0.5, 50, quick ? 5 : 17)) rows.push_back(rest(k, d));
                          return rows;
                        }});
  e.check = [](const Table& table, Claims& claims) {
    const auto gap = table.numbers("gap error"), impulse = table.numbers("impulse error");
    const auto rounding = table.numbers("rounding");
    double worst = 0;
    for (std::size_t n = 0; n < gap.size(); ++n) worst = std::max(worst, gap[n] / (rounding[n] + 1e-14));
    claims.at_most("a ball at rest is mg/k deep for every k and d, but for d/2 + 1 roundings of its place",
                   worst, 1);
    claims.at_most("its impulse is h m g to 3e-14", *std::max_element(impulse.begin(), impulse.end()), 3e-14);
  };
  return e;
}

}  // namespace
}  // namespace spook::plots

int main(int argc, char** argv) {
  return spook::plots::run_experiment(argc, argv, spook::plots::experiment);
}
