#pragma once
/// \file What edits of axes and branches share: a tree being changed, and samples that follow it.

#include "wall/sampling.h"

#include "ostia/lumen/edit.h"

#include <functional>
#include <map>
#include <set>

namespace ostia::lumen {

/// Farther from the tree than this, a click meant something else.
inline constexpr double farthest_from_axis_mm = 10.0;

/// A place on a vessel's way in its tree: on a segment, between two of its control points.
struct TreePlace {
  std::size_t segment = 0;  ///< index in the vessel's list
  double s_mm = 0.0;        ///< on the vessel's axis
  double along_mm = 0.0;    ///< from the segment's first point, by its own abscissas
  double off_mm = 0.0;      ///< distance of the place asked for
  bool past_end = false;
};

/// A vessel's axis' old abscissas to the new ones, by following the axis' places to where they went.
class AbscissaMap {
 public:
  /// `went` gives where a place of the old axis now lies; `from_mm` begins at `to_mm` on the new axis.
  AbscissaMap(const AxisCurve& before, const AxisCurve& after, const std::function<Vec3(double)>& went,
              double from_mm, double to_mm);
  double operator()(double s_mm) const;

 private:
  double from_ = 0.0, step_ = 1.0;
  std::vector<double> values_;
};

/// The abscissa of a place near a guess: of all its feet the one that continues where it was.
double refound(const AxisCurve& axis, const Vec3& place, double guess_mm, double reach_mm);

/// The wall near an abscissa as r(theta): the mean and two harmonics of the samples there. `fallback_mm`
/// where there are none.
struct LocalWall {
  double mean_mm = 1.0;
  std::vector<double> harmonics{0.0, 0.0, 0.0, 0.0};
  double at(double theta) const;
};
LocalWall local_wall(const AxisCurve& axis, const std::vector<SurfaceSample>& samples, double s_mm,
                     double window_mm, double fallback_mm);

/// Throws InvalidInput for a name that is blank, has control characters, or is in use by another vessel than
/// `self`; `what` names the edit.
void check_name(const LumenModel& model, const std::string& name, std::int32_t self, const std::string& what);

/// An edit in progress.
class TreeEdit {
 public:
  TreeEdit(const LumenModel& before, const std::string& op, std::int32_t vessel);
  TreeEdit(const LumenModel& before, const std::string& op);  ///< of no vessel that is there

  const std::string& what() const { return what_; }  ///< "axis.move on vessel 4 (LAD)"
  const LumenModel& before() const { return *before_; }
  geometry::VesselTree& tree() { return after_.tree; }
  geometry::TreeSegment& segment(std::int32_t id);  ///< of the tree as it now is
  geometry::Vessel& vessel(std::int32_t id);
  geometry::TreeNode& node(std::int32_t id);
  std::int32_t new_tree_id() { return after_.next_tree_id++; }
  std::int64_t new_sample_id() { return after_.next_sample_id++; }
  std::string names_of(const std::set<std::int32_t>& vessels);  ///< "D1, D2"
  std::vector<std::string> notes;

  /// The segment's points have changed: abscissas and frames are made anew, and all vessels through it.
  void axis_changed(std::int32_t segment);
  /// The vessel's way has changed.
  void way_changed(std::int32_t vessel) { rebuilt_.insert(vessel); }
  /// The vessel's samples are made from these, not from what it had: a new vessel that was part of another,
  /// or one that took up another. Its way has changed.
  void made_from(std::int32_t vessel, std::shared_ptr<const VesselLumen> source) {
    rebuilt_.insert(vessel);
    sources_[vessel] = std::move(source);
  }
  /// A new vessel starts with this wall, not as a tube.
  void start_with(std::int32_t vessel, NewWall wall) { walls_[vessel] = std::move(wall); }
  /// What no vessel passes any more goes with `finish`.
  void drop(const std::set<std::int32_t>& vessels);
  /// Vessels that pass through any of these segments.
  std::set<std::int32_t> through(const std::vector<std::int32_t>& segments) const;
  /// Segments of which the vessel is the owner.
  std::vector<std::int32_t> own_segments(std::int32_t vessel) const;

  /// Where a place is on a vessel's way; throws InvalidInput where it is too far from the axis.
  TreePlace locate(std::int32_t vessel, const Vec3& place) const;
  TreePlace locate(std::int32_t vessel, double s_mm) const;
  /// Makes a node at a place of a vessel, or takes the one that is there: the segment is split, its proximal
  /// part keeps its id. A control point near the place is the node.
  std::int32_t split(std::int32_t vessel, const TreePlace& place);

  /// The samples of a vessel after the edit; its axis and own_from_mm are the new ones already.
  using Samples =
      std::function<std::vector<SurfaceSample>(const VesselLumen& before, const VesselLumen& after)>;
  /// The outcome; `samples` is asked for each vessel that was there and whose way has changed, and for each
  /// that is made from another. Other new vessels start as tubes. Throws InvalidInput where the tree or an
  /// axis would have a fault.
  EditOutcome finish(const Samples& samples) &&;

 private:
  const LumenModel* before_;
  LumenModel after_;
  std::string what_;
  std::set<std::int32_t> rebuilt_;
  std::map<std::int32_t, std::shared_ptr<const VesselLumen>> sources_;
  std::map<std::int32_t, NewWall> walls_;
  void prune();
  std::shared_ptr<const VesselLumen> built(const geometry::Vessel& vessel, const VesselLumen* old,
                                           const Samples& samples);
};

/// A stretch of new wall. Only what stands free of the samples that are there is added.
struct NewStretch {
  RadialWall wall;
  double from_mm = 0.0, to_mm = 0.0;
  bool cap_before = false, cap_beyond = false;
};
void grow(TreeEdit& edit, const VesselLumen& lumen, const NewStretch& stretch,
          std::vector<SurfaceSample>& samples);

/// Throws InvalidInput for a new vessel's points and radii (two points at least, one radius a point, none too
/// small or large) or a wall that is none; `what` names the edit.
void check_new_vessel(const std::vector<Vec3>& points, const std::vector<double>& radius_mm,
                      const NewWall& wall, const std::string& what);

/// Samples as they were, with their abscissas found on the new axis.
std::vector<SurfaceSample> standing_samples(const VesselLumen& before, const VesselLumen& after);
/// The same where the new axis begins at `from_mm` of the old one.
std::vector<SurfaceSample> standing_samples_from(const VesselLumen& before, const VesselLumen& after,
                                                 double from_mm);

}  // namespace ostia::lumen
