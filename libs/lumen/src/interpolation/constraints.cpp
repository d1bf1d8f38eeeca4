#include "interpolation/constraints.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <tuple>
#include <unordered_set>

namespace ostia::lumen {
namespace {

constexpr double coincident_mm = 1e-6;
constexpr double least_offset = 0.2;       // of lambda
constexpr double lattice_share = 1.0 / 3;  // of the support radius
constexpr double beyond_ends_mm = 4.0;     // caps are no deeper
constexpr double farthest_wall_mm = 10.0;  // of a lumen about its axis

constexpr double bridged = 1.5;  // of the support radius: farther samples leave a place that no centre fills
constexpr double widest_sector = 0.95 * std::numbers::pi;

void check(const SurfaceSample& sample) {
  const std::string object = "sample " + std::to_string(sample.id) + " of the wall";
  if (!sample.position.allFinite() || !sample.normal.allFinite() || !std::isfinite(sample.s_mm))
    throw InvalidInput(object + " has a place, a normal or an abscissa that is not finite; remove it");
  if (std::abs(sample.normal.norm() - 1.0) > 1e-6)
    throw InvalidInput(object + " has a normal of length " + std::to_string(sample.normal.norm()) +
                       "; it must be 1");
  if (sample.position.cwiseAbs().maxCoeff() > 1e4)
    throw InvalidInput(object + " lies more than 10 m from the origin; check its unit (mm)");
}

// Beyond an end the axis runs straight on.
Vec3 place_on(const geometry::AxisCurve& axis, double s_mm) {
  const double within = std::clamp(s_mm, 0.0, axis.length());
  return axis.point(within) + (s_mm - within) * axis.frame(within).tangent;
}

bool same(const Constraint& a, const Constraint& b) {
  return a.place == b.place && a.value == b.value && a.s_mm == b.s_mm;
}

// What only one of the two lists holds.
void compare(std::vector<Constraint> before, std::vector<Constraint> after, ConstraintSet::Difference& out) {
  std::sort(before.begin(), before.end(), constraint_order);
  std::sort(after.begin(), after.end(), constraint_order);
  std::size_t i = 0, j = 0;
  while (i < before.size() || j < after.size()) {
    if (j == after.size() || (i < before.size() && constraint_order(before[i], after[j]))) {
      out.removed.push_back(before[i++]);
    } else if (i == before.size() || constraint_order(after[j], before[i])) {
      out.added.push_back(after[j++]);
    } else {
      if (!same(before[i], after[j])) {
        out.removed.push_back(before[i]);
        out.added.push_back(after[j]);
      }
      ++i, ++j;
    }
  }
}

}  // namespace

bool constraint_order(const Constraint& a, const Constraint& b) {
  return std::tie(a.s_mm, a.key) < std::tie(b.s_mm, b.key);
}

ConstraintSet::ConstraintSet(const VesselLumen& vessel)
    : axis_(vessel.axis),
      options_(vessel.interpolation),
      lattice_mm_(lattice_share * vessel.interpolation.support_radius_mm),
      grid_(std::clamp(0.5 * vessel.interpolation.support_radius_mm, 0.5, 2.0)) {
  validate(options_);
  const std::string object = "vessel " + std::to_string(vessel.vessel);
  if (!axis_) throw InvalidInput(object + " has no axis; give it one");
  if (vessel.samples.empty())
    throw InvalidInput(object + " has no samples on its wall; start it from a tube or a surface");
  for (const SurfaceSample& sample : vessel.samples) {
    check(sample);
    if (slot_.contains(sample.id))
      throw InvalidInput(object + " has the sample " + std::to_string(sample.id) + " twice; give each an id");
    insert(sample);
  }
  samples_ = vessel.samples;
  std::sort(samples_.begin(), samples_.end(), canonical_order);
  for (Entry& entry : entries_) entry.made = offsets_of(entry.sample);

  const auto first = static_cast<int>(std::floor((vessel.own_from_mm - beyond_ends_mm) / lattice_mm_));
  const auto last = static_cast<int>(std::ceil((axis_->length() + beyond_ends_mm) / lattice_mm_));
  for (int k = first; k <= last; ++k) {
    Station station;
    station.s_mm = k * lattice_mm_;
    station.place = place_on(*axis_, station.s_mm);
    station.frame = axis_->frame(std::clamp(station.s_mm, 0.0, axis_->length()));
    stations_.push_back(std::move(station));
    make_station(stations_.size() - 1);
  }
}

void ConstraintSet::insert(const SurfaceSample& sample) {
  std::int32_t slot = 0;
  if (free_.empty()) {
    slot = static_cast<std::int32_t>(entries_.size());
    entries_.push_back({sample, {}});
  } else {
    slot = free_.back();
    free_.pop_back();
    entries_[static_cast<std::size_t>(slot)] = {sample, {}};
  }
  slot_.emplace(sample.id, slot);
  grid_.insert(slot, sample.position);
}

void ConstraintSet::erase(std::int64_t id) {
  const std::int32_t slot = slot_.at(id);
  Entry& entry = entries_[static_cast<std::size_t>(slot)];
  grid_.erase(slot, entry.sample.position);
  entry.made.clear();
  slot_.erase(id);
  free_.push_back(slot);
}

// Of the greatest ball that touches the wall at the sample on one side (+1 outer) and holds no other sample;
// greater ones than 2 lambda are all the same.
double ConstraintSet::ball_radius(const SurfaceSample& sample, double side) const {
  const double enough = 2.0 * options_.offset_mm;
  double radius = enough;
  grid_.near(sample.position, 2.0 * enough, [&](std::int32_t, const Vec3& place, double d2) {
    if (d2 < coincident_mm * coincident_mm) return;
    const double height = side * (place - sample.position).dot(sample.normal);
    if (height > 0.0) radius = std::min(radius, 0.5 * d2 / height);
  });
  return radius;
}

std::vector<Constraint> ConstraintSet::offsets_of(const SurfaceSample& sample) const {
  bool first_here = true;
  grid_.near(sample.position, coincident_mm, [&](std::int32_t slot, const Vec3&, double) {
    if (entries_[static_cast<std::size_t>(slot)].sample.id < sample.id) first_here = false;
  });
  std::vector<Constraint> made;
  if (!first_here) return made;
  made.push_back({sample.position, 0.0, sample.s_mm, 4 * sample.id});
  for (const int side : {1, -1}) {
    const double length = std::min(options_.offset_mm, 0.5 * ball_radius(sample, side));
    if (length < least_offset * options_.offset_mm) continue;
    made.push_back({sample.position + side * length * sample.normal, side * length, sample.s_mm,
                    4 * sample.id + (side > 0 ? 1 : 2)});
  }
  return made;
}

// Whether a place is inside, by all samples about as near as the nearest one, and how far from the wall.
ConstraintSet::Depth ConstraintSet::depth_at(const Vec3& place) const {
  Depth depth;
  double nearest = farthest_wall_mm;
  bool found = false;
  for (double reach = 1.25; !found && reach <= farthest_wall_mm; reach *= 2.0) {
    grid_.near(place, reach, [&](std::int32_t, const Vec3&, double d2) {
      found = true;
      nearest = std::min(nearest, std::sqrt(d2));
    });
  }
  depth.searched_mm = found ? 1.25 * nearest : farthest_wall_mm;
  if (!found) return depth;
  depth.inside = true;
  depth.wall_mm = nearest;
  grid_.near(place, depth.searched_mm, [&](std::int32_t slot, const Vec3& at, double) {
    const Entry& entry = entries_[static_cast<std::size_t>(slot)];
    if (entry.made.empty()) return;  // another stands in its place
    const double height = (at - place).dot(entry.sample.normal);
    if (height < 0.25 * nearest) depth.inside = false;
    depth.wall_mm = std::min(depth.wall_mm, height);
  });
  return depth;
}

void ConstraintSet::make_station(std::size_t index) {
  Station& station = stations_[index];
  station.made.clear();
  station.depends_mm = 0.0;
  const double cap = options_.support_radius_mm;
  int number = 0;
  for (int ring = 0; ring * lattice_mm_ < farthest_wall_mm; ++ring) {
    const int around = std::max(1, 6 * ring);
    const double rho = ring * lattice_mm_;
    bool any = false;
    for (int i = 0; i < around; ++i, ++number) {
      const Vec3 place = station.place +
                         rho * geometry::radial_direction(station.frame, 2.0 * std::numbers::pi * i / around);
      const Depth depth = depth_at(place);
      station.depends_mm = std::max(station.depends_mm, rho + depth.searched_mm);
      if (!depth.inside || depth.wall_mm < options_.offset_mm + 0.45 * lattice_mm_) continue;
      any = true;
      station.made.push_back({place, -std::min(depth.wall_mm, cap), station.s_mm,
                              -1 - (static_cast<std::int64_t>(index) << 16) - number});
    }
    if (!any && ring > 0) break;
  }
}

ConstraintSet::Difference ConstraintSet::change(const std::vector<std::int64_t>& removed,
                                                const std::vector<SurfaceSample>& added) {
  std::unordered_set<std::int64_t> gone;
  for (const std::int64_t id : removed) {
    if (!slot_.contains(id))
      throw InvalidInput("the wall has no sample " + std::to_string(id) + "; remove samples that it has");
    if (!gone.insert(id).second)
      throw InvalidInput("sample " + std::to_string(id) + " is removed twice; remove it once");
  }
  std::unordered_set<std::int64_t> come;
  for (const SurfaceSample& sample : added) {
    check(sample);
    if (!come.insert(sample.id).second || (slot_.contains(sample.id) && !gone.contains(sample.id)))
      throw InvalidInput("the wall has the sample " + std::to_string(sample.id) +
                         " already; give each an id");
  }
  if (samples_.size() + added.size() == removed.size())
    throw InvalidInput("no samples would be left on the wall; leave some, or delete the vessel");

  std::vector<Vec3> touched;
  std::vector<Constraint> before, after;
  const auto keep = [](const std::vector<Constraint>& made, std::vector<Constraint>& out) {
    out.insert(out.end(), made.begin(), made.end());
  };
  for (const std::int64_t id : removed) {
    const Entry& entry = entries_[static_cast<std::size_t>(slot_.at(id))];
    touched.push_back(entry.sample.position);
    keep(entry.made, before);
    erase(id);
  }
  for (const SurfaceSample& sample : added) {
    touched.push_back(sample.position);
    insert(sample);
  }
  std::unordered_set<std::int32_t> again;
  for (const Vec3& place : touched)
    grid_.near(place, 4.001 * options_.offset_mm,
               [&](std::int32_t slot, const Vec3&, double) { again.insert(slot); });
  for (const std::int32_t slot : again) {
    Entry& entry = entries_[static_cast<std::size_t>(slot)];
    keep(entry.made, before);
    entry.made = offsets_of(entry.sample);
    keep(entry.made, after);
  }
  for (std::size_t i = 0; i < stations_.size(); ++i) {
    Station& station = stations_[i];
    const double reach2 = station.depends_mm * station.depends_mm * (1.0 + 1e-9);
    if (std::none_of(touched.begin(), touched.end(),
                     [&](const Vec3& place) { return (place - station.place).squaredNorm() <= reach2; }))
      continue;
    keep(station.made, before);
    make_station(i);
    keep(station.made, after);
  }

  std::erase_if(samples_, [&](const SurfaceSample& sample) { return gone.contains(sample.id); });
  const auto middle = static_cast<std::ptrdiff_t>(samples_.size());
  samples_.insert(samples_.end(), added.begin(), added.end());
  std::sort(samples_.begin() + middle, samples_.end(), canonical_order);
  std::inplace_merge(samples_.begin(), samples_.begin() + middle, samples_.end(), canonical_order);
  Difference difference;
  compare(std::move(before), std::move(after), difference);
  return difference;
}

std::vector<Constraint> ConstraintSet::all() const {
  std::vector<Constraint> constraints;
  for (const Entry& entry : entries_)
    constraints.insert(constraints.end(), entry.made.begin(), entry.made.end());
  for (const Station& station : stations_)
    constraints.insert(constraints.end(), station.made.begin(), station.made.end());
  std::sort(constraints.begin(), constraints.end(), constraint_order);
  return constraints;
}

// Neighbours within reach, seen from the sample in its tangent plane, leave no sector as wide as a half-plane
// and more.
bool ConstraintSet::surrounded(const Entry& entry) const {
  const SurfaceSample& sample = entry.sample;
  const Vec3 u = sample.normal.unitOrthogonal(), v = sample.normal.cross(u);
  std::vector<double> angles;
  for (const double share : {0.2, 0.45, bridged}) {  // the near ones mostly do
    angles.clear();
    grid_.near(sample.position, share * options_.support_radius_mm,
               [&](std::int32_t, const Vec3& at, double d2) {
                 const Vec3 offset = at - sample.position;
                 const double x = offset.dot(u), y = offset.dot(v);
                 if (x * x + y * y > 0.04 * d2 && d2 > coincident_mm * coincident_mm)
                   angles.push_back(std::atan2(y, x));
               });
    if (angles.size() < 3) continue;
    std::sort(angles.begin(), angles.end());
    double widest = angles.front() + 2.0 * std::numbers::pi - angles.back();
    for (std::size_t i = 1; i < angles.size(); ++i) widest = std::max(widest, angles[i] - angles[i - 1]);
    if (widest < widest_sector) return true;
  }
  return false;
}

void ConstraintSet::check_for_holes(const std::vector<Vec3>& near) const {
  const auto check_entry = [&](const Entry& entry) {
    if (entry.made.empty() || surrounded(entry)) return;
    throw InvalidInput("the wall has a hole at " + core::cut_text(entry.sample.s_mm, 3) +
                       " mm along the vessel: a support radius of " +
                       core::cut_text(options_.support_radius_mm, 3) +
                       " mm does not bridge its samples; enlarge the support radius or add samples there");
  };
  if (near.empty()) {
    for (const SurfaceSample& sample : samples_)
      check_entry(entries_[static_cast<std::size_t>(slot_.at(sample.id))]);
    return;
  }
  std::vector<std::int32_t> slots;
  for (const Vec3& place : near)
    grid_.near(place, options_.support_radius_mm,
               [&](std::int32_t slot, const Vec3&, double) { slots.push_back(slot); });
  std::sort(slots.begin(), slots.end());
  slots.erase(std::unique(slots.begin(), slots.end()), slots.end());
  for (const std::int32_t slot : slots) check_entry(entries_[static_cast<std::size_t>(slot)]);
}

}  // namespace ostia::lumen
