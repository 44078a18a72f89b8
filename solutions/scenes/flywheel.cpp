// A motor accelerates a flywheel to its target speed w.
//
//   I ω' = T                    while w - ω > T/c                       ω = T t/I,  for t1 = I w/T - I/c
//   I ω' = c (w - ω)            afterwards                              w - ω = (T/c) exp(-(t - t1) c/I)
//
// With c = ∞, the default up to round-off, it reaches w at t = I w/T.
#include "scenes/disc.hpp"
#include "scenes/registry.hpp"

namespace spook {

namespace {

class Flywheel : public WorldScene<6> {
 public:
  Flywheel(const Parameters& p, const Method& method)
      : WorldScene({.gravity = Vec3::Zero(), .k = p.number("k"), .d = p.number("d")}, method),
        inertia_(p.number("m") * p.number("radius") * p.number("radius") / 2),
        torque_(p.number("torque")),
        wanted_(p.number("speed")),
        viscosity_(p.number("c")) {
    const double m = p.number("m"), radius = p.number("radius");
    const int frame = world_.add_fixed(Vec3::Zero());
    // A thin disc: its moments about a diameter are half of that about its axis.
    wheel_ = world_.add({.mass = m,
                         .principal = inertia_ * Vec3(0.5, 0.5, 1),
                         .corners = disc_points(1.5 * radius, 1, 24)});  // whose mean radius is 2/3 of that
    world_.add_joint({.i = frame,
                      .j = wheel_,
                      .kind = JointKind::hinge,
                      .motor = Motor{.speed = wanted_, .strength = torque_, .viscosity = viscosity_}});
  }

  void observe() override {
    largest_error_ = larger(largest_error_, std::abs(world_.joint_speed(0) - answer()));
  }
  double error() const override { return relative(largest_error_, std::abs(wanted_)); }

  void results(StateStream& s) override { s(largest_error_); }

  std::vector<std::string> columns() const override {
    return {"time [s]", "speed [rad/s]", "answer [rad/s]", "motor [N m]", "turned [rad]"};
  }
  std::vector<double> sample() const override {
    return {time(), world_.joint_speed(0), answer(), world_.motor_force(0), world_.joint_position(0)};
  }

 private:
  double answer() const {
    const double w = std::abs(wanted_), lacks = std::min(torque_ / viscosity_, w);
    const double t1 = inertia_ * (w - lacks) / torque_;
    const double speed = time() < t1 ? torque_ * time() / inertia_
                                     : w - lacks * std::exp(-(time() - t1) * viscosity_ / inertia_);
    return std::copysign(speed, wanted_);
  }

  double inertia_, torque_, wanted_, viscosity_;
  int wheel_ = 0;
  double largest_error_ = 0;
};

}  // namespace

SceneDescription flywheel() {
  const Limits positive = {.low = 0, .low_included = false};
  Parameter d = parameter::relaxation(), c = parameter::viscosity();
  d.value = 0.25;
  c.name = "c";
  c.meaning = "torque of the motor per unit of missing speed, up to its largest";
  c.unit = "N m s/rad";
  return {
      .name = "flywheel",
      .summary = "A motor of bounded torque brings a flywheel to speed.",
      .answer =
          "ω = T t/I until I w/T, then w. A motor of viscosity c has less torque once the missing speed is "
          "below T/c, and ω approaches w as exp(-c t/I).",
      .error_name = "largest error of the speed over the target",
      .error_unit = "relative",
      .parameters =
          {{.name = "torque", .meaning = "the motor's largest", .unit = "N m", .value = 5, .limits = positive},
           {.name = "speed",
            .meaning = "target speed of the motor",
            .unit = "rad/s",
            .value = 20,
            .limits = positive},
           c,
           parameter::mass(10),
           parameter::radius(),
           parameter::stiffness(),
           d},
      .h = 0.01,
      .time = 10,
      .solves = true,
      .build = build_as<Flywheel>,
      .solver = "direct"};
}

}  // namespace spook
