// A disc that spins flat on a plane, under uniform pressure.
//
//   Coulomb   torque 2/3 μ m g R: stops after 3Rω0/(4μg)
//   box       a point at the angle φ has |sin φ| + |cos φ| times the torque of Coulomb, 4/π on average:
//             stops after π/4 of that time                                                     Eq. (5.14)
//
// The disc is a number of points in the plane of its centre, so that friction does not tip it. Their mean distance from
// the centre is that of the disc (see disc.hpp), but their angles cause an error. The Fourier series of
// |sin φ| + |cos φ| is one in 4φ, and the mean over n equal angles keeps every n/4th term,
//
//   (4/π) (1 - Σ_q 2 cos(n q φ0)/(n² q² - 1)),   with a sum of at most 1 - (π/n) cot(π/n), about (π²/3)/n²,
//
// which changes its sign as the disc rotates. There is no error in h, since the torque is constant.
#include "common/require.hpp"
#include "scenes/braking.hpp"
#include "scenes/degrees.hpp"
#include "scenes/disc.hpp"
#include "scenes/registry.hpp"

namespace spook {

namespace {

class SpinningDisc : public WorldScene<6> {
 public:
  SpinningDisc(const Parameters& p, const Method& method)
      : WorldScene({.gravity = Vec3(0, 0, -p.number("g")),
                    .k = p.number("k"),
                    .d = p.number("d"),
                    .friction = p.number("mu"),
                    .viscosity = p.number("viscosity")},
                   method),
        w0_(p.number("w0")),
        answer_{w0_, rate(p, method)} {
    const int points = p.count("points"), rings = p.count("rings");
    if (points % 4 != 0)
      reject("points", points, "a multiple of 4, so that friction does not push it sideways");
    const double m = p.number("m"), R = p.number("radius");
    const double about_z = m * R * R / 2;
    const double depth = m * p.number("g") / (p.number("k") * rings * points);
    world_.add_plane(Vec3::UnitZ(), 0);
    disc_ = world_.add({.x = Vec3(0, 0, -depth),
                        .mass = m,
                        .omega = Vec3(0, 0, w0_),
                        .principal = Vec3(about_z / 2, about_z / 2, about_z),
                        .corners = disc_points(R, rings, points)});
    start_ = world_.x(disc_);
  }

  void observe() override {
    largest_error_ = larger(largest_error_, std::abs(spin() - answer_.v(time())));
    if (spin() > answer_.rate * h_ / 2) spinning_ = time();
  }
  double error() const override { return relative(largest_error_, w0_); }
  std::vector<Ghost> ghosts() const override {
    return {{.body = disc_, .x = start_, .q = Quat(Eigen::AngleAxisd(answer_.way(time()), Vec3::UnitZ()))}};
  }

  void results(StateStream& s) override { s(spinning_, largest_error_); }

  std::vector<std::string> columns() const override {
    return {"time [s]", "spin [rad/s]", "answer [rad/s]", "spinning for [s]", "off the centre [m]", "contacts"};
  }
  std::vector<double> sample() const override {
    const Vec3& x = world_.x(disc_);
    return {time(),
            spin(),
            answer_.v(time()),
            spinning_,
            std::hypot(x.x(), x.y()),
            static_cast<double>(world_.contacts().size())};
  }

 private:
  /// The deceleration of ω [rad/s²]: torque over m R²/2.
  static double rate(const Parameters& p, const Method& method) {
    const double coulomb = 4 * p.number("mu") * p.number("g") / (3 * p.number("radius"));
    const std::string& law = p.choice("answer");
    // The box has corners, unless it follows the slip; the cone has none.
    const bool has_corners = friction_model(method) != FrictionModel::cone && !method.sliding_tangents;
    return law == "coulomb" || (law == "model" && !has_corners) ? coulomb : coulomb * 4 / pi;
  }

  double spin() const { return angular_velocity(world_, disc_).z(); }

  double w0_;
  Braking answer_;
  int disc_ = 0;
  Vec3 start_;
  double spinning_ = 0;
  double largest_error_ = 0;
};

}  // namespace

SceneDescription spinning_disc() {
  // On stiff contacts fifty sweeps do not distribute the load: the disc would stand on a few points.
  Parameter k = parameter::stiffness();
  k.value = 1e4;
  return with_friction(
      FrictionModel::box,
      {.name = "spinning_disc",
       .summary = "A flat disc spins on a plane, and friction stops it.",
       .answer = "ω falls at a constant rate. By Coulomb the disc stops after 3 R w0/(4 mu g), for any mass; "
                 "by the friction box after π/4 of that, since |sin φ| + |cos φ| is 4/π on average. Its points "
                 "cause an error of about 1/points², for any h.",
       .error_name = "largest error of ω over w0",
       .error_unit = "relative",
       .parameters = {{.name = "w0",
                       .meaning = "angular velocity at time 0",
                       .unit = "rad/s",
                       .value = 10,
                       .limits = {.low = 0, .low_included = false}},
                      parameter::friction(),
                      parameter::friction_law({"model", "box", "coulomb"}),
                      {.name = "rings",
                       .meaning = "of points",
                       .value = 2,
                       .limits = {.low = 1, .high = 100, .whole = true}},
                      {.name = "points",
                       .meaning = "on each ring; a multiple of 4",
                       .value = 16,
                       .limits = {.low = 4, .high = 1000, .whole = true}},
                      parameter::mass(),
                      parameter::radius(),
                      parameter::gravity(),
                      k,
                      parameter::relaxation(),
                      parameter::viscosity()},
       .h = 0.01,
       .time = 1,
       .solves = true,
       .build = build_as<SpinningDisc>,
       .solver = "auto"});
}

}  // namespace spook
