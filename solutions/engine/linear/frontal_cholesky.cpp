#include "engine/linear/frontal_cholesky.hpp"

#include <algorithm>
#include <cmath>

#include "engine/linear/elimination.hpp"

namespace spook {

namespace {

constexpr double zeros_in_a_front = 0.2;  // the share that may be stored
constexpr int columns_at_once = 3;        // the rows of a ball joint, or half of a body's velocities

/// Returns the node of each unknown. Unknowns are of one node if each column's entries are those of the one before,
/// without its diagonal.
std::vector<int> nodes_of(const SparseMatrix& A) {
  const int* first = A.outerIndexPtr();
  const int* lines = A.innerIndexPtr();
  std::vector<int> node(A.cols(), 0);
  for (int k = 1; k < A.cols(); ++k) {
    const bool same =
        std::equal(lines + first[k - 1] + 1, lines + first[k], lines + first[k], lines + first[k + 1]);
    node[k] = node[k - 1] + (same ? 0 : 1);
  }
  return node;
}

/// The nodes, eliminated.
struct Order {
  std::vector<int> size, start;         ///< unknowns of each place in the order, and the first one's place
  std::vector<std::vector<int>> later;  ///< places of the later neighbours
  std::vector<int> place;               ///< of each unknown

  explicit Order(const SparseMatrix& A) {
    const std::vector<int> node = nodes_of(A);
    const int nodes = node.back() + 1;
    std::vector<int> sizes(nodes, 0);
    std::vector<std::pair<int, int>> pairs;
    for (int k = 0; k < A.cols(); ++k) {
      if (sizes[node[k]]++ > 0) continue;
      int last = node[k];
      for (SparseMatrix::InnerIterator entry(A, k); entry; ++entry)
        if (node[entry.row()] != last) pairs.emplace_back(node[k], last = node[entry.row()]);
    }
    Elimination found = eliminate(nodes, pairs);
    later = std::move(found.later);
    size.resize(nodes), start.assign(nodes, 0);
    for (int n = 0; n < nodes; ++n) size[found.place[n]] = sizes[n];
    for (int p = 1; p < nodes; ++p) start[p] = start[p - 1] + size[p - 1];
    for (int k = 0; k < A.cols(); ++k)
      place.push_back(k > 0 && node[k] == node[k - 1] ? place.back() + 1 : start[found.place[node[k]]]);
  }

  /// Returns the number of unknowns that the node p acts on, its own included.
  int reach(int p) const {
    int count = size[p];
    for (const int q : later[p]) count += size[q];
    return count;
  }

  /// Returns the last node of the front that begins with p.
  int end_of_front(int p) const {
    double entries = size[p] * reach(p), zeros = 0;
    int width = size[p];
    for (;; ++p) {
      if (later[p].empty() || later[p].front() != p + 1) return p;
      const int more = reach(p + 1) - (reach(p) - size[p]);  // unknowns that p + 1 acts on, but p does not
      zeros += width * more;
      entries += width * more + size[p + 1] * reach(p + 1);
      width += size[p + 1];
      if (zeros > zeros_in_a_front * entries) return p;
    }
  }
};

}  // namespace

bool FrontalCholesky::has_pattern_of(const SparseMatrix& A) const {
  return std::ssize(columns_) == A.outerSize() + 1 && std::ssize(entries_) == A.nonZeros() &&
         std::equal(columns_.begin(), columns_.end(), A.outerIndexPtr()) &&
         std::equal(entries_.begin(), entries_.end(), A.innerIndexPtr());
}

void FrontalCholesky::analyse(const SparseMatrix& A) {
  ++analyses_;
  columns_.assign(A.outerIndexPtr(), A.outerIndexPtr() + A.outerSize() + 1);
  entries_.assign(A.innerIndexPtr(), A.innerIndexPtr() + A.nonZeros());
  const Order order(A);
  place_ = order.place;

  fronts_.clear();
  std::vector<int> front_of(A.cols());  // of each place
  for (int p = 0; p < std::ssize(order.size);) {
    const int last = order.end_of_front(p);
    Front& front = fronts_.emplace_back();
    front.first = order.start[p];
    for (; p <= last; ++p) front.width += order.size[p];
    for (const int q : order.later[last])
      for (int k = 0; k < order.size[q]; ++k) front.border.push_back(order.start[q] + k);
    std::fill_n(front_of.begin() + front.first, front.width, static_cast<int>(fronts_.size()) - 1);
  }

  const auto index_in = [](const Front& front, int place) {
    if (place < front.first + front.width) return place - front.first;
    const auto found = std::lower_bound(front.border.begin(), front.border.end(), place);
    return front.width + static_cast<int>(found - front.border.begin());
  };
  for (std::size_t f = 0; f < fronts_.size(); ++f) {
    if (fronts_[f].border.empty()) continue;
    Front& parent = fronts_[front_of[fronts_[f].border.front()]];
    parent.children.push_back(static_cast<int>(f));
    for (const int place : fronts_[f].border) fronts_[f].in_parent.push_back(index_in(parent, place));
  }
  for (int j = 0; j < A.cols(); ++j)
    for (int e = columns_[j]; e < columns_[j + 1]; ++e) {
      const auto [low, high] = std::minmax(place_[j], place_[entries_[e]]);
      Front& front = fronts_[front_of[low]];
      const int lines = front.width + static_cast<int>(front.border.size());
      front.entries.emplace_back(e, index_in(front, high) + (low - front.first) * lines);
    }
}

/// Sets a front to its entries of A, and adds the rests of its children.
void FrontalCholesky::assemble(const SparseMatrix& A, Front& front) {
  const int width = front.width, border = static_cast<int>(front.border.size());
  front.panel.setZero(width + border, width);
  front.rest.setZero(border, border);
  for (const auto& [entry, at] : front.entries) front.panel.data()[at] += A.valuePtr()[entry];
  for (const int c : front.children) {
    Front& child = fronts_[c];
    const std::vector<int>& index = child.in_parent;
    for (int j = 0; j < std::ssize(index); ++j) {
      const bool own = index[j] < width;
      double* column = own ? &front.panel(0, index[j]) : &front.rest(0, index[j] - width);
      const int begin = own ? 0 : width;
      for (int i = j; i < std::ssize(index); ++i) column[index[i] - begin] += child.rest(i, j);
    }
    child.rest.resize(0, 0);
  }
}

/// Subtracts the products of columns of L, from the line `at` on, with their entries in that line.
void FrontalCholesky::Front::subtract_products(int begin, int end, int at, double* from) const {
  const Eigen::Index lines = panel.rows();
  const double* a = panel.data() + begin * lines + at;
  const Eigen::Index count = lines - at;
  if (end - begin == columns_at_once) {  // all in one loop, which loads and stores each number once
    const double *b = a + lines, *c = b + lines;
    const double a0 = *a, b0 = *b, c0 = *c;
    for (Eigen::Index i = 0; i < count; ++i) from[i] -= a0 * a[i] + b0 * b[i] + c0 * c[i];
    return;
  }
  for (; begin < end; ++begin, a += lines) {
    const double a0 = *a;
    for (Eigen::Index i = 0; i < count; ++i) from[i] -= a0 * a[i];
  }
}

/// Computes the columns of L, and the rest. Returns false if a pivot is not sound.
bool FrontalCholesky::Front::eliminate(const Vector& diagonal) {
  const auto column = [&](int k) { return &panel(k, k); };
  for (int begin = 0; begin < width; begin += columns_at_once) {
    const int end = std::min(begin + columns_at_once, width);
    for (int k = begin; k < end; ++k) {
      subtract_products(begin, k, k, column(k));
      const double D = *column(k), A = diagonal[first + k];
      // Eq. (11.4): A - D has been subtracted.
      if (!(std::isfinite(D) && D > 1e-14 * (A + (A - D)))) return false;
      const double scale = 1 / std::sqrt(D);
      for (double* entry = column(k); entry != panel.data() + (k + 1) * panel.rows(); ++entry) *entry *= scale;
    }
    for (int k = end; k < width; ++k) subtract_products(begin, end, k, column(k));
    for (int k = 0; k < std::ssize(border); ++k) subtract_products(begin, end, width + k, &rest(k, k));
  }
  return true;
}

/// Solves L x = b for the own unknowns, and subtracts what they contribute to the border.
void FrontalCholesky::Front::solve_forward(Vector& x, std::vector<double>& of_border) const {
  double* own = x.data() + first;
  of_border.assign(border.size(), 0);
  for (int k = 0; k < width; ++k) {
    const double* column = &panel(0, k);
    own[k] /= column[k];
    for (int i = k + 1; i < width; ++i) own[i] -= column[i] * own[k];
    for (std::size_t i = 0; i < border.size(); ++i) of_border[i] += column[width + i] * own[k];
  }
  for (std::size_t i = 0; i < border.size(); ++i) x[border[i]] -= of_border[i];
}

/// Solves Lᵀ x = b for the own unknowns, with those of the border known.
void FrontalCholesky::Front::solve_backward(Vector& x, std::vector<double>& of_border) const {
  double* own = x.data() + first;
  of_border.resize(border.size());
  for (std::size_t i = 0; i < border.size(); ++i) of_border[i] = x[border[i]];
  for (int k = width - 1; k >= 0; --k) {
    const double* column = &panel(0, k);
    for (std::size_t i = 0; i < border.size(); ++i) own[k] -= column[width + i] * of_border[i];
    for (int i = k + 1; i < width; ++i) own[k] -= column[i] * own[i];
    own[k] /= column[k];
  }
}

bool FrontalCholesky::factorise(const SparseMatrix& A) {
  if (!has_pattern_of(A)) analyse(A);
  diagonal_.resize(A.cols());
  for (int k = 0; k < A.cols(); ++k) diagonal_[place_[k]] = A.valuePtr()[columns_[k]];
  for (Front& front : fronts_) {
    assemble(A, front);
    if (!front.eliminate(diagonal_)) return false;
  }
  return true;
}

Vector FrontalCholesky::solve(const Vector& b) const {
  Vector x(b.size()), solution(b.size());
  std::vector<double> of_border;
  for (Eigen::Index k = 0; k < b.size(); ++k) x[place_[k]] = b[k];
  for (const Front& front : fronts_) front.solve_forward(x, of_border);
  for (auto front = fronts_.rbegin(); front != fronts_.rend(); ++front) front->solve_backward(x, of_border);
  for (Eigen::Index k = 0; k < b.size(); ++k) solution[k] = x[place_[k]];
  return solution;
}

}  // namespace spook
