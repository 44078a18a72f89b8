#pragma once
// Claims of a figure, each with the number that supports it.
#include <string>
#include <vector>

namespace spook::plots {

struct Claim {
  std::string text;  ///< the same in every run, and in plots/README.md
  double measured;
  double low, high;  ///< the claim holds if `measured` lies between these bounds, which may be infinite

  bool holds() const { return measured >= low && measured <= high; }  // false for NaN
};

class Claims {
 public:
  void between(const std::string& text, double measured, double low, double high);
  void near(const std::string& text, double measured, double expected, double margin);
  void at_most(const std::string& text, double measured, double bound);
  void at_least(const std::string& text, double measured, double bound);

  const std::vector<Claim>& all() const { return all_; }
  bool hold() const;

 private:
  std::vector<Claim> all_;
};

}  // namespace spook::plots
