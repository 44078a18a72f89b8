// Soft steps of large structures: operations for each cube of larger and larger fields, and pyramids that stand.
//
//   updates     row updates in a step, for each cube of a field of pyramids with ten cubes in the lowest layer
//   pairs       pairs that the search looks at in a step, for each cube
//   contacts    contacts for each cube
//   sunk        depth of the top of a pyramid after 1,000 steps [m]
//   tower       depth of the top of a tower as high: Eq. (10.18) for each of its contacts [m]
//   sideways    farthest that a cube of the pyramid has moved sideways [m]
//   speed       largest speed of a cube of the pyramid [m/s]
//   stood       farthest that the top of a pushed tower moves sideways in a minute [m], below the limit of Eq. (10.22)
//   fell        the same, above the limit
//
// All cubes have sides of 1 m and 100 kg, and touch exactly; μ is 0.6. A step of 1/60 s has four substeps.
#include <algorithm>
#include <cmath>

#include "engine/world/world.hpp"
#include "machinery/experiment.hpp"
#include "scenes/scene.hpp"

namespace spook::plots {
namespace {

constexpr double g = 9.81, h = 1.0 / 60;

World<6> on_a_floor() {
  World<6> world({.friction = 0.6, .soft_steps = SoftSteps{}});
  world.add_plane(Vec3::UnitZ(), 0);
  return world;
}

/// Adds a pyramid with its lowest course along x.
void add_pyramid(World<6>& world, int base, const Vec3& corner) {
  for (int course = 0; course < base; ++course)
    for (int k = 0; k < base - course; ++k)
      world.add({.x = corner + Vec3(k + course / 2.0, 0, course + 0.5),
                 .mass = 100,
                 .half_sides = Vec3::Constant(0.5)});
}

/// Pyramids in rows, a metre apart.
std::vector<Row> of_field(int rows, int columns) {
  World<6> world = on_a_floor();
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) add_pyramid(world, 10, Vec3(11 * column, 2 * row, 0));
  const double n = static_cast<double>(world.bodies().size()) - 1;
  world.step(h);
  const std::int64_t before = world.row_updates();
  for (int step = 0; step < 2; ++step) world.step(h);
  return {{"updates", n, static_cast<double>(world.row_updates() - before) / 2 / n},
          {"pairs", n, world.report().pairs / n},
          {"contacts", n, static_cast<double>(world.contacts().size()) / n}};
}

/// Returns the depth to which the top of a tower of equal cubes sinks: Eq. (10.18), where four corners share the load of a cube.
double sinking_of_tower(int cubes) {
  const SoftSteps steps;
  const double omega = steps.contacts.turn() * steps.substeps / h;
  return (cubes + 1.0 * cubes * (cubes - 1)) * g / (omega * omega);
}

std::vector<Row> of_pyramid(int base) {
  World<6> world = on_a_floor();
  add_pyramid(world, base, Vec3::Zero());
  const std::vector<Vec3> before = world.bodies().x;
  for (int step = 0; step < 1000; ++step) world.step(h);
  double sideways = 0, fastest = 0;
  for (std::size_t b = 0; b < before.size(); ++b) {
    sideways = larger(sideways, (world.bodies().x[b] - before[b]).head<2>().norm());
    fastest = larger(fastest, world.bodies().motion.W[b].head<3>().norm());
  }
  const double n = base;
  return {{"sunk", n, (before.back() - world.bodies().x.back()).z()},
          {"tower", n, sinking_of_tower(base)},
          {"sideways", n, sideways},
          {"speed", n, fastest}};
}

/// Returns how far the top of a tower moves sideways in a minute after a push [m].
double lean_of_tower(int cubes, int substeps) {
  World<6> world({.friction = 0.6, .soft_steps = SoftSteps{.substeps = substeps}});
  world.add_plane(Vec3::UnitZ(), 0);
  int top = 0;
  for (int k = 0; k < cubes; ++k)
    top = world.add({.x = Vec3(0, 0, k + 0.5),
                     .v = Vec3(0, 1e-4 * (k + 0.5) / cubes, 0),
                     .mass = 100,
                     .half_sides = Vec3::Constant(0.5)});
  double most = 0;
  for (int step = 0; step < 3600; ++step) {
    world.step(h);
    most = larger(most, world.x(top).head<2>().norm());
  }
  return most;
}

/// Returns the leans of a tower a little below the limit of Eq. (10.22), and of one a little above it.
std::vector<Row> of_towers(int substeps) {
  const double omega = SoftSteps{}.contacts.turn() * substeps / h, limit = std::cbrt(0.98 * omega * omega / g);
  const int low = static_cast<int>(std::floor(0.95 * limit)), high = static_cast<int>(std::ceil(1.07 * limit));
  return {{"stood", static_cast<double>(low), lean_of_tower(low, substeps)},
          {"fell", static_cast<double>(high), lean_of_tower(high, substeps)}};
}

Experiment experiment(Size size) {
  const bool full = size == Size::full;
  const std::vector<std::pair<int, int>> fields =
      full ? std::vector<std::pair<int, int>>{{3, 6}, {8, 9}, {17, 17}, {34, 34}}
           : std::vector<std::pair<int, int>>{{1, 2}, {2, 4}};
  Experiment e;
  e.columns = {"what", "n", "value"};
  for (const auto& [rows, columns] : fields)
    e.points.push_back({"field " + std::to_string(rows) + " x " + std::to_string(columns),
                        [rows = rows, columns = columns] { return of_field(rows, columns); }});
  for (const int base : full ? std::vector<int>{5, 10, 20} : std::vector<int>{5, 10})
    e.points.push_back({"pyramid " + std::to_string(base), [base] { return of_pyramid(base); }});
  for (const int substeps : {4, 8})
    e.points.push_back({"towers " + std::to_string(substeps), [substeps] { return of_towers(substeps); }});
  e.check = [](const Table& table, Claims& claims) {
    const auto of = [&](const std::string& what) { return table.where("what", what).numbers("value"); };
    const auto growth = [&](const std::string& what) { return of(what).back() / of(what).front(); };
    claims.near("in the largest field a step makes as many row updates for each cube as in the smallest",
                growth("updates"), 1, 0.01);
    claims.at_most("the search examines at most 1.1 times as many pairs for each cube", growth("pairs"), 1.1);
    double sunk = 0, sideways = 0, fastest = 0;
    const std::vector<double> pyramids = of("sunk"), towers = of("tower");
    for (std::size_t k = 0; k < pyramids.size(); ++k) sunk = larger(sunk, pyramids[k] / towers[k]);
    for (const double way : of("sideways")) sideways = larger(sideways, way);
    for (const double speed : of("speed")) fastest = larger(fastest, speed);
    claims.at_most("no pyramid's top sinks farther than the top of a tower as high", sunk, 1);
    claims.at_most("no cube of a pyramid moves sideways by a twentieth of its side in 1,000 steps", sideways,
                   0.05);
    claims.at_most("after 1,000 steps no cube moves faster than a centimetre a second", fastest, 0.01);
    const std::vector<double> stood = of("stood"), fell = of("fell");
    claims.at_most("towers of 19 cubes with four substeps, and of 31 with eight, stand for a minute",
                   *std::max_element(stood.begin(), stood.end()), 0.05);
    claims.at_least("towers of 23 cubes with four substeps, and of 36 with eight, fall in that time",
                    *std::min_element(fell.begin(), fell.end()), 1);
  };
  return e;
}

}  // namespace
}  // namespace spook::plots

int main(int argc, char** argv) {
  return spook::plots::run_experiment(argc, argv, spook::plots::experiment);
}
