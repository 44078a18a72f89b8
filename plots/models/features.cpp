// The cost of unused features: a thousand bodies in free fall.
//
//   bare          points, gravity
//   friction      μ is set, but there are no contacts
//   impacts       a restitution is set, but there are no contacts
//   plane         there is ground, but no body has a shape
//   joint         one pair of bodies is joined
//   spheres       a hundred bodies have shapes, so the broad phase runs, but there are no contacts
//   rigid bodies  the same bare fall with 6 degrees of freedom
#include "engine/world/world.hpp"
#include "machinery/experiment.hpp"
#include "machinery/timing.hpp"

namespace spook::plots {
namespace {

constexpr double h = 1.0 / 240;

template <int Dof>
World<Dof> falling(Settings<Dof> settings, int bodies, double radius = 0) {
  World<Dof> world(std::move(settings));
  for (int k = 0; k < bodies; ++k) {
    Body<Dof> body;
    body.x = Vec3(k % 10, k / 10 % 10, k / 100);
    body.radius = radius;
    if constexpr (Dof == 6) body.principal = Vec3::Ones();
    world.add(body);
  }
  return world;
}

template <class Build>
std::vector<Row> measured(const std::string& name, int bodies, bool quick, const Build& build) {
  auto timed = build();
  timed.time_stages();
  timed.step(h);
  double ran = 0;
  for (const std::int64_t runs : timed.stage_times().runs) ran += runs > 0;
  auto world = build();
  const int steps = quick ? 10 : 1000;
  world.step(h);
  const Timing time = time_each(double(steps) * bodies, quick ? 3 : 25, [&] {
    for (int n = 0; n < steps; ++n) world.step(h);
  });
  return {{name, double(bodies), ran, time.median, time.low, time.high}};
}

Experiment experiment(Size size) {
  const bool quick = size == Size::quick;
  Experiment e;
  e.timed = true;
  e.columns = {"feature", "bodies", "stages", "ns a body", "quartile below", "quartile above"};
  const auto add = [&](const std::string& name, int bodies, const auto& build) {
    e.points.push_back({name, [=] { return measured(name, bodies, quick, build); }});
  };
  add("bare", 1000, [] { return falling<3>({}, 1000); });
  add("friction", 1000, [] { return falling<3>({.friction = 0.5}, 1000); });
  add("impacts", 1000, [] { return falling<3>({.impacts = ImpactLaw{.restitution = 0.5}}, 1000); });
  add("plane", 1000, [] {
    World<3> world = falling<3>({}, 1000);
    world.add_plane(Vec3::UnitZ(), -1000);
    return world;
  });
  add("joint", 1000, [] {
    World<3> world = falling<3>({}, 1000);
    world.add_joint({.i = 0, .j = 1, .length = 1});
    return world;
  });
  add("spheres", 100, [] { return falling<3>({}, 100, 0.25); });
  add("rigid bodies", 1000, [] { return falling<6>({}, 1000); });
  e.check = [](const Table& table, Claims& claims) {
    const auto stages = [&](const std::string& feature) {
      return table.where("feature", feature).number("stages");
    };
    double most = 0;
    for (const std::string feature : {"bare", "friction", "impacts", "plane", "rigid bodies"})
      most = std::max(most, stages(feature));
    claims.near(
        "if no moving body has a shape, only forces and integration run: 2 stages, even with friction, impacts "
        "and ground",
        most, 2, 0);
    claims.near("one joint adds rows and a solve: 4 stages", stages("joint"), 4, 0);
  };
  return e;
}

}  // namespace
}  // namespace spook::plots

int main(int argc, char** argv) {
  return spook::plots::run_experiment(argc, argv, spook::plots::experiment);
}
