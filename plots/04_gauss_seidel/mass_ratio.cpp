// The number of sweeps for a heavy body on a light one, compared with Eq. (4.10).
//
// Two point masses at rest on a floor, m = 1 below and M above, as two rows with Σ = 0; λ is swept from 0. The error is
// that of the impulse between the bodies, over its exact value h M g. The notes say that it falls as 1/N.
#include <cmath>

#include "04_gauss_seidel/gauss_seidel.hpp"
#include "machinery/experiment.hpp"

namespace spook::plots {
namespace {

constexpr double h = 1.0 / 60, g = 9.81;

struct Stack {
  std::vector<spook::Row<3>> rows;
  std::vector<Twist<3>> V;
};

/// Builds the rows from the floor up, for masses from below.
Stack stack(const std::vector<double>& masses) {
  const Twist<3> up(0, 0, 1);
  Motion<3> motion;
  motion.inverse_mass.push_back({.linear = 0});
  motion.Wf.push_back(Twist<3>::Zero());
  for (const double mass : masses) {
    motion.inverse_mass.push_back({.linear = 1 / mass});
    motion.Wf.push_back(-h * g * up);
  }
  motion.W.assign(motion.Wf.size(), Twist<3>::Zero());
  Stack result{.rows = {}, .V = motion.W};
  for (int k = 0; k < static_cast<int>(masses.size()); ++k)
    result.rows.push_back(make_row<3>(
        {.i = k, .j = k + 1, .Gi = -up, .Gj = up, .gap = 0, .spook = {.a = 0, .b = 1, .Sigma = 0}}, motion));
  return result;
}

double rate(double ratio) {
  return 1 / (1 + 1 / ratio);  // Eq. (4.10), Σ = 0
}

/// Returns the relative error of the upper impulse at sweeps 1, 2, 5, 10, 20, ... until it is below 1e-6, or for `most`
/// sweeps.
std::vector<Row> history(double ratio, bool heavy_on_top, double most) {
  const double upper = heavy_on_top ? ratio : 1;
  Stack s = stack({heavy_on_top ? 1 : ratio, upper});
  const double exact = h * upper * g;
  const std::string heavy = heavy_on_top ? "on top" : "below";
  std::vector<Row> rows;
  double next = 1, factor = 2;
  double error = 1;
  for (double n = 1; n <= most && error > 1e-6; ++n) {
    sweep(s.rows, s.V);
    error = std::abs(s.rows[1].lambda / exact - 1);
    if (n != next && error > 1e-6) continue;
    rows.push_back({ratio, heavy, n, error, std::pow(rate(heavy_on_top ? ratio : 1 / ratio), n)});
    if (n == next) {
      next *= factor;
      factor = factor == 2 ? 2.5 : 2;
      if (std::fmod(std::log10(next), 1) < 1e-9) factor = 2;
    }
  }
  return rows;
}

Experiment experiment(Size size) {
  const double largest = size == Size::quick ? 1e4 : 1e6;
  Experiment e;
  e.columns = {"ratio", "heavy", "sweeps", "error", "predicted"};
  for (double ratio = 1; ratio <= largest; ratio *= 10)
    for (const bool on_top : {true, false})
      e.points.push_back({std::to_string(static_cast<int>(ratio)) + (on_top ? " on top" : " below"),
                          [=] { return history(ratio, on_top, 16 * largest); }});
  e.check = [largest](const Table& table, Claims& claims) {
    double worst = 0;
    for (double ratio = 10; ratio <= largest; ratio *= 10) {
      const Table one = table.where("ratio", ratio).where("heavy", "on top");
      const auto n = one.numbers("sweeps"), error = one.numbers("error");
      const double measured = std::log(error.back() / error.front()) / (n.back() - n.front());
      worst = std::max(worst, std::abs(measured / std::log(rate(ratio)) - 1));
    }
    claims.at_most(
        "with the heavy body on top, each sweep multiplies the error by ρ of Eq. (4.10): ln ρ agrees to a "
        "relative 1e-5",
        worst, 1e-5);
    claims.near("at 1000:1 an error of 1e-6 takes 13,823 sweeps, not a million",
                table.where("ratio", 1000).where("heavy", "on top").numbers("sweeps").back(), 13823, 0);
    double most = 0;
    for (double ratio = 10; ratio <= largest; ratio *= 10)
      most = std::max(most, table.where("ratio", ratio).where("heavy", "below").numbers("sweeps").back());
    claims.at_most("with the heavy body below, it takes at most 6 sweeps, and fewer the heavier the body", most,
                   6);
  };
  return e;
}

}  // namespace
}  // namespace spook::plots

int main(int argc, char** argv) {
  return spook::plots::run_experiment(argc, argv, spook::plots::experiment);
}
