// A flat box on a grid of contacts: many more rows than degrees of freedom. Any Σ > 0 distributes the load evenly.
//
//   gap = -m g/(n k),  λ = h m g/n,  for each of n contacts
#include <limits>

#include "scenes/registry.hpp"

namespace spook {

namespace {

class FlatBox : public WorldScene<6> {
 public:
  FlatBox(const Parameters& p, const Method& method)
      : WorldScene({.gravity = Vec3(0, 0, -p.number("g")),
                    .k = p.number("k"),
                    .d = p.number("d"),
                    .friction = p.number("mu"),
                    .viscosity = p.number("viscosity")},
                   method),
        share_(h_ * p.number("m") * p.number("g")) {
    const int n = p.count("side_contacts");
    const double half = p.number("side") / 2, height = half / 5, m = p.number("m");
    world_.add_plane(Vec3::UnitZ(), 0);
    std::vector<Vec3> grid;
    for (int a = 0; a < n; ++a)
      for (int b = 0; b < n; ++b)
        grid.push_back(Vec3(half * (2.0 * a / (n - 1) - 1), half * (2.0 * b / (n - 1) - 1), -height));
    corners_ = n * n;
    share_ /= corners_;
    body_ = world_.add({.x = Vec3(0, 0, height),
                        .mass = m,
                        .principal = solid_box_moments(m, Vec3(half, half, height)),
                        .corners = grid});
    rest_gap_ = -m * p.number("g") / (static_cast<double>(grid.size()) * p.number("k"));
    height_ = height;
  }

  void observe() override {
    if (world_.steps() == 0 || world_.settings().stepper) return;  // the impulses are not known
    const auto contacts = static_cast<int>(world_.contacts().size());
    error_ = contacts < corners_ ? share_ : 0;  // an open contact carries nothing
    for (int c = 0; c < contacts; ++c)
      error_ = larger(error_, std::abs(world_.lambda(c) * world_.parts() - share_));
  }
  double error() const override { return relative(error_, share_); }
  std::vector<Ghost> ghosts() const override { return {{.body = body_, .x = Vec3(0, 0, height_ + rest_gap_)}}; }

  void results(StateStream& s) override { s(error_); }

  std::vector<std::string> columns() const override {
    return {"time [s]", "gap [m]", "answer [m]", "largest error of λ [N s]", "contacts"};
  }
  std::vector<double> sample() const override {
    return {time(), world_.x(body_).z() - height_, rest_gap_, error_,
            static_cast<double>(world_.contacts().size())};
  }

 private:
  int body_, corners_;
  double share_, rest_gap_, height_;
  double error_ = std::numeric_limits<double>::quiet_NaN();  // until impulses are known
};

}  // namespace

SceneDescription flat_box_100_contacts() {
  return {.name = "flat_box_100_contacts",
          .summary = "A flat box rests on a grid of contacts, many more than it needs.",
          .answer =
              "The contacts share the weight evenly: λ = h m g/n and gap = -m g/(n k) for each of the n. On a "
              "stiff floor sweeps distribute it slowly.",
          .error_name = "largest error of the last λ over the answer's",
          .error_unit = "relative",
          .parameters = {{.name = "side_contacts",
                          .meaning = "contacts along each side",
                          .value = 10,
                          .limits = {.low = 2, .high = 100, .whole = true}},
                         parameter::friction(0),
                         parameter::mass(),
                         parameter::side(),
                         parameter::weighing_gravity(),
                         parameter::stiffness(),
                         parameter::relaxation(),
                         parameter::viscosity()},
          .h = 1.0 / 60,
          .time = 5,
          .solves = true,
          .build = build_as<FlatBox>,
          .solver = "direct"};
}

}  // namespace spook
