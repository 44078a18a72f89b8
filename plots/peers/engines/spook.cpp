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

}  // namespace

std::unique_ptr<Engine> make_spook(std::unique_ptr<Scene> scene) {
  return std::make_unique<Spook>(std::move(scene));
}

}  // namespace spook::peers
