// A mass on a spring, released from rest.
//
//   x = A cos(t √(k/m)).   Leapfrog is stable for h √(k/m) < 2 and of second order when v starts half a step back.
#include "scenes/registry.hpp"

namespace spook {

namespace {

class Oscillator : public WorldScene<3> {
 public:
  Oscillator(const Parameters& p, const Method& method)
      : WorldScene({.gravity = Vec3::Zero(), .force = spring(p.number("k"))}, method),
        k_(p.number("k")),
        rate_(std::sqrt(p.number("k") / p.number("m"))),
        amplitude_(p.number("amplitude")),
        shifted_(p.choice("start") == "half_step") {
    world_.add({.x = Vec3(amplitude_, 0, 0), .mass = p.number("m")});
    if (shifted_) world_.start_half_step_back(h_);
  }

  void observe() override {
    largest_error_ = larger(largest_error_, std::abs(world_.x(0).x() - amplitude_ * std::cos(rate_ * time())));
  }
  double error() const override { return relative(largest_error_, amplitude_); }
  std::vector<Ghost> ghosts() const override {
    return {{.body = 0, .x = Vec3(amplitude_ * std::cos(rate_ * time()), 0, 0)}};
  }
  double field_energy(const std::vector<Vec3>& x) const override { return k_ * x[0].squaredNorm() / 2; }

  void results(StateStream& s) override { s(largest_error_); }

  std::vector<std::string> columns() const override { return {"time [s]", "x [m]", "v [m/s]", "energy [J]"}; }
  std::vector<double> sample() const override {
    const double x = world_.x(0).x();
    const double v = shifted_ ? world_.synchronized_velocity(0, h_).x() : world_.v(0).x();
    return {time(), x, v, (world_.bodies().mass[0] * v * v + k_ * x * x) / 2};
  }

 private:
  static ForceField spring(double k) {
    return [k](std::size_t i, const std::vector<Vec3>& x) -> Vec3 { return -k * x[i]; };
  }

  double k_, rate_, amplitude_;
  bool shifted_;
  double largest_error_ = 0;
};

}  // namespace

SceneDescription oscillator() {
  Parameter k = parameter::stiffness();
  k.value = 1;
  return {.name = "oscillator",
          .summary = "A mass on a spring, released from rest at its amplitude.",
          .answer = "x = A cos(t √(k/m)), A the amplitude.",
          .error_name = "largest position error over the amplitude",
          .error_unit = "relative",
          .parameters = {parameter::mass(),
                         k,
                         {.name = "amplitude",
                          .meaning = "where it is let go",
                          .unit = "m",
                          .value = 1,
                          .limits = {.low = 0, .low_included = false}},
                         parameter::start()},
          .h = 0.01,
          .time = 10,
          .solves = false,
          .build = build_as<Oscillator>};
}

}  // namespace spook
