// Rotation updates on an asymmetric top without torques: the error of its orientation against steps and nanoseconds.
//
//   first order    Eq. (2.4), with the gyroscopic torque (2.9) at the old ω
//   exponential    Eq. (2.6), the same
//   splitting      Eq. (2.11)
//   no torque      Eq. (2.4), as in the notes: keeps ω constant instead of L
//
// I = (1, 2, 3), ω = (0.3, 1, 0.2), 10 s. The answer is an integration of q' = ½ ω q with ω = I(q)⁻¹ L by RK4 in steps
// of 1/4000 s; its own error, by halving them, is below 1e-12.
#include <cmath>

#include "02_quaternions/quaternions.hpp"
#include "machinery/experiment.hpp"
#include "machinery/timing.hpp"

namespace spook::plots {
namespace {

const Vec3 principal(1, 2, 3);
const Vec3 first_omega(0.3, 1, 0.2);
constexpr double duration = 10;

struct Turning {
  Quat q = Quat::Identity();
  Vec3 omega = first_omega;
};

using Step = void (*)(Turning&, double h);

void gyroscopic_kick(Turning& t, double h) {
  const Mat3 I = world_inertia(t.q, principal);
  t.omega += h * world_inertia(t.q, principal.cwiseInverse()) * gyroscopic_torque(I, t.omega);
}

struct Method {
  std::string name;
  Step step;
};

const std::vector<Method> methods = {
    {"first order",
     [](Turning& t, double h) {
       gyroscopic_kick(t, h);
       t.q = update_first_order(t.q, t.omega, h);
     }},
    {"exponential",
     [](Turning& t, double h) {
       gyroscopic_kick(t, h);
       t.q = update_exponential(t.q, t.omega, h);
     }},
    {"splitting", [](Turning& t, double h) { free_rotation(t.q, t.omega, principal, h); }},
    {"no torque", [](Turning& t, double h) { t.q = update_first_order(t.q, t.omega, h); }}};

Turning turned(const Method& method, int steps) {
  Turning t;
  for (int n = 0; n < steps; ++n) method.step(t, duration / steps);
  return t;
}

/// Integrates by RK4, with constant L.
Quat answer(int steps) {
  const Vec3 L = principal.asDiagonal() * first_omega;
  const auto rate = [&](const Quat& q) {
    const Vec3 omega = world_inertia(q, principal.cwiseInverse()) * L;
    return Eigen::Vector4d(0.5 * (Quat(0, omega.x(), omega.y(), omega.z()) * q).coeffs());
  };
  const auto at = [](const Eigen::Vector4d& coeffs) { return Quat(coeffs).normalized(); };
  Eigen::Vector4d q = Quat::Identity().coeffs();
  const double h = duration / steps;
  for (int n = 0; n < steps; ++n) {
    const Eigen::Vector4d a = rate(at(q)), b = rate(at(q + h / 2 * a)), c = rate(at(q + h / 2 * b)),
                          d = rate(at(q + h * c));
    q = at(q + h / 6 * (a + 2 * b + 2 * c + d)).coeffs();
  }
  return at(q);
}

Experiment experiment(Size size) {
  static const Quat right = answer(40'000);
  Experiment e;
  e.timed = true;
  e.columns = {"method", "steps", "error [rad]", "ns a step", "quartile below", "quartile above"};
  for (const Method& method : methods)
    for (int steps = 200; steps <= (size == Size::quick ? 3200 : 51200); steps *= 2)
      e.points.push_back({method.name + " " + std::to_string(steps), [=]() -> std::vector<Row> {
                            const double error = turned(method, steps).q.angularDistance(right);
                            const Timing time = time_each(steps, size == Size::quick ? 3 : 15, [&] {
                              volatile double kept = turned(method, steps).q.w();
                              static_cast<void>(kept);
                            });
                            return {{method.name, double(steps), error, time.median, time.low, time.high}};
                          }});
  e.check = [](const Table& table, Claims& claims) {
    const auto order = [&](const std::string& method) {
      const Table some = table.where("method", method);
      return -last_log_log_slope(some.numbers("steps"), some.numbers("error [rad]"));
    };
    const auto last = [&](const std::string& method) {
      return table.where("method", method).numbers("error [rad]").back();
    };
    claims.near("the splitting has order 2.0 ± 0.1", order("splitting"), 2, 0.1);
    claims.near("the first-order update with the torque at the old ω has order 1.0 ± 0.1", order("first order"),
                1, 0.1);
    claims.near("the exponential update has order 1.0 ± 0.1, too, because its torque is explicit",
                order("exponential"), 1, 0.1);
    claims.at_least("without the torque no step is small enough: the error stays above 0.1 rad",
                    last("no torque"), 0.1);
  };
  return e;
}

}  // namespace
}  // namespace spook::plots

int main(int argc, char** argv) {
  return spook::plots::run_experiment(argc, argv, spook::plots::experiment);
}
