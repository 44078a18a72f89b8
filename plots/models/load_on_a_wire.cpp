// Model only what a scene needs: the same load on the same wire, in models of increasing detail.
//
//   row        a point on a distance to its anchor: one row
//   points     a wire of N links, points with distances, the load at its end
//   bodies     the same of rigid bodies (thin rods), with ball joints
//
// A load of 1 kg on a wire of 1 m and 10 g, released at 30° from rest, for 2 s. The answer: a straight wire is a rod. A
// rod with a load is a pendulum of length l' = l (M + m/3)/(M + m/2), integrated by RK4 in steps of 1/24,000 s. (A wire
// may bend; under a load of 100:1 it is straight up to 1e-3 of its length.) The error is that of the load's position.
#include <cmath>
#include <numbers>

#include "engine/world/world.hpp"
#include "machinery/experiment.hpp"
#include "machinery/timing.hpp"

namespace spook::plots {
namespace {

constexpr double g = 9.81, length = 1, load = 1, wire_mass = 0.01, first_angle = std::numbers::pi / 6;
constexpr double duration = 2;

Vec3 at_angle(double angle, double r) {
  return r * Vec3(std::sin(angle), 0, -std::cos(angle));
}

/// Returns the angles at t = 0, h, 2h, ... by RK4.
std::vector<double> answer(double h) {
  const double effective = length * (load + wire_mass / 3) / (load + wire_mass / 2);
  const auto acceleration = [&](double angle) { return -g / effective * std::sin(angle); };
  std::vector<double> angles;
  double angle = first_angle, rate = 0;
  const int substeps = static_cast<int>(std::ceil(h * 24'000));
  const double dt = h / substeps;
  for (int n = 0; n <= static_cast<int>(std::lround(duration / h)); ++n) {
    angles.push_back(angle);
    for (int k = 0; k < substeps; ++k) {
      const double a1 = rate, b1 = acceleration(angle);
      const double a2 = rate + dt / 2 * b1, b2 = acceleration(angle + dt / 2 * a1);
      const double a3 = rate + dt / 2 * b2, b3 = acceleration(angle + dt / 2 * a2);
      const double a4 = rate + dt * b3, b4 = acceleration(angle + dt * a3);
      angle += dt / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
      rate += dt / 6 * (b1 + 2 * b2 + 2 * b3 + b4);
    }
  }
  return angles;
}

template <int Dof>
Settings<Dof> settings(int sweeps) {
  return {.gravity = Vec3(0, 0, -g),
          .k = 1e9,
          .solver = gauss_seidel<Dof>(),
          .solver_limits = {.max_sweeps = sweeps}};
}

/// Builds a world with the load as its last body.
World<3> row_model() {
  World<3> world(settings<3>(1));
  world.add_fixed(Vec3::Zero());
  world.add({.x = at_angle(first_angle, length), .mass = load + wire_mass / 2});
  world.add_joint({.i = 0, .j = 1, .length = length});
  return world;
}

World<3> points_model(int links, int sweeps) {
  World<3> world(settings<3>(sweeps));
  const Net net = rope(Vec3::Zero(), at_angle(first_angle, length), links, wire_mass);
  world.add_fixed(net.x[0]);
  for (int point = 1; point <= links; ++point) {
    const auto p = static_cast<std::size_t>(point);
    world.add({.x = net.x[p], .mass = net.mass[p] + (point == links ? load : 0)});
  }
  for (const Link& link : net.links) world.add_joint({.i = link.i, .j = link.j, .length = link.length});
  return world;
}

World<6> bodies_model(int links, int sweeps) {
  World<6> world(settings<6>(sweeps));
  const double piece = length / links, mass = wire_mass / links, radius = 0.002;
  // Turned about y so that the rod's own x axis lies along the wire.
  const Quat q(Eigen::AngleAxisd(std::numbers::pi / 2 - first_angle, Vec3::UnitY()));
  world.add_fixed(Vec3::Zero());
  for (int link = 0; link < links; ++link)
    world.add(
        {.x = at_angle(first_angle, (link + 0.5) * piece),
         .mass = mass,
         .q = q,
         .principal = Vec3(mass * radius * radius / 2, mass * piece * piece / 12, mass * piece * piece / 12)});
  world.add({.x = at_angle(first_angle, length), .mass = load, .principal = Vec3::Constant(1e-4)});
  const Vec3 end(piece / 2, 0, 0);
  for (int link = 0; link <= links; ++link)
    world.add_joint({.i = link,
                     .j = link + 1,
                     .p_i = link == 0 ? Vec3(0, 0, 0) : end,
                     .p_j = link == links ? Vec3(0, 0, 0) : Vec3(-end)});
  return world;
}

template <int Dof>
double largest_error(World<Dof>& world, double h, const std::vector<double>& angles) {
  const int body = static_cast<int>(world.bodies().size()) - 1;
  double worst = 0;
  for (std::size_t n = 1; n < angles.size(); ++n) {
    try {
      world.step(h);
    } catch (const SimulationDiverged&) {
      return std::numeric_limits<double>::infinity();
    }
    worst = std::max(worst, (world.x(body) - at_angle(angles[n], length)).norm());
  }
  return worst;
}

/// Returns the largest stable step, 2/ω of Eq. (1.8). A point of a light wire under tension T oscillates across the
/// wire with ω = √(4T/(m l)).
double largest_step(int links) {
  const double m = wire_mass / links, l = length / links;
  return 2 / std::sqrt(4 * load * g / (m * l));
}

template <class Build>
std::vector<Row> measured(const std::string& name, int links, double h, int sweeps, bool quick,
                          const Build& build) {
  const std::vector<double> angles = answer(h);
  auto world = build();
  const double error = largest_error(world, h, angles);
  const int steps = static_cast<int>(angles.size()) - 1;
  const Timing time = time_each(duration, quick ? 1 : 3, [&] {
    auto timed = build();
    for (int n = 0; n < steps && std::isfinite(error); ++n) timed.step(h);
  });
  return {{name, double(links), h, double(sweeps), error / length, time.median / 1000, time.low / 1000,
           time.high / 1000, double(world.row_updates()) / duration}};
}

Experiment experiment(Size size) {
  const bool quick = size == Size::quick;
  Experiment e;
  e.timed = true;
  e.columns = {"model",          "links",          "h",
               "sweeps",         "error",          "us a second",
               "quartile below", "quartile above", "row updates a second"};
  for (const double rate : {60.0, 240.0, 1000.0, 4000.0}) {
    const double h = 1 / rate;
    e.points.push_back({"row " + std::to_string(rate),
                        [=] { return measured("row", 1, h, 1, quick, [] { return row_model(); }); }});
    for (const int links : {10, 100})
      for (int sweeps = 10; sweeps <= 10'000; sweeps *= 10) {
        if (links * sweeps * duration * rate > (quick ? 3e6 : 1e8)) continue;
        const std::string text =
            std::to_string(links) + " " + std::to_string(sweeps) + " " + std::to_string(rate);
        e.points.push_back({"points " + text, [=] {
                              return measured("points", links, h, sweeps, quick,
                                              [=] { return points_model(links, sweeps); });
                            }});
        e.points.push_back({"bodies " + text, [=] {
                              return measured("bodies", links, h, sweeps, quick,
                                              [=] { return bodies_model(links, sweeps); });
                            }});
      }
  }
  e.check = [](const Table& table, Claims& claims) {
    const Table row = table.where("model", "row").where("h", 1.0 / 60);
    claims.at_most("with one row the error of the load is at most 2 per cent of the wire's length at h = 1/60",
                   row.number("error"), 0.02);
    const Table ten = table.where("model", "points").where("links", 10);
    const auto least = [](const Table& some) {
      const auto errors = some.numbers("error");
      return *std::min_element(errors.begin(), errors.end());
    };
    claims.between("for ten points the limit 2/ω is between steps of 1/240 and 1/1000", largest_step(10),
                   1.0 / 1000, 1.0 / 240);
    claims.at_least(
        "at 1/240 the ten points are lost with any number of sweeps: the error exceeds the wire's length",
        least(ten.where("h", 1.0 / 240)), 1);
    const Table fine = ten.where("h", 1.0 / 1000);
    claims.at_most("at 1/1000 their error is at most 1 per cent", least(fine), 0.01);
    double cheapest = std::numeric_limits<double>::infinity();
    for (const std::string model : {"points", "bodies"}) {
      const Table wires = table.where("model", model);
      const auto errors = wires.numbers("error"), updates = wires.numbers("row updates a second");
      for (std::size_t n = 0; n < errors.size(); ++n)
        if (errors[n] <= 0.02) cheapest = std::min(cheapest, updates[n]);
    }
    claims.at_least(
        "the cheapest wire of points with an error of at most 2 per cent takes more than 1000 times the row "
        "updates of the one row",
        cheapest / row.number("row updates a second"), 1000);
  };
  return e;
}

}  // namespace
}  // namespace spook::plots

int main(int argc, char** argv) {
  return spook::plots::run_experiment(argc, argv, spook::plots::experiment);
}
