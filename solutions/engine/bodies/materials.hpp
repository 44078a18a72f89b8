#pragma once
// The contact parameters of two bodies. A material that was set for the pair has priority. Otherwise the materials of
// the two bodies are combined, with the world's settings for missing numbers:
//
//   friction     √(μ_i μ_j): no friction if either body has none
//   restitution  the larger
//   k, d         the smaller k, the larger d
//   resistance   the larger, to rolling and to torsion
#include <cmath>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace spook {

/// The contact parameters of a body or of a pair of bodies. A missing number of a body is that of the world's settings;
/// of a pair, that of the materials of its two bodies.
struct Material {
  bool operator==(const Material&) const = default;

  std::optional<double> friction = {};     ///< μ
  std::optional<double> restitution = {};  ///< e, 0 to 1
  std::optional<double> k = {};            ///< [N/m]
  std::optional<double> d = {};            ///< [steps]
  /// The largest torque that resists rolling, and spinning about the normal, over the normal force [m]. Default: 0.
  std::optional<double> rolling_resistance = {}, torsional_resistance = {};
};

/// The contact parameters of a pair, complete.
struct PairMaterial {
  double friction, restitution, k, d;
  double rolling_resistance = 0, torsional_resistance = 0;  ///< [m]
};

class Materials {
 public:
  explicit Materials(const PairMaterial& world) : world_(world) {}

  /// Sets the material of a body or of a pair. Throws std::invalid_argument, naming the number, unless μ >= 0, 0 <= e
  /// <= 1, k > 0, d >= 0, and both resistances are >= 0.
  void set(int body, const Material& material);
  void set(int i, int j, const Material& material);

  /// Removes a body. The indices of later bodies decrease by one.
  void remove(int body);

  /// Sets and returns the k of pairs without a k of their own [N/m].
  void set_stiffness(double k) { world_.k = k; }
  double stiffness() const { return world_.k; }

  PairMaterial of(int i, int j) const;

  /// The materials that were set: by body, where bodies after the last may lack one; and by pair, the smaller index
  /// first.
  const std::vector<Material>& of_bodies() const { return bodies_; }
  const std::map<std::pair<int, int>, Material>& of_pairs() const { return pairs_; }

  /// Tells whether any body or pair has a material other than the default one.
  bool any() const { return set_ > 0 || !pairs_.empty(); }

  /// Tells whether any coefficient of friction is positive.
  bool rub() const { return rub_ > 0; }

  /// Tells whether any material has a restitution.
  bool bounce() const { return bounce_ > 0; }

  /// Tells whether any material resists rolling or torsion.
  bool resist() const { return resist_ > 0; }

 private:
  void count(const Material& material, int more);
  PairMaterial of_body(int body) const;

  PairMaterial world_;
  std::vector<Material> bodies_;
  std::map<std::pair<int, int>, Material> pairs_;
  // Numbers of materials: that set a number; with friction, that of the world included; with a restitution; with
  // resistance.
  int set_ = 0, rub_ = world_.friction > 0 ? 1 : 0, bounce_ = 0, resist_ = 0;
};

}  // namespace spook
