#include "engine/solvers/cone_newton.hpp"

#include <algorithm>
#include <cmath>

namespace spook {

/// Returns the λ̂_n S_nn below which a contact is light; 0 while it is not known which are [m/s].
template <int Dof>
static double most_of_light(const ConeProblem<Dof>& problem, double residual) {
  constexpr double near = 1e-3, share_of_light = 0.1;
  if (residual >= near * problem.rhs_norm()) return 0;
  double largest = 0;
  for (const ContactBlock& block : problem.blocks())
    if (block.count == 3) largest = std::max(largest, std::abs(problem.row(block.row).B));
  return share_of_light * largest;
}

static bool is_light(double aim, double diagonal, double most) {
  return aim > 0 && aim * diagonal < most;
}

/// Sets K and k of a row with the residual `r` [m/s]; returns the updated λ without bounds [N s]. `softer`: addition to
/// Σ, in units of S_kk.
template <int Dof>
static double linearise_row(const Row<Dof>& row, double r, double softer, ContactBlock& block) {
  const double aim = row.lambda + r / row.diagonal;
  block.K.setZero();
  block.k.setZero();
  if (row.lo < aim && aim < row.hi) {
    block.K(0, 0) = 1 / (row.Sigma + softer * row.diagonal);
    block.k[0] = block.K(0, 0) * r;
  } else {
    block.k[0] = std::clamp(aim, row.lo, row.hi) - row.lambda;
  }
  return aim;
}

/// Sets K and k of a block whose rows start at `rows` and have the residuals `r` [m/s]. `light`: the load λ̂_n S_nn
/// below which a contact is left to the sweeps [m/s].
template <int Dof>
static void linearise(const Row<Dof>* rows, const Vec3& r, double softer, double light, ContactBlock& block) {
  const double aim = linearise_row(*rows, r[0], softer, block), limit = block.mu * aim;
  if (block.count == 1) return;
  if (is_light(aim, rows[0].diagonal, light)) {
    block.K.setZero();
    block.k.setZero();
    return;
  }
  const Vec2 along(rows[1].lambda, rows[2].lambda), lacks = r.tail<2>(), q = along + lacks / block.s;
  const double soft = rows[1].Sigma + softer * block.s, size = q.norm();
  if (limit <= 0) {  // open, or frictionless
    block.k.tail<2>() = -along;
  } else if (size <= limit) {  // sticking
    block.K(1, 1) = block.K(2, 2) = 1 / soft;
    block.k.tail<2>() = lacks / soft;
  } else {  // sliding
    const Vec2 d = q / size, across(-d[1], d[0]);
    const double c = limit / size, turns = 1 - c + c * soft / block.s;
    block.K.template block<2, 2>(1, 1) = c / block.s / turns * across * across.transpose();
    block.K.template block<2, 1>(1, 0) = block.mu * block.K(0, 0) * d;
    block.k.tail<2>() =
        (block.mu * (rows[0].lambda + block.k[0]) - along.dot(d)) * d - along.dot(across) / turns * across;
  }
}

/// Computes Δλ of all rows; returns false if it is not finite.
template <int Dof>
static bool newton_step(ConeProblem<Dof>& problem, double softer, double light, std::vector<double>& step) {
  for (ContactBlock& block : problem.blocks()) {
    Vec3 r = Vec3::Zero();
    for (int n = 0; n < block.count; ++n) r[n] = problem.row_residual(block.row + n);
    linearise(&problem.row(block.row), r, softer, light, block);
  }
  problem.factorise();
  return problem.solve(step);
}

template <int Dof>
bool cone_newton(ConeProblem<Dof>& problem, double tolerance, int most, std::vector<double>& history) {
  constexpr int sweeps = 5, most_in_vain = 5;
  constexpr double accurate = 1e-8, least_softer = 1e-5, most_softer = 1e-2;
  double least = problem.residual(), softer = 0;
  std::vector<double> step, best = problem.impulses();
  const auto may_fail = [&] { return least <= accurate * problem.rhs_norm() ? 1 : most_in_vain; };
  for (int n = 0, in_vain = 0; n < most && in_vain < may_fail(); ++n) {
    const double share = least / problem.rhs_norm();
    if (!newton_step(problem, std::max(softer, 1e-3 * std::min(1.0, share)), most_of_light(problem, least),
                     step))
      break;
    std::vector<double> there = best;
    for (std::size_t k = 0; k < there.size(); ++k) there[k] += step[k];
    problem.project(there);
    problem.set_impulses(there);
    double left = problem.residual();
    if (!problem.is_solved(left, tolerance)) {
      problem.sweep(sweeps);
      left = problem.residual();
    }
    history.push_back(left);
    if (problem.is_solved(left, tolerance)) return true;
    in_vain += !(left < least / 2);
    if (left < least) {
      least = left;
      best = problem.impulses();
      softer /= 10;
    } else {
      softer = std::clamp(10 * softer, least_softer, most_softer);
      problem.set_impulses(best);
    }
  }
  problem.set_impulses(best);
  if (!history.empty()) history.back() = least;
  return false;
}

template <int Dof>
double share_of_light(const ConeProblem<Dof>& problem) {
  const double most = most_of_light(problem, problem.residual());
  const auto light = [&](const ContactBlock& block) {
    const Row<Dof>& row = problem.row(block.row);
    return block.count == 3 &&
           is_light(row.lambda + problem.row_residual(block.row) / row.diagonal, row.diagonal, most);
  };
  const auto count = std::count_if(problem.blocks().begin(), problem.blocks().end(), light);
  return static_cast<double>(count) / static_cast<double>(problem.blocks().size());
}

template bool cone_newton<3>(ConeProblem<3>&, double, int, std::vector<double>&);
template bool cone_newton<6>(ConeProblem<6>&, double, int, std::vector<double>&);
template double share_of_light<3>(const ConeProblem<3>&);
template double share_of_light<6>(const ConeProblem<6>&);

}  // namespace spook
