// A wire of links with a load at its end, hanging straight down: the hardest scene for Gauss-Seidel.
//
//   T_i = (M + (N - i) m) g      tension of link i = 1 … N from the top, M = ratio m the load        Eq. (6.8)
//   Σ T_i/k                      the stretch of the wire, for any h and d                            Eq. (6.9)
//
// The stretch follows from Eq. (3.7) at rest, if the solver converges. If the solver stops early, each λ is too small,
// and the wire sinks until larger gaps compensate. Eq. (6.12) gives the number of sweeps needed.
//
// With model=body the links are spheres on a string, with ball joints at their touching points. A vertical wire does
// not rotate, so λ and the stretch are those of the points.
#include "scenes/registry.hpp"

namespace spook {

namespace {

template <int Dof>
class Wire : public WorldScene<Dof> {
 public:
  Wire(const Parameters& p, const Method& method)
      : WorldScene<Dof>({.gravity = Vec3(0, 0, -p.number("g")), .k = p.number("k"), .d = p.number("d")},
                        method),
        links_(p.count("links")),
        length_(p.number("length")) {
    const double m = p.number("m"), M = p.number("ratio") * m;
    const bool at_rest = p.choice("begin") == "at_rest";

    world_.add_fixed(Vec3::Zero());
    rest_.push_back(Vec3::Zero());
    double end = 0;  // length of the wire so far, below the anchor
    for (int i = 1; i <= links_; ++i) {
      const double stretch = (M + (links_ - i) * m) * p.number("g") / p.number("k");  // Eq. (6.8)
      rest_stretch_ += stretch;
      const double begin = at_rest ? end + stretch : end;
      end = begin + link();
      add_link(begin, i == links_ ? M : m);
      rest_.push_back(Vec3(0, 0, -i * link() - rest_stretch_) - to_end());
    }
  }

  void observe() override { error_ = std::abs(stretch() - rest_stretch_); }
  double error() const override { return relative(error_, length_); }
  std::vector<Ghost> ghosts() const override {
    std::vector<Ghost> bodies;
    for (int i = 1; i <= links_; ++i) bodies.push_back({.body = i, .x = rest_[static_cast<std::size_t>(i)]});
    return bodies;
  }

  void results(StateStream& s) override { s(error_); }

  std::vector<std::string> columns() const override {
    return {
        "time [s]",        "stretch [m]",       "stretch over length [-]", "error over the right stretch [-]",
        "top tension [N]", "lowest tension [N]"};
  }
  std::vector<double> sample() const override {
    const double error = std::abs(stretch() - rest_stretch_);
    return {this->time(), stretch(),          stretch() / length_, relative(error, rest_stretch_),
            tension(0),   tension(links_ - 1)};
  }

 private:
  using WorldScene<Dof>::world_;

  double link() const { return length_ / links_; }

  /// The vector from a body's centre to the lower end of its link, where a point mass sits.
  Vec3 to_end() const { return Dof == 3 ? Vec3::Zero() : Vec3(0, 0, -link() / 2); }

  /// Adds the next link below the existing bodies.
  void add_link(double begin, double mass) {
    const int above = static_cast<int>(world_.bodies().size()) - 1;
    Body<Dof> body;
    body.x = Vec3(0, 0, -begin - link()) - to_end();
    body.mass = mass;
    Joint joint{.i = above, .j = above + 1};
    if constexpr (Dof == 3) {
      joint.length = link();
    } else {
      body.principal = solid_sphere_moments(mass, link() / 2);
      if (above > 0) joint.p_i = to_end();
      joint.p_j = -to_end();
    }
    world_.add(body);
    world_.add_joint(joint);
  }

  double stretch() const { return -(world_.x(links_) + to_end()).z() - length_; }

  /// The tension of a link in the last step [N].
  double tension(int joint) const {
    // A ball joint's third row pulls the lower body along +z.
    return (Dof == 3 ? -world_.joint_lambda(joint) : world_.joint_lambda(joint, 2)) / this->impulse_time();
  }

  int links_;
  double length_;
  double rest_stretch_ = 0;
  std::vector<Vec3> rest_;  // position of each body at rest
  double error_ = 0;
};

}  // namespace

SceneDescription wire() {
  return {.name = "wire",
          .summary = "A wire of light links hangs straight down, with a load at its end.",
          .answer =
              "The stretch is Σ T_i/k, with T_i = (M + (N - i) m) g the tension of link i and M = ratio m the "
              "load, for any h and d. Gauss-Seidel needs about (N - 1) ratio ln(1/tolerance) sweeps for a "
              "heavy load, and 5.6 N² to 1e-6 for a ratio of 1; with fewer it is elastic.",
          .error_name = "error of the last stretch over the length of the wire",
          .error_unit = "relative",
          .parameters = {parameter::links(5),
                         parameter::ratio(),
                         {.name = "model",
                          .meaning = "point: point masses on distances; body: spheres on ball joints",
                          .choices = {"point", "body"}},
                         parameter::begin(),
                         parameter::length(),
                         parameter::mass(0.01),
                         parameter::gravity(),
                         parameter::stiffness(),
                         parameter::relaxation()},
          .h = 1.0 / 60,
          .time = 5,
          .solves = true,
          .build = build_model<Wire>,
          .solver = "auto"};
}

}  // namespace spook
