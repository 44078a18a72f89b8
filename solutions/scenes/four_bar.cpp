// A chain of four-bar linkages: cranks side by side on the ground, couplers between their ends, all of one length. They
// start upright, and lie on one line twice in a turn. This is a bifurcation, at which only their speed decides the
// motion.
//
//   θ'' = (g/l) ((N + 1)/2 + N)/((N + 1)/3 + N) sin θ       θ from upright
//
//   N   linkages: N + 1 cranks, N couplers, each a uniform rod of m, l
//
// Cranks stay parallel, so couplers do not rotate.
//
// Source of the problem: A02 of the library of benchmark problems for multibody dynamics, Universidad de La Coruña,
// with N = 2 and 40, 1 m, 1 kg and 1 m/s.
#include "scenes/half_step_energy.hpp"
#include "scenes/mechanism.hpp"
#include "scenes/registry.hpp"

namespace spook {

namespace {

class FourBar : public WorldScene<6> {
 public:
  FourBar(const Parameters& p, const Method& method)
      : WorldScene({.gravity = Vec3(0, 0, -p.number("g")), .k = p.number("k"), .d = p.number("d")}, method),
        l_(p.number("l")),
        g_(p.number("g")),
        angle_(
            [rate = rate(p)](const Eigen::Vector2d& y) { return Eigen::Vector2d(y[1], rate * std::sin(y[0])); },
            Eigen::Vector2d(0, p.number("v0") / p.number("l"))) {
    const int loops = p.count("loops");
    const Vec3 up = l_ * Vec3::UnitZ(), side = l_ * Vec3::UnitX(), turning = Vec3::UnitY();
    const double mass = p.number("m"), spin = p.number("v0") / l_;
    const int ground = world_.add_fixed(Vec3::Zero());
    for (int n = 0; n <= loops; ++n) {
      Body<6> crank = thin_rod(n * side, n * side + up, turning, mass);
      crank.omega = spin * turning;
      crank.v = crank.omega.cross(Vec3(up / 2));
      cranks_.push_back(world_.add(crank));
      hinge(ground, cranks_.back(), n * side);
      if (n == 0) continue;
      Body<6> coupler = thin_rod((n - 1) * side + up, n * side + up, turning, mass);
      coupler.v = 2 * crank.v;
      const int between = world_.add(coupler);
      for (const int m : {n - 1, n}) hinge(cranks_[static_cast<std::size_t>(m)], between, m * side + up);
    }
    if (p.choice("start") == "half_step") world_.start_consistently(h_);
    first_energy_ = energy();
  }

  void observe() override { largest_error_ = larger(largest_error_, (end() - answer()).norm()); }
  double error() const override { return relative(largest_error_, l_); }
  std::vector<Ghost> ghosts() const override { return {{.body = cranks_[0], .x = answer() / 2}}; }

  void results(StateStream& s) override { s(angle_, largest_error_); }

  std::vector<std::string> columns() const override {
    return {"time [s]", "x of B0 [m]", "z of B0 [m]", "answer x [m]", "answer z [m]", "energy change [J]"};
  }
  std::vector<double> sample() const override {
    return {time(), end().x(), end().z(), answer().x(), answer().z(), energy() - first_energy_};
  }

 private:
  static double rate(const Parameters& p) {
    const double loops = p.number("loops");
    return p.number("g") / p.number("l") * ((loops + 1) / 2 + loops) / ((loops + 1) / 3 + loops);
  }

  void hinge(int i, int j, const Vec3& place) {
    world_.add_joint(joint_at(world_, JointKind::hinge, i, j, place, Vec3::UnitY()));
  }

  /// The end of the first crank, B0.
  Vec3 end() const { return 2 * world_.x(cranks_[0]); }
  Vec3 answer() const {
    const double theta = angle_.at(time())[0];
    return l_ * Vec3(std::sin(theta), 0, std::cos(theta));
  }
  double energy() const { return half_step_energy(world_.bodies(), g_, 2 * velocity_lag()); }

  double l_, g_;
  mutable ReferenceMotion<2> angle_;  // advances to the requested time
  std::vector<int> cranks_;
  double first_energy_ = 0, largest_error_ = 0;
};

}  // namespace

SceneDescription four_bar() {
  const Limits positive = {.low = 0, .low_included = false};
  Parameter speed = parameter::speed(1);
  speed.meaning = "of the cranks' ends at first";
  return {
      .name = "four_bar",
      .summary =
          "A chain of four-bar linkages turns over, through positions from which it could continue in two "
          "ways.",
      .answer =
          "One angle: θ'' = (g/l) ((N + 1)/2 + N)/((N + 1)/3 + N) sin θ from upright, integrated to round-off. "
          "The problem is A02 of La Coruña's library of multibody benchmarks.",
      .error_name = "largest position error of the first crank's end over its length",
      .error_unit = "relative",
      .parameters = {{.name = "loops",
                      .meaning = "four-bar linkages in the chain",
                      .value = 2,
                      .limits = {.low = 1, .high = 100, .whole = true}},
                     {.name = "l", .meaning = "of each bar", .unit = "m", .value = 1, .limits = positive},
                     speed,
                     parameter::mass(),
                     parameter::gravity(),
                     parameter::stiff_joints(1e10),
                     parameter::relaxation_of_swinging_joints(),
                     parameter::start()},
      .h = 0.001,
      .time = 2,
      .solves = true,
      .build = build_as<FourBar>,
      .solver = "direct"};
}

}  // namespace spook
