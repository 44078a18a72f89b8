// A dropped ball that bounces.
//
//   h_n = h0 e^(2n)                                                                                Eq. (7.11)
//
// The error is that of the peaks, not of the height at a time: if each bounce is late by only a thousandth of a second,
// the height soon differs a lot. The peak of a flight is z + v²/(2g) at any time, with v at the time of z. Leapfrog
// keeps this number constant.
//
// A step detects the ball after penetration. The engine returns to the time of touch, Eq. (7.15), (7.16). Leapfrog
// stays on the parabola, so the peaks are right to round-off, until a bounce takes less than a step.
#include "scenes/bounces.hpp"
#include "scenes/registry.hpp"

namespace spook {

namespace {

class BouncingBall : public WorldScene<3> {
 public:
  BouncingBall(const Parameters& p, const Method& method)
      : WorldScene(
            {.gravity = Vec3(0, 0, -p.number("g")),
             .k = p.number("k"),
             .d = p.number("d"),
             .impacts = ImpactLaw{.restitution = p.number("restitution"), .threshold = p.number("threshold")}},
            method),
        h0_(p.number("h0")),
        g_(p.number("g")),
        radius_(p.number("radius")),
        plain_(method.engine == Engine::plain),
        answer_(h0_, g_, p.number("restitution")) {
    world_.add_plane(Vec3::UnitZ(), 0);
    ball_ = world_.add({.x = Vec3(0, 0, radius_ + h0_), .mass = p.number("m"), .radius = radius_});
    world_.start_half_step_back(h_);
  }

  void observe() override {
    // The plain engine does not count impacts: the ball turns around.
    const int impacts = plain_ ? static_cast<int>(v_before_ < 0 && v() > 0) : world_.report().impacts;
    v_before_ = v();
    bounces_ += impacts;
    if (impacts > 0) last_bounce_ = time() - h_;
    height_by_answer_ = answer_.height(time());
    largest_error_ = larger(largest_error_, std::abs(peak() - answer_.peak(bounces_)));
  }
  double error() const override { return relative(largest_error_, h0_); }
  std::vector<Ghost> ghosts() const override {
    return {{.body = ball_, .x = Vec3(0, 0, radius_ + height_by_answer_)}};
  }
  std::vector<Curve> curves() const override {
    std::vector<Curve> peaks;
    for (int bounces = 0; bounces < 6; ++bounces) {
      const double z = radius_ + answer_.peak(bounces);
      peaks.push_back({.name = "peak after bounce " + std::to_string(bounces),
                       .points = {Vec3(-2 * radius_, 0, z), Vec3(2 * radius_, 0, z)}});
    }
    return peaks;
  }

  void results(StateStream& s) override {
    s(answer_, bounces_, v_before_, last_bounce_, height_by_answer_, largest_error_);
  }

  std::vector<std::string> columns() const override {
    return {"time [s]", "z [m]", "v [m/s]", "z by (7.11) [m]", "peak [m]", "last bounce [s]", "bounces"};
  }
  std::vector<double> sample() const override {
    return {time(), z(), v(), height_by_answer_, peak(), last_bounce_, static_cast<double>(bounces_)};
  }

 private:
  double z() const { return world_.x(ball_).z() - radius_; }
  double v() const { return world_.synchronized_velocity(ball_, h_).z(); }
  double peak() const { return z() + v() * v() / (2 * g_); }

  double h0_, g_, radius_;  // h0 is the height of the lowest point
  bool plain_;
  Bounces answer_;
  int ball_ = 0;
  int bounces_ = 0;
  double v_before_ = 0;
  double last_bounce_ = 0, height_by_answer_ = 0;
  double largest_error_ = 0;
};

}  // namespace

SceneDescription bouncing_ball() {
  return {.name = "bouncing_ball",
          .summary = "A ball is dropped, and bounces.",
          .answer =
              "Its peaks are h0 e^(2n), with e the restitution, and all bounces end after √(2 h0/g) "
              "(1+e)/(1-e), for any mass. A step detects the ball in the floor. Moved back to where it "
              "touched, (7.15), it has the right peaks with any step.",
          .error_name = "largest error of a peak over h0",
          .error_unit = "relative",
          .parameters = {{.name = "h0",
                          .meaning = "height of its lowest point at time 0",
                          .unit = "m",
                          .value = 1,
                          .limits = {.low = 0, .low_included = false}},
                         parameter::restitution(0.8),
                         parameter::threshold(),
                         parameter::mass(),
                         parameter::radius(0.1),
                         parameter::weighing_gravity(),
                         parameter::stiffness(),
                         parameter::relaxation()},
          .h = 0.001,
          .time = 5,
          .solves = true,
          .build = build_as<BouncingBall>};
}

}  // namespace spook
