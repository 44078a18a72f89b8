// Effect of Σ on Gauss-Seidel: for a heavy body on a light one, Eq. (4.10), and for contradictory rows.
//
//   sweeps       to an error of 1e-6 of the impulse between the two, over the mass ratio, for m Σ of 0, 1e-4 and 1e-2
//   contradict   two rows between the same two bodies, S = [[1, 1], [1, 1]] + Σ, with right-hand sides of 1 and 2 m/s:
//                the first impulse and the velocity after each sweep
#include <cmath>

#include "04_gauss_seidel/gauss_seidel.hpp"
#include "machinery/experiment.hpp"

namespace spook::plots {
namespace {

constexpr double h = 1.0 / 60, g = 9.81, m = 1;

const Twist<3> up(0, 0, 1);

double sweeps_needed(double ratio, double Sigma) {
  Motion<3> motion;
  motion.inverse_mass = {{.linear = 0}, {.linear = 1 / m}, {.linear = 1 / (ratio * m)}};
  motion.W.assign(3, Twist<3>::Zero());
  motion.Wf = {Twist<3>::Zero(), -h * g * up, -h * g * up};
  std::vector<spook::Row<3>> rows;
  for (int k = 0; k < 2; ++k)
    rows.push_back(make_row<3>(
        {.i = k, .j = k + 1, .Gi = -up, .Gj = up, .gap = 0, .spook = {.a = 0, .b = 1, .Sigma = Sigma}},
        motion));
  // The exact answer of (1/m + Σ) λ0 - λ1/m = h g and -λ0/m + (1/m + 1/M + Σ) λ1 = 0.
  const double S00 = 1 / m + Sigma, S11 = 1 / m + 1 / (ratio * m) + Sigma;
  const double exact = (h * g / m) / (S00 * S11 - 1 / (m * m));
  std::vector<Twist<3>> V(3, Twist<3>::Zero());
  for (double n = 1;; ++n) {
    sweep(rows, V);
    if (std::abs(rows[1].lambda / exact - 1) <= 1e-6) return n;
  }
}

/// Eq. (4.10), (4.11).
double predicted_sweeps(double ratio, double Sigma) {
  const double rate = 1 / ((1 + m * Sigma) * (1 + 1 / ratio + m * Sigma));
  return std::log(1e6) / -std::log(rate);
}

std::vector<Row> contradiction(double Sigma, int sweeps) {
  Motion<3> motion;
  motion.inverse_mass = {{.linear = 0}, {.linear = 1}};
  motion.W.assign(2, Twist<3>::Zero());
  motion.Wf = motion.W;
  std::vector<spook::Row<3>> rows;
  for (const double wanted : {1.0, 2.0})
    rows.push_back(make_row<3>({.i = 0,
                                .j = 1,
                                .Gi = -up,
                                .Gj = up,
                                .gap = -wanted,
                                .spook = {.a = 1, .b = 1, .Sigma = Sigma},
                                .lo = -infinity},
                               motion));
  std::vector<Twist<3>> V(2, Twist<3>::Zero());
  std::vector<Row> history;
  for (int n = 1; n <= sweeps; ++n) {
    sweep(rows, V);
    history.push_back({"contradict", Sigma, double(n), rows[0].lambda, V[1].z()});
  }
  return history;
}

Experiment experiment(Size size) {
  Experiment e;
  e.columns = {"what", "Sigma", "ratio or sweep", "sweeps or impulse", "predicted or velocity"};
  for (const double Sigma : {0.0, 1e-4, 1e-2})
    for (double ratio = 1; ratio <= (size == Size::quick ? 1e4 : 1e6); ratio *= 10)
      e.points.push_back(
          {"ratio " + std::to_string(Sigma) + " " + std::to_string(ratio), [=]() -> std::vector<Row> {
             return {{"ratio", Sigma, ratio, sweeps_needed(ratio, Sigma), predicted_sweeps(ratio, Sigma)}};
           }});
  for (const double Sigma : {0.0, 0.01, 0.1})
    e.points.push_back({"contradict " + std::to_string(Sigma), [=] { return contradiction(Sigma, 200); }});
  e.check = [](const Table& table, Claims& claims) {
    const Table ratios = table.where("what", "ratio");
    const auto found = ratios.numbers("sweeps or impulse"), predicted = ratios.numbers("predicted or velocity");
    double off = 0;
    for (std::size_t n = 0; n < found.size(); ++n)
      off = std::max(off, (std::abs(found[n] - predicted[n]) - 1) / predicted[n]);
    claims.at_most(
        "the number of sweeps is that of Eq. (4.11) for every mass ratio and Σ, within one sweep plus 1e-4 of "
        "the number",
        off, 1e-4);
    const auto soft = ratios.where("Sigma", 0.01).numbers("sweeps or impulse");
    claims.at_most("with m Σ = 0.01 no mass ratio takes more than 700 sweeps",
                   *std::max_element(soft.begin(), soft.end()), 700);

    const Table rows = table.where("what", "contradict");
    const auto drift = rows.where("Sigma", 0).numbers("sweeps or impulse");
    claims.near("with Σ = 0 two contradictory rows change their impulses by 1 N s in every sweep, without end",
                (drift.front() - drift.back()) / (static_cast<double>(drift.size()) - 1), 1, 1e-9);
    const auto settled = rows.where("Sigma", 0.1).numbers("predicted or velocity");
    claims.near("with Σ = 0.1 they converge to the velocity 3/(2 + Σ) m/s", settled.back(), 3 / 2.1, 1e-9);
  };
  return e;
}

}  // namespace
}  // namespace spook::plots

int main(int argc, char** argv) {
  return spook::plots::run_experiment(argc, argv, spook::plots::experiment);
}
