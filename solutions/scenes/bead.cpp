// A bead slides out along a rod that rotates freely in the plane y = 0, and slows the rod as an ice skater slows who
// opens her arms. There is no gravity.
//
//   r'' = r ω²,   ω = L/(I + m r²)        L is constant; I is that of the rod, plus that of the bead about its centre
//
// The slider's axis rotates with the rod, and the bead is far from the rod's centre. So the second term of (22) in the
// notes is not small here. Without it L is not conserved: chapter 13.
#include "engine/bodies/conserved_quantities.hpp"
#include "scenes/degrees.hpp"
#include "scenes/reference_motion.hpp"
#include "scenes/registry.hpp"

namespace spook {

namespace {

constexpr double rail_thickness = 0.02;  // half the thickness of the rod [m]

class Bead : public WorldScene<6> {
 public:
  Bead(const Parameters& p, const Method& method)
      : WorldScene({.gravity = Vec3::Zero(), .k = p.number("k"), .d = p.number("d")}, method),
        m_(p.number("m")) {
    const double r0 = p.number("r0"), spin = p.number("spin"), radius = p.number("radius");
    const Vec3 half(p.number("length"), rail_thickness, rail_thickness), omega(0, -spin, 0);
    const Vec3 of_rod = solid_box_moments(p.number("rod"), half), of_bead = solid_sphere_moments(m_, radius);
    inertia_ = of_rod.y() + of_bead.y();
    const int frame = world_.add_fixed(Vec3::Zero());
    const int rod = world_.add(
        {.mass = p.number("rod"), .omega = omega, .principal = of_rod, .corners = box_corners(half)});
    bead_ = world_.add(
        {.x = Vec3(r0, 0, 0), .v = omega.cross(Vec3(r0, 0, 0)), .mass = m_, .radius = radius, .omega = omega});
    world_.add_joint({.i = frame, .j = rod, .kind = JointKind::hinge, .axis = -Vec3::UnitY()});
    world_.add_joint({.i = rod, .j = bead_, .kind = JointKind::slider, .axis = Vec3::UnitX()});
    world_.start_consistently(h_);
    momentum_ = (inertia_ + m_ * r0 * r0) * spin;
    answer_.emplace(
        [this](const State& y) {
          const double w = momentum_ / (inertia_ + m_ * y[0] * y[0]);
          return State(y[1], y[0] * w * w, w);
        },
        State(r0, 0, 0));
  }

  void observe() override {
    const State& y = answer_->at(time());
    radius_ = y[0];
    angle_ = y[2];
    largest_error_ = larger(largest_error_, relative((world_.x(bead_) - place()).norm(), radius_));
  }
  double error() const override { return largest_error_; }
  std::vector<Ghost> ghosts() const override {
    return {{.body = bead_, .x = place(), .q = Quat(Eigen::AngleAxisd(angle_, -Vec3::UnitY()))}};
  }

  void results(StateStream& s) override { s(*answer_, radius_, angle_, largest_error_); }

  std::vector<std::string> columns() const override {
    return {"time [s]", "out [m]", "answer [m]", "spin [rad/s]", "L [kg m²/s]"};
  }
  std::vector<double> sample() const override {
    return {time(), world_.joint_position(1), radius_, world_.joint_speed(0),
            -angular_momentum(world_.bodies()).y()};
  }

 private:
  using State = Eigen::Vector3d;  // r, r', the angle of the rod

  Vec3 place() const { return radius_ * Vec3(std::cos(angle_), 0, std::sin(angle_)); }

  double m_, inertia_ = 0, momentum_ = 0;
  std::optional<ReferenceMotion<3>> answer_;
  double radius_ = 0, angle_ = 0;  // the answer's
  int bead_ = 0;
  double largest_error_ = 0;
};

}  // namespace

SceneDescription bead() {
  const Limits positive = {.low = 0, .low_included = false};
  Parameter k = parameter::stiffness(), d = parameter::relaxation();
  k.value = 1e9;
  d.value = 0.25;
  return {
      .name = "bead",
      .summary = "A bead slides out along a rod that turns freely.",
      .answer = "r'' = r ω², ω = L/(I + m r²), integrated to round-off; the angular momentum L stays the same.",
      .error_name = "largest error of the bead's place over its distance from the axis",
      .error_unit = "relative",
      .parameters =
          {{.name = "r0",
            .meaning = "where the bead begins, from the axis",
            .unit = "m",
            .value = 0.1,
            .limits = positive},
           {.name = "spin",
            .meaning = "of rod and bead at time 0",
            .unit = "rad/s",
            .value = 5,
            .limits = positive},
           {.name = "rod", .meaning = "mass of the rod", .unit = "kg", .value = 3, .limits = positive},
           {.name = "length",
            .meaning = "of the rod, from the axis to an end",
            .unit = "m",
            .value = 1,
            .limits = positive},
           parameter::radius(0.05),
           parameter::mass(),
           k,
           d},
      .h = 0.001,
      .time = 0.6,
      .solves = true,
      .build = build_as<Bead>,
      .solver = "direct"};
}

}  // namespace spook
