// Free fall from rest, which leapfrog with a half-step start computes exactly.
//
//   z = -g t²/2.   Unshifted, z_n = -g h² n(n+1)/2: an error of g h t/2, first order.  Eq. (1.3)-(1.5)
#include "scenes/registry.hpp"

namespace spook {

namespace {

class FreeFall : public WorldScene<3> {
 public:
  FreeFall(const Parameters& p, const Method& method)
      : WorldScene({.gravity = Vec3(0, 0, -p.number("g"))}, method),
        g_(p.number("g")),
        shifted_(p.choice("start") == "half_step") {
    world_.add({.mass = p.number("m")});
    if (shifted_) world_.start_half_step_back(h_);
  }

  void observe() override { largest_error_ = larger(largest_error_, std::abs(world_.x(0).z() - answer())); }
  double error() const override { return relative(largest_error_, std::abs(answer())); }
  std::vector<Ghost> ghosts() const override { return {{.body = 0, .x = Vec3(0, 0, answer())}}; }

  void results(StateStream& s) override { s(largest_error_); }

  std::vector<std::string> columns() const override { return {"time [s]", "z [m]", "v [m/s]", "energy [J]"}; }
  std::vector<double> sample() const override {
    const double z = world_.x(0).z();
    const double v = shifted_ ? world_.synchronized_velocity(0, h_).z() : world_.v(0).z();
    return {time(), z, v, world_.bodies().mass[0] * (v * v / 2 + g_ * z)};
  }

 private:
  double answer() const { return -g_ * time() * time() / 2; }

  double g_;
  bool shifted_;
  double largest_error_ = 0;
};

}  // namespace

SceneDescription free_fall() {
  return {.name = "free_fall",
          .summary = "A point mass falls from rest.",
          .answer =
              "z = -g t²/2, at every step to round-off with start=half_step; unshifted, leapfrog gives "
              "-g h² n(n+1)/2 after n steps, a relative error of h/t.",
          .error_name = "largest position error over the distance fallen",
          .error_unit = "relative",
          .parameters = {parameter::mass(), parameter::gravity(), parameter::start()},
          .h = 0.01,
          .time = 5,
          .solves = false,
          .build = build_as<FreeFall>};
}

}  // namespace spook
