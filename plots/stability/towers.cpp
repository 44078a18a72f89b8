// Towers under Gauss-Seidel: the depth of the lowest contact by sweeps per step.
//
//   tower    n equal spheres of 1 kg, k = 1e8
//   ratio    a heavy sphere of 1 kg on a light one of m = 1/ratio kg, k = 1e6
//
// Released at touch, h = 1/60 s, for 5 s; the depth is the mean of the second half. The error is the depth over the
// right depth N/k, minus 1: an error of 1 is twice the right depth. A run is lost if a sphere's centre has passed the
// sphere below, or the floor. After the release a tower oscillates to nearly twice its depth at rest.
//
// The law. At rest λ = h N for any number of sweeps. After n sweeps from λ = 0 it is (1 - Eⁿ) S⁻¹ B, with
// E = (D-L)⁻¹ U of Eq. (4.2); so
//
//   B = S (1 - Eⁿ)⁻¹ h N,    gap = (h G g - B)/a
//
// For two bodies E has one eigenvalue other than 0, ρ of Eq. (4.10), and the lowest contact is too deep by
//
//   (h N₂/(a m)) ρⁿ⁻¹ (1-ρ)/(1-ρⁿ)
//
// For a tower the largest eigenvalue is ρ = cos²(π/(2n)), and the error is 1 after (4n²/π²) ln(1 + π²/(4 n² mΣ))
// sweeps: c n², with a c that changes slowly.
#include <Eigen/LU>
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

constexpr double g = 9.81, h = 1.0 / 60, d = 3, radius = 0.5;
constexpr double tower_k = 1e8, ratio_k = 1e6;
constexpr int steps = 300;

struct Tower {
  std::vector<double> masses;  // from the bottom
  double k;

  double load(std::size_t contact) const {
    double sum = 0;
    for (std::size_t i = contact; i < masses.size(); ++i) sum += masses[i] * g;
    return sum;
  }
};

/// Returns the depth of the lowest contact over N/k, minus 1; infinite if the run is lost.
double measured(const Tower& tower, int sweeps) {
  World<3> world({.gravity = Vec3(0, 0, -g),
                  .k = tower.k,
                  .d = d,
                  .solver = gauss_seidel<3>(),
                  .solver_limits = {.max_sweeps = sweeps}});
  world.add_plane(Vec3::UnitZ(), 0);
  const int count = static_cast<int>(tower.masses.size());
  for (int i = 0; i < count; ++i)
    world.add({.x = Vec3(0, 0, radius * (2 * i + 1)),
               .mass = tower.masses[static_cast<std::size_t>(i)],
               .radius = radius});
  double sum = 0;
  for (int n = 0; n < steps; ++n) {
    world.step(h);
    for (int i = 1; i <= count; ++i)
      if (world.x(i).z() <= (i == 1 ? 0 : world.x(i - 1).z())) return infinity;
    if (n >= steps / 2) sum += radius - world.x(1).z();
  }
  return sum / (steps - steps / 2) * tower.k / tower.load(0) - 1;
}

/// Returns that error at rest, from the matrices.
double predicted(const Tower& tower, int sweeps) {
  const auto n = static_cast<Eigen::Index>(tower.masses.size());
  const SpookParameters spook = spook_parameters(h, tower.k, d);
  Eigen::MatrixXd lower = Eigen::MatrixXd::Zero(n, n), upper = lower;  // D - L, and U
  Eigen::VectorXd hN(n);
  for (Eigen::Index c = 0; c < n; ++c) {
    const double here = 1 / tower.masses[static_cast<std::size_t>(c)];
    const double below = c > 0 ? 1 / tower.masses[static_cast<std::size_t>(c - 1)] : 0;
    lower(c, c) = here + below + spook.Sigma;
    if (c > 0) lower(c, c - 1) = upper(c - 1, c) = below;
    hN[c] = h * tower.load(static_cast<std::size_t>(c));
  }
  for (Eigen::Index c = 1; c < n; ++c) lower(c, c - 1) *= -1;
  const Eigen::MatrixXd E = lower.triangularView<Eigen::Lower>().solve(upper);
  Eigen::MatrixXd power = Eigen::MatrixXd::Identity(n, n), square = E;
  for (int left = sweeps; left > 0; left /= 2, square = square * square)
    if (left % 2 == 1) power = power * square;
  const Eigen::VectorXd B =
      (lower - upper) * (Eigen::MatrixXd::Identity(n, n) - power).partialPivLu().solve(hN);
  return (B[0] - h * g) / spook.a * tower.k / tower.load(0) - 1;
}

std::vector<Row> rows(const std::string& what, double across, const Tower& tower,
                      const std::vector<int>& sweeps) {
  std::vector<Row> rows;
  for (const int n : sweeps) {
    const double found = or_infinity([&] { return measured(tower, n); });
    rows.push_back({what, across, double(n), std::abs(found), double(std::isinf(found)), predicted(tower, n)});
  }
  return rows;
}

/// Returns the error by the closed form, with the largest eigenvalue of a tower, or the only one of two bodies.
double sweeps_to_twice(double n) {
  const double slow = std::numbers::pi * std::numbers::pi / (4 * n * n);
  return std::log(1 + slow / spook_parameters(h, tower_k, d).Sigma) / slow;
}

double two_bodies(double ratio, double sweeps) {
  const double mSigma = spook_parameters(h, ratio_k, d).Sigma / ratio, m = 1 / ratio;
  const double rho = 1 / ((1 + mSigma) * (1 + m + mSigma));  // Eq. (4.10), M = 1 kg
  const double deeper =
      h * g * h * (1 + 4 * d) / (4 * m) * std::pow(rho, sweeps - 1) * (1 - rho) / (1 - std::pow(rho, sweeps));
  return deeper * ratio_k / ((1 + m) * g);
}

void check(const Table& table, Claims& claims) {
  double off = 0, shallowest_lost = infinity, deepest_kept = 0, closed = 0, twice = 0;
  for (const std::string what : {"tower", "ratio"}) {
    const Table some = table.where("what", what);
    const auto across = some.numbers("across"), sweeps = some.numbers("sweeps"), error = some.numbers("error");
    const auto lost = some.numbers("lost"), law = some.numbers("predicted");
    for (std::size_t n = 0; n < error.size(); ++n) {
      const bool tower = what == "tower";
      const double right = tower ? across[n] * g / tower_k : (1 + 1 / across[n]) * g / ratio_k;
      const double depth = right * (1 + law[n]);
      if (lost[n] != 0) {
        shallowest_lost = std::min(shallowest_lost, depth);
        continue;
      }
      deepest_kept = std::max(deepest_kept, depth);
      if (depth < 0.05 && law[n] > 1e-3) off = std::max(off, std::abs(error[n] / law[n] - 1));
      if (!tower && law[n] > 1e-3)
        closed = std::max(closed, std::abs(two_bodies(across[n], sweeps[n]) / law[n] - 1));
      if (!tower || across[n] < 6 || n == 0 || across[n - 1] != across[n]) continue;
      if (lost[n - 1] == 0 && error[n - 1] > 1 && error[n] <= 1) {
        const double part = std::log(error[n - 1]) / std::log(error[n - 1] / error[n]);
        const double found = sweeps[n - 1] + part * (sweeps[n] - sweeps[n - 1]);
        twice = std::max(twice, std::abs(found / sweeps_to_twice(across[n]) - 1));
      }
    }
  }
  // A tower that swings slowly, about 5 cm, has a mean over 2.5 s that is 2/(2.5 s √(g/5 cm)) off.
  claims.at_most(
      "if the lowest contact sinks by less than 5 cm, its depth is that of B = S (1 - Eⁿ)⁻¹ h N, within 6 per "
      "cent",
      off, 0.06);
  claims.at_most(
      "for two bodies it is too deep by (h N₂/(a m)) ρⁿ⁻¹ (1-ρ)/(1-ρⁿ), with ρ of Eq. (4.10), to 1e-5", closed,
      1e-5);
  claims.at_most(
      "in a tower of n spheres it is twice as deep as it should be after (4n²/π²) ln(1 + π²/(4 n² mΣ)) sweeps, "
      "within 10 per cent",
      twice, 0.1);
  claims.at_least("no tower is lost if the depth by this law is below 25 cm, half a radius", shallowest_lost,
                  0.25);
  claims.at_most("every tower is lost if that depth is above 35 cm", deepest_kept, 0.35);
}

Experiment experiment(Size size) {
  const bool quick = size == Size::quick;
  Experiment e;
  e.columns = {"what", "across", "sweeps", "error", "lost", "predicted"};
  const std::vector<int> few = whole_log_spaced(1, quick ? 3000 : 30'000, quick ? 8 : 13);
  for (const int n : quick ? std::vector<int>{2, 6, 20} : whole_log_spaced(2, 100, 9))
    e.points.push_back(
        {"tower " + std::to_string(n), [=] {
           return rows("tower", n, {std::vector<double>(static_cast<std::size_t>(n), 1.0), tower_k}, few);
         }});
  const std::vector<int> many = whole_log_spaced(1, quick ? 1e4 : 1e5, quick ? 9 : 16);
  for (const double ratio : log_spaced(1, 1e8, quick ? 5 : 17))
    e.points.push_back({"ratio " + exact_text(ratio), [=] {
                          return rows("ratio", ratio, {{1 / ratio, 1}, ratio_k}, many);
                        }});
  e.check = check;
  return e;
}

}  // namespace
}  // namespace spook::plots

int main(int argc, char** argv) {
  return spook::plots::run_experiment(argc, argv, spook::plots::experiment);
}
