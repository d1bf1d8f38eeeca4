#pragma once
/// \file One tissue of the body as an implicit shape.

#include "ostia/geometry/vec.h"
#include "ostia/phantom/scene.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace ostia::phantom {

using geometry::Vec3;

/// Smooth random variation of a tissue's CT number.
struct Texture {
  float amplitude_hu = 0.0f;  ///< standard deviation
  float grain_mm = 5.0f;
  float dorsal_hu_per_mm = 0.0f;  ///< rises towards the back (blood and water sink in a lying patient)
};

/// Negative inside; changes by no more than 1 a mm, so that its value in the middle of a block tells whether
/// the block can hold any of the tissue, or only it.
using Distance = std::function<double(const Vec3&)>;

/// A piece of a tube: what is nearer to its axis than the radius, which runs linearly between both ends.
struct Capsule {
  Vec3 from, to;
  double from_radius = 0.0, to_radius = 0.0;
  bool holds(const Vec3& p) const;
  geometry::Box3 box() const;
};
using Capsules = std::vector<Capsule>;

struct Organ {
  Material material;
  Texture texture;
  Distance distance;   ///< the shape, or none:
  Capsules capsules;   ///< tubes
  bool stays = false;  ///< where it is, although the heart is bent: it was made about the arteries
  /// CT number at a place, instead of the material's; or none. Only beside a texture.
  std::function<float(const Vec3&)> mixed_hu = {};
};

/// In order: a place belongs to the first organ that holds it.
using Organs = std::vector<Organ>;

/// |to_unit (p - centre)| < 1.
Distance ellipsoid(const Vec3& centre, const geometry::Mat3& to_unit);
Distance ellipsoid(const Vec3& centre, const Vec3& semi_axes);
/// An elliptic cylinder along z without end.
Distance column(double x, double y, double semi_x, double semi_y);
Distance half_space(const Vec3& point, const Vec3& outward);
Distance both(Distance a, Distance b);         ///< intersection
Distance either(std::vector<Distance> parts);  ///< union
Distance without(Distance a, Distance b);      ///< difference
Distance grown(Distance a, double by_mm);

/// A round tube along a smooth curve through control points, with radii at them.
Capsules tube(const std::vector<Vec3>& controls, const std::vector<double>& radii, double step_mm = 2.0);
Capsules grown(Capsules capsules, double by_mm);
void append(Capsules& to, const Capsules& more);

/// Smooth noise of deviation about 1, periodic over 64 grains: a table drawn from a seed.
class NoiseField {
 public:
  explicit NoiseField(std::uint64_t seed);
  double at(const Vec3& place_in_grains) const;

 private:
  std::vector<float> value_;
};

/// The shape with an uneven outline: in and out by about `amplitude_mm` over distances of `grain_mm`.
Distance uneven(Distance a, double amplitude_mm, double grain_mm, std::shared_ptr<const NoiseField> noise);

}  // namespace ostia::phantom
