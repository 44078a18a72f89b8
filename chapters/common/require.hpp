#pragma once
// Checks of input numbers: each throws std::invalid_argument with the parameter's name and value. All reject NaN.
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>

namespace spook {

[[noreturn]] inline void reject(const std::string& name, double value, const std::string& rule) {
  std::ostringstream message;
  message.precision(17);
  message << name << " must be " << rule << ", but is " << value;
  throw std::invalid_argument(message.str());
}

inline void require_finite(const std::string& name, double value) {
  if (!std::isfinite(value)) reject(name, value, "finite");
}

inline void require_positive(const std::string& name, double value) {
  if (!(std::isfinite(value) && value > 0)) reject(name, value, "positive and finite");
}

inline void require_not_negative(const std::string& name, double value) {
  if (!(std::isfinite(value) && value >= 0)) reject(name, value, "zero or positive, and finite");
}

/// Throws unless every coefficient of an Eigen vector or matrix is finite.
template <class Matrix>
void require_all_finite(const std::string& name, const Matrix& values) {
  for (int k = 0; k < values.size(); ++k) require_finite(name, values.reshaped()(k));
}

}  // namespace spook
