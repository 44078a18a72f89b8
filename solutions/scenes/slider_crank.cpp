// A spatial slider-crank: the crank turns about x, beside and above the line of the slider. The rod between them has a
// ball joint at either end.
//
// The answer uses natural coordinates, scenes/natural_coordinates.hpp, of two points: the crank's end and the slider.
// It omits rotation of the rod about its own line, since no torque acts about that line.
#include "scenes/half_step_energy.hpp"
#include "scenes/mechanism.hpp"
#include "scenes/registry.hpp"

namespace spook {

namespace {

const Vec3 pivot(0, 0.1, 0.12), crank_end(0, 0.1, 0.2),
    slider_at(0.2, 0, 0);                                             // at first [m]; the rod has 0.3 m
constexpr double crank_mass = 0.12, rod_mass = 0.5, slider_mass = 2;  // [kg]

/// The velocity of the slider, for a velocity v of the crank's end: the rod keeps its length.
Vec3 slider_velocity(const Vec3& v) {
  const Vec3 along = crank_end - slider_at;
  return along.dot(v) / along.x() * Vec3::UnitX();
}

NaturalCoordinates natural(const Vec3& v, const Vec3& gravity) {
  using Place = NaturalCoordinates::Place;
  NaturalCoordinates two;
  const Place A = NaturalCoordinates::fixed(pivot), origin = NaturalCoordinates::fixed(Vec3::Zero());
  const auto unit = [](int axis) { return NaturalCoordinates::fixed(Vec3::Unit(axis)); };
  const Place B = two.add(crank_end, v), C = two.add(slider_at, slider_velocity(v));
  two.hold(B, A, B, A);
  two.hold(B, A, unit(0), origin);
  two.hold(B, C, B, C);
  for (const int axis : {1, 2}) two.hold(C, origin, unit(axis), origin);
  two.add_rod(A, B, crank_mass, gravity);
  two.add_rod(B, C, rod_mass, gravity);
  two.add_rod(C, C, slider_mass, gravity);
  return two;
}

class SliderCrank : public WorldScene<6> {
 public:
  SliderCrank(const Parameters& p, const Method& method)
      : WorldScene({.gravity = Vec3(0, 0, -p.number("g")), .k = p.number("k"), .d = p.number("d")}, method),
        g_(p.number("g")),
        answer_(motion_of(natural(end_velocity(p), Vec3(0, 0, -g_)))) {
    const Vec3 v = end_velocity(p), slides = slider_velocity(v), across = Vec3::UnitX();
    const int ground = world_.add_fixed(Vec3::Zero());
    Body<6> crank = thin_rod(pivot, crank_end, across, crank_mass);
    crank.v = v / 2;
    crank.omega = p.number("spin") * Vec3::UnitX();
    const Vec3 along = crank_end - slider_at;
    Body<6> between = thin_rod(slider_at, crank_end, along.cross(Vec3::UnitX()).normalized(), rod_mass);
    between.v = (v + slides) / 2;
    between.omega = along.cross(v - slides) / along.squaredNorm();
    const Body<6> slider{.x = slider_at, .v = slides, .mass = slider_mass, .principal = Vec3::Constant(1e-3)};
    const int first = world_.add(crank), second = world_.add(between);
    slider_ = world_.add(slider);
    world_.add_joint(joint_at(world_, JointKind::hinge, ground, first, pivot, Vec3::UnitX()));
    world_.add_joint(joint_at(world_, JointKind::ball, first, second, crank_end));
    world_.add_joint(joint_at(world_, JointKind::ball, second, slider_, slider_at));
    world_.add_joint(joint_at(world_, JointKind::slider, ground, slider_, slider_at, Vec3::UnitX()));
    if (p.choice("start") == "half_step") world_.start_consistently(h_);
    first_energy_ = energy();
  }

  void observe() override { largest_error_ = larger(largest_error_, (world_.x(slider_) - answer()).norm()); }
  double error() const override { return relative(largest_error_, (crank_end - slider_at).norm()); }
  std::vector<Ghost> ghosts() const override { return {{.body = slider_, .x = answer()}}; }

  void results(StateStream& s) override { s(answer_, largest_error_); }

  std::vector<std::string> columns() const override {
    return {"time [s]", "x of the slider [m]", "answer [m]", "energy change [J]"};
  }
  std::vector<double> sample() const override {
    return {time(), world_.x(slider_).x(), answer().x(), energy() - first_energy_};
  }

 private:
  static Vec3 end_velocity(const Parameters& p) {
    return p.number("spin") * Vec3::UnitX().cross(Vec3(crank_end - pivot));
  }
  Vec3 answer() const { return answer_.at(time()).segment<3>(3); }
  double energy() const { return half_step_energy(world_.bodies(), g_, 2 * velocity_lag()); }

  double g_;
  mutable NaturalMotion answer_;  // advances to the requested time
  int slider_ = 0;
  double first_energy_ = 0, largest_error_ = 0;
};

}  // namespace

SceneDescription slider_crank() {
  return {
      .name = "slider_crank",
      .summary = "A crank turns beside the line on which it drives a slider, by a rod with two ball joints.",
      .answer =
          "Places of the crank's end and of the slider, integrated to round-off: no orientations, no joints.",
      .error_name = "largest position error of the slider over the rod's length",
      .error_unit = "relative",
      .parameters = {{.name = "spin", .meaning = "of the crank at first", .unit = "rad/s", .value = 6},
                     parameter::gravity(),
                     parameter::stiff_joints(1e10),
                     parameter::relaxation_of_swinging_joints(),
                     parameter::start()},
      .h = 0.0005,
      .time = 2,
      .solves = true,
      .build = build_as<SliderCrank>,
      .solver = "direct"};
}

}  // namespace spook
