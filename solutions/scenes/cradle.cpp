// Newton's cradle without strings: equal touching spheres in line, and one that arrives with v.
//
//   pair by pair   (v, 0, 0) -> (0, v, 0) -> (0, 0, v)                                             Eq. (7.13)
//   all at once    (-1/3, 2/3, 2/3) v: another model, e = 1 at every contact; not what the engine does
//
// If the touch is detected too late by the fraction `late` of a step, two spheres overlap by late v h. Eq. (7.16)
// corrects the position of each ball.
#include <limits>

#include "common/require.hpp"
#include "engine/bodies/conserved_quantities.hpp"
#include "scenes/pairwise.hpp"
#include "scenes/registry.hpp"

namespace spook {

namespace {

class Cradle : public WorldScene<3> {
 public:
  Cradle(const Parameters& p, const Method& method)
      : WorldScene({.gravity = Vec3::Zero(),
                    .k = p.number("k"),
                    .d = p.number("d"),
                    .impacts = ImpactLaw{.restitution = p.number("restitution"),
                                         .threshold = rest * p.number("v0"),
                                         .max_passes = 100'000}},
                   method),
        until_((touch - p.number("late")) * h_),
        before_(static_cast<std::size_t>(p.count("bodies")), 0.0) {
    const double radius = p.number("radius"), v0 = p.number("v0");
    if (v0 * h_ > radius) reject("v0 h", v0 * h_, "at most the radius, or the balls jump through each other");

    // The spheres at rest touch exactly: with a radius of 24 bits all sums are exact. The arriving sphere may be early
    // by a few rounding errors. If it were late, its touch would be detected a step later.
    const double touching = to_24_bits(radius);
    const double way = (touch - p.number("late")) * v0 * h_;
    for (int i = 0; i < p.count("bodies"); ++i)
      world_.add({.x = Vec3(i == 0 ? (roundings - 1) * way : 2 * i * touching, 0, 0),
                  .v = Vec3(i == 0 ? v0 : 0, 0, 0),
                  .mass = p.number("m"),
                  .radius = touching});
    start_x_ = world_.bodies().x;
    before_[0] = v0;
    after_ = pair_by_pair(before_, p.number("restitution"), rest * p.number("v0"));
  }

  void observe() override {
    // The step after the touch finds it.
    has_hit_ = has_hit_ || time() - h_ >= until_ - 1e-12 * h_;
    const std::vector<double>& answer = has_hit_ ? after_ : before_;
    error_ = 0;
    for (std::size_t i = 0; i < answer.size(); ++i) error_ = larger(error_, std::abs(v(i) - answer[i]));
  }
  double error() const override { return relative(error_, before_[0]); }
  std::vector<Ghost> ghosts() const override {
    const double since = std::max(0.0, time() - until_);
    std::vector<Ghost> balls;
    for (std::size_t i = 0; i < start_x_.size(); ++i)
      balls.push_back({.body = static_cast<int>(i),
                       .x = start_x_[i] + Vec3(before_[i] * (time() - since) + after_[i] * since, 0, 0)});
    return balls;
  }

  void results(StateStream& s) override { s(until_, has_hit_, start_x_, error_); }

  std::vector<std::string> columns() const override {
    std::vector<std::string> names = {"time [s]", "energy [J]"};
    for (std::size_t i = 0; i < before_.size(); ++i) names.push_back("v " + std::to_string(i) + " [m/s]");
    return names;
  }
  std::vector<double> sample() const override {
    std::vector<double> values = {time(), kinetic_energy(world_.bodies())};
    for (std::size_t i = 0; i < before_.size(); ++i) values.push_back(v(i));
    return values;
  }

 private:
  double v(std::size_t i) const { return world_.bodies().motion.W[i].x(); }

  static double to_24_bits(double x) {
    int exponent;
    const double mantissa = std::frexp(x, &exponent);
    return std::ldexp(std::round(std::ldexp(mantissa, 24)), exponent - 24);
  }

  /// The first touch is at the end of this step, or earlier by the fraction `late`.
  static constexpr int touch = 10;
  static constexpr double roundings = 2 * touch * std::numeric_limits<double>::epsilon();
  static constexpr double rest = 1e-9;  // relative to v0: slower approaches are ignored

  double until_;          // time of the first touch, by the step at the start [s]
  bool has_hit_ = false;  // a step has found the touch
  std::vector<Vec3> start_x_;
  std::vector<double> before_, after_;
  double error_ = 0;
};

}  // namespace

SceneDescription cradle() {
  return {
      .name = "cradle",
      .summary = "Newton's cradle: equal balls in line touch, and another one hits them.",
      .answer =
          "Pair by pair: with restitution 1 the last leaves with v0 and the others rest. (With all contacts "
          "at once it would be (-1/3, 2/3, 2/3) v0 of three.) It is the same however late the first touch is "
          "found, (7.15).",
      .error_name = "largest error of the last velocities over v0",
      .error_unit = "relative",
      .parameters = {parameter::bodies(5, 100),
                     parameter::speed(1),
                     parameter::restitution(1),
                     {.name = "late",
                      .meaning = "the fraction of a step by which the first touch is found too late",
                      .value = 0,
                      .limits = {.low = 0, .high = 1, .high_included = false}},
                     parameter::mass(),
                     parameter::radius(0.1),
                     parameter::stiffness(),
                     parameter::relaxation()},
      .h = 0.01,
      .time = 1,
      .solves = true,
      .build = build_as<Cradle>};
}

}  // namespace spook
