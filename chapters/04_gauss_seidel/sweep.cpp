#include "04_gauss_seidel/gauss_seidel.hpp"
#include "common/not_implemented.hpp"

namespace spook {

template <int Dof>
double sweep(std::vector<Row<Dof>>& rows, std::vector<Twist<Dof>>& V) {
  // Eq. (4.7) for every row in turn; what goes in and out, and in which units, is in gauss_seidel.hpp.
  not_implemented("4.4 sweep", rows, V);
}

// Compiles the template for point masses (3) and for rigid bodies (6): leave these two lines as they are.
template double sweep<3>(std::vector<Row<3>>&, std::vector<Twist<3>>&);
template double sweep<6>(std::vector<Row<6>>&, std::vector<Twist<6>>&);

}  // namespace spook
