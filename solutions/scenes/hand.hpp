#pragma once
// What a hand does to a scene while it runs: it pulls at a body by a soft point joint, pushes it, drops another ball.
#include <optional>
#include <vector>

#include "engine/world/world.hpp"

namespace spook {

class Hand {
 public:
  virtual ~Hand() = default;

  /// Holds a body's point, in its own axes [m], to a place [m]; from one pull to the next the place follows. True for a
  /// new grip: there is another joint then.
  /// Throws std::invalid_argument for a static body, or an index that is no body's.
  virtual bool pull(int body, const Vec3& point, const Vec3& to) = 0;

  /// True if there was something to let go.
  virtual bool let_go() = 0;

  /// [N s], through the centre.
  virtual void apply_central_impulse(int body, const Vec3& impulse) = 0;

  /// Another ball, at rest [m, m, kg]. Throws std::invalid_argument for a radius or a mass that is not positive.
  virtual void drop(const Vec3& x, double radius, double mass) = 0;
};

/// The hand in a world of which a scene has built the bodies and joints.
template <int Dof>
class HandIn final : public Hand {
 public:
  explicit HandIn(World<Dof>& world) : world_(world) {}

  bool pull(int body, const Vec3& point, const Vec3& to) override;
  bool let_go() override;
  void apply_central_impulse(int body, const Vec3& impulse) override;
  void drop(const Vec3& x, double radius, double mass) override;

  /// The body that it holds on to, once it has held something.
  std::optional<int> anchor() const { return anchor_; }

  /// Adds what the other hand has dropped, and holds what it holds. False where the other's scene has other bodies.
  bool take_over(const HandIn& other);

 private:
  /// Bodies that came later than the scene: a ball, or what the hand holds on to.
  struct Later {
    int body;
    double radius = 0, mass = 0;  // 0: the hand's
  };
  struct Grip {
    int body;
    Vec3 point;
    int joint;
  };

  int scene_bodies() const { return static_cast<int>(world_.bodies().size() - later_.size()); }

  World<Dof>& world_;
  std::vector<Later> later_;
  std::optional<int> anchor_;  // a fixed body, from the first pull on
  std::optional<Grip> grip_;
};

}  // namespace spook
