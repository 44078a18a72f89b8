#include "11_direct/direct.hpp"
#include "common/not_implemented.hpp"

namespace spook {

Interior interior_start(const SparseMatrix& S, const Vector& B, const Vector& lo, const Vector& hi,
                        const Vector& guess) {
  // Eq. (11.12); what goes in and out, and in which units, is in direct.hpp.
  not_implemented("11.8 interior_start", S, B, lo, hi, guess);
}

}  // namespace spook
