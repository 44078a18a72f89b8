#include "11_direct/direct.hpp"
#include "common/not_implemented.hpp"

namespace spook {

bool factorise(const SparseMatrix& A, Factors& factors) {
  // Eq. (11.3), (11.4); what goes in and out, and in which units, is in direct.hpp.
  not_implemented("11.3 factorise", A, factors);
}

}  // namespace spook
