// A gyroscope in gimbals, with a weight on the inner ring: it precesses instead of falling.
//
//   outer ring   turns about z in the frame          inner ring   turns about x in the outer one
//   rotor        spins about y in the inner one      weight       m at s along y
//
//   Ω = m g s/(I ω)        steady precession; exact for a level spin axis and any mass of the rings
//
// The torque about the centre is s ŷ × (-m g ẑ) = -m g s x̂, and L = I ω ŷ + … ẑ turns at Ω ẑ × L = -I ω Ω x̂.
#include "scenes/degrees.hpp"
#include "scenes/disc.hpp"
#include "scenes/registry.hpp"

namespace spook {

namespace {

class Gyroscope : public WorldScene<6> {
 public:
  Gyroscope(const Parameters& p, const Method& method)
      : WorldScene({.gravity = Vec3(0, 0, -p.number("g")), .k = p.number("k"), .d = p.number("d")}, method),
        s_(p.number("arm")) {
    const double radius = p.number("radius"), rotor_mass = p.number("rotor"), m = p.number("m");
    const double inertia = rotor_mass * radius * radius / 2, spin = p.number("spin");
    rate_ = m * p.number("g") * s_ / (inertia * spin);
    const Vec3 turning(0, 0, rate_);
    const Quat level(Eigen::AngleAxisd(-pi / 2, Vec3::UnitX()));  // rotates the rotor's axis from z to y
    const double outer = 1.5 * radius, inner = 1.2 * radius;

    const int frame = world_.add_fixed(Vec3(0, 0, 1.3 * outer));
    const int outer_ring = world_.add({.mass = 0.1, .omega = turning, .principal = Vec3::Constant(1e-3)});
    weight_ = world_.add({.x = Vec3(0, s_, 0),
                          .v = turning.cross(Vec3(0, s_, 0)),
                          .mass = m,
                          .omega = turning,
                          .principal = Vec3::Constant(1e-3)});
    rotor_ = world_.add({.mass = rotor_mass,
                         .q = level,
                         .omega = turning + Vec3(0, spin, 0),
                         .principal = inertia * Vec3(0.5, 0.5, 1),
                         .corners = disc_points(1.5 * radius, 1, 24)});
    const auto hinge = [&](int i, int j, const Vec3& at, const Vec3& axis) {
      world_.add_joint({.i = i,
                        .j = j,
                        .p_i = at - world_.x(i),
                        .p_j = orientation(world_, j).conjugate() * (at - world_.x(j)),
                        .kind = JointKind::hinge,
                        .axis = axis});
    };
    hinge(frame, outer_ring, Vec3(0, 0, outer), Vec3::UnitZ());
    hinge(outer_ring, weight_, Vec3(inner, 0, 0), Vec3::UnitX());
    hinge(weight_, rotor_, Vec3::Zero(), Vec3::UnitY());
    world_.start_consistently(h_);
  }

  void observe() override {
    const double off = std::abs(world_.joint_position(0) - rate_ * time());
    largest_error_ = larger(largest_error_, std::max(off, std::abs(world_.joint_position(1))));
  }
  double error() const override { return largest_error_; }
  std::vector<Ghost> ghosts() const override {
    const Quat q(Eigen::AngleAxisd(rate_ * time(), Vec3::UnitZ()));
    return {{.body = weight_, .x = q * Vec3(0, s_, 0), .q = q}};
  }
  std::vector<Curve> curves() const override {
    return {curve("the circle", 0, 2 * pi,
                  [s = s_](double angle) -> Vec3 { return s * Vec3(-std::sin(angle), std::cos(angle), 0); })};
  }

  void results(StateStream& s) override { s(largest_error_); }

  std::vector<std::string> columns() const override {
    return {"time [s]", "precession [degrees]", "answer [degrees]", "nod [degrees]", "spin [rad/s]"};
  }
  std::vector<double> sample() const override {
    return {time(), world_.joint_position(0) / radians(1), rate_ * time() / radians(1),
            world_.joint_position(1) / radians(1), world_.joint_speed(2)};
  }

 private:
  double s_;
  double rate_ = 0;  // Ω [rad/s]
  int weight_ = 0, rotor_ = 0;
  double largest_error_ = 0;
};

}  // namespace

SceneDescription gyroscope() {
  const Limits positive = {.low = 0, .low_included = false};
  Parameter k = parameter::stiffness(), d = parameter::relaxation();
  k.value = 1e9;
  d.value = 0.25;
  return {.name = "gyroscope",
          .summary = "A gyroscope in gimbals, with a weight that makes it walk round.",
          .answer =
              "It precesses steadily at Ω = m g s/(I ω), I that of the rotor about its axis, and does not nod.",
          .error_name = "largest error of the angles of precession and nod",
          .error_unit = "rad",
          .parameters =
              {{.name = "spin", .meaning = "of the rotor", .unit = "rad/s", .value = 100, .limits = positive},
               {.name = "rotor", .meaning = "mass of the rotor", .unit = "kg", .value = 2, .limits = positive},
               parameter::radius(0.1),
               {.name = "arm",
                .meaning = "from the centre to the weight",
                .unit = "m",
                .value = 0.2,
                .limits = positive},
               parameter::mass(0.5),
               parameter::gravity(),
               k,
               d},
          .h = 0.001,
          .time = 5,
          .solves = true,
          .build = build_as<Gyroscope>,
          .solver = "direct"};
}

}  // namespace spook
