// Our own engine behind the same interface.
#include "peers/engines/spook.hpp"

namespace spook::peers {

namespace {

class Spook : public Engine {
 public:
  explicit Spook(std::unique_ptr<Scene> scene) : scene_(std::move(scene)) {}
  void advance(std::int64_t steps) override { scene_->advance(steps); }
  Vec3 x(int body) const override {
    return scene_->points() ? scene_->points()->x(body) : scene_->rigid_bodies()->x(body);
  }
  Quat q(int body) const override {
    return scene_->points() ? Quat::Identity() : orientation(*scene_->rigid_bodies(), body);
  }

 private:
  std::unique_ptr<Scene> scene_;
};

class SpookWorld : public Engine {
 public:
  SpookWorld(World<6> world, double h) : world_(std::move(world)), h_(h) {}
  void advance(std::int64_t steps) override {
    for (std::int64_t n = 0; n < steps; ++n) world_.step(h_);
  }
  Vec3 x(int body) const override { return world_.x(body); }
  Quat q(int body) const override { return orientation(world_, body); }

 private:
  World<6> world_;
  double h_;
};

}  // namespace

std::unique_ptr<Engine> make_spook(std::unique_ptr<Scene> scene) {
  return std::make_unique<Spook>(std::move(scene));
}
std::unique_ptr<Engine> make_spook(World<6> world, double h) {
  return std::make_unique<SpookWorld>(std::move(world), h);
}

}  // namespace spook::peers
