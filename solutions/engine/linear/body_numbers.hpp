#pragma once
// Numbers of the bodies that some rows act on, from 0 in the order of the rows.
#include <vector>

#include "04_gauss_seidel/gauss_seidel.hpp"

namespace spook {

/// Returns false for static bodies, which no impulse moves: Bodies::is_fixed, for code that has no Bodies.
template <int Dof>
bool is_dynamic(const InverseMass<Dof>& inverse_mass) {
  return inverse_mass.linear > 0;
}

/// Tells whether body i, or j, of a row is dynamic: whether the row's impulse changes its velocity. Needs no masses,
/// unlike is_dynamic.
template <int Dof>
bool moves_i(const Row<Dof>& row) {
  return !row.MinvGi.isZero(0);
}
template <int Dof>
bool moves_j(const Row<Dof>& row) {
  return !row.MinvGj.isZero(0);
}

class BodyNumbers {
 public:
  /// Starts anew, for a world of so many bodies.
  void begin(std::size_t bodies) {
    numbers_.assign(bodies, -1);
    bodies_.clear();
  }

  /// Numbers the dynamic bodies of the rows.
  template <int Dof>
  void begin(const std::vector<Row<Dof>>& rows, const std::vector<InverseMass<Dof>>& inverse_mass) {
    begin(inverse_mass.size());
    for (const Row<Dof>& row : rows)
      for (const int body : {row.i, row.j})
        if (is_dynamic(inverse_mass[body])) add(body);
  }

  /// Returns the number of a body, which gets the next one if it has none.
  int add(int body) {
    if (numbers_[body] < 0) {
      numbers_[body] = static_cast<int>(bodies_.size());
      bodies_.push_back(body);
    }
    return numbers_[body];
  }

  /// Takes the numbers away again: cheaper than to begin if few of many bodies have one.
  void clear() {
    for (const int body : bodies_) numbers_[body] = -1;
    bodies_.clear();
  }

  int operator[](int body) const { return numbers_[body]; }  ///< -1 for a body without a number
  const std::vector<int>& bodies() const { return bodies_; }
  std::size_t size() const { return numbers_.size(); }  ///< of the world

 private:
  std::vector<int> numbers_, bodies_;
};

}  // namespace spook
