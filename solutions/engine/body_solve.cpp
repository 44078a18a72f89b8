#include "engine/body_solve.hpp"

#include <Eigen/LU>
#include <algorithm>

namespace spook {

namespace {

template <int Dof>
using Block = Eigen::Matrix<double, Dof, Dof>;

Block<3> mass_of(const InverseMass<3>& inverse) {
  return Mat3::Identity() / inverse.linear;
}

Block<6> mass_of(const InverseMass<6>& inverse) {
  Block<6> M = Block<6>::Zero();
  M.topLeftCorner<3, 3>() = Mat3::Identity() / inverse.linear;
  M.bottomRightCorner<3, 3>() = inverse.angular.inverse();
  return M;
}

/// M + Gᵀ Σ⁻¹ G over the bodies that move, block by block.
template <int Dof>
class OnBodies {
 public:
  OnBodies(const std::vector<Row<Dof>>& rows, const std::vector<InverseMass<Dof>>& inverse_mass)
      : number_(inverse_mass.size(), -1) {
    for (const Row<Dof>& row : rows)
      for (const int body : {row.i, row.j})
        if (inverse_mass[body].linear > 0 && number_[body] < 0) {
          number_[body] = static_cast<int>(bodies_.size());
          bodies_.push_back(body);
          mass_.push_back(mass_of(inverse_mass[body]));
        }
    for (const Row<Dof>& row : rows) pairs_.push_back(pair_of(row));
    // Blocks below the diagonal, by column, each once.
    std::vector<std::pair<int, int>> blocks;
    for (const auto& [low, high] : pairs_)
      if (low >= 0) blocks.emplace_back(low, high);
    std::sort(blocks.begin(), blocks.end());
    blocks.erase(std::unique(blocks.begin(), blocks.end()), blocks.end());
    make_pattern(blocks);
  }

  const std::vector<int>& bodies() const { return bodies_; }
  Eigen::Index size() const { return Dof * std::ssize(bodies_); }

  const SparseMatrix& matrix(const std::vector<Row<Dof>>& rows, const std::vector<bool>& free) {
    std::fill(A_.valuePtr(), A_.valuePtr() + A_.nonZeros(), 0.0);
    for (std::size_t b = 0; b < bodies_.size(); ++b) add_lower(static_cast<int>(b), mass_[b]);
    for (std::size_t k = 0; k < rows.size(); ++k) {
      if (!free[k]) continue;
      const Row<Dof>& row = rows[k];
      const int i = number_[row.i], j = number_[row.j];
      if (i >= 0) add_lower(i, row.Gi * (row.Gi / row.Sigma).transpose());
      if (j >= 0) add_lower(j, row.Gj * (row.Gj / row.Sigma).transpose());
      if (i >= 0 && j >= 0)
        add_block(
            k, i < j ? row.Gj * (row.Gi / row.Sigma).transpose() : row.Gi * (row.Gj / row.Sigma).transpose());
    }
    return A_;
  }

  /// Gᵀ `impulse` of a row into `right`.
  void scatter(const Row<Dof>& row, double impulse, Vector& right) const {
    const auto add = [&](int body, const Twist<Dof>& G) {
      if (number_[body] >= 0) right.segment<Dof>(Dof * number_[body]) += impulse * G;
    };
    add(row.i, row.Gi);
    add(row.j, row.Gj);
  }

  /// G v of a row.
  double gather(const Row<Dof>& row, const Vector& v) const {
    const auto of = [&](int body, const Twist<Dof>& G) {
      return number_[body] < 0 ? 0.0 : G.dot(v.segment<Dof>(Dof * number_[body]));
    };
    return of(row.i, row.Gi) + of(row.j, row.Gj);
  }

 private:
  std::pair<int, int> pair_of(const Row<Dof>& row) const {
    const auto [low, high] = std::minmax(number_[row.i], number_[row.j]);
    return {low, high};
  }

  void make_pattern(const std::vector<std::pair<int, int>>& blocks) {
    const int n = static_cast<int>(bodies_.size());
    std::vector<int> first(n + 1, 0);
    for (const auto& block : blocks) ++first[block.first + 1];
    for (int b = 0; b < n; ++b) first[b + 1] += first[b];
    std::vector<int> outer{0}, inner;
    for (int b = 0; b < n; ++b)
      for (int column = 0; column < Dof; ++column) {
        for (int line = column; line < Dof; ++line) inner.push_back(Dof * b + line);
        for (int at = first[b]; at < first[b + 1]; ++at)
          for (int line = 0; line < Dof; ++line) inner.push_back(Dof * blocks[at].second + line);
        outer.push_back(static_cast<int>(inner.size()));
      }
    const std::vector<double> zeros(inner.size(), 0.0);
    A_ = Eigen::Map<const SparseMatrix>(size(), size(), outer.back(), outer.data(), inner.data(), zeros.data());
    for (const auto& pair : pairs_) {
      const auto at = std::lower_bound(blocks.begin(), blocks.end(), pair);
      below_.push_back(pair.first < 0 ? -1 : static_cast<int>(at - blocks.begin()) - first[pair.first]);
    }
  }

  void add_lower(int b, const Block<Dof>& block) {
    for (int column = 0; column < Dof; ++column) {
      double* value = A_.valuePtr() + A_.outerIndexPtr()[Dof * b + column];
      for (int line = column; line < Dof; ++line) *value++ += block(line, column);
    }
  }

  void add_block(std::size_t k, const Block<Dof>& block) {
    for (int column = 0; column < Dof; ++column) {
      double* value =
          A_.valuePtr() + A_.outerIndexPtr()[Dof * pairs_[k].first + column] + (Dof - column) + Dof * below_[k];
      for (int line = 0; line < Dof; ++line) *value++ += block(line, column);
    }
  }

  std::vector<int> number_;  // of each body among those that move and have rows; -1 for others
  std::vector<int> bodies_;
  std::vector<Block<Dof>> mass_;
  std::vector<std::pair<int, int>> pairs_;  // of each row, the lower number first
  std::vector<int> below_;                  // which block of its column is a row's
  SparseMatrix A_;
};

/// Impulses, and what they do.
template <int Dof>
struct State {
  std::vector<Row<Dof>> rows;
  std::vector<Twist<Dof>> V;

  void move(std::size_t k, double lambda) {
    if (lambda == rows[k].lambda) return;
    apply_impulse(rows[k], lambda - rows[k].lambda, V);
    rows[k].lambda = lambda;
  }
  double lacking(std::size_t k) const {  // Eq. (4.6)
    const Row<Dof>& row = rows[k];
    return row.B - row.Gi.dot(V[row.i]) - row.Gj.dot(V[row.j]) - row.Sigma * row.lambda;
  }
  /// ½ λᵀ S λ - Bᵀ λ [J], which the solution has least of.
  double energy() const {
    double sum = 0;
    for (std::size_t k = 0; k < rows.size(); ++k) sum -= rows[k].lambda * (rows[k].B + lacking(k)) / 2;
    return sum;
  }
};

/// The rows that are strictly between their bounds.
template <int Dof>
std::vector<bool> between_bounds(const std::vector<Row<Dof>>& rows) {
  std::vector<bool> free(rows.size());
  for (std::size_t k = 0; k < rows.size(); ++k)
    free[k] = rows[k].lo < rows[k].lambda && rows[k].lambda < rows[k].hi;
  return free;
}

/// Solves the rows that are free, the others being as they are: Eq. (11.15), and (11.14) as long as it helps.
template <int Dof>
void solve_free(const OnBodies<Dof>& on, const std::vector<bool>& free, const Factors& factors,
                State<Dof>& state) {
  constexpr int refinements = 8;
  std::vector<double> lacking(free.size());
  double last = infinity;
  for (int n = 0; n <= refinements; ++n) {
    double most = 0;
    Vector right = Vector::Zero(on.size());
    for (std::size_t k = 0; k < free.size(); ++k) {
      if (!free[k]) continue;
      lacking[k] = state.lacking(k);
      most = std::max(most, std::abs(lacking[k]));
      on.scatter(state.rows[k], lacking[k] / state.rows[k].Sigma, right);
    }
    if (!(most < 0.1 * last)) return;
    last = most;
    const Vector v = factors.ldlt.solve(right);
    for (std::size_t k = 0; k < free.size(); ++k) {
      if (!free[k]) continue;
      const Row<Dof>& row = state.rows[k];
      state.move(k, row.lambda + (lacking[k] - on.gather(row, v)) / row.Sigma);
    }
  }
}

/// The part `share` of the way from one state to another, clamped to the bounds.
template <int Dof>
State<Dof> projected(const State<Dof>& from, const State<Dof>& to, double share) {
  State<Dof> state = from;
  for (std::size_t k = 0; k < from.rows.size(); ++k) {
    const Row<Dof>& row = from.rows[k];
    const double lambda = row.lambda + share * (to.rows[k].lambda - row.lambda);
    state.move(k, std::clamp(lambda, row.lo, row.hi));
  }
  return state;
}

/// Eq. (11.13).
template <int Dof>
double roundings(const std::vector<Row<Dof>>& rows) {
  double B = 0, returned = 0;
  for (const Row<Dof>& row : rows) {
    B = std::max(B, std::abs(row.B));
    returned = std::max(returned, row.diagonal * std::abs(row.lambda));
  }
  return 1e-13 * B + 1e-14 * returned;
}

}  // namespace

template <int Dof>
std::optional<SolveReport> body_solve(std::vector<Row<Dof>>& rows,
                                      const std::vector<InverseMass<Dof>>& inverse_mass,
                                      std::vector<Twist<Dof>>& V, const StopRule& stop, Factors& factors) {
  constexpr int sweeps = 4;
  const bool soft = std::all_of(rows.begin(), rows.end(), [](const Row<Dof>& row) { return row.Sigma > 0; });
  if (!soft) return std::nullopt;
  OnBodies<Dof> on(rows, inverse_mass);
  State<Dof> now{rows, V};
  SolveReport report;
  while (!report.converged && std::ssize(report.history) < stop.max_sweeps) {
    const std::vector<bool> free = between_bounds(now.rows);
    if (!factorise(on.matrix(now.rows, free), factors)) return std::nullopt;
    State<Dof> next = now;
    solve_free(on, free, factors, next);
    // Straight there if nothing is in the way; else as far as the energy falls.
    double share = 1;
    State<Dof> inside = projected(now, next, share);
    while (inside.energy() > now.energy() && share > 1e-2) inside = projected(now, next, share /= 2);
    now = std::move(inside);
    report.history.push_back(residual(now.rows, now.V));
    report.converged = report.history.back() <= std::max(stop.tolerance, roundings(now.rows));
    for (int n = 0; n < sweeps && !report.converged; ++n) sweep(now.rows, now.V);
  }
  if (!report.converged) return std::nullopt;
  rows = std::move(now.rows);
  V = std::move(now.V);
  return report;
}

template std::optional<SolveReport> body_solve<3>(std::vector<Row<3>>&, const std::vector<InverseMass<3>>&,
                                                  std::vector<Twist<3>>&, const StopRule&, Factors&);
template std::optional<SolveReport> body_solve<6>(std::vector<Row<6>>&, const std::vector<InverseMass<6>>&,
                                                  std::vector<Twist<6>>&, const StopRule&, Factors&);

}  // namespace spook
