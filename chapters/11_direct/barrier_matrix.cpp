#include "11_direct/direct.hpp"
#include "common/not_implemented.hpp"

namespace spook {

SparseMatrix barrier_matrix(const SparseMatrix& S, const Interior& now) {
  // Eq. (11.7); what goes in and out, and in which units, is in direct.hpp.
  not_implemented("11.5 barrier_matrix", S, now);
}

}  // namespace spook
