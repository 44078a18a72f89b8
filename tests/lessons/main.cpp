#include <cmath>
#include <cstdio>

#include "numbers.hpp"

namespace spook::lessons {

void say(const std::string& name, double value) {
  std::printf("%s %.10g\n", name.c_str(), std::abs(value) < 1e-14 ? 0.0 : value);
}

}  // namespace spook::lessons

int main() {
  spook::lessons::worked_examples();
  spook::lessons::predicted_numbers();
}
