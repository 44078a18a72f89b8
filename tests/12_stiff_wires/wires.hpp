#pragma once
// A swinging wire, for the tests of chapter 12.
#include <cmath>
#include <functional>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "12_stiff_wires/stiff_wires.hpp"
#include "checks.hpp"

namespace spook::testing {

constexpr double gravity = 10;  // [m/s²], along -z

/// Links between points, from a hook at the origin. x is at one time, v half a step earlier. It is released at rest.
class Wire {
 public:
  /// A straight wire, at an angle from the vertical; points of `mass`, the last of `load`.
  Wire(int links, double length, double mass, double load, double angle, double h)
      : h_(h), length_(length / links), spook_(spook_parameters(h, 1e12, 3)) {
    const Vec3 along(std::sin(angle), 0, -std::cos(angle));
    for (int point = 0; point <= links; ++point) {
      x_.push_back(point * length_ * along);
      const double m = point < links ? mass : load;
      motion_.inverse_mass.push_back({.linear = point == 0 ? 0 : 1 / m});
    }
    motion_.W.assign(x_.size(), Vec3::Zero());
    motion_.Wf = motion_.W;
    V_ = motion_.W;
    for (int link = 0; link < links; ++link)
      tension_.push_back(std::cos(angle) * (load + (links - 1 - link) * mass) * gravity);
    start_ = potential();
  }

  /// Steps with K, by stiff_solve. Returns false when stiff_solve does.
  bool step() { return step(true); }

  /// Steps without K, by chapter 11's saddle_solve.
  bool step_without_stiffness() { return step(false); }

  Vec3 load() const { return x_.back(); }

  /// The largest error of a link's length, over its length.
  double link_error() const {
    double largest = 0;
    for (std::size_t k = 1; k < x_.size(); ++k)
      largest = std::max(largest, std::abs((x_[k] - x_[k - 1]).norm() / length_ - 1));
    return largest;
  }

  /// Kinetic energy and that of the weight, both at the begin of the last step, less their sum at the start [J].
  double gained() const { return gained_; }

 private:
  double mass(std::size_t point) const { return 1 / motion_.inverse_mass[point].linear; }

  double potential() const {
    double sum = 0;
    for (std::size_t k = 1; k < x_.size(); ++k) sum += mass(k) * gravity * x_[k].z();
    return sum;
  }

  bool step(bool stiff) {
    const double part = begun_ ? 1 : 0.5;  // Eq. (1.5)
    std::vector<Row<3>> rows;
    std::vector<Stiffness> stiffness;
    for (std::size_t k = 1; k < x_.size(); ++k) motion_.Wf[k] = -part * h_ * gravity * Vec3::UnitZ();
    for (int k = 1; k < static_cast<int>(x_.size()); ++k) {
      const Attachment i{.body = k - 1, .x = at(k - 1)}, j{.body = k, .x = at(k)};
      const Vec3 n = (j.x - i.x).normalized();
      rows.push_back(make_row(distance_constraint<3>(i, j, length_, spook_), motion_));
      stiffness.push_back(
          {.i = k - 1, .j = k, .K = geometric_stiffness(n, length_, tension_[rows.size() - 1])});
    }
    const bool solved = stiff ? stiff_solve(rows, motion_, stiffness, h_, V_, factors_)
                              : saddle_solve(rows, motion_.inverse_mass, V_, factors_);
    if (!solved) return false;
    if (V_.size() != x_.size()) throw std::logic_error("V no longer has one velocity a body");

    gained_ = potential() - start_;
    for (std::size_t k = 1; k < x_.size(); ++k) {
      const Vec3 before = motion_.W[k];
      motion_.W[k] += motion_.Wf[k] + V_[k];
      if (begun_) gained_ += mass(k) * (before + motion_.W[k]).squaredNorm() / 8;  // Eq. (1.6)
      x_[k] = drift(x_[k], motion_.W[k], h_);
      if (!(x_[k].norm() < 1e6))
        throw std::logic_error(
            "a body is more than 1000 km away, or its position is NaN: the simulation has blown up");
    }
    for (std::size_t k = 0; k < rows.size(); ++k) tension_[k] = -rows[k].lambda / (part * h_);  // Eq. (12.4)
    begun_ = true;
    return true;
  }

  Vec3 at(int point) const { return x_[static_cast<std::size_t>(point)]; }

  double h_, length_;
  SpookParameters spook_;
  std::vector<Vec3> x_;
  Motion<3> motion_;
  std::vector<Twist<3>> V_;
  std::vector<double> tension_;
  Factors factors_;
  bool begun_ = false;
  double start_ = 0, gained_ = 0;
};

}  // namespace spook::testing
