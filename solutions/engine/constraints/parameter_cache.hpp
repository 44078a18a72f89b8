#pragma once
// SPOOK's parameters for many rows, most of which share k and d.
#include "03_single_contact/single_contact.hpp"

namespace spook {

/// Keeps the parameters of the last k and d.
class ParameterCache {
 public:
  explicit ParameterCache(double h) : h_(h) {}
  const SpookParameters& operator()(double k, double d) {
    if (k != k_ || d != d_) spook_ = spook_parameters(h_, k, d);
    k_ = k, d_ = d;
    return spook_;
  }

 private:
  double h_, k_ = 0, d_ = 0;  // no k is 0
  SpookParameters spook_{};
};

}  // namespace spook
