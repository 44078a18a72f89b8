// Does: throws what is no std::exception.
// Verdict: failed
#include "01_leapfrog/leapfrog.hpp"

namespace spook {

Vec3 kick(const Vec3& v, const Vec3& f, double inverse_mass, double h) {
  throw 42;
}

}  // namespace spook
