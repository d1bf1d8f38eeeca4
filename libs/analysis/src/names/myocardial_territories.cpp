#include "ostia/analysis/myocardial_territories.h"

#include "ostia/analysis/graph_measures.h"
#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/core/text.h"
#include "ostia/geometry/kd_tree.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace ostia::analysis {
namespace {

using geometry::Vec3;

constexpr double farthest_mm = 30.0;    // of the nearest artery from the muscle
constexpr double longest_drift = 0.02;  // of a way along smooth axes against chords

void require_territory(double value, double low, double high, const char* name, const char* range) {
  if (!(value >= low && value <= high))
    throw InvalidInput(std::string("territories: ") + name + " is " + core::rounded_text(value, 3) +
                       "; it has to be in " + range);
}

std::vector<TerritoryPlace> places_along(const geometry::VesselTree& tree, double step_mm) {
  std::vector<TerritoryPlace> places;
  for (const geometry::TreeSegment& segment : tree.segments) {
    const geometry::Centerline line = geometry::resample(segment.axis, step_mm);
    for (std::size_t i = 0; i < line.size(); ++i)
      places.push_back({segment.id, line.abscissa[i], line.points[i], 0.0});
  }
  return places;
}

/// The vessel that a segment is of: the first that has it.
std::map<std::int32_t, std::size_t> owners_of(const geometry::VesselTree& tree) {
  std::map<std::int32_t, std::size_t> owners;
  for (std::size_t v = 0; v < tree.vessels.size(); ++v)
    for (const std::int32_t segment : tree.vessels[v].segments) owners.try_emplace(segment, v);
  return owners;
}

double lumen_of(const geometry::VesselTree& tree) {
  double sum = 0.0;
  for (const geometry::TreeSegment& segment : tree.segments) {
    const geometry::Centerline& axis = segment.axis;
    if (axis.radius.size() != axis.size()) continue;
    for (std::size_t i = 1; i < axis.size(); ++i)
      sum += measure_cone((axis.points[i] - axis.points[i - 1]).norm(), axis.radius[i - 1], axis.radius[i])
                 .volume_mm3;
  }
  return sum;
}

void check_territories(const geometry::VesselTree& tree, const imaging::MaskVolume& myocardium) {
  if (const auto fault = geometry::find_fault(tree)) throw InvalidInput("territories: " + *fault);
  if (tree.segments.empty()) throw InvalidInput("territories: the tree has no vessels");
  if (tree.vessels.size() > 255)
    throw InvalidInput("territories: the tree has " + std::to_string(tree.vessels.size()) +
                       " vessels; at most 255 can be told apart");
  if (std::none_of(myocardium.voxels.begin(), myocardium.voxels.end(), [](std::uint8_t v) { return v != 0; }))
    throw InvalidInput("territories: the mask of the myocardium is empty");
}

/// The nearest place of each voxel of a slice, -1 outside the mask.
void nearest_in_slice(const imaging::MaskVolume& mask, const geometry::KdTree& arteries, std::int64_t k,
                      std::vector<std::int32_t>& nearest) {
  for (std::int64_t j = 0; j < mask.geometry.size[1]; ++j)
    for (std::int64_t i = 0; i < mask.geometry.size[0]; ++i) {
      if (mask(i, j, k) == 0) continue;
      const Vec3 at(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k));
      nearest[static_cast<std::size_t>(mask.geometry.offset(i, j, k))] =
          arteries.nearest(mask.geometry.world(at));
    }
}

void require_near(const imaging::MaskVolume& mask, const std::vector<TerritoryPlace>& places,
                  const std::vector<std::int32_t>& nearest) {
  double least = 1e300;
  const imaging::Geometry& grid = mask.geometry;
  for (std::size_t n = 0; n < nearest.size(); ++n) {
    if (nearest[n] < 0) continue;
    const auto at = static_cast<std::int64_t>(n);
    const Vec3 voxel(static_cast<double>(at % grid.size[0]),
                     static_cast<double>(at / grid.size[0] % grid.size[1]),
                     static_cast<double>(at / (grid.size[0] * grid.size[1])));
    const Vec3 away = grid.world(voxel) - places[static_cast<std::size_t>(nearest[n])].place;
    least = std::min(least, away.squaredNorm());
  }
  if (least > farthest_mm * farthest_mm)
    throw InvalidInput("territories: no artery comes nearer than " + core::rounded_text(std::sqrt(least), 0) +
                       " mm to the myocardium; the mask is of another patient or in another frame");
}

}  // namespace

void validate(const TerritoryOptions& o) {
  require_territory(o.density_g_ml, 0.9, 1.2, "density_g_ml", "[0.9, 1.2] g/ml");
  require_territory(o.step_mm, 0.1, 5.0, "step_mm", "[0.1, 5] mm");
}

MyocardialTerritories myocardial_territories(const geometry::VesselTree& tree,
                                             const imaging::MaskVolume& myocardium,
                                             const TerritoryOptions& options, const core::TaskContext& task) {
  validate(options);
  check_territories(tree, myocardium);
  task.set_stage("territories");
  MyocardialTerritories out;
  out.options = options;
  out.places = places_along(tree, options.step_mm);
  out.lumen_mm3 = lumen_of(tree);
  std::vector<Vec3> points;
  for (const TerritoryPlace& place : out.places) points.push_back(place.place);
  const geometry::KdTree arteries(std::move(points));
  std::vector<std::int32_t> nearest(myocardium.voxels.size(), -1);
  core::parallel_for(static_cast<std::size_t>(myocardium.geometry.size[2]), 1, [&](std::size_t k) {
    task.throw_if_cancelled();
    nearest_in_slice(myocardium, arteries, static_cast<std::int64_t>(k), nearest);
  });
  require_near(myocardium, out.places, nearest);
  const double voxel_g = myocardium.geometry.spacing.prod() / 1000.0 * options.density_g_ml;
  std::vector<std::int64_t> voxels(out.places.size(), 0);
  for (const std::int32_t place : nearest)
    if (place >= 0) ++voxels[static_cast<std::size_t>(place)];
  const std::map<std::int32_t, std::size_t> owners = owners_of(tree);
  for (const geometry::Vessel& vessel : tree.vessels)
    out.vessels.push_back({vessel.id, vessel.name, 0.0, 0.0});
  for (std::size_t n = 0; n < voxels.size(); ++n) {
    out.places[n].mass_g = static_cast<double>(voxels[n]) * voxel_g;
    out.mass_g += out.places[n].mass_g;
    if (const auto owner = owners.find(out.places[n].segment); owner != owners.end())
      out.vessels[owner->second].mass_g += out.places[n].mass_g;
  }
  for (VesselTerritory& vessel : out.vessels) vessel.share = vessel.mass_g / out.mass_g;
  out.labels = {myocardium.geometry, std::vector<std::uint8_t>(myocardium.voxels.size(), 0)};
  for (std::size_t n = 0; n < nearest.size(); ++n) {
    if (nearest[n] < 0) continue;
    const auto owner = owners.find(out.places[static_cast<std::size_t>(nearest[n])].segment);
    if (owner != owners.end()) out.labels.voxels[n] = static_cast<std::uint8_t>(owner->second + 1);
  }
  return out;
}

double mass_behind_g(const MyocardialTerritories& territories, const geometry::VesselTree& tree,
                     std::int32_t vessel, double s_mm) {
  const auto found = std::find_if(tree.vessels.begin(), tree.vessels.end(),
                                  [&](const geometry::Vessel& one) { return one.id == vessel; });
  if (found == tree.vessels.end())
    throw InvalidInput("territories: there is no vessel " + std::to_string(vessel));
  // The segment that the place is in, and how far along. A vessel's smooth axis is a little longer than its
  // segments' chords.
  double left = s_mm;
  const geometry::TreeSegment* at = nullptr;
  for (const std::int32_t id : found->segments) {
    at = &geometry::segment(tree, id);
    if (left <= at->axis.abscissa.back() + 1e-6) break;
    left -= at->axis.abscissa.back();
  }
  if (at == nullptr || !(s_mm >= 0.0) || left > at->axis.abscissa.back() + 1e-6 + longest_drift * s_mm)
    throw InvalidInput("territories: " + found->name + " has no place at " + core::rounded_text(s_mm, 1) +
                       " mm");
  std::set<std::int32_t> nodes{at->to}, behind;
  for (bool more = true; more;) {
    more = false;
    for (const geometry::TreeSegment& segment : tree.segments)
      if (segment.id != at->id && nodes.contains(segment.from) && behind.insert(segment.id).second) {
        nodes.insert(segment.to);
        more = true;
      }
  }
  double mass = 0.0;
  for (const TerritoryPlace& place : territories.places)
    if (behind.contains(place.segment) || (place.segment == at->id && place.along_mm >= left))
      mass += place.mass_g;
  return mass;
}

}  // namespace ostia::analysis
