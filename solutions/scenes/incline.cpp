// A block on a slope, from rest. The axes are those of the slope, and gravity is tilted. z is the slope's normal, and
// the first tangent t1 of Eq. (5.1) points down the slope, along which the friction box has the limit μ N.
//
//   sticks  <=>  μ >= tan θ,   else   a = g (sin θ - μ cos θ),  x = ½ a t²                          Eq. (5.9)
//
// A sticking block creeps at m g sin θ/(N c), with N contacts of viscosity c: Eq. (5.5). On four corners there are more
// unknowns than degrees of freedom, and the solver's error exceeds the creep.
#include "scenes/block.hpp"
#include "scenes/degrees.hpp"
#include "scenes/registry.hpp"

namespace spook {

namespace {

/// Forces on the block along the slope and along its normal, over its mass [m/s²].
struct Slope {
  double pull, press;
};

Slope slope(const Parameters& p) {
  const double theta = radians(p.number("angle"));
  return {p.number("g") * std::sin(theta), p.number("g") * std::cos(theta)};
}

template <int Dof>
class Incline : public WorldScene<Dof> {
 public:
  Incline(const Parameters& p, const Method& method)
      : WorldScene<Dof>(settings(p), method),
        pull_(slope(p).pull),
        acceleration_(std::max(0.0, pull_ - p.number("mu") * slope(p).press)) {
    const double m = p.number("m");
    const double friction = m * (pull_ - acceleration_);
    world_.add_plane(Vec3::UnitZ(), 0);
    Body<Dof> body = lying<Dof>(block(p), m * slope(p).press, -friction * down_, p.number("k"));
    if (p.choice("start") == "half_step") body.v = -this->velocity_lag() * acceleration_ * down_;  // Eq. (1.5)
    block_ = world_.add(body);
    start_ = body.x;
  }

  void observe() override {
    const double t = this->time();
    largest_error_ = larger(largest_error_, std::abs(x() - acceleration_ * t * t / 2));
  }
  double error() const override {
    const double t = this->time();
    return relative(largest_error_, pull_ * t * t / 2);
  }
  std::vector<Ghost> ghosts() const override {
    const double t = this->time();
    return {{.body = block_, .x = start_ + acceleration_ * t * t / 2 * down_}};
  }

  void results(StateStream& s) override { s(largest_error_); }

  std::vector<std::string> columns() const override {
    return {"time [s]", "x [m]", "v at t - h/2 [m/s]", "friction [N]", "contacts"};
  }
  std::vector<double> sample() const override {
    const int contacts = static_cast<int>(world_.contacts().size());
    double friction = 0;
    for (int c = 0; c < contacts; ++c) friction -= world_.impulse(c).dot(down_) / this->impulse_time();
    return {this->time(), x(), world_.v(block_).dot(down_), friction, static_cast<double>(contacts)};
  }

 private:
  using WorldScene<Dof>::world_;
  using WorldScene<Dof>::h_;

  static Vec3 down() { return tangents(Vec3::UnitZ()).t1; }

  static Settings<Dof> settings(const Parameters& p) {
    return {.gravity = slope(p).pull * down() - slope(p).press * Vec3::UnitZ(),
            .k = p.number("k"),
            .d = p.number("d"),
            .friction = p.number("mu"),
            .viscosity = p.number("viscosity")};
  }

  double x() const { return world_.x(block_).dot(down_); }

  Vec3 down_ = down();
  double pull_, acceleration_;
  int block_ = 0;
  Vec3 start_;
  double largest_error_ = 0;
};

}  // namespace

SceneDescription incline() {
  return with_friction(
      FrictionModel::box,
      {.name = "incline",
       .summary = "A block on a slope, from rest: it sticks, or slides.",
       .answer =
           "It sticks if mu >= tan θ, for any mass; else x = ½ g (sin θ - mu cos θ) t², to round-off with "
           "start=half_step. A sticking block creeps, at m g sin θ over the viscosity of its contacts.",
       .error_name = "largest position error over ½ g sin θ t², the way without friction",
       .error_unit = "relative",
       .parameters = {parameter::friction(),
                      {.name = "angle",
                       .meaning = "θ, of the slope",
                       .unit = "degrees",
                       .value = 30,
                       .limits = {.low = 0, .high = 90, .low_included = false, .high_included = false}},
                      parameter::block_model(),
                      parameter::mass(),
                      parameter::base(1),
                      parameter::height(0.2),
                      parameter::gravity(),
                      parameter::stiffness(),
                      parameter::relaxation(),
                      parameter::viscosity(),
                      parameter::start()},
       .h = 1.0 / 60,
       .time = 2,
       .solves = true,
       .build = build_model<Incline>});
}

}  // namespace spook
