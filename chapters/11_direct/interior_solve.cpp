#include "11_direct/direct.hpp"
#include "common/not_implemented.hpp"
#include "common/require.hpp"

namespace spook {

SolveReport interior_solve(const SparseMatrix& S, const Vector& B, const Vector& lo, const Vector& hi,
                           const StopRule& stop, Vector& lambda, Factors& factors) {
  // Eq. (4.8), (11.13); what goes in and out, and in which units, is in direct.hpp.
  not_implemented("11.10 interior_solve", S, B, lo, hi, stop, lambda, factors);
}

}  // namespace spook
