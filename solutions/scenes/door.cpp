// A door on a leaning post, with any number of hinges. Each hinge holds five of six degrees of freedom, so all rows of
// the second and later hinges are redundant.
//
//   θ'' = -(m g (w/2) sin λ/I) sin θ,   I = I_z + m (w/2)²        about the post, which leans by λ; θ = 0 hangs down
//   m g cos λ                                                     along the post, on all hinges together
//
// The motion does not depend on the number of hinges: Σ distributes their load.
#include "scenes/degrees.hpp"
#include "scenes/plane_pendulum.hpp"
#include "scenes/registry.hpp"

namespace spook {

namespace {

Vec3 door_half_sides(const Parameters& p) {
  return {p.number("width") / 2, 0.02, p.number("height") / 2};
}

/// ω² of small oscillations [1/s²].
double door_squared_rate(const Parameters& p) {
  const double arm = p.number("width") / 2, m = p.number("m");
  const double inertia = solid_box_moments(m, door_half_sides(p)).z() + m * arm * arm;
  return m * p.number("g") * arm * std::sin(radians(p.number("lean"))) / inertia;
}

class Door : public WorldScene<6> {
 public:
  Door(const Parameters& p, const Method& method)
      : WorldScene({.gravity = Vec3(0, 0, -p.number("g")), .k = p.number("k"), .d = p.number("d")}, method),
        upright_(Eigen::AngleAxisd(radians(p.number("lean")), Vec3::UnitY())),
        arm_(p.number("width") / 2),
        hinges_(p.count("hinges")),
        along_(p.number("m") * p.number("g") * std::cos(radians(p.number("lean")))),
        answer_(radians(p.number("angle")), std::sqrt(door_squared_rate(p))) {
    const Vec3 half = door_half_sides(p);
    const int post = world_.add_fixed(Vec3::Zero());
    const Quat q = turned(radians(p.number("angle")));
    const double m = p.number("m");
    door_ = world_.add({.x = q * (arm_ * Vec3::UnitX()),
                        .mass = m,
                        .q = q,
                        .principal = solid_box_moments(m, half),
                        .corners = box_corners(half)});
    for (int n = 0; n < hinges_; ++n) {
      const double height = hinges_ == 1 ? 0 : 0.8 * half.z() * (2.0 * n / (hinges_ - 1) - 1);
      world_.add_joint({.i = post,
                        .j = door_,
                        .p_i = upright_ * Vec3(0, 0, height),
                        .p_j = Vec3(-arm_, 0, height),
                        .kind = JointKind::hinge,
                        .axis = upright_ * Vec3::UnitZ(),
                        .rest = upright_});
    }
    world_.start_consistently(h_);
  }

  void observe() override {
    const PlanePendulum::Direction theta = answer_.direction(time());
    angle_ = std::atan2(theta.sin, theta.cos);
    largest_error_ = larger(largest_error_, std::abs(world_.joint_position(0) - angle_));
  }
  double error() const override { return largest_error_; }
  std::vector<Ghost> ghosts() const override {
    const Quat q = turned(angle_);
    return {{.body = door_, .x = q * (arm_ * Vec3::UnitX()), .q = q}};
  }

  void results(StateStream& s) override { s(angle_, largest_error_); }

  std::vector<std::string> columns() const override {
    return {"time [s]", "angle [degrees]", "answer [degrees]", "along the post [N]", "its answer [N]"};
  }
  std::vector<double> sample() const override {
    double along = 0;
    for (int n = 0; n < hinges_; ++n)  // without the joint of a hand
      along += world_.joint_force(n).dot(upright_ * Vec3::UnitZ());
    return {time(), world_.joint_position(0) / radians(1), angle_ / radians(1), along, along_};
  }

 private:
  /// The orientation of the door when it is open by an angle.
  Quat turned(double angle) const { return upright_ * Quat(Eigen::AngleAxisd(angle, Vec3::UnitZ())); }

  Quat upright_;  // orientation of the post
  double arm_;
  int hinges_;
  double along_;
  PlanePendulum answer_;
  double angle_ = 0;  // the answer's [rad]
  int door_ = 0;
  double largest_error_ = 0;
};

}  // namespace

SceneDescription door() {
  const Limits positive = {.low = 0, .low_included = false};
  Parameter k = parameter::stiffness(), d = parameter::relaxation();
  k.value = 1e9;  // so large that the deflection of the hinges is smaller than the error of a step
  d.value = 0.25;
  return {
      .name = "door",
      .summary = "A door on a post that leans, on more hinges than it needs.",
      .answer =
          "A pendulum under g sin(lean): θ'' = -(m g w sin(lean)/2I) sin θ, whatever the number of "
          "hinges; along the post they carry m g cos(lean) together.",
      .error_name = "largest error of the angle",
      .error_unit = "rad",
      .parameters = {{.name = "hinges",
                      .meaning = "how many; one is enough",
                      .value = 3,
                      .limits = {.low = 1, .high = 100, .whole = true}},
                     {.name = "lean",
                      .meaning = "of the post, from the vertical",
                      .unit = "degrees",
                      .value = 10,
                      .limits = {.low = 0, .high = 90}},
                     {.name = "angle",
                      .meaning = "initial angle, from hanging down",
                      .unit = "degrees",
                      .value = 90,
                      .limits = {.low = 0, .high = 180, .high_included = false}},
                     {.name = "width", .meaning = "of the door", .unit = "m", .value = 1, .limits = positive},
                     {.name = "height", .meaning = "of the door", .unit = "m", .value = 2, .limits = positive},
                     parameter::mass(20),
                     parameter::gravity(),
                     k,
                     d},
      .h = 0.01,
      .time = 10,
      .solves = true,
      .build = build_as<Door>,
      .solver = "direct"};
}

}  // namespace spook
