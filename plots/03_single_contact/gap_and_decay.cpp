// Effect of SPOOK's k and d on one contact: its depth at rest, Eq. (3.13), and the decay of a violation, Eq. (3.14).
//
// A point mass of 1 kg over a floor, as one row without projection. The decay is the factor by which a violation
// shrinks in a step, on average over the later half of a long run without forces.
#include <algorithm>
#include <cmath>

#include "03_single_contact/single_contact.hpp"
#include "machinery/experiment.hpp"

namespace spook::plots {
namespace {

constexpr double m = 1, g = 9.81;

struct State {
  double gap, v;
};

/// One step of Eq. (3.10) without (3.11), and (3.12).
State step(const State& s, double h, const SpookParameters& spook, double gravity) {
  const double v_f = -h * gravity;
  const double lambda = (-spook.a * s.gap - spook.b * s.v - v_f) / (1 / m + spook.Sigma);
  const double v = s.v + v_f + lambda / m;
  return {s.gap + h * v, v};
}

double rest_gap(double h, double k, double d) {
  const SpookParameters spook = spook_parameters(h, k, d);
  State s{0, 0};
  for (int n = 0; n < 20000; ++n) s = step(s, h, spook, g);
  return s.gap;
}

/// Returns the modulus of the larger root of Eq. (3.14).
double predicted_factor(double h, double k, double d) {
  const double sigma = 1 / (1 + m * spook_parameters(h, k, d).Sigma);
  const double beta = 1 - 2 * (d + 1) * sigma / (1 + 4 * d);
  const double alpha = 1 - 4 * d * sigma / (1 + 4 * d);
  const double discriminant = beta * beta - alpha;
  return discriminant < 0 ? std::sqrt(alpha) : std::abs(beta) + std::sqrt(discriminant);
}

/// Scales the violation back to its initial size after each step, so that round-off does not hide it.
double measured_factor(double h, double k, double d) {
  const SpookParameters spook = spook_parameters(h, k, d);
  State s{-1, 0};
  const int steps = 4000;
  double log_size = 0;
  for (int n = 0; n < steps; ++n) {
    s = step(s, h, spook, 0);
    const double size = std::hypot(s.gap, h * s.v);
    log_size += n >= steps / 2 ? std::log(size) : 0;
    s.gap /= size;
    s.v /= size;
  }
  return std::exp(log_size / (steps - steps / 2));
}

std::string text(double value) {
  return std::to_string(value);
}

Experiment experiment(Size size) {
  Experiment e;
  e.columns = {"what", "h", "k", "d", "value", "predicted"};
  for (const double h : {1.0 / 30, 1.0 / 60, 1.0 / 240})
    for (const double d : {1.0, 3.0, 10.0})
      for (double k = 1e3; k <= 1e9; k *= size == Size::quick ? 1000 : 10)
        e.points.push_back({"gap " + text(h) + " " + text(k) + " " + text(d), [=]() -> std::vector<Row> {
                              return {{"gap", h, k, d, rest_gap(h, k, d), -m * g / k}};
                            }});
  for (const double k : {1e3, 1e4, 1e9})
    for (double power = -2; power <= 5; power += size == Size::quick ? 1 : 0.25)
      e.points.push_back({"decay " + text(k) + " " + text(power), [=]() -> std::vector<Row> {
                            const double h = 1.0 / 60, d = std::exp2(power);
                            return {{"decay", h, k, d, measured_factor(h, k, d), predicted_factor(h, k, d)}};
                          }});
  e.check = [](const Table& table, Claims& claims) {
    const auto worst = [&](const std::string& what) {
      const Table some = table.where("what", what);
      const auto value = some.numbers("value"), predicted = some.numbers("predicted");
      double largest = 0;
      for (std::size_t n = 0; n < value.size(); ++n)
        largest = std::max(largest, std::abs(value[n] / predicted[n] - 1));
      return largest;
    };
    claims.at_most("a resting contact has the gap -mg/k for any h and d, to a relative 1e-9", worst("gap"),
                   1e-9);
    claims.at_most(
        "after the first steps, a step multiplies a violation on average by the larger modulus of the roots "
        "(3.14), to 1 per cent",
        worst("decay"), 0.01);
    const Table stiff = table.where("what", "decay").where("k", 1e9);
    const auto factors = stiff.numbers("value"), d = stiff.numbers("d");
    const auto least = std::min_element(factors.begin(), factors.end());
    claims.near("a violation of a stiff contact decays fastest at d = 2",
                d[std::size_t(least - factors.begin())], 2, 1e-6);
  };
  return e;
}

}  // namespace
}  // namespace spook::plots

int main(int argc, char** argv) {
  return spook::plots::run_experiment(argc, argv, spook::plots::experiment);
}
