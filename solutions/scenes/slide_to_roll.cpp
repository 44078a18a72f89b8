// A sphere thrown without spin along a plane: friction slows it and spins it up until it rolls.
//
//   slides   v = v0 - μgt,  Rω = (5/2) μgt,   until they are equal, at t = 2v0/(7μg)
//   rolls    v = Rω = 5/7 v0                                                                   Eq. (5.11)
//
// It slides along the first tangent of Eq. (5.1). v + (2/5) Rω is conserved, also in the engine, so the final v is
// right; the error of the position is at most μg h²/8, as in `sliding_block`.
#include "scenes/braking.hpp"
#include "scenes/registry.hpp"

namespace spook {

namespace {

class SlideToRoll : public WorldScene<6> {
 public:
  SlideToRoll(const Parameters& p, const Method& method)
      : WorldScene({.gravity = Vec3(0, 0, -p.number("g")),
                    .k = p.number("k"),
                    .d = p.number("d"),
                    .friction = p.number("mu"),
                    .viscosity = p.number("viscosity")},
                   method),
        sliding_{p.number("v0"), p.number("mu") * p.number("g")},
        radius_(p.number("radius")),
        shifted_(p.choice("start") == "half_step") {
    const double m = p.number("m"), back = shifted_ ? -velocity_lag() : 0;
    world_.add_plane(Vec3::UnitZ(), 0);
    sphere_ = world_.add({.x = Vec3(0, 0, radius_ - m * p.number("g") / p.number("k")),
                          .v = (sliding_.v0 - sliding_.rate * back) * ahead_,
                          .mass = m,
                          .radius = radius_,
                          .omega = spin_rate() * back * axis_,
                          .principal = solid_sphere_moments(m, radius_)});
    start_ = world_.x(sphere_);
  }

  void observe() override {
    const double t = time();
    x_error_ = larger(x_error_, std::abs(x() - answer(t)));
    spin_error_ = larger(spin_error_, std::abs(spin() - spin_rate() * std::min(spin_time(), rolls_after())));
  }
  double error() const override {
    const double slid = sliding_.way(std::min(time(), rolls_after()));
    return larger(relative(x_error_, slid), relative(spin_error_, sliding_.v0 / radius_ * 5 / 7));
  }
  std::vector<Ghost> ghosts() const override {
    const double t = time(), speeding_up = std::min(t, rolls_after());
    const double angle = spin_rate() * speeding_up * (t - speeding_up / 2);
    return {{.body = sphere_, .x = start_ + answer(t) * ahead_, .q = Quat(Eigen::AngleAxisd(angle, axis_))}};
  }

  void results(StateStream& s) override { s(x_error_, spin_error_); }

  std::vector<std::string> columns() const override {
    return {"time [s]", "x [m]", "v at t - h/2 [m/s]", "spin at t - h/2 [rad/s]", "slip at t - h/2 [m/s]"};
  }
  std::vector<double> sample() const override {
    const double v = world_.v(sphere_).dot(ahead_);
    return {time(), x(), v, spin(), v - radius_ * spin()};
  }

 private:
  double x() const { return world_.x(sphere_).dot(ahead_); }
  double spin() const { return angular_velocity(world_, sphere_).dot(axis_); }

  double rolls_after() const { return sliding_.duration() * 2 / 7; }
  double spin_rate() const { return 2.5 * sliding_.rate / radius_; }  // [rad/s²]
  /// The time to which ω belongs.
  double spin_time() const { return shifted_ ? time() - velocity_lag() : time(); }

  double answer(double t) const {
    const double rolling = std::max(0.0, t - rolls_after());
    return sliding_.way(t - rolling) + sliding_.v0 * 5 / 7 * rolling;
  }

  Braking sliding_;
  double radius_;
  bool shifted_;
  Vec3 ahead_ = tangents(Vec3::UnitZ()).t1;
  Vec3 axis_ = Vec3::UnitZ().cross(ahead_);
  int sphere_ = 0;
  Vec3 start_;
  double x_error_ = 0, spin_error_ = 0;
};

}  // namespace

SceneDescription slide_to_roll() {
  return with_friction(
      FrictionModel::box,
      {.name = "slide_to_roll",
       .summary = "A sphere is thrown without spin: it slides, then rolls.",
       .answer =
           "It slides for 2 v0/(7 mu g), over 12 v0²/(49 mu g), then rolls with 5/7 v0: a speed that depends "
           "on neither mu, nor mass, nor radius.",
       .error_name = "larger of two errors: of x over the sliding distance, of the spin over its final value",
       .error_unit = "relative",
       .parameters = {parameter::speed(3), parameter::friction(0.2), parameter::mass(), parameter::radius(),
                      parameter::gravity(), parameter::stiffness(), parameter::relaxation(),
                      parameter::viscosity(), parameter::start()},
       .h = 0.01,
       .time = 1,
       .solves = true,
       .build = build_as<SlideToRoll>});
}

}  // namespace spook
