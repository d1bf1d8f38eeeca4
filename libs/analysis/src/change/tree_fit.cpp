#include "change/axis_laying.h"
#include "change/paired_vessels.h"

#include "ostia/analysis/aha_segments.h"
#include "ostia/analysis/tree_match.h"
#include "ostia/core/error.h"
#include "ostia/lumen/lumen_model.h"

#include <algorithm>
#include <cctype>
#include <set>

namespace ostia::analysis {
namespace {

using geometry::AxisCurve;
using geometry::RigidFit;
using geometry::Vessel;
using geometry::VesselTree;

constexpr double start_step_mm = 5.0, laid_step_mm = 1.0;

/// "V3", "vessel_3", "3", and no name at all: what programs call a vessel of which they know nothing.
bool is_number(const std::string& name) {
  std::string letters;
  for (const char c : name)
    if (std::isalpha(static_cast<unsigned char>(c)) != 0)
      letters += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    else if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '_' && c != ' ')
      return false;
  return letters.empty() || letters == "v" || letters == "vessel";
}

/// Where a vessel's own part begins, and whose way it leaves there.
struct Beginning {
  Vec3 place;
  std::string from;  ///< empty: an ostium
};

Beginning beginning_of(const VesselTree& tree, std::size_t index, const AxisCurve& axis) {
  const Vessel& vessel = tree.vessels[index];
  const double own = lumen::own_from_mm(tree, vessel.id);
  if (!(own > 0.0)) return {axis.point(0.0), {}};
  const std::int32_t parent = lumen::owner_at(tree, vessel.id, 0.999 * own);
  for (const Vessel& one : tree.vessels)
    if (one.id == parent) return {axis.point(own), telling_name(one)};
  return {axis.point(own), {}};
}

std::vector<TreeLandmark> landmarks_of(const std::vector<std::pair<std::size_t, std::size_t>>& pairs,
                                       const VesselTree& before, const std::vector<AxisCurve>& b_axes,
                                       const VesselTree& after, const std::vector<AxisCurve>& a_axes) {
  std::vector<TreeLandmark> landmarks;
  for (const auto& [b, a] : pairs) {
    const Beginning was = beginning_of(before, b, b_axes[b]), is = beginning_of(after, a, a_axes[a]);
    const std::string name = telling_name(before.vessels[b]);
    if (was.from == is.from)
      landmarks.push_back(
          {was.from.empty() ? name + ", ostium" : name + " leaves " + was.from, was.place, is.place});
  }
  return landmarks;
}

Vec3 mirrored(const Vec3& place) {
  return {-place.x(), place.y(), place.z()};
}

/// Points of the named vessels' whole ways, those of a way that several share once for each.
struct NamedWays {
  std::vector<Vec3> from, to;  ///< at equal lengths
  std::vector<PlacesOnAxis> places;
};

NamedWays named_ways(const std::vector<std::pair<std::size_t, std::size_t>>& pairs,
                     const std::vector<AxisCurve>& before, const std::vector<AxisCurve>& after, bool mirror) {
  const auto seen = [&](const Vec3& place) { return mirror ? mirrored(place) : place; };
  NamedWays ways;
  for (const auto& [b, a] : pairs) {
    const double both = std::min(before[b].length(), after[a].length());
    for (double s = 0.0; s <= both; s += start_step_mm) {
      ways.from.push_back(seen(before[b].point(s)));
      ways.to.push_back(after[a].point(s));
    }
    PlacesOnAxis one{{}, &after[a]};
    for (double s = 0.0; s <= before[b].length(); s += laid_step_mm)
      one.places.push_back(seen(before[b].point(s)));
    ways.places.push_back(std::move(one));
  }
  return ways;
}

LaidPlaces laid(const NamedWays& ways) {
  return lay_on_axes(ways.places, geometry::rigid_fit(ways.from, ways.to));
}

}  // namespace

std::string telling_name(const Vessel& vessel) {
  const std::string usual = usual_name(vessel.name);
  return !usual.empty() ? usual : is_number(vessel.name) ? std::string() : vessel.name;
}

std::vector<std::pair<std::size_t, std::size_t>> pairs_by_name(const VesselTree& before,
                                                               const VesselTree& after) {
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  std::set<std::string> taken;
  for (std::size_t b = 0; b < before.vessels.size(); ++b) {
    const std::string name = telling_name(before.vessels[b]);
    if (name.empty() || !taken.insert(name).second) continue;
    const auto found = std::find_if(after.vessels.begin(), after.vessels.end(),
                                    [&](const Vessel& one) { return telling_name(one) == name; });
    if (found != after.vessels.end())
      pairs.emplace_back(b, static_cast<std::size_t>(found - after.vessels.begin()));
  }
  return pairs;
}

std::vector<AxisCurve> axes_of(const VesselTree& tree) {
  std::vector<AxisCurve> axes;
  for (const Vessel& vessel : tree.vessels) axes.emplace_back(geometry::vessel_axis(tree, vessel));
  return axes;
}

TreeFit fit_trees(const VesselTree& before, const VesselTree& after) {
  const auto pairs = pairs_by_name(before, after);
  if (pairs.empty())
    throw InvalidInput(
        "no vessel has the same name in both trees, so that nothing says how they lie to each other; name "
        "the vessels (RCA, LAD, LCX, ...) in both");
  const std::vector<AxisCurve> b_axes = axes_of(before), a_axes = axes_of(after);
  const LaidPlaces as_is = laid(named_ways(pairs, b_axes, a_axes, false));
  const LaidPlaces mirror = laid(named_ways(pairs, b_axes, a_axes, true));
  TreeFit fit;
  fit.motion = as_is.motion;
  fit.vessels = pairs.size();
  fit.axes_mm = as_is.mean_mm;
  fit.mirrored_mm = mirror.mean_mm;
  fit.landmarks = landmarks_of(pairs, before, b_axes, after, a_axes);
  for (const TreeLandmark& one : fit.landmarks)
    fit.landmark_residuals_mm.push_back((fit.motion(one.before) - one.after).norm());
  return fit;
}

}  // namespace ostia::analysis
