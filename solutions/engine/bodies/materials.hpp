#pragma once
// What two bodies are to each other where they touch.
//
//   of a pair    as it was given for the two; else from what was given for each of them, and from the world's settings
//                for what was not
//   friction     √(μ_i μ_j): without friction on either side there is none
//   restitution  the larger
//   k, d         the softer k, the larger d
#include <cmath>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace spook {

/// Of a body, or of a pair; what is not given is the world's.
struct Material {
  std::optional<double> friction = {};     ///< μ
  std::optional<double> restitution = {};  ///< e, 0 to 1
  std::optional<double> k = {};            ///< [N/m]
  std::optional<double> d = {};            ///< [steps]
};

/// All of it.
struct PairMaterial {
  double friction, restitution, k, d;
};

class Materials {
 public:
  explicit Materials(const PairMaterial& world) : world_(world) {}

  /// Throws std::invalid_argument, naming the number, unless μ >= 0, 0 <= e <= 1, k > 0 and d >= 0.
  void set(int body, const Material& material);
  void set(int i, int j, const Material& material);

  /// Forgets a body; those after it move up by one.
  void remove(int body);

  /// The k of pairs of which nothing else was said [N/m].
  void set_stiffness(double k) { world_.k = k; }
  double stiffness() const { return world_.k; }

  PairMaterial of(int i, int j) const;

  /// Whether anything was said of a body, or of a pair.
  bool any() const { return !bodies_.empty() || !pairs_.empty(); }

  /// Whether anything rubs on anything, or may bounce.
  bool rub() const { return rub_; }
  bool bounce() const { return bounce_; }

 private:
  void look_at(const Material& material);
  PairMaterial of_body(int body) const;

  PairMaterial world_;
  std::vector<Material> bodies_;
  std::map<std::pair<int, int>, Material> pairs_;
  bool rub_ = world_.friction > 0, bounce_ = false;
};

}  // namespace spook
