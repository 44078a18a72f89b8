// The same number of row updates in a step of 1/60 s: n sweeps, or n substeps of a sweep each; cold, or warm.
//
//   wire    9 points of 1 kg on a wire of ten links and 1 m, and 100 kg at its end
//   stack   10 point masses of 1 kg, one on the other
//
// k = 1e8, d = 3. The error is that of the worst gap, its mean over the second half of 10 s against T/k or N/k, over
// the length of a link; a million when it is lost. "needed" are the sweeps that a warm start needs by Eq. (10.12), with
// the rate that a long solve has at its end.
#include <cmath>

#include "10_convergence/convergence.hpp"
#include "machinery/experiment.hpp"

namespace spook::plots {
namespace {

constexpr double g = 9.81, k = 1e8, d = 3, link = 0.1, seconds = 10, lost = 1e6;

/// Point masses in a line, each joined to the one before: by a link below it, or by a contact above it.
struct Chain {
  bool hangs;
  std::vector<double> mass;  ///< 0 is fixed

  std::vector<double> gaps(const std::vector<double>& z) const {
    std::vector<double> all;
    for (std::size_t n = 1; n < z.size(); ++n)
      all.push_back((hangs ? z[n - 1] - z[n] : z[n] - z[n - 1]) - link);
    return all;
  }

  std::vector<spook::Row<3>> rows(const std::vector<double>& gaps, const Spook& spook,
                                  const Motion<3>& motion) const {
    const Twist<3> away(0, 0, hangs ? -1 : 1);
    std::vector<spook::Row<3>> all;
    for (int i = 0; i < static_cast<int>(gaps.size()); ++i)
      all.push_back(make_row<3>({.i = i,
                                 .j = i + 1,
                                 .Gi = -away,
                                 .Gj = away,
                                 .gap = gaps[i],
                                 .spook = spook,
                                 .lo = hangs ? -infinity : 0},
                                motion));
    return all;
  }

  /// What a gap is at rest, from what it carries.
  double right(std::size_t row) const {
    double load = 0;
    for (std::size_t n = row + 1; n < mass.size(); ++n) load += mass[n] * g;
    return (hangs ? load : -load) / k;
  }
};

Chain wire() {
  return {true, {0, 1, 1, 1, 1, 1, 1, 1, 1, 1, 100}};
}
Chain stack() {
  return {false, {0, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1}};
}

struct Method {
  std::string name;
  bool substeps, warm;
};

double error_of(const Chain& chain, const Method& method, int updates) {
  const double h = 1.0 / 60 / (method.substeps ? updates : 1);
  const int sweeps = method.substeps ? 1 : updates;
  const Spook spook = spook_parameters(h, k, d);
  const std::size_t n = chain.mass.size();
  Motion<3> motion;
  std::vector<double> z;
  for (std::size_t i = 0; i < n; ++i) {
    motion.inverse_mass.push_back({.linear = i == 0 ? 0 : 1 / chain.mass[i]});
    motion.Wf.push_back(Twist<3>(0, 0, i == 0 ? 0 : -h * g));
    z.push_back((chain.hangs ? -link : link) * static_cast<double>(i));
  }
  motion.W.assign(n, Twist<3>::Zero());
  std::vector<Twist<3>> V = motion.W;
  std::vector<double> impulses(n - 1, 0), sums(n - 1, 0);
  const int steps = static_cast<int>(std::lround(seconds / h));
  for (int step = 0; step < steps; ++step) {
    const auto gaps = chain.gaps(z);
    auto rows = chain.rows(gaps, spook, motion);
    warm_start(method.warm ? impulses : std::vector<double>(rows.size(), 0.0), rows, V);
    solve(rows, V, {.max_sweeps = sweeps, .tolerance = 0});
    for (std::size_t row = 0; row < rows.size(); ++row) {
      impulses[row] = rows[row].lambda;
      if (step >= steps / 2) sums[row] += gaps[row];
    }
    for (std::size_t i = 0; i < n; ++i) {
      motion.W[i] += motion.Wf[i] + V[i];
      z[i] += h * motion.W[i].z();
    }
  }
  double worst = 0;
  for (std::size_t row = 0; row < sums.size(); ++row) {
    const double off = std::abs(sums[row] / (steps - steps / 2) - chain.right(row)) / link;
    if (!(off < lost)) return lost;
    worst = std::max(worst, off);
  }
  return worst;
}

double needed(const Chain& chain) {
  const double h = 1.0 / 60;
  Motion<3> motion;
  for (const double mass : chain.mass) {
    motion.inverse_mass.push_back({.linear = mass == 0 ? 0 : 1 / mass});
    motion.Wf.push_back(Twist<3>(0, 0, mass == 0 ? 0 : -h * g));
  }
  motion.W.assign(chain.mass.size(), Twist<3>::Zero());
  std::vector<Twist<3>> V = motion.W;
  auto rows = chain.rows(std::vector<double>(chain.mass.size() - 1, 0.0), spook_parameters(h, k, d), motion);
  const double rate = observed_rate(solve(rows, V, {.max_sweeps = 20000, .tolerance = 1e-10}).history);
  return std::log(1 - 1 / (1 + d)) / std::log(rate);
}

void check(const Table& table, Claims& claims) {
  const auto error = [&](const std::string& scene, const std::string& method, double updates) {
    return table.where("scene", scene).where("method", method).where("updates", updates).number("error");
  };
  const auto slope = [&](const std::string& method) {
    return log_log_slope({16, 64}, {error("wire", method, 16), error("wire", method, 64)});
  };
  claims.near("n sweeps in a step leave the wire an error that goes with 1/n: slope -1.0 ± 0.1",
              slope("sweeps"), -1, 0.1);
  claims.near("n substeps of a sweep each, with 1/n²: slope -2.0 ± 0.05", slope("substeps"), -2, 0.05);
  claims.near("with 64 of either the substeps' error is 60 ± 5 times smaller",
              error("wire", "sweeps", 64) / error("wire", "substeps", 64), 60, 5);
  claims.at_most("a warm stack is right with 16 sweeps, to 1e-6 of a link", error("stack", "warm sweeps", 16),
                 1e-6);
  claims.at_least("with 8 it hops, off by more than 1e-3", error("stack", "warm sweeps", 8), 1e-3);
  claims.near("the least by Eq. (10.12) is 11.6 ± 0.1",
              table.where("scene", "stack").where("method", "needed").number("updates"), 11.6, 0.1);
  claims.at_least("a warm wire is lost with 128 sweeps, further off than its length",
                  error("wire", "warm sweeps", 128), 10);
  claims.at_most("with 512 it is right, to 1e-9 of a link", error("wire", "warm sweeps", 512), 1e-9);
  claims.near("the least by Eq. (10.12) is 264 ± 5",
              table.where("scene", "wire").where("method", "needed").number("updates"), 264, 5);
}

Experiment experiment(Size size) {
  Experiment e;
  e.columns = {"scene", "method", "updates", "error"};
  const std::vector<Method> methods = {{"sweeps", false, false},
                                       {"substeps", true, false},
                                       {"warm sweeps", false, true},
                                       {"warm substeps", true, true}};
  for (const std::string scene : {"wire", "stack"}) {
    const Chain chain = scene == "wire" ? wire() : stack();
    for (const Method& method : methods)
      for (int updates = 1; updates <= (size == Size::quick && method.substeps ? 64 : 512); updates *= 2)
        e.points.push_back(
            {scene + " " + method.name + " " + std::to_string(updates), [=]() -> std::vector<Row> {
               return {{scene, method.name, double(updates), error_of(chain, method, updates)}};
             }});
    e.points.push_back({scene + " needed", [=]() -> std::vector<Row> {
                          return {{scene, "needed", needed(chain), 0.0}};
                        }});
  }
  e.check = check;
  return e;
}

}  // namespace
}  // namespace spook::plots

int main(int argc, char** argv) {
  return spook::plots::run_experiment(argc, argv, spook::plots::experiment);
}
