#pragma once
// A world as Python has it: with forces that are set, arrays that look at it, and a verdict on its steps.
#include <memory>

#include "engine/diagnostics/run_check.hpp"
#include "views.hpp"

namespace spook {

/// What Python puts on each body; a world without any has none of it. The world's copy has a copy.
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

 private:
  std::shared_ptr<std::vector<Twist<Dof>>> loads_;
};

template <int Dof>
class PythonWorld {
 public:
  PythonWorld(World<Dof> made, bool checked) : world_(std::move(made)), checked_(checked) {}
  PythonWorld(const PythonWorld& other)
      : world_(other.world()),
        check_(other.check_),
        checked_(other.checked_),
        warned_(other.warned_),
        reason_(other.reason_) {}

  /// Throws std::runtime_error while another thread steps.
  World<Dof>& world() { return const_cast<World<Dof>&>(std::as_const(*this).world()); }
  const World<Dof>& world() const {
    if (busy_) throw std::runtime_error("the world is taking a step in another thread");
    return world_;
  }
  /// The same, to add or remove bodies. Throws py::buffer_error while there are arrays that look at them.
  World<Dof>& bodies_of(const char* what) {
    views.require_none(what);
    return moved();
  }
  /// The same, to move bodies from outside.
  World<Dof>& moved() {
    check_.bodies_were_moved();
    return world();
  }

  /// Takes steps, without Python's lock but for a look at Ctrl-C. Throws what World::step throws, and a Python error.
  void step(double h, std::int64_t steps);

  State state() const { return reason_.empty() ? check_.verdict().state : State::lost; }
  const std::string& reason() const { return reason_.empty() ? check_.verdict().reason : reason_; }
  const std::string& note() const { return check_.verdict().note; }

  /// Throws std::invalid_argument for what is not finite, and for a body that does not move.
  void put_load(int body, const Twist<Dof>& load);
  void remove_body(int body);
  /// Goes back to `saved`: bodies, joints, settings, time and the impulses of a warm start. Throws py::buffer_error while
  /// there are arrays that look at the bodies.
  void restore(const PythonWorld& saved);

  Views views = {};

 private:
  /// The clock is asked after so many steps, so that a fast step pays nothing for it.
  static constexpr std::int64_t most_between_looks = 1024;
  static constexpr std::chrono::milliseconds patience{50};

  void step_unlocked(double h, std::int64_t steps);
  void warn();

  World<Dof> world_;
  RunCheck<Dof> check_;
  bool checked_;
  bool busy_ = false;
  bool warned_ = false;
  std::string reason_;  // of a world that is no longer finite
};

}  // namespace spook
