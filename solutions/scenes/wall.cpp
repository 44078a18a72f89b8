// A wall of bricks, twice as long as high, which should stand. Each brick lies above the joint of two others; every
// other course has half a brick at either end.
//
// The forces between bricks have no closed form. But there are no horizontal forces, and the floor carries the whole
// weight. A brick may move only by the deflection of its contacts, about weight/k.
#include <algorithm>

#include "scenes/boxes.hpp"
#include "scenes/registry.hpp"

namespace spook {

namespace {

class Wall : public BoxesOnFloor {
 public:
  Wall(const Parameters& p, const Method& method) : BoxesOnFloor(p, method), length_(2 * p.number("side")) {
    const double side = p.number("side"), m = p.number("m");
    const int columns = p.count("columns"), courses = p.count("courses");
    // A small space between neighbours, so that they do not wedge each other.
    const double pitch = 1.001 * length_;
    for (int course = 0; course < courses; ++course)
      // Every other course starts and ends with half a brick.
      for (int half = course % 2 == 0 ? 0 : -1; half < 2 * columns; half += 2) {
        const int from = std::max(half, 0), to = std::min(half + 2, 2 * columns);
        const double part = (to - from) / 2.0;
        add_box(Vec3(pitch * ((from + to) / 4.0 - columns / 2.0), 0, (course + 0.5) * side), part * m,
                Vec3(part * length_, side, side) / 2);
        weight_ += part * m * p.number("g");
      }
  }

  void observe() override {}
  double error() const override { return farthest_sideways() / length_; }
  std::vector<Ghost> ghosts() const override {
    std::vector<Ghost> bricks;
    for (std::size_t body = 1; body < put_.size(); ++body)
      bricks.push_back({.body = static_cast<int>(body), .x = put_[body]});
    return bricks;
  }

  std::vector<std::string> columns() const override {
    return {"time [s]", "farthest sideways [m]", "floor's load over the weight", "contacts"};
  }
  std::vector<double> sample() const override {
    return {time(), farthest_sideways(), floor_load() / weight_, static_cast<double>(world_.contacts().size())};
  }

 private:
  double length_, weight_ = 0;
};

}  // namespace

SceneDescription wall() {
  return {.name = "wall",
          .summary = "A wall of bricks stands.",
          .answer =
              "No brick moves sideways by more than its contacts yield, some weight/k, and the floor carries "
              "the weight of all.",
          .error_name = "largest sideways displacement of a brick, over its length",
          .error_unit = "relative",
          .parameters = {{.name = "columns",
                          .meaning = "bricks in the lowest course",
                          .value = 3,
                          .limits = {.low = 2, .high = 100, .whole = true}},
                         {.name = "courses",
                          .meaning = "layers of bricks",
                          .value = 3,
                          .limits = {.low = 1, .high = 100, .whole = true}},
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
          .build = build_as<Wall>,
          .solver = "auto"};
}

}  // namespace spook
