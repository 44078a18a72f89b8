// Momentum lost without the second term of (22), and convergence of mechanisms with the step.
//
//   momentum   angular momentum of a bead on a freely rotating rod, over its initial value, with the second term of
//              (13.6) and without. Without this term the rod keeps its ω, so that r = r0 cosh ωt, and
//              L/L0 = (I + m r²)/(I + m r0²)
//   error      largest error of a scene so far, in its unit
#include <cmath>

#include "13_mechanisms/mechanisms.hpp"
#include "machinery/experiment.hpp"
#include "scenes/registry.hpp"
#include "scenes/run.hpp"

namespace spook::plots {
namespace {

constexpr double inertia = 1, mass = 1, r0 = 0.1, spin = 5, end = 0.6;

/// Returns L/L0 against time. The row across the rod is solved exactly in each step.
std::vector<Row> momentum(const std::string& which, double h, int every) {
  double angle = 0, omega = spin;
  Vec3 x(r0, 0, 0), v(0, r0 * spin, 0);
  const auto L = [&] { return inertia * omega + mass * x.cross(v).z(); };
  const double start = L();
  std::vector<Row> rows;
  for (int n = 0; n <= std::lround(end / h); ++n) {
    if (n % every == 0) rows.push_back({which, h, n * h, L() / start});
    const JointFrame rod{{.body = 0, .x = Vec3::Zero()}, Quat(Eigen::AngleAxisd(angle, Vec3::UnitZ()))};
    const JointFrame bead{{.body = 1, .x = x}, Quat::Identity()};
    const Coordinate across = shift_along(rod, bead, 1);
    const Vec3 along = across.Gj.head<3>();
    // With its own point the rod's lever arm would be r_i, which is 0.
    const double arm = which == "with" ? across.Gi[5] : 0;
    const double lambda =
        -(across.value / h + arm * omega + along.dot(v)) / (arm * arm / inertia + along.squaredNorm() / mass);
    omega += arm * lambda / inertia;
    v += along * lambda / mass;
    angle += h * omega;
    x += h * v;
  }
  return rows;
}

double error_of(const std::string& name, double h) {
  const SceneDescription& description = find_scene(name);
  const auto scene =
      description.build(Parameters(description.parameters), {.h = h, .solver = description.solver});
  scene->observe();
  for (std::int64_t n = 0; n < step_count(h, description.time); ++n) {
    scene->advance(1);
    scene->observe();
  }
  return scene->error();
}

const std::vector<std::string> scenes_of_order_two = {"door", "physical_pendulum", "gyroscope", "bead"};

Experiment experiment(Size size) {
  Experiment e;
  e.columns = {"what", "h [s]", "time [s]", "value"};
  for (const std::string which : {"with", "without"})
    for (const double h : {1e-3, 1e-4})
      e.points.push_back({which + " " + std::to_string(h), [=]() -> std::vector<Row> {
                            return momentum(which, h, static_cast<int>(std::lround(0.01 / h)));
                          }});
  const std::vector<double> steps =
      size == Size::quick ? std::vector<double>{500, 1000} : std::vector<double>{125, 250, 500, 1000};
  for (const std::string& name : scenes_of_order_two)
    for (const double a_second : steps)
      e.points.push_back({name + " " + std::to_string(a_second), [=]() -> std::vector<Row> {
                            return {{name, 1 / a_second, 0.0, error_of(name, 1 / a_second)}};
                          }});
  e.check = [](const Table& table, Claims& claims) {
    const auto at_end = [&](const std::string& which, double h) {
      return table.where("what", which).where("h [s]", h).numbers("value").back();
    };
    claims.near("with the second term the angular momentum of rod and bead stays constant, to 1e-11",
                at_end("with", 1e-3), 1, 1e-11);
    const double r = r0 * std::cosh(spin * end);
    const double predicted = (inertia + mass * r * r) / (inertia + mass * r0 * r0);
    claims.near(
        "without it the rod turns on as fast as before: after 0.6 s the angular momentum is 1.99 ± 0.01 times "
        "as large",
        at_end("without", 1e-4), predicted, 0.005);
    claims.near("a ten times smaller step changes this factor by less than 3 per cent",
                at_end("without", 1e-3) / at_end("without", 1e-4), 1, 0.03);
    for (const std::string& name : scenes_of_order_two) {
      const Table some = table.where("what", name);
      claims.near("the error of " + name + " falls with h²: slope 2.0 ± 0.1",
                  last_log_log_slope(some.numbers("h [s]"), some.numbers("value")), 2, 0.1);
    }
  };
  return e;
}

}  // namespace
}  // namespace spook::plots

int main(int argc, char** argv) {
  return spook::plots::run_experiment(argc, argv, spook::plots::experiment);
}
