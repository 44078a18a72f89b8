#include "13_mechanisms/mechanisms.hpp"
#include "common/not_implemented.hpp"

namespace spook {

std::array<Coordinate, 3> turned_apart(const JointFrame& i, const JointFrame& j) {
  // Eq. (13.1)-(13.4); what goes in and out, and in which units, is in mechanisms.hpp.
  not_implemented("13.1 turned_apart", i, j);
}

}  // namespace spook
