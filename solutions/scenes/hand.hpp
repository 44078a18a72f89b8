#pragma once
// Interaction with a running scene: pulling a body by a soft ball joint, pushing it, dropping a ball.
#include <optional>
#include <vector>

#include "engine/world/world.hpp"

namespace spook {

class Hand {
 public:
  virtual ~Hand() = default;

  /// Pulls a point of a body, in its own axes [m], to a place [m]; the place may differ from call to call. Returns true
  /// if the grip is new: then there is a new joint. Throws std::invalid_argument for a static body and for an index out
  /// of range.
  virtual bool pull(int body, const Vec3& point, const Vec3& to) = 0;

  /// Ends the pull; returns false if there was none.
  virtual bool let_go() = 0;

  /// Applies an impulse at the centre of mass [N s].
  virtual void apply_central_impulse(int body, const Vec3& impulse) = 0;

  /// Adds a ball at rest [m, m, kg]. Throws std::invalid_argument for a radius or a mass that is not positive.
  virtual void drop(const Vec3& x, double radius, double mass) = 0;
};

/// The hand in a world whose bodies and joints a scene has built.
template <int Dof>
class HandIn final : public Hand {
 public:
  explicit HandIn(World<Dof>& world) : world_(world) {}

  bool pull(int body, const Vec3& point, const Vec3& to) override;
  bool let_go() override;
  void apply_central_impulse(int body, const Vec3& impulse) override;
  void drop(const Vec3& x, double radius, double mass) override;

  /// The static body to which the joint is attached; none before the first pull.
  std::optional<int> anchor() const { return anchor_; }

  /// Adds the balls that the other hand has dropped, and grips what it grips. Returns false if the other scene has
  /// other bodies.
  bool take_over(const HandIn& other);

 private:
  /// A body added after the scene's own: a dropped ball, or the static body to which the joint is attached.
  struct Later {
    int body;
    double radius = 0, mass = 0;  // 0: the static body of the joint
  };
  struct Grip {
    int body;
    Vec3 point;
    int joint;
  };

  int scene_bodies() const { return static_cast<int>(world_.bodies().size() - later_.size()); }

  World<Dof>& world_;
  std::vector<Later> later_;
  std::optional<int> anchor_;  // a static body, from the first pull on
  std::optional<Grip> grip_;
};

}  // namespace spook
