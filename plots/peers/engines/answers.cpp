#include "peers/engines/answers.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "scenes/bounces.hpp"
#include "scenes/free_top.hpp"
#include "scenes/reference_motion.hpp"

namespace spook::peers {

namespace {

double size_of(const ProblemBody& body) {
  return body.radius > 0 ? body.radius : body.half_sides.minCoeff();
}

int first_that_moves(const Problem& problem) {
  const auto found = std::find_if(problem.bodies.begin(), problem.bodies.end(),
                                  [](const ProblemBody& body) { return body.moves; });
  if (found == problem.bodies.end()) throw std::logic_error("nothing moves in this scene");
  return static_cast<int>(found - problem.bodies.begin());
}

class InPlace : public Judge {
 public:
  explicit InPlace(const Problem& problem) : problem_(problem) {}
  void look(const Engine& engine, double) override {
    error_ = 0;
    for (std::size_t i = 0; i < problem_.bodies.size(); ++i)
      error_ = larger(error_, (engine.x(static_cast<int>(i)) - problem_.bodies[i].x).norm());
    error_ /= size_of(problem_.bodies[static_cast<std::size_t>(first_that_moves(problem_))]);
  }
  double error() const override { return error_; }

 private:
  Problem problem_;
  double error_ = 0;
};

class Joints : public Judge {
 public:
  explicit Joints(const Problem& problem) : joints_(problem.joints) {
    const auto x = [&](int body) { return problem.bodies[static_cast<std::size_t>(body)].x; };
    link_ = (x(joints_.front().j) - x(joints_.front().i)).norm();
  }
  void look(const Engine& engine, double) override {
    error_ = 0;
    const auto point = [&](int body, const Vec3& p) { return Vec3(engine.x(body) + engine.q(body) * p); };
    for (const Joint& joint : joints_)
      error_ = larger(error_, (point(joint.j, joint.p_j) - point(joint.i, joint.p_i)).norm() / link_);
  }
  double error() const override { return error_; }

 private:
  std::vector<Joint> joints_;
  double link_, error_ = 0;
};

class Length : public Judge {
 public:
  Length(const Problem& problem, double time)
      : begin_(problem.joints.front().i), end_(problem.joints.back().j), after_(time / 2) {
    length_ =
        (problem.bodies[static_cast<std::size_t>(end_)].x - problem.bodies[static_cast<std::size_t>(begin_)].x)
            .norm();
  }
  void look(const Engine& engine, double time) override {
    if (time < after_) return;
    error_ = larger(error_, std::abs((engine.x(end_) - engine.x(begin_)).norm() / length_ - 1));
  }
  double error() const override { return error_; }

 private:
  int begin_, end_;
  double after_, length_, error_ = 0;
};

/// Angles θ_k of the rods from hanging down, then θ_k'. Lagrange's equations of points on rods, with μ_jk the mass of all
/// points from the lower of j, k on:
///   Σ_k μ_jk l_j l_k cos(θ_j - θ_k) θ_k'' = -Σ_k μ_jk l_j l_k sin(θ_j - θ_k) θ_k'² - μ_jj l_j g sin θ_j
template <int Rods>
class Chain : public Judge {
 public:
  using Angles = ReferenceMotion<2 * Rods>;
  using State = typename Angles::State;
  using Vector = Eigen::Matrix<double, Rods, 1>;

  explicit Chain(const Problem& problem)
      : g_(-problem.gravity.z()), top_(problem.bodies[0].x), motion_(nullptr, State::Zero()) {
    State start = State::Zero();
    for (int k = 0; k < Rods; ++k) {
      const Vec3 rod = body(problem, k + 1).x - body(problem, k).x;
      l_[k] = rod.norm();
      start[k] = std::atan2(rod.x(), -rod.z());
    }
    for (int k = Rods - 1; k >= 0; --k)
      below_[k] = body(problem, k + 1).mass + (k + 1 < Rods ? below_[k + 1] : 0);
    motion_ = Angles([this](const State& y) { return rate(y); }, start);
  }
  Chain(const Chain&) = delete;
  Chain& operator=(const Chain&) = delete;

  void look(const Engine& engine, double time) override {
    const State& y = motion_.at(time);
    Vec3 x = top_;
    for (int k = 0; k < Rods; ++k) x += l_[k] * Vec3(std::sin(y[k]), 0, -std::cos(y[k]));
    error_ = larger(error_, (engine.x(Rods) - x).norm() / l_.sum());
  }
  double error() const override { return error_; }

 private:
  static const ProblemBody& body(const Problem& problem, int i) {
    return problem.bodies[static_cast<std::size_t>(i)];
  }

  State rate(const State& y) const {
    Eigen::Matrix<double, Rods, Rods> M;
    Vector force;
    for (int j = 0; j < Rods; ++j) {
      force[j] = -below_[j] * l_[j] * g_ * std::sin(y[j]);
      for (int k = 0; k < Rods; ++k) {
        const double both = below_[std::max(j, k)] * l_[j] * l_[k];
        M(j, k) = both * std::cos(y[j] - y[k]);
        force[j] -= both * std::sin(y[j] - y[k]) * y[Rods + k] * y[Rods + k];
      }
    }
    State rate;
    rate.template head<Rods>() = y.template tail<Rods>();
    rate.template tail<Rods>() = M.llt().solve(force);
    return rate;
  }

  double g_;
  Vec3 top_;
  Vector l_, below_;
  Angles motion_;
  double error_ = 0;
};

class Thrown : public Judge {
 public:
  Thrown(const Problem& problem, double v0)
      : body_(first_that_moves(problem)), way_(v0 * v0 / (2 * problem.friction * problem.gravity.norm())) {}
  void look(const Engine& engine, double) override {
    const Vec3 x = engine.x(body_);
    error_ = std::abs(std::hypot(x.x(), x.y()) - way_) / way_;
  }
  double error() const override { return error_; }

 private:
  int body_;
  double way_, error_ = 0;
};

class Rolling : public Judge {
 public:
  Rolling(const Problem& problem, double v0)
      : body_(first_that_moves(problem)),
        v0_(v0),
        rate_(problem.friction * problem.gravity.norm()),
        start_(problem.bodies[static_cast<std::size_t>(body_)].x) {}
  void look(const Engine& engine, double time) override {
    const Vec3 way = engine.x(body_) - start_;
    error_ = larger(error_, std::abs(std::hypot(way.x(), way.y()) - answer(time)) / answer(rolls_after()));
  }
  double error() const override { return error_; }

 private:
  double rolls_after() const { return 2 * v0_ / (7 * rate_); }
  double answer(double t) const {
    const double slides = std::min(t, rolls_after());
    return v0_ * slides - rate_ * slides * slides / 2 + 5.0 / 7 * v0_ * (t - slides);
  }

  int body_;
  double v0_, rate_;
  Vec3 start_;
  double error_ = 0;
};

/// Rate q' = ½ q ω, with ω in the body's axes by its closed form; the fifth number is the time.
class Turning : public Judge {
 public:
  Turning(const Problem& problem, const Vec3& omega)
      : body_(first_that_moves(problem)),
        omega_(problem.bodies[static_cast<std::size_t>(body_)].principal, omega),
        motion_([this](const State& y) { return rate(y); }, State({1.0, 0.0, 0.0, 0.0, 0.0})) {}
  Turning(const Turning&) = delete;
  Turning& operator=(const Turning&) = delete;

  void look(const Engine& engine, double time) override {
    const State& y = motion_.at(time);
    error_ = larger(error_, engine.q(body_).angularDistance(Quat(y[0], y[1], y[2], y[3]).normalized()));
  }
  double error() const override { return error_; }

 private:
  using State = ReferenceMotion<5>::State;
  State rate(const State& y) const {
    const Vec3 w = omega_.omega(y[4]);
    const Quat rate = Quat(y[0], y[1], y[2], y[3]) * Quat(0, w[0] / 2, w[1] / 2, w[2] / 2);
    return State({rate.w(), rate.x(), rate.y(), rate.z(), 1.0});
  }

  int body_;
  FreeTop omega_;
  ReferenceMotion<5> motion_;
  double error_ = 0;
};

class Peaks : public Judge {
 public:
  Peaks(const Problem& problem, double h0)
      : body_(first_that_moves(problem)),
        h0_(h0),
        answer_(h0, problem.gravity.norm(), problem.restitution),
        floor_(size_of(problem.bodies[static_cast<std::size_t>(body_)])) {}
  void look(const Engine& engine, double) override {
    const double z = engine.x(body_).z() - floor_;
    if (seen_ >= 2 && before_ >= last_but_one_ && before_ > z && peaks_ < count) {
      // The parabola through (-1, a), (0, b), (1, c) has the peak b + (a - c)²/(8 (2b - a - c)).
      const double a = last_but_one_, b = before_;
      const double peak = b + (a - z) * (a - z) / (8 * (2 * b - a - z));
      ++peaks_;
      error_ = larger(error_, std::abs(peak - answer_.peak(peaks_)) / h0_);
    }
    ++seen_;
    last_but_one_ = before_;
    before_ = z;
  }
  double error() const override { return peaks_ == count ? error_ : 1; }

 private:
  static constexpr int count = 5;
  int body_;
  double h0_;
  Bounces answer_;
  double floor_, last_but_one_ = 0, before_ = 0, error_ = 0;
  int seen_ = 0, peaks_ = 0;
};

class Pile : public Judge {
 public:
  explicit Pile(const Problem& problem) : problem_(problem) {}
  void look(const Engine& engine, double time) override {
    before_.swap(now_);
    now_.clear();
    q_.clear();
    for (std::size_t i = 0; i < problem_.bodies.size(); ++i) {
      now_.push_back(engine.x(static_cast<int>(i)));
      q_.push_back(engine.q(static_cast<int>(i)));
    }
    h_ = time - time_;
    time_ = time;
  }
  double error() const override {
    const ProblemBody& body = problem_.bodies[static_cast<std::size_t>(first_that_moves(problem_))];
    const double size = size_of(body);
    double moved = 0;
    for (std::size_t i = 0; i < now_.size(); ++i) {
      moved += (now_[i] - before_[i]).norm() / static_cast<double>(now_.size());
      for (const Plane& plane : problem_.planes)
        if (problem_.bodies[i].moves && plane.n.dot(now_[i]) < plane.offset) return 1;
    }
    if (!(moved <= h_ * size)) return 1;
    const std::vector<double> depths = this->depths();
    double sum = 0;
    for (const double depth : depths) sum += depth;
    return sum / static_cast<double>(depths.size()) / size;
  }

 private:
  /// Returns the depths of all overlapping contacts, by the contact sets of chapter 08 [m].
  std::vector<double> depths() const {
    World<6> still({.gravity = Vec3::Zero(), .contact_margin = 0});
    for (const Plane& plane : problem_.planes) still.add_plane(plane.n, plane.offset);
    for (std::size_t i = 0; i < now_.size(); ++i) {
      const ProblemBody& body = problem_.bodies[i];
      if (!body.moves) continue;
      still.add({.x = now_[i],
                 .mass = body.mass,
                 .radius = body.radius,
                 .q = q_[i].normalized(),
                 .principal = body.principal,
                 .half_sides = body.half_sides});
    }
    std::vector<Contact> contacts;
    ContactFinder().find(still.shapes(), still.bodies(), 0, contacts);
    std::vector<double> found;
    for (const Contact& contact : contacts)
      if (contact.gap < 0) found.push_back(-contact.gap);
    return found;
  }

  Problem problem_;
  std::vector<Vec3> before_, now_;
  std::vector<Quat> q_;
  double time_ = 0, h_ = 0;
};

}  // namespace

std::unique_ptr<Judge> stays_in_place(const Problem& problem) {
  return std::make_unique<InPlace>(problem);
}
std::unique_ptr<Judge> holds_its_joints(const Problem& problem) {
  return std::make_unique<Joints>(problem);
}
std::unique_ptr<Judge> keeps_its_length(const Problem& problem, double time) {
  return std::make_unique<Length>(problem, time);
}
std::unique_ptr<Judge> swings_as_rods(const Problem& problem) {
  if (problem.joints.size() == 1) return std::make_unique<Chain<1>>(problem);
  if (problem.joints.size() == 2) return std::make_unique<Chain<2>>(problem);
  if (problem.joints.size() == 10) return std::make_unique<Chain<10>>(problem);
  throw std::logic_error("an answer is here for chains of 1, 2 and 10 rods");
}
std::unique_ptr<Judge> stops_by_coulomb(const Problem& problem, double v0) {
  return std::make_unique<Thrown>(problem, v0);
}
std::unique_ptr<Judge> slides_then_rolls(const Problem& problem, double v0) {
  return std::make_unique<Rolling>(problem, v0);
}
std::unique_ptr<Judge> turns_by_euler(const Problem& problem, const Vec3& omega) {
  return std::make_unique<Turning>(problem, omega);
}
std::unique_ptr<Judge> bounces_to(const Problem& problem, double h0) {
  return std::make_unique<Peaks>(problem, h0);
}
std::unique_ptr<Judge> lies_without_overlap(const Problem& problem) {
  return std::make_unique<Pile>(problem);
}

}  // namespace spook::peers
