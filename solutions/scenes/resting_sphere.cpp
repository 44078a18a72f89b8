// A rigid sphere on a plane, released at touch.
//
//   gap = -m g/k  and  λ = h m g,  for any h and d: the solution of Eq. (3.7) at rest.
#include "scenes/registry.hpp"

namespace spook {

namespace {

class RestingSphere : public WorldScene<6> {
 public:
  RestingSphere(const Parameters& p, const Method& method)
      : WorldScene({.gravity = Vec3(0, 0, -p.number("g")), .k = p.number("k"), .d = p.number("d")}, method),
        radius_(p.number("radius")),
        rest_gap_(-p.number("m") * p.number("g") / p.number("k")) {
    const double m = p.number("m");
    world_.add_plane(Vec3::UnitZ(), 0);
    sphere_ = world_.add({.x = Vec3(0, 0, radius_),
                          .mass = m,
                          .radius = radius_,
                          .principal = solid_sphere_moments(m, radius_)});
  }

  void observe() override { error_ = std::abs(gap() - rest_gap_); }
  double error() const override { return of_springs(relative(error_, std::abs(rest_gap_))); }
  std::vector<Ghost> ghosts() const override {
    return {{.body = sphere_, .x = Vec3(0, 0, radius_ + rest_gap_)}};
  }

  void results(StateStream& s) override { s(error_); }

  std::vector<std::string> columns() const override {
    return {"time [s]", "gap [m]", "v [m/s]", "lambda [N s]"};
  }
  std::vector<double> sample() const override {
    return {time(), gap(), world_.v(sphere_).z(),
            world_.contacts().empty() ? 0 : world_.lambda(0) * world_.parts()};
  }

 private:
  double gap() const { return world_.x(sphere_).z() - radius_; }

  double radius_, rest_gap_;
  int sphere_ = 0;
  double error_ = 0;
};

}  // namespace

SceneDescription resting_sphere() {
  return {.name = "resting_sphere",
          .summary = "A sphere comes to rest on a plane.",
          .answer = "gap = -m g/k with the impulse h m g in every step, whatever h, for d of 1/4 and more.",
          .error_name = "error of the last gap over m g/k",
          .error_unit = "relative",
          .parameters = {parameter::mass(), parameter::gravity(), parameter::stiffness(),
                         parameter::relaxation(), parameter::radius()},
          .h = 1.0 / 60,
          .time = 5,
          .solves = true,
          .build = build_as<RestingSphere>};
}

}  // namespace spook
