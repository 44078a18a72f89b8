// A pendulum, released from rest at any angle: a point mass on a rod, or a rigid sphere on a ball joint.
//
//   point   θ'' = -(g/l) sin θ                                    one distance row
//   body    θ'' = -(m g l/I) sin θ,  I = m l² + (2/5) m r²        three rows; it rotates with its rod
//
//   T = 4 K(sin(θ0/2))/ω,  ω² = g/l or m g l/I                                              Eq. (6.13)
//
// Both are of second order in h. The bob has the acceleration A = v²/l towards the anchor. Therefore the row leaves a
// gap, which makes the rod too long, and which lags behind A:
//
//   gap = (1 + 2d) h² A/4 - d² h³ A'/2 + …        in addition to tension/k
//
// The first term conserves energy; the second dissipates (3/4) m d² h³ ∫ A'² dt, of third order.
//
// At the release the rod balances the weight along it, m g cos θ0. So half a step back, too, the bob moves only across
// the rod.
#include "scenes/degrees.hpp"
#include "scenes/half_step_energy.hpp"
#include "scenes/plane_pendulum.hpp"
#include "scenes/registry.hpp"

namespace spook {

namespace {

/// The length that the inertia of a solid sphere adds to l in ω² = g/l [m]; 0 for a point mass.
double added_length(const Parameters& p) {
  if (p.choice("model") == "point") return 0;
  const double radius = p.number("radius");
  return 0.4 * radius * radius / p.number("l");
}

template <int Dof>
class Pendulum : public WorldScene<Dof> {
 public:
  Pendulum(const Parameters& p, const Method& method)
      : WorldScene<Dof>({.gravity = Vec3(0, 0, -p.number("g")), .k = p.number("k"), .d = p.number("d")},
                        method),
        l_(p.number("l")),
        g_(p.number("g")),
        answer_(radians(p.number("angle")), std::sqrt(g_ / (l_ + added_length(p)))) {
    const double angle0 = radians(p.number("angle"));
    const Vec3 outward(std::sin(angle0), 0, -std::cos(angle0)), across(std::cos(angle0), 0, std::sin(angle0));

    Body<Dof> bob;
    bob.x = l_ * outward;
    bob.mass = p.number("m");
    double spin = 0;  // θ' [rad/s]
    if (p.choice("start") == "half_step")
      spin = this->velocity_lag() * g_ / (l_ + added_length(p)) * std::sin(angle0);  // Eq. (1.5), from -θ''
    bob.v = l_ * spin * across;
    if constexpr (Dof == 6) {
      bob.principal = solid_sphere_moments(bob.mass, p.number("radius"));
      bob.omega = -spin * Vec3::UnitY();
    }
    anchor_ = world_.add_fixed(Vec3::Zero());
    bob_ = world_.add(bob);
    if constexpr (Dof == 6)
      world_.add_joint({.i = anchor_, .j = bob_, .p_j = -bob.x});
    else
      world_.add_joint({.i = anchor_, .j = bob_, .length = l_});
  }

  void observe() override { largest_error_ = larger(largest_error_, (world_.x(bob_) - answer()).norm()); }
  double error() const override { return relative(largest_error_, l_); }
  std::vector<Ghost> ghosts() const override { return {{.body = bob_, .x = answer()}}; }
  std::vector<Curve> curves() const override {
    return {curve("the circle", 0, 2 * pi,
                  [l = l_](double angle) -> Vec3 { return l * Vec3(std::sin(angle), 0, -std::cos(angle)); })};
  }

  void results(StateStream& s) override { s(largest_error_); }

  std::vector<std::string> columns() const override {
    return {"time [s]", "angle [degrees]", "answer [degrees]", "gap [m]", "tension [N]", "energy [J]"};
  }
  std::vector<double> sample() const override {
    return {this->time(),      degrees(world_.x(bob_)),
            degrees(answer()), gap(),
            tension(),         half_step_energy(world_.bodies(), g_, 2 * this->velocity_lag())};
  }

 private:
  using WorldScene<Dof>::world_;

  static double degrees(const Vec3& x) { return std::atan2(x.x(), -x.z()) / radians(1); }

  Vec3 answer() const {
    const PlanePendulum::Direction theta = answer_.direction(this->time());
    return l_ * Vec3(theta.sin, 0, -theta.cos);
  }

  /// The stretch of the rod: distance of the bob from the anchor, minus l [m].
  double gap() const { return world_.x(bob_).norm() - l_; }

  /// The tension in the last step, along the current direction of the rod [N].
  double tension() const {
    if constexpr (Dof == 3) return -world_.joint_lambda(0) / this->impulse_time();
    const Vec3 on_bob(world_.joint_lambda(0, 0), world_.joint_lambda(0, 1), world_.joint_lambda(0, 2));
    return -on_bob.dot(world_.x(bob_).normalized()) / this->impulse_time();
  }

  double l_, g_;
  PlanePendulum answer_;
  int anchor_ = 0, bob_ = 0;
  double largest_error_ = 0;
};

}  // namespace

SceneDescription pendulum() {
  const Limits positive = {.low = 0, .low_included = false};
  Parameter radius = parameter::radius();
  radius.meaning += "; model=body";
  Parameter k = parameter::stiffness();
  k.value = 1e9;  // so large that the rod's stretch is smaller than the error of a step
  return {.name = "pendulum",
          .summary = "A bob on a rod is released from rest at any angle.",
          .answer =
              "sin(θ/2) = sin(θ0/2) cd(ωt), a Jacobian elliptic function, ω² = g/l of a point mass and "
              "m g l/I of a body; the period 4 K(sin(θ0/2))/ω is 2.34524 s from 90° with l = 1, g = 10 "
              "and a point mass, whatever its m.",
          .error_name = "largest position error over the length of the rod",
          .error_unit = "relative",
          .parameters = {{.name = "l",
                          .meaning = "from the anchor to the bob's centre",
                          .unit = "m",
                          .value = 1,
                          .limits = positive},
                         {.name = "angle",
                          .meaning = "initial angle, from hanging down",
                          .unit = "degrees",
                          .value = 90,
                          .limits = {.low = 0, .high = 180, .high_included = false}},
                         {.name = "model",
                          .meaning = "point: a point mass on a distance; body: a sphere on a ball joint",
                          .choices = {"point", "body"}},
                         radius,
                         parameter::mass(),
                         parameter::gravity(),
                         k,
                         parameter::relaxation(),
                         parameter::start()},
          .h = 0.001,
          .time = 5,
          .solves = true,
          .build = build_model<Pendulum>};
}

}  // namespace spook
