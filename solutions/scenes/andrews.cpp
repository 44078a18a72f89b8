// Andrews' squeezer as seven bodies on ten hinges in a plane: a torque on the crank, a spring against it, from rest. In
// 0.03 s the crank turns two and a half times, and reaches 1140 rad/s.
//
// The answer integrates the published equations in seven angles: scenes/andrews_squeezer.hpp.
#include "scenes/andrews_squeezer.hpp"

#include "scenes/mechanism.hpp"
#include "scenes/registry.hpp"

namespace spook {

namespace {

/// The crank's torque and the spring's force, on bodies after a static one. They depend on positions only.
Twist<6> driven(std::size_t i, const Bodies<6>& bodies) {
  Twist<6> wrench = Twist<6>::Zero();
  if (i == 1) wrench[5] = squeezer::drive;
  if (i == 3) {
    const Quat& q = bodies.orientations.q[3];
    // Seen from B, in the body's axes, D is at (sd, -sc) and the centre at (sb, -sa).
    const Vec3 D = bodies.x[3] + q * Vec3(squeezer::sd - squeezer::sb, squeezer::sa - squeezer::sc, 0);
    const Vec3 F = squeezer::spring_force(D);
    wrench << F, (D - bodies.x[3]).cross(F);
  }
  return wrench;
}

class Andrews : public WorldScene<6> {
 public:
  Andrews(const Parameters& p, const Method& method)
      : WorldScene({.gravity = Vec3::Zero(),
                    .wrench = [](std::size_t i, const Bodies<6>& bodies, double) { return driven(i, bodies); },
                    .k = p.number("k"),
                    .d = p.number("d")},
                   method),
        answer_([](const squeezer::State& y) { return squeezer::rate(y); }, at_rest(), 1e-14,
                [](const squeezer::State& y) { return squeezer::projected(y); }) {
    using namespace squeezer;
    const Angles q = squeezer::start(), a = of_bodies(q);
    const std::array<Vec3, 7> x = centres(q);
    world_.add_fixed(Vec3::Zero());
    for (std::size_t n = 0; n < 7; ++n)
      world_.add({.x = x[n],
                  .mass = mass[n],
                  .q = Quat(Eigen::AngleAxisd(a[static_cast<Eigen::Index>(n)], Vec3::UnitZ())),
                  .principal = Vec3::Constant(inertia[n])});
    const auto along = [&](int body, double length) {
      return Vec3(length * (orientation(world_, body) * Vec3::UnitX()));
    };
    const Vec3 A(xa, ya, 0), B(xb, yb, 0), crank_end = along(1, rr), E = crank_end - along(2, d);
    const Vec3 turned_back = Vec3(std::sin(a[6]), -std::cos(a[6]), 0);
    hinge(0, 1, Vec3::Zero());
    hinge(1, 2, crank_end);
    for (const int arm : {3, 4, 6}) hinge(2, arm, E);
    hinge(0, 3, B);
    hinge(4, 5, A + along(5, zt));
    hinge(0, 5, A);
    hinge(6, 7, A + u * turned_back);
    hinge(0, 7, A);
    if (p.choice("start") == "half_step") world_.start_consistently(h_);
  }

  void observe() override {
    const squeezer::Angles right = squeezer::of_bodies(answer_.at(time()).head<7>());
    for (int body = 1; body <= 7; ++body) {
      const Quat wanted(Eigen::AngleAxisd(right[body - 1], Vec3::UnitZ()));
      largest_error_ = larger(largest_error_, orientation(world_, body).angularDistance(wanted));
    }
  }
  double error() const override { return largest_error_; }
  std::vector<Ghost> ghosts() const override {
    std::vector<Ghost> ghosts;
    const std::array<Vec3, 7> x = squeezer::centres(answer_.at(time()).head<7>());
    for (int body = 1; body <= 7; ++body)
      ghosts.push_back({.body = body, .x = x[static_cast<std::size_t>(body - 1)]});
    return ghosts;
  }

  void results(StateStream& s) override { s(answer_, largest_error_); }

  std::vector<std::string> columns() const override {
    return {"time [s]", "beta [rad]", "answer [rad]", "beta' [rad/s]", "answer beta' [rad/s]"};
  }
  std::vector<double> sample() const override {
    const squeezer::State& right = answer_.at(time());
    return {time(), world_.joints()[0].angle + squeezer::start()[0], right[0], angular_velocity(world_, 1).z(),
            right[7]};
  }

 private:
  static squeezer::State at_rest() {
    squeezer::State y;
    y << squeezer::start(), squeezer::Angles::Zero();
    return y;
  }
  void hinge(int i, int j, const Vec3& place) {
    world_.add_joint(joint_at(world_, JointKind::hinge, i, j, place, Vec3::UnitZ()));
  }

  mutable ReferenceMotion<14> answer_;  // advances to the requested time
  double largest_error_ = 0;
};

}  // namespace

SceneDescription andrews() {
  return {.name = "andrews",
          .summary = "Andrews' squeezer: seven bodies on ten hinges, driven by a torque against a spring.",
          .answer =
              "The equations of Hairer and Wanner, II, VII.7, in seven angles, integrated to round-off; at "
              "0.03 s they "
              "are the solution published in the Test Set for IVP Solvers, to 1.2e-9 rad.",
          .error_name = "largest error of a body's angle so far",
          .error_unit = "rad",
          .parameters = {parameter::stiff_joints(1e15), parameter::relaxation_of_swinging_joints(),
                         parameter::start()},
          .h = 2e-5,
          .time = 0.03,
          .solves = true,
          .build = build_as<Andrews>,
          .solver = "direct"};
}

}  // namespace spook
