// A ball at rest on the floor: errors of its depth and its impulse, for any k, d and h.
//
// m = 1 kg, radius 0.5 m; released at touch, for as many steps as the roots of Eq. (3.14) need to decay to 1e-17, and
// 1000 more. Errors are relative: |gap + mg/k| over mg/k, |λ - h m g| over h m g, Eq. (3.13).
//
// The law. Only round-off is left. x just below 0.5 m is a multiple of u = 2⁻⁵⁴ m. A ball with an error δ of its gap
// returns at v = δ/(dh), since -aδ - bv = 0, Eq. (3.10). If h v = δ/d is less than u/2, x + h v rounds to x again: the
// ball does not move, with v ≠ 0. So the error of the gap is bounded by
//
//   |δ| <= d u/2 + u,     over mg/k
//
// for any h. (The second u is for the right position, which is not a multiple of u.) v = δ/(dh) has rounding errors,
// too: the speed h g is added and removed in each step, with an error of half of its last digit w each in the kick, in
// B, in λ and in V. Their sum is at most 2w, so δ may be larger by 2 d h w: this is visible at 1/30 s.
//
// While the ball does not move, λ is right. A ball that sometimes moves by u has an error of λ of
//
//   a u,     over h m g
//
// which is 4u/(h² g (1+4d)): larger for smaller steps.
#include <algorithm>
#include <cmath>
#include <complex>

#include "engine/world/world.hpp"
#include "machinery/experiment.hpp"
#include "scenes/number.hpp"
#include "stability/grid.hpp"

namespace spook::plots {
namespace {

constexpr double g = 9.81, radius = 0.5;
const double u = std::ldexp(1, -54);

/// Returns the larger root of Eq. (3.14), for m = 1 kg.
double decay(double h, double k, double d) {
  const double sigma = 1 / (1 + spook_parameters(h, k, d).Sigma);
  const double beta = 1 - 2 * (d + 1) * sigma / (1 + 4 * d), alpha = 1 - 4 * d * sigma / (1 + 4 * d);
  const std::complex<double> root = std::sqrt(std::complex<double>(beta * beta - alpha));
  return std::max(std::abs(beta + root), std::abs(beta - root));
}

Row rest(double h, double k, double d) {
  World<3> world({.gravity = Vec3(0, 0, -g),
                  .k = k,
                  .d = d,
                  .solver = gauss_seidel<3>(),
                  .solver_limits = {.max_sweeps = 1}});
  world.add_plane(Vec3::UnitZ(), 0);
  const int ball = world.add({.x = Vec3(0, 0, radius), .radius = radius});
  const int steps = 1000 + static_cast<int>(std::log(1e-17) / std::log(decay(h, k, d)));
  for (int n = 0; n < steps; ++n) world.step(h);
  const double gap = world.x(ball).z() - radius, lambda = world.contacts().empty() ? 0 : world.lambda(0);
  const double w = std::nextafter(h * g, infinity) - h * g;
  return {h,
          k,
          d,
          std::abs(gap * k / g + 1),
          std::abs(lambda / (h * g) - 1),
          ((d / 2 + 1) * u + 2 * d * h * w) * k / g,
          spook_parameters(h, k, d).a * u / (h * g)};
}

Experiment experiment(Size size) {
  const bool quick = size == Size::quick;
  Experiment e;
  e.columns = {"h", "k", "d", "gap error", "impulse error", "rounding", "hop"};
  for (const double h : {1.0 / 1000, 1.0 / 240, 1.0 / 60, 1.0 / 30})
    for (const double k : log_spaced(1e2, 1e12, quick ? 6 : 31))
      e.points.push_back({exact_text(h) + " " + exact_text(k), [=] {
                            std::vector<Row> rows;
                            for (const double d : log_spaced(0.5, 50, quick ? 5 : 17))
                              rows.push_back(rest(h, k, d));
                            return rows;
                          }});
  e.check = [](const Table& table, Claims& claims) {
    const auto gap = table.numbers("gap error"), impulse = table.numbers("impulse error");
    const auto rounding = table.numbers("rounding"), hop = table.numbers("hop");
    double worst = 0, hops = 0;
    for (std::size_t n = 0; n < gap.size(); ++n) {
      worst = std::max(worst, gap[n] / (rounding[n] + 1e-14));
      hops = std::max(hops, impulse[n] / (hop[n] + 1e-14));
    }
    claims.at_most(
        "the depth of a ball at rest is mg/k for every k, d and h; its error is at most d/2 + 1 rounding "
        "errors of the position plus 2 d h of those of the speed",
        worst, 1);
    claims.at_most(
        "its impulse is h m g, within one rounding error of the position times the weight a of the gap, Eq. "
        "(3.4)",
        hops, 1);
  };
  return e;
}

}  // namespace
}  // namespace spook::plots

int main(int argc, char** argv) {
  return spook::plots::run_experiment(argc, argv, spook::plots::experiment);
}
