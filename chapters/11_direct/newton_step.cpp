#include "11_direct/direct.hpp"
#include "common/not_implemented.hpp"

namespace spook {

Interior newton_step(const SparseMatrix& S, const Vector& B, const Interior& now, const Target& target,
                     const Factors& factors) {
  // Eq. (11.8), (11.9); what goes in and out, and in which units, is in direct.hpp.
  not_implemented("11.6 newton_step", S, B, now, target, factors);
}

}  // namespace spook
