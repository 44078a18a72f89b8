// The energy of a Kepler orbit under three integrators, at equal cost: a cost is an evaluation of the force.
//
//   leapfrog    1 evaluation a step, order 2, and a bounded error                         Eq. (1.3), (1.4)
//   Euler       1 evaluation a step, order 1: x and v from the same old values
//   RK4         4 evaluations a step, order 4, and a growing error
//
// GM = 1, semi-major axis 1 (so an orbit takes 2π), eccentricity 0.5, from the nearest point. The error is the largest
// energy error so far, relative to the initial energy; half a kick moves v to the time of x.
#include <cmath>
#include <numbers>

#include "01_leapfrog/leapfrog.hpp"
#include "machinery/experiment.hpp"

namespace spook::plots {
namespace {

constexpr double eccentricity = 0.5;
constexpr double period = 2 * std::numbers::pi;

struct State {
  Vec3 x, v;
};

Vec3 acceleration(const Vec3& x) {
  return -x / std::pow(x.norm(), 3);
}

double energy(const State& s) {
  return s.v.squaredNorm() / 2 - 1 / s.x.norm();
}

State nearest_point() {
  return {Vec3(1 - eccentricity, 0, 0), Vec3(0, std::sqrt((1 + eccentricity) / (1 - eccentricity)), 0)};
}

/// Advances by h. Leapfrog's v is half a step behind.
using Step = State (*)(const State&, double h);

State leapfrog(const State& s, double h) {
  const Vec3 v = kick(s.v, acceleration(s.x), 1, h);
  return {drift(s.x, v, h), v};
}

State euler(const State& s, double h) {
  return {s.x + h * s.v, s.v + h * acceleration(s.x)};
}

State rk4(const State& s, double h) {
  const auto rate = [](const State& at) { return State{at.v, acceleration(at.x)}; };
  const auto onward = [&](const State& slope, double step) {
    return State{s.x + step * slope.x, s.v + step * slope.v};
  };
  const State a = rate(s), b = rate(onward(a, h / 2)), c = rate(onward(b, h / 2)), d = rate(onward(c, h));
  return {s.x + h / 6 * (a.x + 2 * b.x + 2 * c.x + d.x), s.v + h / 6 * (a.v + 2 * b.v + 2 * c.v + d.v)};
}

struct Method {
  std::string name;
  Step step;
  int evaluations;  // a step
  bool staggered;
};

const std::vector<Method> methods = {
    {"leapfrog", leapfrog, 1, true}, {"explicit Euler", euler, 1, false}, {"RK4", rk4, 4, false}};

/// The largest energy error of each orbit, relative.
std::vector<double> errors_by_orbit(const Method& method, int evaluations_per_orbit, int orbits) {
  const int steps = evaluations_per_orbit / method.evaluations;
  const double h = period / steps;
  State s = nearest_point();
  const double E = energy(s);
  if (method.staggered) s.v = half_step_start(s.v, acceleration(s.x), 1, h);
  std::vector<double> errors;
  for (int orbit = 0; orbit < orbits; ++orbit) {
    double worst = 0;
    for (int n = 0; n < steps; ++n) {
      s = method.step(s, h);
      const Vec3 v = method.staggered ? half_step_start(s.v, acceleration(s.x), 1, -h) : s.v;
      worst = std::max(worst, std::abs(energy({s.x, v}) / E - 1));
    }
    errors.push_back(worst);
  }
  return errors;
}

Experiment experiment(Size size) {
  Experiment e;
  e.columns = {"method", "evaluations an orbit", "orbit", "energy error"};
  const int finest = size == Size::quick ? 3200 : 25600;
  const int orbits = size == Size::quick ? 100 : 1000;
  for (const Method& method : methods) {
    for (int evaluations = 100; evaluations <= finest; evaluations *= 2)
      e.points.push_back({method.name + ", " + std::to_string(evaluations), [=]() -> std::vector<Row> {
                            const double error = errors_by_orbit(method, evaluations, 1).back();
                            return {{method.name, double(evaluations), 1.0, error}};
                          }});
    e.points.push_back(
        {method.name + ", many orbits", [=] {
           const auto errors = errors_by_orbit(method, 1000, orbits);
           std::vector<Row> rows;
           for (int orbit = 2; orbit <= orbits; orbit = std::max(orbit + 1, orbit * 5 / 4))
             rows.push_back({method.name, 1000.0, double(orbit), errors[std::size_t(orbit - 1)]});
           return rows;
         }});
  }
  e.check = [](const Table& table, Claims& claims) {
    const auto slope = [&](const std::string& method) {
      const Table first = table.where("method", method).where("orbit", 1);
      return last_log_log_slope(first.numbers("evaluations an orbit"), first.numbers("energy error"));
    };
    claims.near("the energy error of leapfrog falls with the second power of the cost: slope -2.0 ± 0.1",
                slope("leapfrog"), -2, 0.1);
    claims.near("that of RK4 falls with the fourth power: slope -4.0 ± 0.2", slope("RK4"), -4, 0.2);
    claims.between("that of explicit Euler falls with the first power at best: slope between -1.1 and 0",
                   slope("explicit Euler"), -1.1, 0);
    const auto growth = [&](const std::string& method) {
      const Table long_run = table.where("method", method).where("evaluations an orbit", 1000);
      const auto errors = long_run.numbers("energy error");
      return errors.back() / errors.front();
    };
    claims.near(
        "the error of leapfrog does not grow over many orbits: the last orbit has 1.00 ± 0.01 times the error "
        "of the second",
        growth("leapfrog"), 1, 0.01);
    claims.at_least(
        "the error of RK4 grows all the way: the last orbit has more than 20 times the error of the second",
        growth("RK4"), 20);
  };
  return e;
}

}  // namespace
}  // namespace spook::plots

int main(int argc, char** argv) {
  return spook::plots::run_experiment(argc, argv, spook::plots::experiment);
}
