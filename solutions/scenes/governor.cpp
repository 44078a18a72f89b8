// A flyball governor: spindle, two balls on arms, a sleeve on links. Above its steady speed the balls swing out, lift
// the sleeve and slow the spindle; then they return.
//
// Hinges connect ground and spindle, spindle and arms. A slider connects spindle and sleeve. Links are massless
// distances. The answer integrates two angles: scenes/governor_motion.hpp.
#include "scenes/governor_motion.hpp"

#include "scenes/degrees.hpp"
#include "scenes/half_step_energy.hpp"
#include "scenes/mechanism.hpp"
#include "scenes/registry.hpp"

namespace spook {

namespace {

constexpr double sleeve_moment = 1e-3;  // about each of its axes [kg m²]

Governor governor_of(const Parameters& p) {
  const double mass = p.number("m");
  return {.l = p.number("l"),
          .M = mass,
          .J = solid_sphere_moments(mass, p.number("radius")).x(),
          .m = p.number("sleeve"),
          .I0 = p.number("spindle") + sleeve_moment,
          .g = p.number("g")};
}

class FlyballGovernor : public WorldScene<6> {
 public:
  FlyballGovernor(const Parameters& p, const Method& method)
      : WorldScene({.gravity = Vec3(0, 0, -p.number("g")), .k = p.number("k"), .d = p.number("d")}, method),
        right_(governor_of(p)),
        L_(right_.moment(radians(p.number("angle"))) * p.number("spin")),
        answer_([right = right_, L = L_](const Governor::State& y) { return right.rate(y, L); },
                Governor::State(radians(p.number("angle")), 0, 0)) {
    const Vec3 turning = p.number("spin") * Vec3::UnitZ();
    const int ground = world_.add_fixed(Vec3::Zero());
    const int spindle = world_.add({.omega = turning, .principal = Vec3::Constant(p.number("spindle"))});
    const Vec3 at = height() * Vec3::UnitZ();
    sleeve_ =
        world_.add({.x = at, .mass = right_.m, .omega = turning, .principal = Vec3::Constant(sleeve_moment)});
    world_.add_joint(joint_at(world_, JointKind::hinge, ground, spindle, Vec3::Zero(), Vec3::UnitZ()));
    world_.add_joint(joint_at(world_, JointKind::slider, spindle, sleeve_, at, Vec3::UnitZ()));
    for (const double side : {1, -1}) {
      const Vec3 x(side * ball().x(), 0, at.z());
      const int ball = world_.add({.x = x,
                                   .v = turning.cross(x),
                                   .mass = right_.M,
                                   .omega = turning,
                                   .principal = Vec3::Constant(right_.J)});
      world_.add_joint(joint_at(world_, JointKind::hinge, spindle, ball, Vec3::Zero(), Vec3::UnitY()));
      world_.add_joint({.i = ball, .j = sleeve_, .p_i = -x / 2, .length = right_.l / 2});
      if (side > 0) ball_ = ball;
    }
    if (p.choice("start") == "half_step") world_.start_consistently(h_);
    first_energy_ = energy();
  }

  void observe() override {
    const double off = std::max((world_.x(ball_) - ball()).norm(), std::abs(world_.x(sleeve_).z() - height()));
    largest_error_ = larger(largest_error_, off);
  }
  double error() const override { return relative(largest_error_, right_.l); }
  std::vector<Ghost> ghosts() const override {
    return {{.body = ball_, .x = ball()}, {.body = sleeve_, .x = height() * Vec3::UnitZ()}};
  }

  void results(StateStream& s) override { s(answer_, largest_error_); }

  std::vector<std::string> columns() const override {
    return {"time [s]",      "sleeve [m]",           "answer [m]",
            "speed [rad/s]", "answer speed [rad/s]", "energy change [J]"};
  }
  std::vector<double> sample() const override {
    return {time(),
            world_.x(sleeve_).z(),
            height(),
            world_.joint_speed(0),
            L_ / right_.moment(answer_.at(time())[0]),
            energy() - first_energy_};
  }

 private:
  /// The right position of the first ball, and the height of the sleeve.
  Vec3 ball() const {
    const Governor::State& y = answer_.at(time());
    const double out = right_.l * std::sin(y[0]);
    return {out * std::cos(y[2]), out * std::sin(y[2]), -right_.l * std::cos(y[0])};
  }
  double height() const { return ball().z(); }
  double energy() const { return half_step_energy(world_.bodies(), right_.g, 2 * velocity_lag()); }

  Governor right_;
  double L_;                           // angular momentum, which is constant [kg m²/s]
  mutable ReferenceMotion<3> answer_;  // advances to the requested time
  int sleeve_ = 0, ball_ = 0;
  double first_energy_ = 0, largest_error_ = 0;
};

}  // namespace

SceneDescription governor() {
  const Limits positive = {.low = 0, .low_included = false};
  return {
      .name = "governor",
      .summary = "A flyball governor starts above its steady speed: its balls swing out and come back.",
      .answer =
          "The angles of arms and spindle, integrated to round-off. Steady where cos(angle) = (1 + "
          "sleeve/(2m)) "
          "g/(l spin²).",
      .error_name = "largest position error of a ball or of the sleeve over l",
      .error_unit = "relative",
      .parameters =
          {{.name = "angle",
            .meaning = "of the arms at first, from hanging down",
            .unit = "degrees",
            .value = 30,
            .limits = {.low = 0, .high = 90, .low_included = false, .high_included = false}},
           {.name = "spin", .meaning = "of the spindle at first", .unit = "rad/s", .value = 11},
           {.name = "l", .meaning = "of an arm", .unit = "m", .value = 0.3, .limits = positive},
           parameter::mass(0.5),
           parameter::radius(0.04),
           {.name = "sleeve", .meaning = "mass of the sleeve", .unit = "kg", .value = 1, .limits = positive},
           {.name = "spindle",
            .meaning = "its moment of inertia",
            .unit = "kg m²",
            .value = 0.01,
            .limits = positive},
           parameter::gravity(),
           parameter::stiff_joints(1e10),
           parameter::relaxation_of_swinging_joints(),
           parameter::start()},
      .h = 0.0005,
      .time = 2,
      .solves = true,
      .build = build_as<FlyballGovernor>,
      .solver = "direct"};
}

}  // namespace spook
