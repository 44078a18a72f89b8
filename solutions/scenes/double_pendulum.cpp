// A double pendulum of two point masses on rods, from rest: no closed form, and chaotic.
//
//   θ1'' + μ (l2/l1) cos δ θ2'' = -μ (l2/l1) sin δ θ2'² - (g/l1) sin θ1,     μ = m2/(m1 + m2),  δ = θ1 - θ2
//   θ2'' + (l1/l2) cos δ θ1''   =    (l1/l2) sin δ θ1'² - (g/l2) sin θ2
//
// are integrated to round-off, and compared with two distances. An error grows little in the first seconds. Then it
// grows about tenfold in each two seconds with 1 m rods (from 90°, after about 7 s), so comparisons become meaningless.
//
// After a release from rest, half a step back the velocities are -h/2 times these accelerations.
#include "common/require.hpp"
#include "scenes/degrees.hpp"
#include "scenes/half_step_energy.hpp"
#include "scenes/reference_motion.hpp"
#include "scenes/registry.hpp"

namespace spook {

namespace {

/// θ1, θ2, θ1', θ2'.
using Angles = ReferenceMotion<4>::State;

struct Rods {
  double l1, l2, m1, m2, g;

  Angles rate(const Angles& y) const {
    const double sin = std::sin(y[0] - y[1]), cos = std::cos(y[0] - y[1]);
    const double mu = m2 / (m1 + m2), ratio = l2 / l1;
    const double A = -mu * ratio * sin * y[3] * y[3] - g / l1 * std::sin(y[0]);
    const double B = sin / ratio * y[2] * y[2] - g / l2 * std::sin(y[1]);
    const double determinant = sin * sin + m1 / (m1 + m2) * cos * cos;  // 1 - μ cos²δ
    return {y[2], y[3], (A - mu * ratio * cos * B) / determinant, (B - cos / ratio * A) / determinant};
  }

  Vec3 first(const Angles& y) const { return l1 * Vec3(std::sin(y[0]), 0, -std::cos(y[0])); }
  Vec3 second(const Angles& y) const { return first(y) + l2 * Vec3(std::sin(y[1]), 0, -std::cos(y[1])); }
};

Rods rods(const Parameters& p) {
  const Rods rods{p.number("l1"), p.number("l2"), p.number("m1"), p.number("m2"), p.number("g")};
  // A light mass oscillates faster by √(m1/m2), and a short rod by √(l2/l1); the reference must resolve this.
  const double masses = rods.m2 / rods.m1, lengths = rods.l2 / rods.l1;
  if (!(masses <= 1e4)) reject("m2/m1", masses, "at most 1e4");
  if (!(lengths >= 1e-4 && lengths <= 1e4)) reject("l2/l1", lengths, "from 1e-4 to 1e4");
  return rods;
}

class DoublePendulum : public WorldScene<3> {
 public:
  DoublePendulum(const Parameters& p, const Method& method)
      : WorldScene({.gravity = Vec3(0, 0, -p.number("g")), .k = p.number("k"), .d = p.number("d")}, method),
        rods_(rods(p)),
        answer_([rods = rods_](const Angles& y) { return rods.rate(y); }, start(p)) {
    // Beyond this time neither the engine nor the reference is meaningful.
    const double swing = std::sqrt(std::max(rods_.l1, rods_.l2) / rods_.g);
    if (!(h_ <= 10 * swing)) reject("h", h_, "at most ten times √(l/g) of the longer rod");

    const Angles y = start(p);
    Vec3 v1 = Vec3::Zero(), v2 = Vec3::Zero();
    if (p.choice("start") == "half_step") {
      const Angles rate = rods_.rate(y);
      const auto across = [](double angle) { return Vec3(std::cos(angle), 0, std::sin(angle)); };
      v1 = -velocity_lag() * rods_.l1 * rate[2] * across(y[0]);  // Eq. (1.5)
      v2 = v1 - velocity_lag() * rods_.l2 * rate[3] * across(y[1]);
    }
    const int anchor = world_.add_fixed(Vec3::Zero());
    first_ = world_.add({.x = rods_.first(y), .v = v1, .mass = rods_.m1});
    second_ = world_.add({.x = rods_.second(y), .v = v2, .mass = rods_.m2});
    world_.add_joint({.i = anchor, .j = first_, .length = rods_.l1});
    world_.add_joint({.i = first_, .j = second_, .length = rods_.l2});
  }

  void observe() override { largest_error_ = larger(largest_error_, (world_.x(second_) - answer()).norm()); }
  double error() const override { return relative(largest_error_, rods_.l1 + rods_.l2); }
  std::vector<Ghost> ghosts() const override {
    return {{.body = first_, .x = rods_.first(answer_.at(time()))}, {.body = second_, .x = answer()}};
  }

  void results(StateStream& s) override { s(answer_, largest_error_); }

  std::vector<std::string> columns() const override {
    return {"time [s]",     "x [m]",         "z [m]",         "answer x [m]",
            "answer z [m]", "tension 1 [N]", "tension 2 [N]", "energy [J]"};
  }
  std::vector<double> sample() const override {
    const Vec3& x = world_.x(second_);
    const Vec3 answer = this->answer();
    return {time(),
            x.x(),
            x.z(),
            answer.x(),
            answer.z(),
            -world_.joint_lambda(0) / impulse_time(),
            -world_.joint_lambda(1) / impulse_time(),
            half_step_energy(world_.bodies(), rods_.g, 2 * velocity_lag())};
  }

 private:
  static Angles start(const Parameters& p) {
    return {radians(p.number("angle1")), radians(p.number("angle2")), 0, 0};
  }

  /// The right position of the lower mass.
  Vec3 answer() const { return rods_.second(answer_.at(time())); }

  Rods rods_;
  mutable ReferenceMotion<4> answer_;  // advances to the requested time
  int first_ = 0, second_ = 0;
  double largest_error_ = 0;
};

}  // namespace

SceneDescription double_pendulum() {
  const Limits positive = {.low = 0, .low_included = false};
  const auto length = [&](const std::string& name, const std::string& meaning) {
    return Parameter{.name = name, .meaning = meaning, .unit = "m", .value = 1, .limits = positive};
  };
  const auto mass = [&](const std::string& name, const std::string& meaning) {
    return Parameter{.name = name, .meaning = meaning, .unit = "kg", .value = 1, .limits = positive};
  };
  const auto angle = [](const std::string& name, const std::string& meaning) {
    return Parameter{
        .name = name, .meaning = meaning, .unit = "degrees", .value = 90, .limits = {.low = -360, .high = 360}};
  };
  Parameter k = parameter::stiffness();
  k.value = 1e9;  // so large that the stretch of the rods is smaller than the error of a step
  return {
      .name = "double_pendulum",
      .summary = "Two point masses on rods, one hung from the other, are released from rest.",
      .answer =
          "The equations of the two angles, integrated to round-off by extrapolation; only the "
          "ratio of the masses counts. It is chaotic: from 90°, after some 7 s, errors grow about tenfold in "
          "two "
          "seconds.",
      .error_name = "largest position error of the lower mass over l1 + l2",
      .error_unit = "relative",
      .parameters = {length("l1", "of the rod from the anchor"), length("l2", "of the rod between the masses"),
                     mass("m1", "of the upper mass"), mass("m2", "of the lower mass"),
                     angle("angle1", "of the upper rod, from hanging down"),
                     angle("angle2", "of the lower rod, from hanging down"), parameter::gravity(), k,
                     parameter::relaxation(), parameter::start()},
      .h = 0.001,
      .time = 2,
      .solves = true,
      .build = build_as<DoublePendulum>,
      .chaotic = true};
}

}  // namespace spook
