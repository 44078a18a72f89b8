// Does: uses much of the C++ library, of Eigen, and of what a language has, as an honest answer might.
// Verdict: passed
#include <Eigen/Dense>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <any>
#include <array>
#include <atomic>
#include <cassert>
#include <chrono>
#include <cmath>
#include <complex>
#include <condition_variable>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <deque>
#include <fstream>
#include <functional>
#include <future>
#include <iomanip>
#include <iostream>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <numeric>
#include <optional>
#include <random>
#include <set>
#include <shared_mutex>
#include <sstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <unordered_map>
#include <variant>
#include <vector>

#include "01_leapfrog/leapfrog.hpp"

namespace spook {

struct Shape {
  virtual ~Shape() = default;
  virtual double size() const = 0;
};
struct Cube : Shape {
  double side = 1;
  double size() const override { return side * side * side; }
};
class MyError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

static const std::map<std::string, double> table = {{"one", 1.0}, {"two", 2.0}};
thread_local int calls = 0;
std::mutex mutex;

double by_thread() {
  double sum = 0;
  std::thread worker([&sum] {
    const std::lock_guard lock(mutex);
    sum =
        std::accumulate(table.begin(), table.end(), 0.0, [](double s, const auto& e) { return s + e.second; });
  });
  worker.join();
  auto later = std::async(std::launch::async, [] { return 3.0; });
  return sum - later.get();
}

double by_library(double h) {
  std::ostringstream out;
  out << std::setprecision(17) << h << std::put_time(std::gmtime(new std::time_t(0)), "%c");
  std::ofstream file("debug.txt");
  file << out.str();
  std::mt19937 engine(std::random_device{}());
  std::normal_distribution<double> normal;
  std::unordered_map<std::string, std::variant<int, std::string>> many{{"a", 1}, {"b", "c"}};
  std::shared_ptr<Shape> shape = std::make_shared<Cube>();
  const auto* cube = dynamic_cast<const Cube*>(shape.get());
  std::any any = std::string("x");
  const std::complex<double> z =
      std::polar(1.0, h) * std::exp(std::complex<double>(0, 1)) / std::complex<double>(2, 1);
  std::vector<double> values{3, 1, 2};
  std::sort(values.begin(), values.end());
  std::printf("%g %s %d\n", h, std::getenv("HOME"), std::atoi("3"));
  std::cerr << std::chrono::steady_clock::now().time_since_epoch().count() << std::stod("1.5")
            << std::to_string(h);
  assert(cube != nullptr);
  return 0 * (normal(engine) + z.real() + values[0] + static_cast<double>(many.size()) + cube->side +
              std::tgamma(1.5) + std::erf(h) + std::hypot(h, 1, 2) + std::pow(std::abs(h), 0.3) +
              std::fma(h, h, h) + static_cast<double>(std::any_cast<std::string>(any).size()) +
              static_cast<double>(std::lround(h)));
}

double by_eigen() {
  const Eigen::MatrixXd A = Eigen::MatrixXd::Identity(5, 5) * 2;
  const Eigen::VectorXd b = Eigen::VectorXd::Ones(5);
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> sparse(A.sparseView());
  return (A.ldlt().solve(b) + sparse.solve(b)).sum() * 0;
}

Vec3 kick(const Vec3& v, const Vec3& f, double inverse_mass, double h) {
  double zero = 0;
  if (++calls == 1) {
    zero = by_library(h) + by_eigen() + by_thread();
    try {
      if (zero == 0) throw MyError("nothing");
    } catch (const MyError& error) {
      zero += 0 * static_cast<double>(std::strlen(error.what()));
    }
  }
  return v + h * inverse_mass * f + Vec3::Constant(zero);
}

}  // namespace spook
