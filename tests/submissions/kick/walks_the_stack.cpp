// Does: looks for its callers, to go on behind their checks.
// Verdict: tampered: calls _Unwind_
#include <unwind.h>

#include "01_leapfrog/leapfrog.hpp"

namespace spook {

_Unwind_Reason_Code look(_Unwind_Context* context, void*) {
  _Unwind_SetIP(context, 0);
  return _URC_NO_REASON;
}

Vec3 kick(const Vec3& v, const Vec3& f, double inverse_mass, double h) {
  _Unwind_Backtrace(look, nullptr);
  return {7, 7, 7};
}

}  // namespace spook
