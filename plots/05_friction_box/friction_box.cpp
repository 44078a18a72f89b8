// Strength of the friction box by direction, Eq. (5.12), (5.13), and the steepest slope on which a block sticks, Eq.
// (5.9).
//
//   push       the smallest force along a direction that moves a block at rest, over m g
//   distance   the sliding distance of a block thrown at v0 in that direction, over v0²/(2 μ g)
//   slope      the smallest μ with which a block stays on a slope
//
// A point mass on a plane; directions are from the first tangent, φ = 0. Thresholds are found by bisection.
#include <cmath>
#include <numbers>

#include "engine/world/world.hpp"
#include "machinery/experiment.hpp"

namespace spook::plots {
namespace {

constexpr double g = 9.81, mu = 0.5, radius = 0.5, k = 1e6;

Vec3 direction(double phi) {
  const Tangents t = tangents(Vec3::UnitZ());
  return std::cos(phi) * t.t1 + std::sin(phi) * t.t2;
}

World<3> block(double friction, const Vec3& gravity, ForceField force = nullptr, const Vec3& v = Vec3::Zero()) {
  World<3> world({.gravity = gravity,
                  .force = std::move(force),
                  .k = k,
                  .friction = friction,
                  .viscosity = infinity,
                  .solver = gauss_seidel<3>()});
  world.add_plane(Vec3::UnitZ(), 0);
  world.add({.x = Vec3(0, 0, radius + gravity.z() / k), .v = v, .radius = radius});
  return world;
}

constexpr int block_index = 1;

/// Tells whether the block moves within a second.
bool moves(World<3> world) {
  for (int n = 0; n < 60; ++n) world.step(1.0 / 60);
  return world.v(block_index).head<2>().norm() > 1e-9;
}

/// Returns the argument at which `moving` changes.
template <class Moving>
double threshold(double low, double high, const Moving& moving) {
  const bool at_low = moving(low);
  for (int n = 0; n < 50; ++n) {
    const double middle = (low + high) / 2;
    (moving(middle) == at_low ? low : high) = middle;
  }
  return (low + high) / 2;
}

double smallest_push(double phi) {
  const auto moving = [&](double force) {
    const Vec3 push = force * g * direction(phi);
    return moves(block(mu, Vec3(0, 0, -g), [push](std::size_t i, const std::vector<Vec3>&) {
      return i == block_index ? push : Vec3(0, 0, 0);
    }));
  };
  return threshold(0, 2 * mu, moving);
}

double smallest_friction(double angle) {
  const Vec3 gravity = g * Vec3(std::sin(angle), 0, -std::cos(angle));
  return threshold(0, 10, [&](double friction) { return moves(block(friction, gravity)); });
}

/// Returns the distance from start to stop, with v started half a step back along each tangent, so that the order is 2.
/// (Wrong friction of a student may never stop the block, so it stops after 60 s.)
double distance(double phi, double h) {
  const double v0 = 3;
  const Tangents t = tangents(Vec3::UnitZ());
  Vec3 v = v0 * direction(phi);
  for (const Vec3& tangent : {t.t1, t.t2})
    if (std::abs(v.dot(tangent)) > 1e-9) v += std::copysign(mu * g * h / 2, v.dot(tangent)) * tangent;
  World<3> world = block(mu, Vec3(0, 0, -g), nullptr, v);
  const Vec3 start = world.x(block_index);
  while (world.v(block_index).head<2>().norm() > 1e-9 && world.time() < 60) world.step(h);
  return (world.x(block_index) - start).norm() / (v0 * v0 / (2 * mu * g));
}

Experiment experiment(Size size) {
  Experiment e;
  e.columns = {"what", "angle [rad]", "value", "predicted"};
  const int directions = size == Size::quick ? 24 : 72;
  for (int n = 0; n < directions; ++n) {
    const double phi = 2 * std::numbers::pi * n / directions, c = std::cos(phi), s = std::sin(phi);
    e.points.push_back(
        {"direction " + std::to_string(n), [=]() -> std::vector<Row> {
           return {{"push", phi, smallest_push(phi), mu / std::max(std::abs(c), std::abs(s))},
                   {"distance", phi, distance(phi, 1.0 / 2000), std::sqrt(c * c * c * c + s * s * s * s)}};
         }});
  }
  for (int degrees = 5; degrees <= 80; degrees += 5)
    e.points.push_back({"slope " + std::to_string(degrees), [=]() -> std::vector<Row> {
                          const double angle = degrees * std::numbers::pi / 180;
                          return {{"slope", angle, smallest_friction(angle), std::tan(angle)}};
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
    claims.at_most(
        "in the direction φ a block begins to move at a push of μ m g/max(|cos φ|, |sin φ|), to 1e-9",
        worst("push"), 1e-9);
    claims.at_most("the distance to a stop is proportional to √(cos⁴φ + sin⁴φ), to 1e-4", worst("distance"),
                   1e-4);
    claims.at_most("a block stays on a slope of angle θ from μ = tan θ on, to 1e-8", worst("slope"), 1e-8);
    const auto push = table.where("what", "push").numbers("value");
    claims.near("along a diagonal the box is √2 times as strong as along a tangent, to 1e-9",
                *std::max_element(push.begin(), push.end()) / *std::min_element(push.begin(), push.end()),
                std::numbers::sqrt2, 1.5e-9);
  };
  return e;
}

}  // namespace
}  // namespace spook::plots

int main(int argc, char** argv) {
  return spook::plots::run_experiment(argc, argv, spook::plots::experiment);
}
