// A block thrown along a plane.
//
//   Coulomb   decelerates by μg against its motion: stops after v0/(μg), at v0²/(2μg)          Eq. (5.10)
//   box       decelerates by μg along each tangent, until that component is zero: stops after
//             max(|cos φ|, |sin φ|) v0/(μg), at √(cos⁴φ + sin⁴φ) v0²/(2μg), φ from a tangent   Eq. (5.12), (5.13)
//
// In the engine a component decreases by μgh in each step, and to zero in the last step. With velocities half a step
// back this is exact until the stop. If the stop is at a time δ from the nearest step, the error is ½ μg δ², at most
// μg h²/8: second order.
#include "scenes/block.hpp"
#include "scenes/braking.hpp"
#include "scenes/degrees.hpp"
#include "scenes/registry.hpp"

namespace spook {

namespace {

template <int Dof>
class SlidingBlock : public WorldScene<Dof> {
 public:
  SlidingBlock(const Parameters& p, const Method& method)
      : WorldScene<Dof>({.gravity = Vec3(0, 0, -p.number("g")),
                         .k = p.number("k"),
                         .d = p.number("d"),
                         .friction = p.number("mu"),
                         .viscosity = p.number("viscosity")},
                        method),
        heading_(heading(p.number("heading"))),
        coulomb_{p.number("v0"), p.number("mu") * p.number("g")},
        box_answer_(p.choice("answer") == "box") {
    // The initial deceleration by the engine's friction, box or Coulomb, whichever answer is chosen.
    Vec3 slowing = Vec3::Zero();
    if (friction_model(method) == FrictionModel::cone || method.sliding_tangents)
      slowing = coulomb_.rate * heading_;
    else
      for (const Vec3& t : {tangents_.t1, tangents_.t2}) slowing += coulomb_.rate * sign(heading_.dot(t)) * t;

    const double m = p.number("m");
    world_.add_plane(Vec3::UnitZ(), 0);
    Body<Dof> body = lying<Dof>(block(p), m * p.number("g"), -m * slowing, p.number("k"));
    body.v = coulomb_.v0 * heading_;
    if (p.choice("start") == "half_step") body.v += this->velocity_lag() * slowing;  // Eq. (1.5)
    block_ = world_.add(body);
    start_ = body.x;
  }

  void observe() override {
    largest_error_ = larger(largest_error_, (from_start() - answer()).norm());
    if (world_.v(block_).norm() > stands_still()) moving_ = this->time();
  }
  double error() const override { return relative(largest_error_, coulomb_.way(this->time())); }
  std::vector<Ghost> ghosts() const override { return {{.body = block_, .x = start_ + answer()}}; }

  void results(StateStream& s) override { s(moving_, largest_error_); }

  std::vector<std::string> columns() const override {
    return {"time [s]",       "x [m]",       "y [m]", "vx at t - h/2 [m/s]", "vy at t - h/2 [m/s]",
            "moving for [s]", "distance [m]"};
  }
  std::vector<double> sample() const override {
    const Vec3 x = from_start(), v = world_.v(block_);
    return {this->time(), x.x(), x.y(), v.x(), v.y(), moving_, x.norm()};
  }

 private:
  using WorldScene<Dof>::world_;
  using WorldScene<Dof>::h_;

  /// The speed below which the block counts as resting: half of the speed lost in a step. The box's pitch adds far
  /// less.
  double stands_still() const { return coulomb_.rate * h_ / 2; }

  static double sign(double x) { return x > 0 ? 1 : x < 0 ? -1 : 0; }

  Vec3 from_start() const { return Vec3(world_.x(block_).x(), world_.x(block_).y(), 0); }

  Vec3 answer() const {
    const double t = this->time();
    if (!box_answer_) return coulomb_.way(t) * heading_;
    Vec3 x = Vec3::Zero();
    for (const Vec3& tangent : {tangents_.t1, tangents_.t2}) {
      const double along = heading_.dot(tangent);
      x += sign(along) * Braking{std::abs(along) * coulomb_.v0, coulomb_.rate}.way(t) * tangent;
    }
    return x;
  }

  Tangents tangents_ = tangents(Vec3::UnitZ());
  Vec3 heading_;
  Braking coulomb_;
  bool box_answer_;
  int block_ = 0;
  Vec3 start_;
  double moving_ = 0;
  double largest_error_ = 0;
};

}  // namespace

SceneDescription sliding_block() {
  return with_friction(
      FrictionModel::box,
      {.name = "sliding_block",
       .summary = "A block is thrown over a plane, and friction stops it.",
       .answer = "By Coulomb it stops after v0/(mu g) and v0²/(2 mu g), for any mass and heading. By the "
                 "friction box each tangent's component stops on its own: max(|cos φ|, |sin φ|) of that time, "
                 "√(cos⁴φ + sin⁴φ) of that distance, φ from a tangent to the heading.",
       .error_name = "largest position error over the distance slid by Coulomb's law, at last v0²/(2 mu g)",
       .error_unit = "relative",
       .parameters = {parameter::speed(3),
                      parameter::friction(),
                      {.name = "heading", .meaning = "of v0, from x towards y", .unit = "degrees", .value = 0},
                      parameter::friction_law(),
                      parameter::block_model(),
                      parameter::mass(),
                      parameter::base(1),
                      parameter::height(0.2),
                      parameter::gravity(),
                      parameter::stiffness(),
                      parameter::relaxation(),
                      parameter::viscosity(),
                      parameter::start()},
       .h = 0.01,
       .time = 1,
       .solves = true,
       .build = build_model<SlidingBlock>});
}

}  // namespace spook
