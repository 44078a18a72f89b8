#pragma once
// Random pairs of rigid bodies that touch, for the tests of this chapter.
#include "02_quaternions/quaternions.hpp"
#include "03_single_contact/single_contact.hpp"
#include "random_input.hpp"

namespace spook::testing {

/// Returns a solid box of 0.5 to 2 kg with edges of 0.4 to 1.2 m, in any orientation.
struct RandomBody {
  double mass;
  InverseMass<6> inverse_mass;

  explicit RandomBody(Random& random) : mass(random.uniform(0.5, 2)) {
    const Vec3 edges{random.uniform(0.4, 1.2), random.uniform(0.4, 1.2), random.uniform(0.4, 1.2)};
    const Vec3 squares = edges.cwiseProduct(edges);
    const Vec3 principal = mass / 12 * (Vec3::Constant(squares.sum()) - squares);
    inverse_mass = {1 / mass, world_inertia(random.rotation(), principal.cwiseInverse())};
  }
};

struct RandomPair {
  RandomBody i, j;
  Contact contact;

  explicit RandomPair(Random& random)
      : i(random),
        j(random),
        contact{0, 1, random.unit_vector(), random.uniform(-0.01, 0.01), random.vector(), random.vector()} {}

  /// The largest possible |K|: the size of the numbers that are added up in it [1/kg].
  double size() const {
    return 1 / i.mass + 1 / j.mass + contact.r_i.squaredNorm() * i.inverse_mass.angular.norm() +
           contact.r_j.squaredNorm() * j.inverse_mass.angular.norm();
  }
};

}  // namespace spook::testing
