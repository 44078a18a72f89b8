// Spheres in a vertical stack, released at touch: point masses, since they do not rotate. One may be heavier.
//
//   gap_i = -N_i/k,   N_i the weight above contact i (0 is the ground)
#include "scenes/registry.hpp"

namespace spook {

namespace {

class Stack : public WorldScene<3> {
 public:
  Stack(const Parameters& p, const Method& method)
      : WorldScene({.gravity = Vec3(0, 0, -p.number("g")), .k = p.number("k"), .d = p.number("d")}, method),
        radius_(p.number("radius")),
        rest_gap_(static_cast<std::size_t>(p.count("bodies"))) {
    const int n = p.count("bodies");
    const int heavy = p.choice("heavy") == "top" ? n - 1 : 0;
    const auto mass = [&](int i) { return i == heavy ? p.number("ratio") * p.number("m") : p.number("m"); };

    world_.add_plane(Vec3::UnitZ(), 0);
    for (int i = 0; i < n; ++i)
      world_.add({.x = Vec3(0, 0, (2 * i + 1) * radius_), .mass = mass(i), .radius = radius_});

    double load = 0;
    for (int i = n - 1; i >= 0; --i) {
      load += mass(i) * p.number("g");
      rest_gap_[static_cast<std::size_t>(i)] = -load / p.number("k");
    }
  }

  void observe() override {
    error_ = 0;
    for (std::size_t i = 0; i < rest_gap_.size(); ++i) error_ = larger(error_, std::abs(gap(i) - rest_gap_[i]));
  }
  double error() const override { return of_springs(relative(error_, std::abs(rest_gap_[0]))); }
  std::vector<Ghost> ghosts() const override {
    std::vector<Ghost> balls;
    double z = -radius_;
    for (std::size_t i = 0; i < rest_gap_.size(); ++i) {
      z += 2 * radius_ + rest_gap_[i];
      balls.push_back({.body = static_cast<int>(i) + 1, .x = Vec3(0, 0, z)});
    }
    return balls;
  }

  void results(StateStream& s) override { s(error_); }

  std::vector<std::string> columns() const override {
    std::vector<std::string> names = {"time [s]"};
    for (std::size_t i = 0; i < rest_gap_.size(); ++i) names.push_back("gap " + std::to_string(i) + " [m]");
    return names;
  }
  std::vector<double> sample() const override {
    std::vector<double> values = {time()};
    for (std::size_t i = 0; i < rest_gap_.size(); ++i) values.push_back(gap(i));
    return values;
  }

 private:
  /// The contact below sphere i; body 0 is the ground.
  double gap(std::size_t i) const {
    const double z = world_.bodies().x[i + 1].z();
    return i == 0 ? z - radius_ : z - world_.bodies().x[i].z() - 2 * radius_;
  }

  double radius_;
  std::vector<double> rest_gap_;
  double error_ = 0;
};

}  // namespace

SceneDescription stack() {
  return {.name = "stack",
          .summary = "A vertical pile of spheres comes to rest; one may be heavy.",
          .answer =
              "gap_i = -N_i/k, N_i the weight of all that rests on contact i. On stiff contacts Gauss-Seidel "
              "needs about ratio · ln(1/tolerance) sweeps for a heavy sphere on a light one, and few for the "
              "reverse.",
          .error_name = "largest error of the last gaps over the largest gap",
          .error_unit = "relative",
          .parameters = {parameter::bodies(3, 10000),
                         parameter::ratio(),
                         {.name = "heavy", .meaning = "which sphere is heavy", .choices = {"top", "bottom"}},
                         parameter::mass(),
                         parameter::gravity(),
                         parameter::stiffness(),
                         parameter::relaxation(),
                         parameter::radius()},
          .h = 1.0 / 60,
          .time = 5,
          .solves = true,
          .build = build_as<Stack>};
}

}  // namespace spook
