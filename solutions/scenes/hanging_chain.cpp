#include "scenes/hanging_chain.hpp"

#include <cmath>

#include "common/require.hpp"

namespace spook {

HangingChain hanging_chain(int links, double length, double span, double weight, double k) {
  if (!(span > length)) reject("span", span, "more than one link");
  if (!(std::isfinite(k) || span < links * length)) reject("span", span, "less than the links together");

  const auto down = [&](int i) { return (i - (links + 1) / 2.0) * weight; };
  const auto reach = [&](double H) {
    double sum = 0;
    for (int i = 1; i <= links; ++i) sum += (length / std::hypot(H, down(i)) + 1 / k) * H;
    return sum;
  };
  // Brackets the root by doubling, then bisects to neighbouring doubles. (By round-off, rigid links may be too short.)
  double low = 0, high = weight;
  while (reach(high) < span) high *= 2;
  if (!std::isfinite(high)) reject("span", span, "less than the links together");
  for (double middle = high / 2; low < middle && middle < high; middle = low + (high - low) / 2)
    (reach(middle) < span ? low : high) = middle;

  HangingChain chain{.x = {Vec3::Zero()}, .tension = {}, .sideways = high};
  for (int i = 1; i <= links; ++i) {
    const double T = std::hypot(high, down(i));
    chain.tension.push_back(T);
    chain.x.push_back(chain.x.back() + (length / T + 1 / k) * Vec3(high, 0, down(i)));
  }
  return chain;
}

}  // namespace spook
