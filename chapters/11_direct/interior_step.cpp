#include "11_direct/direct.hpp"
#include "common/not_implemented.hpp"

namespace spook {

Interior interior_step(const SparseMatrix& S, const Vector& B, const Vector& lo, const Vector& hi,
                       const Interior& now, const Factors& factors) {
  // Eq. (11.8)-(11.11); what goes in and out, and in which units, is in direct.hpp.
  not_implemented("11.9 interior_step", S, B, lo, hi, now, factors);
}

}  // namespace spook
