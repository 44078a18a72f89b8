// Redundant rows, by stiffness and sweeps.
//
//   box     a flat box of 1 kg on 10 x 10 contacts, released at touch, after 60 steps of 1/60 s: the error of its depth
//           over the right depth, mg/(100 k)
//   loop    a point of 1 kg on two rods of 1 m and 1.1 m to one anchor, with equal k: the error of x over 10 cm, after
//           1000 steps
//
// The law of the box. At rest a row has the residual r = -a gap - Σ λ, so the error of the depth, a mean, is at most
// max|r|/a. The slow part is the distribution of λ among the rows: it changes no velocity, and enters through Σ only.
// For N equal rows the largest eigenvalue of E = (D-L)⁻¹ U, Eq. (4.2), is 1/(1 + mΣ (1 - e^(2πi/N))) for small mΣ. So
// the error falls to a fraction e in N²/(2π² mΣ) sweeps. (The rows of this box, which also turn it, take 0.55 times as
// many.)
//
// The law of the loop. E has one eigenvalue other than 0, ρ = 1/((1+mΣ₁)(1+mΣ₂)). After n sweeps from λ = 0 the two
// impulses cancel where x is the mean of the lengths with the weights
//
//   w₁ = Σ₂ (1 - ρⁿ),   w₂ = Σ₁ + (1 + mΣ₁) Σ₂ ρⁿ
//
// As ρⁿ goes to 0 their ratio becomes k₁ to k₂; for few sweeps the last row dominates.
#include <algorithm>
#include <cmath>

#include "engine/world/world.hpp"
#include "machinery/experiment.hpp"
#include "scenes/number.hpp"
#include "stability/grid.hpp"

namespace spook::plots {
namespace {

constexpr double g = 9.81, h = 1.0 / 60, d = 3, l1 = 1, l2 = 1.1;

Row box(double k, int sweeps) {
  World<6> world({.gravity = Vec3(0, 0, -g),
                  .k = k,
                  .d = d,
                  .solver = gauss_seidel<6>(),
                  .solver_limits = {.max_sweeps = sweeps}});
  world.add_plane(Vec3::UnitZ(), 0);
  const Vec3 half(0.5, 0.5, 0.2);
  std::vector<Vec3> corners;
  for (int i = 0; i < 10; ++i)
    for (int j = 0; j < 10; ++j) corners.emplace_back(i / 9.0 - 0.5, j / 9.0 - 0.5, -half.z());
  const int body =
      world.add({.x = Vec3(0, 0, half.z()), .principal = solid_box_moments(1, half), .corners = corners});
  for (int n = 0; n < 60; ++n) world.step(h);
  double sum = 0, least = infinity;
  for (int c = 0; c < static_cast<int>(world.contacts().size()); ++c) {
    sum += world.lambda(c);
    least = std::min(least, world.lambda(c));
  }
  const double right = g / (100 * k);
  const double lacks = world.report().residual / spook_parameters(h, k, d).a / right;
  const double error = std::abs((half.z() - world.x(body).z()) / right - 1);
  // A contact without a force may have a negative residual, which is no error.
  return {"box", k, double(sweeps), error, least > 0 ? lacks : infinity, std::abs(sum / (h * g) - 1)};
}

Row loop(double k, int sweeps) {
  World<3> world({.gravity = Vec3::Zero(),
                  .k = k,
                  .d = d,
                  .solver = gauss_seidel<3>(),
                  .solver_limits = {.max_sweeps = sweeps}});
  world.add_fixed(Vec3::Zero());
  world.add({.x = Vec3((l1 + l2) / 2, 0, 0)});
  world.add_joint({.i = 0, .j = 1, .length = l1});
  world.add_joint({.i = 0, .j = 1, .length = l2});
  for (int n = 0; n < 1000; ++n) world.step(h);
  const double soft = spook_parameters(h, k, d).Sigma, left = std::exp(-2 * sweeps * std::log1p(soft));  // ρⁿ
  const double w1 = 1 - left, w2 = 1 + (1 + soft) * left;
  const double law = (w1 * l1 + w2 * l2) / (w1 + w2);
  const double x = world.x(1).x(), right = (l1 + l2) / 2;
  return {
      "loop",           k, double(sweeps), std::abs(x - right) / (l2 - l1), std::abs(law - right) / (l2 - l1),
      std::abs(x - law)};
}

Experiment experiment(Size size) {
  const bool quick = size == Size::quick;
  Experiment e;
  e.columns = {"what", "k", "sweeps", "error", "law", "off"};
  for (const double k : log_spaced(1e3, quick ? 1e6 : 1e10, quick ? 4 : 15))
    e.points.push_back({"box " + exact_text(k), [=] {
                          std::vector<Row> rows;
                          for (const int n : whole_log_spaced(10, quick ? 1000 : 3162, quick ? 3 : 6))
                            rows.push_back(box(k, n));
                          return rows;
                        }});
  for (const double k : log_spaced(1e2, 1e12, quick ? 6 : 21))
    e.points.push_back({"loop " + exact_text(k), [=] {
                          std::vector<Row> rows;
                          for (const int n : whole_log_spaced(1, quick ? 1000 : 10'000, quick ? 4 : 9))
                            rows.push_back(loop(k, n));
                          return rows;
                        }});
  e.check = [](const Table& table, Claims& claims) {
    const Table box = table.where("what", "box"), loop = table.where("what", "loop");
    const auto sum = box.numbers("off"), error = box.numbers("error"), lacks = box.numbers("law");
    double over = 0;
    for (std::size_t n = 0; n < error.size(); ++n) over = std::max(over, (error[n] - 1e-9) / lacks[n]);
    claims.at_most(
        "the impulses of a hundred contacts under a box add up to h m g, to 1e-10, for any number of sweeps",
        *std::max_element(sum.begin(), sum.end()), 1e-10);
    claims.at_most("the error of its depth is at most the residual of a row, over a", over, 1);
    // Cells in which the error no longer depends on k, and with more sweeps than the motion needs.
    const auto k = box.numbers("k"), sweeps = box.numbers("sweeps");
    double apart = 0;
    int pairs = 0;
    for (std::size_t n = 0; n < k.size(); ++n)
      for (std::size_t m = 0; m < k.size(); ++m) {
        const bool tenfold = std::abs(k[m] / (10 * k[n]) - 1) < 1e-6 && sweeps[m] == 10 * sweeps[n];
        if (!tenfold || k[n] < 0.9e5 || sweeps[n] < 100) continue;
        ++pairs;
        apart = std::max(apart, std::abs(error[m] - error[n]));
      }
    claims.at_most(
        "from 100 sweeps on, ten times the k and ten times the sweeps give the same relative error of the "
        "depth, within 0.01",
        pairs > 0 ? apart : infinity, 0.01);
    const auto off = loop.numbers("off");
    claims.at_most("two contradictory rods hold a point at the mean with the weights w₁ and w₂, to 1e-12 m",
                   *std::max_element(off.begin(), off.end()), 1e-12);
  };
  return e;
}

}  // namespace
}  // namespace spook::plots

int main(int argc, char** argv) {
  return spook::plots::run_experiment(argc, argv, spook::plots::experiment);
}
