#pragma once
/// \file The trees of two scans of one patient, brought together (docs/methods/compare.md).

#include "ostia/geometry/rigid_fit.h"
#include "ostia/geometry/vessel_tree.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace ostia::analysis {

using geometry::Vec3;

/// Where a place of the former scan lies in the later one, mm.
using PointMap = std::function<Vec3(const Vec3& before)>;

/// A place that both trees name: an ostium, or where a vessel leaves another one.
struct TreeLandmark {
  std::string name;  ///< "RCA, ostium", "D1 leaves LAD"
  Vec3 before = Vec3::Zero(), after = Vec3::Zero();
};

/// How the trees lie to each other when each is taken as rigid.
struct TreeFit {
  geometry::RigidFit motion;  ///< from the former to the later
  std::size_t vessels = 0;    ///< with a name that both have
  double axes_mm = 0.0;       ///< mean distance of their axes, where both run
  double mirrored_mm = 0.0;   ///< the same with the former tree mirrored
  /// Of vessels whose names both trees have; a name that is only a number ("V3") says nothing.
  std::vector<TreeLandmark> landmarks;
  std::vector<double> landmark_residuals_mm{};  ///< of each, carried
};
/// Begins with places at equal lengths along vessels of the same name, then lays axes on axes by their
/// distances across (Gauss and Newton), without what is far off. Throws InvalidInput where no vessel has the
/// same name in both.
TreeFit fit_trees(const geometry::VesselTree& before, const geometry::VesselTree& after);

struct TreeMatchOptions {
  double reach_mm = 4.0;         ///< as far apart the axes of one vessel may be, [0.5, 30]
  double named_reach_mm = 12.0;  ///< where the names are the same, [0.5, 50]
  double least_share = 0.4;      ///< of the shorter of the two that runs beside the other, [0.05, 1]
  double step_mm = 0.5;          ///< of places along the axes, [0.1, 5]
  /// Each axis is laid on its partner by a rigid motion of its own before places are paired: takes away what
  /// the map leaves, most of it where the map is rigid and the heart is not.
  bool lay_axes = true;
};
void validate(const TreeMatchOptions& options);  ///< throws InvalidInput

/// The same place of a vessel in both scans; abscissas from the root.
struct MatchedPlace {
  double before_mm = 0.0, after_mm = 0.0;
};
struct VesselMatch {
  std::int32_t before = 0, after = 0;  ///< ids of the vessels
  bool by_name = false;                ///< both have the same name
  double distance_mm = 0.0;            ///< mean, of the carried axis where both run
  double shared_mm = 0.0;              ///< length of that, of the vessels' own parts
  std::vector<MatchedPlace> places;    ///< ascending in both, two at least

  /// Linear between places; nothing beyond them.
  std::optional<double> to_after(double before_mm) const;
  std::optional<double> to_before(double after_mm) const;
};
struct TreeMatch {
  std::vector<VesselMatch> vessels;                     ///< each vessel once at most, in the former's order
  std::vector<std::int32_t> before_alone, after_alone;  ///< vessels without a partner
  double shared_share = 0.0;  ///< of the shorter tree's length that runs beside the other
  const VesselMatch* of_before(std::int32_t vessel) const;
  const VesselMatch* of_after(std::int32_t vessel) const;
};
/// Vessels whose own parts run beside each other, those nearest to each other first; the same name counts
/// for 3 mm. Throws InvalidInput for bad options or a map that gives what is not finite.
TreeMatch match_trees(const geometry::VesselTree& before, const geometry::VesselTree& after,
                      const PointMap& map, const TreeMatchOptions& options = {});

struct SamePatientBounds {
  double axes_mm = 5.0;       ///< TreeFit::axes_mm is no more
  double landmarks_mm = 8.0;  ///< nor the median of TreeFit::landmark_residuals_mm, of three or more
  double shared_share = 0.5;  ///< TreeMatch::shared_share is no less
};
/// Why the trees are hardly of one patient, a sentence; empty where nothing speaks against it.
std::string why_another_patient(const TreeFit& fit, const TreeMatch& match,
                                const SamePatientBounds& bounds = {});

}  // namespace ostia::analysis
