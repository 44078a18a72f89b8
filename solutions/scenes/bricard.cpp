// Bricard's mechanism: six rods in a ring, initially along edges of a cube. The hinge at each corner is perpendicular
// to the two rods that meet there. By the number of rows, 5 · 6 = 6 · 5, the ring could not move. But one row is
// redundant.
//
// The answer uses natural coordinates, scenes/natural_coordinates.hpp. Neighbours share a corner and a hinge's axis.
//
// Source of the problem: A04 of the library of benchmark problems for multibody dynamics, Universidad de La Coruña:
// five moving rods of 1 m and 1 kg, energy constant over 10 s.
#include "scenes/half_step_energy.hpp"
#include "scenes/mechanism.hpp"
#include "scenes/registry.hpp"

namespace spook {

namespace {

constexpr std::size_t corner_count = 6, moving_rods = 5;

const std::array<Vec3, corner_count>& places() {
  static const std::array<Vec3, corner_count> places = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0),
                                                        Vec3(1, 1, 1), Vec3(0, 1, 1), Vec3(0, 0, 1)};
  return places;
}

/// Returns the hinge axis at a corner, perpendicular to the rods that meet there.
const std::array<Vec3, corner_count>& axes() {
  static const std::array<Vec3, corner_count> axes = {Vec3::UnitY(), Vec3::UnitZ(), Vec3::UnitX(),
                                                      Vec3::UnitY(), Vec3::UnitZ(), Vec3::UnitX()};
  return axes;
}

/// Corners 0 and 5 belong to the static rod.
NaturalCoordinates natural(double l, double mass, double thickness, const Vec3& gravity) {
  using Place = NaturalCoordinates::Place;
  NaturalCoordinates ring;
  const Place origin = NaturalCoordinates::fixed(Vec3::Zero());
  std::array<Place, corner_count> P, u;
  for (std::size_t n = 0; n < corner_count; ++n) {
    const bool stays = n == 0 || n == corner_count - 1;
    P[n] = stays ? NaturalCoordinates::fixed(l * places()[n]) : ring.add(l * places()[n]);
    u[n] = stays ? NaturalCoordinates::fixed(axes()[n]) : ring.add(axes()[n]);
    if (!stays) ring.hold(u[n], origin, u[n], origin);
  }
  for (std::size_t n = 0; n < moving_rods; ++n) {
    ring.hold(P[n], P[n + 1], P[n], P[n + 1]);
    ring.hold(P[n], P[n + 1], u[n], origin);
    ring.hold(P[n], P[n + 1], u[n + 1], origin);
    ring.hold(u[n], origin, u[n + 1], origin);
    ring.add_rod(P[n], P[n + 1], mass, gravity);
    for (const Place& across : {u[n], u[n + 1]})
      ring.add_second_moment(across, mass * thickness * thickness / 12);
  }
  return ring;
}

class Bricard : public WorldScene<6> {
 public:
  Bricard(const Parameters& p, const Method& method)
      : WorldScene({.gravity = Vec3(0, 0, -p.number("g")), .k = p.number("k"), .d = p.number("d")}, method),
        l_(p.number("l")),
        g_(p.number("g")),
        answer_(motion_of(natural(l_, p.number("m"), thickness * l_, Vec3(0, 0, -g_)))) {
    const int ground = world_.add_fixed(Vec3::Zero());
    int before = ground;
    for (std::size_t n = 0; n < moving_rods; ++n) {
      const Vec3 from = l_ * places()[n], to = l_ * places()[n + 1];
      const int next = world_.add(rod(from, to, axes()[n], p.number("m"), thickness * l_));
      world_.add_joint(joint_at(world_, JointKind::hinge, before, next, from, axes()[n]));
      before = next;
    }
    world_.add_joint(joint_at(world_, JointKind::hinge, before, ground, l_ * places().back(), axes().back()));
    if (p.choice("start") == "half_step") world_.start_consistently(h_);
    first_energy_ = energy();
  }

  void observe() override { largest_error_ = larger(largest_error_, (corner() - answer()).norm()); }
  double error() const override { return relative(largest_error_, l_); }

  void results(StateStream& s) override { s(answer_, largest_error_); }

  std::vector<std::string> columns() const override {
    return {"time [s]", "x of P3 [m]", "y of P3 [m]", "z of P3 [m]", "error [m]", "energy change [J]"};
  }
  std::vector<double> sample() const override {
    const Vec3 P = corner();
    return {time(), P.x(), P.y(), P.z(), (P - answer()).norm(), energy() - first_energy_};
  }

 private:
  static constexpr double thickness = 0.1;  // over the length of a rod

  /// The corner farthest from the static rod, at the end of the third moving rod.
  static constexpr int third = 3;
  Vec3 corner() const { return world_.x(third) + orientation(world_, third) * Vec3(l_ / 2, 0, 0); }
  Vec3 answer() const { return answer_.at(time()).segment<3>(2 * 6); }  // corners and axes alternate, from 1
  double energy() const { return half_step_energy(world_.bodies(), g_, 2 * velocity_lag()); }

  double l_, g_;
  mutable NaturalMotion answer_;  // advances to the requested time
  double first_energy_ = 0, largest_error_ = 0;
};

}  // namespace

SceneDescription bricard() {
  return {.name = "bricard",
          .summary = "Six rods in a ring of six hinges, which moves although its rows are too many by one.",
          .answer =
              "Places of corners and hinge axes, which neighbours share, integrated to round-off: no "
              "orientations and no joints. The problem is A04 of La Coruña's library of multibody benchmarks.",
          .error_name = "largest position error of the farthest corner over a rod's length",
          .error_unit = "relative",
          .parameters = {{.name = "l",
                          .meaning = "of each rod",
                          .unit = "m",
                          .value = 1,
                          .limits = {.low = 0, .low_included = false}},
                         parameter::mass(),
                         parameter::gravity(),
                         parameter::stiff_joints(1e10),
                         parameter::relaxation_of_swinging_joints(),
                         parameter::start()},
          .h = 0.001,
          .time = 2,
          .solves = true,
          .build = build_as<Bricard>,
          .solver = "direct"};
}

}  // namespace spook
