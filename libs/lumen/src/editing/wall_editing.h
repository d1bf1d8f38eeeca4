#pragma once
/// \file What the four edits of a wall share.

#include "editing/dismissal.h"

#include "ostia/lumen/edit.h"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace ostia::lumen {

/// No wall comes nearer to its axis than this.
inline constexpr double least_radius_mm = 0.1;
/// A place farther from the axis than this belongs to no coronary vessel.
inline constexpr double farthest_mm = 15.0;

/// A stretch of a vessel's way and the vessel whose samples make its wall.
struct OwnedStretch {
  std::int32_t owner = 0;
  double from_mm = 0.0, to_mm = 0.0;  ///< the first begins at -infinity, the last ends at +infinity
};
std::vector<OwnedStretch> owned_stretches(const LumenModel& model, std::int32_t vessel);

/// The given points: finite, at least so many, or InvalidInput ("what" names the edit).
void check_points(const std::vector<Vec3>& points, std::size_t least, const std::string& what);
/// "cpr.stroke on LAD" for messages.
std::string object_of(const LumenModel& model, std::int32_t vessel, const std::string& op);

/// Where places drawn one after another are along a vessel: of all orthogonal projections those that make one
/// continuous walk, so that no foot jumps in a bend tighter than the radius. A plane's angle, if there is
/// one, decides among walks alike. Throws InvalidInput naming the point.
std::vector<geometry::AxisFoot> feet_along(const AxisCurve& axis, const std::vector<Vec3>& places,
                                           const std::optional<double>& plane_theta, const std::string& what);

/// A vessel's own coordinates (s, rho cos theta, rho sin theta): there it is straight. Beyond an end the axis
/// runs straight on.
Vec3 straightened(const AxisCurve& axis, const Vec3& place, const geometry::AxisFoot& foot);
Vec3 bent(const AxisCurve& axis, const Vec3& coordinates);

/// The distance that samples of a vessel have of each other where its wall is `radius_mm` from the axis. It
/// follows from the vessel's support radius, which edits keep, so that no edit makes the next one denser.
double sample_spacing_mm(const VesselLumen& vessel, double radius_mm);

/// A sample as an edit sees it.
struct WallPlace {
  const SurfaceSample* sample = nullptr;
  double theta = 0.0, rho_mm = 0.0;
  double tilt = 0.0;   ///< of the normal within the cross-section, from radial towards growing theta
  double slope = 0.0;  ///< d rho / d s of the tangent plane
};
WallPlace wall_place(const AxisCurve& axis, const SurfaceSample& sample);
/// The samples of a vessel's wall (without caps) with a foot in [from, to], in canonical order.
std::vector<WallPlace> wall_places(const VesselLumen& vessel, double from_mm, double to_mm);
double angle_between(double theta, double from);  ///< theta - from in (-pi, pi]

/// The tilt within the cross-section of a wall newly drawn at (s, theta, rho): where drawn walls stand on
/// both sides of it, of a circle through the three; else of the wall that was there. `before`: all; `kept`:
/// what the edit leaves. Both of some stretch around s.
double tilt_at(const std::vector<WallPlace>& before, const std::vector<WallPlace>& kept, double s_mm,
               double theta, double rho_mm, double spacing_mm);

/// One vessel's samples while an edit works on them.
class WallChange {
 public:
  explicit WallChange(const VesselLumen& vessel) : vessel_(&vessel), gone_(vessel.samples.size(), false) {}
  const VesselLumen& vessel() const { return *vessel_; }
  void remove(std::size_t index) { gone_[index] = true; }
  void remove(const std::vector<std::size_t>& indices) {
    for (const std::size_t i : indices) gone_[i] = true;
  }
  bool removed(std::size_t index) const { return gone_[index]; }
  /// The id is given when the change is made.
  void add(const SurfaceSample& sample) { added_.push_back(sample); }
  const std::vector<SurfaceSample>& added() const { return added_; }
  std::vector<SurfaceSample> kept() const;
  /// Removes what stands so near to a new sample, on the same side of the lumen, that both would bend the
  /// wall between them.
  void remove_crowded(double share_of_spacing);

 private:
  const VesselLumen* vessel_;
  std::vector<bool> gone_;
  std::vector<SurfaceSample> added_;
};

/// The changes of an edit, by vessel.
class WallEdit {
 public:
  WallEdit(const LumenModel& model, std::int32_t vessel, const std::string& op);
  const LumenModel& model() const { return *model_; }
  const std::string& what() const { return what_; }
  const std::vector<OwnedStretch>& stretches() const { return stretches_; }
  const OwnedStretch& stretch_at(double s_mm) const;
  WallChange& of(std::int32_t owner);
  std::vector<std::string> notes;

  /// The model after it; ids in the order of adding. Throws InvalidInput where a new sample stands nearer to
  /// the axis than the least radius or faces it: the wall would be inside out.
  EditOutcome outcome() &&;

 private:
  const LumenModel* model_;
  std::string what_;
  std::vector<OwnedStretch> stretches_;
  std::map<std::int32_t, WallChange> changes_;
};

}  // namespace ostia::lumen
