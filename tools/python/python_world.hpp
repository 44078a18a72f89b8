#pragma once
// A world for Python: with forces on its bodies, arrays over its numbers, and a verdict on its steps.
#include <memory>
#include <string>
#include <thread>

#include "engine/diagnostics/run_check.hpp"
#include "views.hpp"

namespace spook {

/// The forces that Python sets on bodies; empty without any. A copy of the world copies them.
template <int Dof>
class Loads {
 public:
  Loads() : loads_(std::make_shared<std::vector<Twist<Dof>>>()) {}
  Loads(const Loads& other) : loads_(std::make_shared<std::vector<Twist<Dof>>>(*other.loads_)) {}
  Loads& operator=(const Loads&) = delete;
  Twist<Dof> operator()(std::size_t i, const Bodies<Dof>&, double) const {
    return i < loads_->size() ? (*loads_)[i] : Twist<Dof>::Zero().eval();
  }
  void set(std::size_t i, const Twist<Dof>& load) const {
    if (i >= loads_->size()) loads_->resize(i + 1, Twist<Dof>::Zero());
    (*loads_)[i] = load;
  }
  void remove(std::size_t i) const {
    if (i < loads_->size()) loads_->erase(loads_->begin() + static_cast<std::ptrdiff_t>(i));
  }
  const std::vector<Twist<Dof>>& all() const { return *loads_; }

 private:
  std::shared_ptr<std::vector<Twist<Dof>>> loads_;
};

template <int Dof>
class PythonWorld {
 public:
  PythonWorld(World<Dof> made, bool checked) : world_(std::move(made)), checked_(checked) {}
  PythonWorld(const PythonWorld& other)
      : given(other.given),
        world_(other.world()),
        check_(other.check_),
        checked_(other.checked_),
        warned_(other.warned_),
        last_h_(other.last_h_),
        reason_(other.reason_) {}

  /// Throws std::runtime_error during a step: of another thread, or of this one, in a velocity function.
  World<Dof>& world() { return const_cast<World<Dof>&>(std::as_const(*this).world()); }
  const World<Dof>& world() const {
    if (busy_)
      throw std::runtime_error(stepping_ == std::this_thread::get_id()
                                   ? "a velocity function cannot use its world, which is taking a step"
                                   : "the world is taking a step in another thread");
    return world_;
  }
  /// Locks the world to add or remove bodies. Throws py::buffer_error while arrays of the bodies' numbers exist.
  World<Dof>& bodies_of(const char* what) {
    views.require_none(what);
    return moved();
  }
  /// Locks the world to move bodies from outside.
  World<Dof>& moved() {
    check_.bodies_were_moved();
    return world();
  }

  /// Takes steps without Python's lock, except to check for Ctrl-C. Throws as World::step does, or a Python error.
  void step(double h, std::int64_t steps);

  /// The length of the last step [s]; 1 before the first, when there are no impulses.
  double last_h() const { return last_h_; }

  /// Returns "sound", "unsolved" or "lost"; "unchecked" for a finite world without checks.
  std::string state_name() const { return checked_ || !reason_.empty() ? name_of(state()) : "unchecked"; }
  State state() const { return reason_.empty() ? check_.verdict().state : State::lost; }
  const std::string& reason() const { return reason_.empty() ? check_.verdict().reason : reason_; }
  const std::string& note() const { return check_.verdict().note; }

  /// Throws std::invalid_argument for a number that is not finite, and for a static body.
  void put_load(int body, const Twist<Dof>& load);
  /// Returns a row for each body that has had a force; none if no body has.
  std::optional<Eigen::Matrix<double, Eigen::Dynamic, Dof, Eigen::RowMajor>> loads() const;
  void remove_body(int body);
  /// Restores `saved`: bodies, joints, settings, time and the impulses of a warm start. Throws py::buffer_error while
  /// arrays of the bodies' numbers exist.
  void restore(const PythonWorld& saved);

  /// Returns the state as bytes, and continues from such bytes. Throws std::invalid_argument for bytes of another world.
  std::string bytes();
  void continue_from(const std::string& bytes);
  void state(StateStream& s) { s(world_, check_, warned_, last_h_, reason_); }

  Views views = {};
  py::object given = py::none();  ///< the arguments of the constructor, by name

 private:
  /// The clock is read after so many steps, so that it does not slow fast steps.
  static constexpr std::int64_t most_between_looks = 1024;
  static constexpr std::chrono::milliseconds patience{50};

  void step_unlocked(double h, std::int64_t steps);
  void warn();

  World<Dof> world_;
  RunCheck<Dof> check_;
  bool checked_;
  bool busy_ = false;
  std::thread::id stepping_ = {};  // the thread that takes the step
  bool warned_ = false;
  double last_h_ = 1;
  std::string reason_;  // of a world that is no longer finite
};

}  // namespace spook
