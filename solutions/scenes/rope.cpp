// A rope of equal links between two supports of the same height: rope() of chapter 06.
//
// The answer is the chain of HangingChain, whose links are stretched by T_i/k as SPOOK's are at rest. The rope starts
// there, and should stay at rest. Or it starts with links at their natural length, stretches by T_i/k, and oscillates
// about the answer without damping, since rows do not act across links.
//
// To transverse motion a link of length l under T is a spring of stiffness T/l. Leapfrog is stable for it while h ω <
// 2, with ω² = 4T/(m l) and the mass m of a point, for any rows along the link. T is M g/2 or more at the ends, so this
// is N h < √(2L/g): at 60 Hz a rope of 1 m has at most 26 links, and a rope with more is unstable.
#include "common/require.hpp"
#include "scenes/half_step_energy.hpp"
#include "scenes/hanging_chain.hpp"
#include "scenes/registry.hpp"

namespace spook {

namespace {

class Rope : public WorldScene<3> {
 public:
  Rope(const Parameters& p, const Method& method)
      : WorldScene({.gravity = Vec3(0, 0, -p.number("g")), .k = p.number("k"), .d = p.number("d")}, method),
        links_(p.count("links")),
        length_(p.number("length")),
        g_(p.number("g")) {
    const double span = p.number("span");
    if (!(span < length_)) reject("span", span, "less than length");
    const Net net = spook::rope(Vec3::Zero(), length_ * Vec3::UnitX(), links_, p.number("m"));
    const double weight = g_ * p.number("m") / links_;
    const auto chain = [&](double k) { return hanging_chain(links_, length_ / links_, span, weight, k); };
    answer_ = chain(p.number("k"));

    const std::vector<Vec3> x = p.choice("begin") == "at_rest" ? answer_.x : chain(infinity).x;
    for (std::size_t k = 0; k < x.size(); ++k)
      if (k == 0 || k == x.size() - 1)
        world_.add_fixed(x[k]);
      else
        world_.add({.x = x[k], .mass = net.mass[k]});
    for (const Link& link : net.links) world_.add_joint({.i = link.i, .j = link.j, .length = link.length});
  }

  void observe() override {
    for (std::size_t k = 0; k < answer_.x.size(); ++k)
      largest_error_ = larger(largest_error_, (world_.bodies().x[k] - answer_.x[k]).norm());
  }
  double error() const override { return relative(largest_error_, length_); }
  std::vector<Curve> curves() const override { return {{.name = "the chain at rest", .points = answer_.x}}; }

  void results(StateStream& s) override { s(largest_error_); }

  std::vector<std::string> columns() const override {
    return {"time [s]",         "lowest z [m]",        "end tension [N]", "middle tension [N]",
            "answer's end [N]", "answer's middle [N]", "energy [J]"};
  }
  std::vector<double> sample() const override {
    double lowest = 0;
    for (const Vec3& x : world_.bodies().x) lowest = std::min(lowest, x.z());
    return {time(),
            lowest,
            tension(0),
            tension(links_ / 2),
            answer_.tension.front(),
            answer_.tension[static_cast<std::size_t>(links_ / 2)],
            half_step_energy(world_.bodies(), g_, 2 * velocity_lag())};
  }

 private:
  /// The tension of a link in the last step [N].
  double tension(int link) const { return -world_.joint_lambda(link) / impulse_time(); }

  int links_;
  double length_, g_;
  HangingChain answer_;
  double largest_error_ = 0;
};

}  // namespace

SceneDescription rope() {
  return {.name = "rope",
          .summary = "A rope hangs between two supports at one height.",
          .answer =
              "The chain of N links in balance: each link pulls sideways with the same H, and up or down with "
              "the weights between it and the middle. Σ (l/T_i + 1/k) H = span gives H. This holds for any d, "
              "and while h √(T/(m l)) < 1 for the tightest link, with m a point's mass.",
          .error_name = "largest position error of a point over the length of the rope",
          .error_unit = "relative",
          .parameters = {parameter::links(10),
                         parameter::length(),
                         {.name = "span",
                          .meaning = "between the supports; less than length, more than a link",
                          .unit = "m",
                          .value = 0.8,
                          .limits = {.low = 0, .low_included = false}},
                         parameter::begin(),
                         parameter::mass(),
                         parameter::weighing_gravity(),
                         parameter::stiffness(),
                         parameter::relaxation()},
          .h = 1.0 / 240,
          .time = 2,
          .solves = true,
          .build = build_as<Rope>,
          .solver = "auto"};
}

}  // namespace spook
