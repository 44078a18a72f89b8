// An asymmetric top without torques: spinning near its middle axis, it turns over periodically.
//
// Compares ω in the body's own axes with the closed form of FreeTop, so errors of ω and of q both count.
#include "engine/bodies/conserved_quantities.hpp"
#include "scenes/free_top.hpp"
#include "scenes/reference_motion.hpp"
#include "scenes/registry.hpp"

namespace spook {

namespace {

Vec3 principal(const Parameters& p) {
  return {p.number("I1"), p.number("I2"), p.number("I3")};
}
Vec3 first_omega(const Parameters& p) {
  return {p.number("wx"), p.number("wy"), p.number("wz")};
}

/// The half sides of a solid box of 1 kg with these moments, m/3 (b² + c²) and so on; of a thin box if no solid box has
/// them.
Vec3 half_sides(const Vec3& principal) {
  const double sum = principal.sum();
  return (1.5 * (Vec3::Constant(sum) - 2 * principal)).cwiseMax(0.01 * sum).cwiseSqrt();
}

RotationRule<6> rotation_rule(const Parameters& p) {
  const std::string& update = p.choice("update");
  const bool gyroscopic = p.choice("gyroscopic") == "on";
  if (update == "first_order") return {RotationUpdate::first_order, gyroscopic};
  if (update == "exponential") return {RotationUpdate::exponential, gyroscopic};
  if (!gyroscopic)
    throw std::invalid_argument(
        "gyroscopic=off needs update=first_order or exponential, but is with "
        "update=splitting");
  return {RotationUpdate::splitting, true};
}

class Top : public WorldScene<6> {
 public:
  Top(const Parameters& p, const Method& method)
      : WorldScene({.gravity = Vec3::Zero(), .rotation = rotation_rule(p)}, method),
        answer_(principal(p), first_omega(p)) {
    world_.add({.omega = first_omega(p), .principal = principal(p), .half_sides = half_sides(principal(p))});
  }

  void observe() override {
    largest_error_ = larger(largest_error_, (omega_in_body() - answer_.omega(time())).norm());
  }
  double error() const override { return relative(largest_error_, answer_.omega(0).norm()); }
  std::vector<Ghost> ghosts() const override {
    const Eigen::Matrix<double, 5, 1>& y = turned_.at(time());
    return {{.body = 0, .x = Vec3::Zero(), .q = Quat(y[0], y[1], y[2], y[3]).normalized()}};
  }

  void results(StateStream& s) override { s(largest_error_); }

  std::vector<std::string> columns() const override {
    return {"time [s]",   "omega 1 [rad/s]", "omega 2 [rad/s]", "omega 3 [rad/s]",
            "energy [J]", "L x [kg m²/s]",   "L y [kg m²/s]",   "L z [kg m²/s]"};
  }
  std::vector<double> sample() const override {
    const Vec3 w = omega_in_body();
    const Vec3 L = angular_momentum(world_.bodies());
    return {time(), w[0], w[1], w[2], kinetic_energy(world_.bodies()), L[0], L[1], L[2]};
  }

 private:
  Vec3 omega_in_body() const { return orientation(world_, 0).conjugate() * angular_velocity(world_, 0); }

  FreeTop answer_;
  // q' = ½ q ω, with ω in the body's axes; the fifth number is the time.
  mutable ReferenceMotion<5> turned_{
      [this](const Eigen::Matrix<double, 5, 1>& y) {
        const Quat q(y[0], y[1], y[2], y[3]);
        const Vec3 w = answer_.omega(y[4]);
        const Quat rate = q * Quat(0, w[0] / 2, w[1] / 2, w[2] / 2);
        return Eigen::Matrix<double, 5, 1>({rate.w(), rate.x(), rate.y(), rate.z(), 1.0});
      },
      Eigen::Matrix<double, 5, 1>({1.0, 0.0, 0.0, 0.0, 0.0})};
  double largest_error_ = 0;
};

}  // namespace

SceneDescription top() {
  const auto moment = [](const std::string& name, double value) {
    return Parameter{.name = name,
                     .meaning = "principal moment; I1 < I2 < I3",
                     .unit = "kg m²",
                     .value = value,
                     .limits = {.low = 0, .low_included = false}};
  };
  const auto spin = [](const std::string& name, double value) {
    return Parameter{.name = name, .meaning = "angular velocity at time 0", .unit = "rad/s", .value = value};
  };
  return {.name = "top",
          .summary = "An asymmetric top without a torque.",
          .answer =
              "ω in the body's axes is A cn(u), ±B sn(u), ±C dn(u), Jacobi's elliptic functions of time; "
              "with the default moments and spin it turns over and back in 39.1057 s.",
          .error_name = "largest error of ω in the body's axes over |ω| at time 0",
          .error_unit = "relative",
          .parameters = {moment("I1", 1),
                         moment("I2", 2),
                         moment("I3", 3),
                         spin("wx", 0.01),
                         spin("wy", 1),
                         spin("wz", 0.01),
                         {.name = "update",
                          .meaning = "how q and ω are moved on",
                          .choices = {"splitting", "first_order", "exponential"}},
                         {.name = "gyroscopic",
                          .meaning = "adds the gyroscopic torque explicitly; update=splitting always has it",
                          .choices = {"on", "off"}}},
          .h = 0.01,
          .time = 40,
          .solves = false,
          .build = build_as<Top>};
}

}  // namespace spook
