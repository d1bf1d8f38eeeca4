#include "ostia/session/model_changes.h"

#include "case_file/same_bits.h"

#include <algorithm>
#include <cstring>
#include <unordered_map>

namespace ostia::session {
namespace {

using geometry::Vec3;
using lumen::LumenModel;
using lumen::SurfaceSample;
using lumen::VesselChange;
using lumen::VesselLumen;

bool same(const Vec3& a, const Vec3& b) {
  return std::memcmp(a.data(), b.data(), 3 * sizeof(double)) == 0;
}

template <class Items, class Same>
bool all_same(const Items& a, const Items& b, const Same& are_same) {
  return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(), are_same);
}

/// The vessel's way in its tree: which segments, and their axes.
bool same_way(const LumenModel& a, const LumenModel& b, std::size_t i, std::size_t k) {
  const geometry::Vessel &va = a.tree.vessels[i], &vb = b.tree.vessels[k];
  if (va.segments != vb.segments) return false;
  return std::all_of(va.segments.begin(), va.segments.end(), [&](std::int32_t id) {
    return session::same(geometry::segment(a.tree, id).axis, geometry::segment(b.tree, id).axis);
  });
}

VesselChange change_of(const VesselLumen& before, const VesselLumen& after) {
  VesselChange change;
  change.vessel = after.vessel;
  std::unordered_map<std::int64_t, const SurfaceSample*> old;
  old.reserve(before.samples.size());
  for (const SurfaceSample& sample : before.samples) old.emplace(sample.id, &sample);
  for (const SurfaceSample& sample : after.samples) {
    const auto found = old.find(sample.id);
    if (found != old.end() && session::same(*found->second, sample)) {
      old.erase(found);
      continue;
    }
    change.added.push_back(sample);
  }
  for (const auto& [id, sample] : old) change.removed.push_back(id);
  std::sort(change.removed.begin(), change.removed.end());
  return change;
}

VesselChange whole(const VesselLumen& lumen, bool gone) {
  VesselChange change;
  change.vessel = lumen.vessel;
  change.axis_changed = true;
  if (gone)
    for (const SurfaceSample& sample : lumen.samples) change.removed.push_back(sample.id);
  else
    change.added = lumen.samples;
  return change;
}

bool same_options(const lumen::InterpolationOptions& a, const lumen::InterpolationOptions& b) {
  return a.kernel == b.kernel && same_bits(a.support_radius_mm, b.support_radius_mm) &&
         same_bits(a.offset_mm, b.offset_mm) && a.far_field == b.far_field;
}

}  // namespace

bool same(const SurfaceSample& a, const SurfaceSample& b) {
  return a.id == b.id && same(a.position, b.position) && same(a.normal, b.normal) &&
         same_bits(a.s_mm, b.s_mm) && a.origin == b.origin;
}

bool same(const geometry::Centerline& a, const geometry::Centerline& b) {
  const auto same_points = [](const Vec3& p, const Vec3& q) { return same(p, q); };
  return all_same(a.points, b.points, same_points) && all_same(a.radius, b.radius, same_bits) &&
         all_same(a.abscissa, b.abscissa, same_bits) &&
         all_same(a.frames, b.frames, [](const geometry::Frame& f, const geometry::Frame& g) {
           return same(f.tangent, g.tangent) && same(f.normal, g.normal) && same(f.binormal, g.binormal);
         });
}

std::vector<VesselChange> changes_between(const LumenModel& before, const LumenModel& after) {
  std::vector<VesselChange> changes;
  std::unordered_map<std::int32_t, std::size_t> old;
  for (std::size_t i = 0; i < before.vessels.size(); ++i) old.emplace(before.vessels[i]->vessel, i);
  for (std::size_t k = 0; k < after.vessels.size(); ++k) {
    const VesselLumen& now = *after.vessels[k];
    const auto found = old.find(now.vessel);
    if (found == old.end()) {
      changes.push_back(whole(now, false));
      continue;
    }
    const std::size_t i = found->second;
    old.erase(found);
    if (before.vessels[i] == after.vessels[k]) continue;
    VesselChange change = change_of(*before.vessels[i], now);
    change.axis_changed = !same_way(before, after, i, k) ||
                          !same_bits(before.vessels[i]->own_from_mm, now.own_from_mm) ||
                          !same_options(before.vessels[i]->interpolation, now.interpolation);
    if (change.axis_changed || !change.removed.empty() || !change.added.empty())
      changes.push_back(std::move(change));
  }
  for (const auto& lumen : before.vessels)
    if (old.contains(lumen->vessel)) changes.push_back(whole(*lumen, true));
  std::sort(changes.begin(), changes.end(),
            [](const VesselChange& a, const VesselChange& b) { return a.vessel < b.vessel; });
  return changes;
}

}  // namespace ostia::session
