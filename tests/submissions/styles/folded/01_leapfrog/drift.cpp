#include "01_leapfrog/leapfrog.hpp"

namespace spook {

namespace {

template <class Vector>
Vector moved(Vector x, const Vector& v, double h) {
  x += h * v;
  return x;
}

}  // namespace

Vec3 drift(const Vec3& x, const Vec3& v, double h) {
  return moved(x, v, h);
}

}  // namespace spook
