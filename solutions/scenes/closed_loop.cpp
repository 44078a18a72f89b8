// A loop that cannot close: n links in a ring of point masses. One link is longer than all others together, so no
// positions satisfy all rows. Σ makes each row a spring, and the ring comes to rest as a ring of springs.
//
//   (n - 1)(l + F/k) = L - F/k      short links pulled by F and the long one pushed by it, along one line
//   F = (L - (n - 1) l) k/n
#include "scenes/registry.hpp"

namespace spook {

namespace {

class ClosedLoop : public WorldScene<3> {
 public:
  ClosedLoop(const Parameters& p, const Method& method)
      : WorldScene({.gravity = Vec3::Zero(), .k = p.number("k"), .d = p.number("d")}, method),
        short_links_(p.count("links") - 1),
        l_(p.number("length")),
        misfit_(p.number("misfit") * l_),
        pull_(misfit_ / (short_links_ + 1)) {
    const double span = short_links_ * l_ + misfit_;
    for (int point = 0; point <= short_links_; ++point)
      world_.add({.x = Vec3(span * point / short_links_, 0, 0), .mass = p.number("m")});
    for (int link = 0; link < short_links_; ++link) world_.add_joint({.i = link, .j = link + 1, .length = l_});
    world_.add_joint({.i = 0, .j = short_links_, .length = span});
  }

  void observe() override {
    error_ = std::abs(long_link_gap() + pull_);
    for (int link = 0; link < short_links_; ++link) error_ = larger(error_, std::abs(gap(link) - pull_));
  }
  double error() const override { return relative(error_, misfit_); }
  std::vector<Ghost> ghosts() const override {
    std::vector<Ghost> points;
    const double span = short_links_ * l_ + misfit_, link = l_ + pull_;
    for (int point = 0; point <= short_links_; ++point)
      points.push_back({.body = point, .x = Vec3(span / 2 + (point - short_links_ / 2.0) * link, 0, 0)});
    return points;
  }

  void results(StateStream& s) override { s(error_); }

  std::vector<std::string> columns() const override {
    return {"time [s]", "short link's stretch [m]", "answer [m]", "long link's stretch [m]"};
  }
  std::vector<double> sample() const override { return {time(), gap(0), pull_, long_link_gap()}; }

 private:
  /// The stretch of a link [m].
  double gap(int joint) const {
    const Joint& link = world_.joints()[static_cast<std::size_t>(joint)];
    return distance(link, world_.bodies()) - *link.length;
  }
  double long_link_gap() const { return gap(short_links_); }

  int short_links_;
  double l_, misfit_;
  double pull_;  // F/k [m]
  double error_ = 0;
};

}  // namespace

SceneDescription closed_loop() {
  Parameter links = parameter::links(4);
  links.meaning = "how many, the long one included";
  links.limits.low = 3;
  return {.name = "closed_loop",
          .summary = "A ring of links that cannot close, as one is too long.",
          .answer =
              "The rows contradict each other. Each link is a spring k: the short ones are longer by F/k, the "
              "long one shorter, F/k = misfit/links.",
          .error_name = "largest error of the last stretches over the misfit",
          .error_unit = "relative",
          .parameters =
              {links,
               {.name = "misfit",
                .meaning =
                    "excess of the long link over all others together, divided by the length of a short link",
                .value = 0.1,
                .limits = {.low = 0, .high = 10, .low_included = false}},
               {.name = "length",
                .meaning = "of a short link",
                .unit = "m",
                .value = 1,
                .limits = {.low = 0, .low_included = false}},
               parameter::mass(),
               parameter::stiffness(),
               parameter::relaxation()},
          .h = 1.0 / 60,
          .time = 5,
          .solves = true,
          .build = build_as<ClosedLoop>,
          .solver = "direct"};
}

}  // namespace spook
