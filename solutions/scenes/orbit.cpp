// A Kepler orbit about a fixed centre, from its nearest point.
//
//   x = a (cos E - e),  y = a √(1-e²) sin E,   E - e sin E = t √(GM/a³)
//
//   a   semi-major axis [m]     e   eccentricity     E   eccentric anomaly [rad]     GM   [m³/s²]
#include "scenes/degrees.hpp"
#include "scenes/registry.hpp"

namespace spook {

namespace {

/// Returns E of Kepler's equation E - e sin E = M, for 0 <= e < 1. Newton's method, held in the bracket [M - e, M + e].
double eccentric_anomaly(double M, double e) {
  double low = M - e, high = M + e, E = M;
  for (int n = 0; n < 100; ++n) {
    const double f = E - e * std::sin(E) - M;
    if (f == 0) return E;
    (f > 0 ? high : low) = E;
    double next = E - f / (1 - e * std::cos(E));
    if (!(next > low && next < high)) next = (low + high) / 2;
    if (std::abs(next - E) <= 1e-16 * std::abs(next)) return next;
    E = next;
  }
  return E;
}

class Orbit : public WorldScene<3> {
 public:
  Orbit(const Parameters& p, const Method& method)
      : WorldScene({.gravity = Vec3::Zero(), .force = attraction(p.number("gm"), p.number("m"))}, method),
        gm_(p.number("gm")),
        axis_(p.number("axis")),
        e_(p.number("eccentricity")),
        shifted_(p.choice("start") == "half_step") {
    const double fastest = std::sqrt(gm_ / axis_ * (1 + e_) / (1 - e_));
    world_.add({.x = Vec3(axis_ * (1 - e_), 0, 0), .v = Vec3(0, fastest, 0), .mass = p.number("m")});
    if (shifted_) world_.start_half_step_back(h_);
  }

  void observe() override { largest_error_ = larger(largest_error_, (world_.x(0) - answer()).norm()); }
  double error() const override { return relative(largest_error_, axis_); }
  std::vector<Ghost> ghosts() const override { return {{.body = 0, .x = answer()}}; }
  std::vector<Curve> curves() const override {
    const auto on_sun = [radius = axis_ / 25](double angle) -> Vec3 {  // winds round a ball
      const double turns = 12 * angle;
      return radius *
             Vec3(std::sin(angle) * std::cos(turns), std::sin(angle) * std::sin(turns), std::cos(angle));
    };
    return {curve("the ellipse", 0, 2 * pi, [this](double E) { return at_anomaly(E); }),
            curve("the sun", 0, pi, on_sun)};
  }
  double field_energy(const std::vector<Vec3>& x) const override {
    return -gm_ * world_.bodies().mass[0] / x[0].norm();
  }

  void results(StateStream& s) override { s(largest_error_); }

  std::vector<std::string> columns() const override {
    return {"time [s]", "x [m]", "y [m]", "energy [J]", "angular momentum [kg m²/s]"};
  }
  std::vector<double> sample() const override {
    const Vec3& x = world_.x(0);
    const Vec3 v = shifted_ ? world_.synchronized_velocity(0, h_) : world_.v(0);
    const double m = world_.bodies().mass[0];
    return {time(), x.x(), x.y(), m * (v.squaredNorm() / 2 - gm_ / x.norm()), m * x.cross(v).z()};
  }

 private:
  static ForceField attraction(double gm, double m) {
    return [gm, m](std::size_t i, const std::vector<Vec3>& x) -> Vec3 {
      const double r2 = x[i].squaredNorm();
      return -gm * m / (r2 * std::sqrt(r2)) * x[i];
    };
  }

  Vec3 answer() const {
    const double E = eccentric_anomaly(time() * std::sqrt(gm_ / axis_) / axis_, e_);
    return at_anomaly(E);
  }
  Vec3 at_anomaly(double E) const {
    return axis_ * Vec3(std::cos(E) - e_, std::sqrt(1 - e_ * e_) * std::sin(E), 0);
  }

  double gm_, axis_, e_;
  bool shifted_;
  double largest_error_ = 0;
};

}  // namespace

SceneDescription orbit() {
  const Limits positive = {.low = 0, .low_included = false};
  return {.name = "orbit",
          .summary = "A planet on a Kepler ellipse, from its point nearest to the sun.",
          .answer =
              "x = a (cos E - e), y = a √(1-e²) sin E, with Kepler's equation E - e sin E = t √(GM/a³) solved.",
          .error_name = "largest position error over the semi-major axis",
          .error_unit = "relative",
          .parameters =
              {parameter::mass(),
               {.name = "eccentricity",
                .meaning = "of the ellipse; 0 is a circle",
                .value = 0.5,
                .limits = {.low = 0, .high = 0.99}},
               {.name = "axis", .meaning = "semi-major axis", .unit = "m", .value = 1, .limits = positive},
               {.name = "gm", .meaning = "GM of the sun", .unit = "m³/s²", .value = 1, .limits = positive},
               parameter::start()},
          .h = 0.01,
          .time = 10,
          .solves = false,
          .build = build_as<Orbit>};
}

}  // namespace spook
