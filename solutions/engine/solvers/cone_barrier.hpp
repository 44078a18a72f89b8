#pragma once
// A point of the interior-point method on cones: λ strictly inside its bounds and discs, and a multiplier of each. The
// symbols, and both starts, are explained in engine/solvers/cone_interior_point.hpp.
#include <cmath>
#include <vector>

#include "engine/solvers/cone_problem.hpp"

namespace spook {

/// Multipliers of both bounds of a block's first row, and its slip speed σ [m/s].
struct Push {
  double lo = 0, hi = 0, slip = 0;
};

/// Keeps a reference to the problem, and λ there. Blocks are numbered by `b`.
template <int Dof>
class ConeBarrier {
 public:
  /// Starts near the current λ with that w [m/s], or well inside if w is 0. θ of a block is min(1, share/μ).
  ConeBarrier(ConeProblem<Dof>& problem, double share, double w);

  const Push& push(std::size_t b) const { return push_[b]; }

  /// Moves λ and the multipliers by a fraction of their changes: one of λ for each row, one of multipliers for each
  /// block.
  void advance(double fraction, const std::vector<double>& step, const std::vector<Push>& change);

  std::size_t size() const { return problem_.blocks().size(); }
  const ContactBlock& block(std::size_t b) const { return problem_.blocks()[b]; }

  bool has_lo(const ContactBlock& of) const { return is_open(of) && std::isfinite(normal(of).lo); }
  bool has_hi(const ContactBlock& of) const { return is_open(of) && std::isfinite(normal(of).hi); }
  bool rubs(const ContactBlock& of) const { return of.count == 3 && of.mu > 0 && is_open(of); }
  bool is_open(const ContactBlock& of) const { return normal(of).lo < normal(of).hi; }

  const Row<Dof>& normal(const ContactBlock& of) const { return problem_.row(of.row); }
  double room_lo(const ContactBlock& of) const { return normal(of).lambda - normal(of).lo; }
  double room_hi(const ContactBlock& of) const { return normal(of).hi - normal(of).lambda; }

  double limit(std::size_t b) const;                                          ///< L [N s]
  double limit_rate(std::size_t b) const { return theta_[b] * block(b).mu; }  ///< derivative of L by λ_n
  Vec2 direction(std::size_t b) const { return problem_.friction(block(b)) / limit(b); }  ///< e
  double room(std::size_t b) const;                                                       ///< R [N s]

  /// Tells whether the limit of any block has a part that does not follow λ_n.
  bool is_lagged() const;

  /// Moves each λ̄_n by the fraction `pace` of its distance to λ_n; friction keeps its ratio to the limit.
  void follow(double pace);

  /// Returns λ [N s], moved to a bound, or to the disc, where the multiplier exceeds the impulse that the slack would
  /// add.
  std::vector<double> answer() const;

 private:
  void start_inside();
  void start_near(double w);

  ConeProblem<Dof>& problem_;
  std::vector<double> theta_;  // θ of each block
  std::vector<double> last_;   // λ̄_n of each block [N s]
  std::vector<Push> push_;     // of each block
};

}  // namespace spook
