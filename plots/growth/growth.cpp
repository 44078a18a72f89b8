// The cost of larger scenes: time and memory per link, body and contact; and the gain by a second thread.
//
//   link       a hanging wire, solved directly: time of a step per link [us], and the top link's tension over the
//              weight below
//   body       balls in a pyramid's layers between walls, 20 sweeps a step of 1/240 s: time of a step per ball [us],
//              in the given order, in stripes, and in stripes on two threads
//   stands     after a second: the mean depth of the balls, in radii, and the largest speed [m/s]
//   memory     per link, ball, and contact with friction [bytes]
//   same       1 if two threads give the same bits as one, else 0
#ifdef __APPLE__
#include <malloc/malloc.h>
#else
#include <malloc.h>
#endif

#include <cmath>
#include <map>

#include "engine/world/world.hpp"
#include "machinery/experiment.hpp"
#include "machinery/timing.hpp"
#include "scenes/scene.hpp"

namespace spook::plots {
namespace {

constexpr double g = 9.81, h = 1.0 / 240, radius = 0.1;

/// Returns the size of all allocated memory [bytes].
double allocated() {
#ifdef __APPLE__
  malloc_statistics_t all;
  malloc_zone_statistics(nullptr, &all);
  return static_cast<double>(all.size_in_use);
#else
  const struct mallinfo2 all = mallinfo2();
  return static_cast<double>(all.uordblks + all.hblkhd);
#endif
}

/// A wire so stiff that a pull at the top reaches the end within a step.
World<3> wire(int links) {
  World<3> world({.k = 1e13 * links * links, .solver = direct<3>()});
  int above = world.add_fixed(Vec3::Zero());
  for (int k = 1; k <= links; ++k) {
    const int below = world.add({.x = Vec3(0, 0, -0.1 * k), .mass = 1});
    world.add_joint({.i = above, .j = below, .length = 0.1});
    above = below;
  }
  return world;
}

std::vector<Row> of_wire(int links, bool timed) {
  const double before = allocated();
  World<3> world = wire(links);
  world.step(h);
  const double bytes = allocated() - before, n = links;
  std::vector<Row> rows = {{"link", "tension", n, world.joint_force(0).norm() / (n * g)},
                           {"memory", "link", n, bytes / n}};
  if (timed) rows.push_back({"link", "time", n, time_each(n, 5, [&] { world.step(h); }).low / 1e3});
  return rows;
}

/// Square layers, each ball on four of the layer below; all balls touch, and the floor and the walls support them.
World<6> stack(int across, int layers, const Solver<6>& solver, int threads, double apart = 1) {
  World<6> world({.k = 1e6,
                  .friction = 0.5,
                  .solver = solver,
                  .warm_start = true,
                  .threads = threads,
                  .solver_limits = {.max_sweeps = 20}});
  const double half = apart * radius * across;
  world.add_plane(Vec3::UnitZ(), 0);
  for (const Vec3& inwards : {Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 1, 0), Vec3(0, -1, 0)})
    world.add_plane(inwards, -half);
  for (int z = 0; z < layers; ++z) {
    const int shift = z % 2, side = across - shift;
    const auto place = [&](int k) { return apart * radius * (2 * k + 1 + shift) - half; };
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x)
        world.add({.x = Vec3(place(x), place(y), radius * (1 + apart * std::sqrt(2) * z)),
                   .mass = 1,
                   .radius = radius,
                   .principal = Vec3::Constant(0.4 * radius * radius)});
  }
  return world;
}

double balls(const World<6>& world) {
  return static_cast<double>(world.bodies().size()) - 5;
}

std::vector<Row> of_memory(int across, int layers) {
  double before = allocated();
  World<6> alone = stack(across, layers, spatial_decomposition<6>(), 1, 1.2);
  alone.add_plane(-Vec3::UnitZ(), -1e3);
  alone.step(h);
  const double n = balls(alone) - 1, a_ball = (allocated() - before) / n;
  before = allocated();
  World<6> touching = stack(across, layers, spatial_decomposition<6>(), 1);
  for (int k = 0; k < 2; ++k) touching.step(h);
  const double all = allocated() - before, contacts = static_cast<double>(touching.contacts().size());
  return {{"memory", "ball", n, a_ball}, {"memory", "contact", n, (all - n * a_ball) / contacts}};
}

std::vector<Row> of_standing(int across, int layers) {
  World<6> world = stack(across, layers, spatial_decomposition<6>(), 2);
  const std::vector<Vec3> before = world.bodies().x;
  for (int n = 0; n < 240; ++n) world.step(h);
  double fastest = 0, sunk = 0;
  for (std::size_t b = 0; b < before.size(); ++b) {
    fastest = larger(fastest, world.v(static_cast<int>(b)).norm());
    sunk += (before[b] - world.bodies().x[b]).z();
  }
  return {{"stands", "fastest", balls(world), fastest},
          {"stands", "sunk", balls(world), sunk / balls(world) / radius}};
}

std::vector<Row> of_threads(int across, int layers) {
  World<6> one = stack(across, layers, spatial_decomposition<6>(), 1),
           two = stack(across, layers, spatial_decomposition<6>(), 2);
  bool same = true;
  for (int n = 0; n < 5; ++n) {
    one.step(h);
    two.step(h);
    same = same && one.bodies().x == two.bodies().x && one.solved().history == two.solved().history;
  }
  return {{"same", "bits", balls(one), same ? 1.0 : 0.0}};
}

std::vector<Row> of_times(int across, int layers) {
  World<6> swept = stack(across, layers, gauss_seidel<6>(), 1),
           one = stack(across, layers, spatial_decomposition<6>(), 1),
           two = stack(across, layers, spatial_decomposition<6>(), 2);
  const double n = balls(swept);
  const std::vector<std::pair<std::string, World<6>*>> ways = {
      {"as given", &swept}, {"spatial_decomposition", &one}, {"two threads", &two}};
  for (const auto& [name, world] : ways)
    for (int step = 0; step < 10; ++step) world->step(h);  // until all contacts exist
  // In turns, so that other load of the machine slows all of them alike.
  std::map<std::string, std::vector<double>> times;
  for (int round = 0; round < 25; ++round)
    for (const auto& [name, world] : ways)
      times[name].push_back(time_each(n, 1, [world = world] { world->step(h); }).low / 1e3);
  std::vector<Row> rows;
  for (auto& [name, all] : times) {
    std::nth_element(all.begin(), all.begin() + 6, all.end());
    rows.push_back({"body", name, n, all[6]});
  }
  return rows;
}

struct Stack {
  int across, layers;
};

std::string name_of(const Stack& stack) {
  return std::to_string(stack.across) + " x " + std::to_string(stack.layers);
}

Experiment experiment(Size size) {
  const bool full = size == Size::full;
  const std::vector<int> links =
      full ? std::vector<int>{100, 1000, 10'000, 100'000} : std::vector<int>{100, 1000};
  const std::vector<Stack> small = {{6, 7}, {10, 11}},
                           stacks = full ? std::vector<Stack>{{6, 7}, {10, 11}, {16, 17}, {25, 27}} : small;
  Experiment e;
  e.columns = {"what", "case", "n", "value"};
  e.timed = true;  // allocated memory is measured for one point at a time
  for (const int n : links) e.points.push_back({"wire " + std::to_string(n), [=] { return of_wire(n, full); }});
  for (const Stack& s : stacks) {
    e.points.push_back({"memory " + name_of(s), [s] { return of_memory(s.across, s.layers); }});
    e.points.push_back({"standing " + name_of(s), [s] { return of_standing(s.across, s.layers); }});
    e.points.push_back({"threads " + name_of(s), [s] { return of_threads(s.across, s.layers); }});
  }
  if (full) {
    std::vector<Stack> timed = stacks;
    timed.push_back({40, 42});
    for (const Stack& s : timed)
      e.points.push_back({"times " + name_of(s), [s] { return of_times(s.across, s.layers); }});
  }
  e.check = [](const Table& table, Claims& claims) {
    const auto largest_of = [&](const std::string& what, const std::string& which) {
      double most = 0;
      for (const double value : table.where("what", what).where("case", which).numbers("value"))
        most = larger(most, value);
      return most;
    };
    const std::vector<double> tensions = table.where("what", "link").where("case", "tension").numbers("value");
    double off = 0;
    for (const double tension : tensions) off = larger(off, std::abs(tension - 1));
    claims.at_most("the top link of every wire carries the whole weight of the wire, to 1e-6", off, 1e-6);
    claims.at_most("a link takes less than 1.5 kilobytes of memory, whatever their number",
                   largest_of("memory", "link"), 1500);
    claims.at_most("a ball takes less than 1.5 kilobytes", largest_of("memory", "ball"), 1500);
    claims.at_most("a contact with friction takes less than 2.5 kilobytes", largest_of("memory", "contact"),
                   2500);
    claims.at_most("after a second with 20 sweeps a step every stack is at rest, to 1e-4 m/s",
                   largest_of("stands", "fastest"), 1e-4);
    claims.at_most("in the mean the balls have sunk by less than a fiftieth of a radius",
                   largest_of("stands", "sunk"), 0.02);
    const std::vector<double> same = table.where("what", "same").numbers("value");
    claims.near("two threads give the same bits as one", *std::min_element(same.begin(), same.end()), 1, 0);
  };
  return e;
}

}  // namespace
}  // namespace spook::plots

int main(int argc, char** argv) {
  return spook::plots::run_experiment(argc, argv, spook::plots::experiment);
}
