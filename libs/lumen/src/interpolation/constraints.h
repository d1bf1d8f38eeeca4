#pragma once
/// \file What a vessel's function must be at which places: values at samples, at offsets and within the
/// lumen.

#include "interpolation/point_grid.h"

#include "ostia/lumen/vessel_lumen.h"

#include <cstdint>
#include <unordered_map>
#include <vector>

namespace ostia::lumen {

/// f(place) = value.
struct Constraint {
  Vec3 place = Vec3::Zero();
  double value = 0.0;    ///< mm
  double s_mm = 0.0;     ///< of its sample, or of its station on the axis
  std::int64_t key = 0;  ///< 4 id + {0 on the wall, 1 outer offset, 2 inner offset}; < 0 within the lumen
};
bool constraint_order(const Constraint& a, const Constraint& b);  ///< by abscissa, then by key

/// The constraints of a vessel's samples. They are a function of the set of samples alone, and a local one,
/// so that after a change the same constraints stand as if all were made afresh:
/// - 0 at each sample; of samples nearer than 1e-6 mm to each other the one with the lowest id counts;
/// - +-l at p +- l n with l = min(lambda, r / 2), r the radius of the greatest ball that touches the wall at
/// p
///   on that side and has no sample in it: the offset's nearest sample is its own, and on both sides of a
///   narrow lumen offsets stay apart. Where l would be less than lambda / 5, it is left out;
/// - minus the distance to the wall, at most `interior_cap`, on a lattice about the axis, where its nearest
///   samples agree that it is inside and it keeps away from the inner offsets.
class ConstraintSet {
 public:
  explicit ConstraintSet(const VesselLumen& vessel);  ///< throws InvalidInput

  struct Difference {
    std::vector<Constraint> removed, added;  ///< in canonical order; no key with the same content in both
  };
  /// Throws InvalidInput for unknown or repeated ids and places that are not finite; then all is as before.
  Difference change(const std::vector<std::int64_t>& removed, const std::vector<SurfaceSample>& added);

  std::vector<Constraint> all() const;                                    ///< in canonical order
  const std::vector<SurfaceSample>& samples() const { return samples_; }  ///< in canonical order
  /// Refuses walls with a place that the centres cannot bridge: a sample whose neighbours within reach do not
  /// surround it. Of the samples near `places` alone if there are any. Throws InvalidInput.
  void check_for_holes(const std::vector<Vec3>& near = {}) const;

 private:
  struct Entry {  // of one sample
    SurfaceSample sample;
    std::vector<Constraint> made;
  };
  struct Station {  // a place of the axis with the lattice across it
    double s_mm = 0.0;
    Vec3 place = Vec3::Zero();
    geometry::Frame frame;
    double depends_mm = 0.0;  // no sample farther than this has a say
    std::vector<Constraint> made;
  };
  struct Depth {
    bool inside = false;
    double wall_mm = 0.0, searched_mm = 0.0;
  };

  std::vector<Constraint> offsets_of(const SurfaceSample& sample) const;
  double ball_radius(const SurfaceSample& sample, double side) const;
  Depth depth_at(const Vec3& place) const;
  void make_station(std::size_t index);
  void insert(const SurfaceSample& sample);
  void erase(std::int64_t id);
  bool surrounded(const Entry& entry) const;

  std::shared_ptr<const geometry::AxisCurve> axis_;
  InterpolationOptions options_;
  double lattice_mm_ = 1.0;
  PointGrid grid_;
  std::unordered_map<std::int64_t, std::int32_t> slot_;  // id -> entry
  std::vector<Entry> entries_;
  std::vector<std::int32_t> free_;
  std::vector<Station> stations_;
  std::vector<SurfaceSample> samples_;
};

}  // namespace ostia::lumen
