#include "python_world.hpp"

#include <chrono>
#include <stdexcept>

#include "common/require.hpp"

namespace spook {

template <int Dof>
void PythonWorld<Dof>::step(double h, std::int64_t steps) {
  if (steps < 0) throw std::invalid_argument("steps must be at least 0, but is " + std::to_string(steps));
  world();
  struct Busy {
    bool& busy;
    explicit Busy(bool& of) : busy(of) { busy = true; }
    ~Busy() { busy = false; }
  };
  try {
    stepping_ = std::this_thread::get_id();
    const Busy busy(busy_);
    const py::gil_scoped_release unlocked;
    step_unlocked(h, steps);
  } catch (const SimulationDiverged& diverged) {
    reason_ = diverged.what();
    warned_ = true;  // by the exception
    throw;
  }
  warn();
}

template <int Dof>
void PythonWorld<Dof>::step_unlocked(double h, std::int64_t steps) {
  using Clock = std::chrono::steady_clock;
  auto last = Clock::now();
  std::int64_t between = 1;
  for (std::int64_t n = 1, next = 1; n <= steps; ++n) {
    if (checked_) check_.begin_step(world_);
    world_.step(h);
    last_h_ = h;
    if (checked_) check_.look(world_, h);
    if (n < next) continue;
    const auto now = Clock::now();
    between = now - last < patience ? std::min(2 * between, most_between_looks) : 1;
    next = n + between;
    last = now;
    const py::gil_scoped_acquire locked;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  }
}

/// Warns once that the world is lost, by Python's warnings.
template <int Dof>
void PythonWorld<Dof>::warn() {
  if (warned_ || state() != State::lost) return;
  warned_ = true;
  const std::string text =
      "the world is lost in step " + std::to_string(check_.verdict().step) + ": " + reason();
  if (PyErr_WarnEx(PyExc_RuntimeWarning, text.c_str(), 1) != 0) throw py::error_already_set();
}

template <int Dof>
void PythonWorld<Dof>::put_load(int body, const Twist<Dof>& load) {
  const std::size_t i = world().index(body);
  if (world_.bodies().is_fixed(i))
    throw std::invalid_argument("body " + std::to_string(body) + " is static: no force moves it");
  require_all_finite("force", load.template head<3>());
  if constexpr (Dof == 6) require_all_finite("torque", load.template tail<3>());
  if (!world_.settings().wrench) world_.set_wrench(Loads<Dof>());
  world_.settings().wrench.template target<Loads<Dof>>()->set(i, load);
}

template <int Dof>
std::optional<Eigen::Matrix<double, Eigen::Dynamic, Dof, Eigen::RowMajor>> PythonWorld<Dof>::loads() const {
  if (!world().settings().wrench) return {};
  const std::vector<Twist<Dof>>& all = world_.settings().wrench.template target<Loads<Dof>>()->all();
  Eigen::Matrix<double, Eigen::Dynamic, Dof, Eigen::RowMajor> rows(std::ssize(all), Dof);
  for (Eigen::Index i = 0; i < rows.rows(); ++i) rows.row(i) = all[static_cast<std::size_t>(i)];
  return rows;
}

template <int Dof>
void PythonWorld<Dof>::remove_body(int body) {
  const std::size_t i = world().index(body);
  bodies_of("remove_body").remove_body(body);
  if (world_.settings().wrench) world_.settings().wrench.template target<Loads<Dof>>()->remove(i);
}

template <int Dof>
void PythonWorld<Dof>::restore(const PythonWorld& saved) {
  bodies_of("restore") = World<Dof>(saved.world());
  given = saved.given;
  check_ = saved.check_;
  checked_ = saved.checked_;
  warned_ = saved.warned_;
  last_h_ = saved.last_h_;
  reason_ = saved.reason_;
}

template <int Dof>
std::string PythonWorld<Dof>::bytes() {
  world();  // not while it takes a step
  return bytes_of_state(*this);
}

template <int Dof>
void PythonWorld<Dof>::continue_from(const std::string& bytes) {
  const std::string before = this->bytes();
  try {
    read_state(bytes, *this);
  } catch (const std::runtime_error&) {
    read_state(before, *this);
    throw std::invalid_argument(
        "state must be the bytes that get_state returned, of a world that was built in the same way and has "
        "the "
        "same solver");
  }
}

template class PythonWorld<3>;
template class PythonWorld<6>;

}  // namespace spook
