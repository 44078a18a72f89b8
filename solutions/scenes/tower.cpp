// A tower of cubes, released at touch; each stands on four contacts. One may be heavier.
//
//   gap_i = -N_i/(4 k)      N_i the weight above level i (0 is the floor), on four contacts
//
// There are no horizontal forces, so cubes should not move sideways.
#include "scenes/boxes.hpp"
#include "scenes/registry.hpp"

namespace spook {

namespace {

class Tower : public BoxesOnFloor {
 public:
  Tower(const Parameters& p, const Method& method) : BoxesOnFloor(p, method), side_(p.number("side")) {
    const int n = p.count("boxes");
    const int heavy = p.choice("heavy") == "top" ? n - 1 : 0;
    const auto mass = [&](int i) { return i == heavy ? p.number("ratio") * p.number("m") : p.number("m"); };
    double load = 0;
    for (int i = 0; i < n; ++i) {
      add_box(Vec3(0, 0, (i + 0.5) * side_), mass(i), Vec3::Constant(side_ / 2));
      load += mass(i) * p.number("g");
    }
    double sunk = 0;
    for (int i = 0; i < n; ++i) {
      sunk += load / (4 * p.number("k"));
      rest_sinking_.push_back(sunk);
      load -= mass(i) * p.number("g");
    }
  }

  void observe() override {
    error_ = 0;
    for (std::size_t i = 0; i < rest_sinking_.size(); ++i)
      error_ = larger(error_, std::abs(sinking(i) - rest_sinking_[i]));
  }
  double error() const override { return of_springs(relative(error_, rest_sinking_.back())); }
  std::vector<Ghost> ghosts() const override {
    std::vector<Ghost> boxes;
    for (std::size_t i = 0; i < rest_sinking_.size(); ++i)
      boxes.push_back({.body = static_cast<int>(i) + 1, .x = put_[i + 1] - rest_sinking_[i] * Vec3::UnitZ()});
    return boxes;
  }

  void results(StateStream& s) override { s(error_); }

  std::vector<std::string> columns() const override {
    return {"time [s]",         "top's sinking [m]", "answer [m]", "farthest sideways [m]",
            "floor's load [N]", "contacts"};
  }
  std::vector<double> sample() const override {
    return {time(),
            sinking(rest_sinking_.size() - 1),
            rest_sinking_.back(),
            farthest_sideways(),
            floor_load(),
            static_cast<double>(world_.contacts().size())};
  }

 private:
  double sinking(std::size_t i) const { return (put_[i + 1] - world_.bodies().x[i + 1]).z(); }

  double side_;
  std::vector<double> rest_sinking_;  // depth of each box at rest [m]
  double error_ = 0;
};

}  // namespace

SceneDescription tower() {
  return {.name = "tower",
          .summary = "Cubes stand on top of each other; one may be heavy.",
          .answer =
              "Level i is N_i/(4 k) deep, with N_i the weight of all cubes above it: four contacts share it. "
              "No cube moves sideways. With ten sweeps a step a tower of twenty collapses.",
          .error_name = "largest error of the last sinkings over the top's",
          .error_unit = "relative",
          .parameters = {parameter::boxes(5, 1000),
                         parameter::ratio(),
                         {.name = "heavy", .meaning = "which cube is heavy", .choices = {"top", "bottom"}},
                         parameter::friction(),
                         parameter::mass(),
                         parameter::side(),
                         parameter::weighing_gravity(),
                         parameter::stiffness(),
                         parameter::relaxation(),
                         parameter::viscosity()},
          .h = 1.0 / 60,
          .time = 5,
          .solves = true,
          .build = build_as<Tower>,
          .solver = "auto"};
}

}  // namespace spook
