// A wire of point masses with a heavy load, released straight at an angle. Its tension acts as transverse springs whose
// periods are shorter than practical steps.
//
//   ω = √(4 T/(m l))      the highest frequency, Eq. (12.1): without its stiffness in M, steps above 2/ω are unstable
//
// The answer: links keep their length, and energy does not grow. All points start with the acceleration g sin θ across
// the wire, so their velocities start half a step back, Eq. (1.5).
#include "12_stiff_wires/stiff_wires.hpp"
#include "scenes/degrees.hpp"
#include "scenes/half_step_energy.hpp"
#include "scenes/registry.hpp"

namespace spook {

namespace {

class StiffWire : public WorldScene<3> {
 public:
  StiffWire(const Parameters& p, const Method& method)
      : WorldScene({.gravity = Vec3(0, 0, -p.number("g")), .k = p.number("k"), .d = p.number("d")}, method),
        links_(p.count("links")),
        length_(p.number("length")),
        g_(p.number("g")) {
    const double m = p.number("m"), M = p.number("ratio") * m, angle = radians(p.number("angle"));
    const Vec3 along(std::sin(angle), 0, -std::cos(angle)), across(-std::cos(angle), 0, -std::sin(angle));
    world_.add_fixed(Vec3::Zero());
    double from_start = 0;
    for (int i = 1; i <= links_; ++i) {
      const double mass = i == links_ ? M : m;
      world_.add({.x = length_ * i / links_ * along,
                  .v = -velocity_lag() * g_ * std::sin(angle) * across,
                  .mass = mass});
      world_.add_joint({.i = i - 1, .j = i, .length = length_ / links_});
      start_energy_ += mass * g_ * world_.x(i).z();
      from_start += mass * g_ * (world_.x(i).z() + length_ * i / links_);
    }
    scale_ = from_start;
    const double tension = (M + (links_ - 1) * m) * g_ * std::cos(angle);
    largest_step_ = 2 / transverse_frequency(tension, m, length_ / links_);
  }

  void observe() override {
    double worst = 0;
    for (int link = 0; link < links_; ++link) worst = larger(worst, std::abs(gap(link)));
    now_ = worst * links_ / length_;
    error_ = larger(error_, now_);
  }
  double error() const override { return error_; }
  std::vector<Curve> curves() const override {
    return {curve("where a wire of the right length ends", 0, 2 * pi, [l = length_](double angle) -> Vec3 {
      return l * Vec3(std::sin(angle), 0, -std::cos(angle));
    })};
  }

  void results(StateStream& s) override { s(now_, error_); }

  std::vector<std::string> columns() const override {
    return {"time [s]",       "load x [m]",
            "load z [m]",     "energy over the start's",
            "worst link [-]", "largest step without stiffness [s]"};
  }
  std::vector<double> sample() const override {
    const Vec3& load = world_.x(links_);
    return {time(), load.x(), load.z(), energy(), now_, largest_step_};
  }

 private:
  double gap(int joint) const {
    const Joint& link = world_.joints()[static_cast<std::size_t>(joint)];
    return distance(link, world_.bodies()) - *link.length;
  }

  /// The energy half a step ago, over the energy released by the swing; 1 at the start.
  double energy() const {
    if (time() == 0) return 1;
    return 1 + (half_step_energy(world_.bodies(), g_, 2 * velocity_lag()) - start_energy_) / scale_;
  }

  int links_;
  double length_, g_, start_energy_ = 0, scale_ = 0, largest_step_ = 0;
  double now_ = 0, error_ = 0;
};

}  // namespace

SceneDescription stiff_wire() {
  Parameter ratio = parameter::ratio(), stiffness = parameter::stiffness(), length = parameter::length();
  ratio.value = 1000;
  stiffness.value = 1e9;
  length.value = 10;
  return {
      .name = "stiff_wire",
      .summary = "A wire with a heavy load is released at an angle, and swings.",
      .answer =
          "Links keep their length, and energy does not grow. With steps above 2/ω, ω = √(4 T/(m l)), the run "
          "is lost with every solver, exact ones included, except geometric_stiffness, which adds the "
          "stiffness of the tension to M.",
      .error_name = "largest error of any link's length so far over that length",
      .error_unit = "relative",
      .parameters = {parameter::links(100),
                     ratio,
                     {.name = "angle",
                      .meaning = "initial angle, from hanging down; from 90 on the wire would go slack, and be "
                                 "lost when it becomes taut again within a step",
                      .unit = "degrees",
                      .value = 30,
                      .limits = {.low = 0, .high = 90, .high_included = false}},
                     length,
                     parameter::mass(0.01),
                     parameter::weighing_gravity(),
                     stiffness,
                     parameter::relaxation()},
      .h = 1.0 / 60,
      .time = 5,
      .solves = true,
      .build = build_as<StiffWire>,
      .solver = "geometric_stiffness"};
}

}  // namespace spook
