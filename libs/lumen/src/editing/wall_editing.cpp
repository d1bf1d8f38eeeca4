#include "editing/wall_editing.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace ostia::lumen {

using core::mm_text;
using geometry::AxisFoot;

namespace {

using std::numbers::pi;
constexpr double infinity = std::numeric_limits<double>::infinity();

struct Walk {
  double cost = infinity;
  std::size_t from = 0;
};

// How badly a foot suits its place: far feet, and feet seen at another angle than the plane's.
double foot_cost(const AxisFoot& foot, const std::optional<double>& plane_theta) {
  const double aside = plane_theta ? std::abs(std::sin(foot.theta - *plane_theta)) : 0.0;
  return foot.rho_mm * (1.0 + aside);
}

// How badly a foot follows another: a walk along the wall covers no more of the axis than of space (but on
// the inner side of a bend), and does not jump about the vessel.
double step_cost(const AxisFoot& a, const AxisFoot& b, double moved_mm) {
  const double run = std::abs(b.s_mm - a.s_mm);
  const double turn = std::abs(angle_between(b.theta, a.theta)) * std::min(a.rho_mm, b.rho_mm);
  return std::max(0.0, run - moved_mm) + 0.25 * std::max(0.0, turn - moved_mm);
}

}  // namespace

double angle_between(double theta, double from) {
  return std::remainder(theta - from, 2.0 * pi);
}

std::string object_of(const LumenModel& model, std::int32_t vessel, const std::string& op) {
  for (const geometry::Vessel& candidate : model.tree.vessels)
    if (candidate.id == vessel)
      return op + " on " + (candidate.name.empty() ? "vessel " + std::to_string(vessel) : candidate.name);
  return op + " on vessel " + std::to_string(vessel);
}

void check_points(const std::vector<Vec3>& points, std::size_t least, const std::string& what) {
  for (std::size_t i = 0; i < points.size(); ++i)
    if (!points[i].allFinite())
      throw InvalidInput(what + ": point " + std::to_string(i + 1) + " is not finite; draw it again");
  if (points.size() < least)
    throw InvalidInput(what + " has " + std::to_string(points.size()) + " points; it needs at least " +
                       std::to_string(least));
}

std::vector<OwnedStretch> owned_stretches(const LumenModel& model, std::int32_t vessel_id) {
  const double length = vessel(model, vessel_id).axis->length();
  std::vector<double> bounds{0.0, length};
  for (const geometry::Vessel& other : model.tree.vessels) {
    const double from = own_from_mm(model.tree, other.id);
    if (from > 0.0 && from < length) bounds.push_back(from);
  }
  std::sort(bounds.begin(), bounds.end());
  std::vector<OwnedStretch> stretches;
  for (std::size_t i = 0; i + 1 < bounds.size(); ++i) {
    if (!(bounds[i + 1] > bounds[i])) continue;
    const std::int32_t owner = owner_at(model.tree, vessel_id, 0.5 * (bounds[i] + bounds[i + 1]));
    if (!stretches.empty() && stretches.back().owner == owner)
      stretches.back().to_mm = bounds[i + 1];
    else
      stretches.push_back({owner, bounds[i], bounds[i + 1]});
  }
  stretches.front().from_mm = -infinity;
  stretches.back().to_mm = infinity;
  return stretches;
}

std::vector<AxisFoot> feet_along(const AxisCurve& axis, const std::vector<Vec3>& places,
                                 const std::optional<double>& plane_theta, const std::string& what) {
  std::vector<std::vector<AxisFoot>> candidates;
  std::vector<std::vector<Walk>> walks;
  for (std::size_t i = 0; i < places.size(); ++i) {
    candidates.push_back(axis.feet(places[i], farthest_mm));
    if (candidates[i].empty())
      throw InvalidInput(what + ": point " + std::to_string(i + 1) + " is " +
                         mm_text(axis.nearest_foot(places[i]).rho_mm) +
                         " from the vessel's axis, more than " + mm_text(farthest_mm) +
                         "; choose the vessel that it belongs to");
    walks.emplace_back(candidates[i].size());
    for (std::size_t k = 0; k < candidates[i].size(); ++k) {
      Walk& walk = walks[i][k];
      const double own = foot_cost(candidates[i][k], plane_theta);
      if (i == 0) {
        walk.cost = own;
        continue;
      }
      const double moved = (places[i] - places[i - 1]).norm();
      for (std::size_t j = 0; j < candidates[i - 1].size(); ++j) {
        const double cost =
            walks[i - 1][j].cost + own + step_cost(candidates[i - 1][j], candidates[i][k], moved);
        if (cost < walk.cost) walk = {cost, j};
      }
    }
  }
  std::vector<AxisFoot> feet(places.size());
  std::size_t k = 0;
  for (std::size_t j = 1; j < walks.back().size(); ++j)
    if (walks.back()[j].cost < walks.back()[k].cost) k = j;
  for (std::size_t i = places.size(); i-- > 0;) {
    feet[i] = candidates[i][k];
    k = walks[i][k].from;
  }
  for (std::size_t i = 1; i < places.size(); ++i) {
    const double run = std::abs(feet[i].s_mm - feet[i - 1].s_mm), moved = (places[i] - places[i - 1]).norm();
    if (run > 4.0 * moved + 2.0)
      throw InvalidInput(what + ": from point " + std::to_string(i) + " to " + std::to_string(i + 1) + ", " +
                         mm_text(moved) + " apart, its foot jumps " + mm_text(run) +
                         " along the axis; set more points there, or draw on a cross-section");
  }
  return feet;
}

Vec3 straightened(const AxisCurve& axis, const Vec3& place, const AxisFoot& foot) {
  const geometry::Frame frame = axis.frame(foot.s_mm);
  const Vec3 offset = place - axis.point(foot.s_mm);
  const Vec3 along_normal = geometry::radial_direction(frame, 0.0);
  const Vec3 along_second = geometry::radial_direction(frame, 0.5 * pi);
  const double past = foot.past_end ? offset.dot(frame.tangent) : 0.0;
  return {foot.s_mm + past, offset.dot(along_normal), offset.dot(along_second)};
}

Vec3 bent(const AxisCurve& axis, const Vec3& coordinates) {
  const double s = std::clamp(coordinates.x(), 0.0, axis.length());
  const geometry::Frame frame = axis.frame(s);
  return axis.point(s) + (coordinates.x() - s) * frame.tangent +
         coordinates.y() * geometry::radial_direction(frame, 0.0) +
         coordinates.z() * geometry::radial_direction(frame, 0.5 * pi);
}

double sample_spacing_mm(const VesselLumen& vessel, double radius_mm) {
  const double wide = std::clamp(vessel.interpolation.support_radius_mm / 3.0, 0.3, 1.5);
  return std::clamp(0.8 * radius_mm, 0.3, wide);
}

WallPlace wall_place(const AxisCurve& axis, const SurfaceSample& sample) {
  const geometry::Frame frame = axis.frame(sample.s_mm);
  const Vec3 offset = sample.position - axis.point(sample.s_mm);
  WallPlace place;
  place.sample = &sample;
  place.theta = geometry::angle_of(frame, offset);
  place.rho_mm = offset.norm();
  const Vec3 outwards = geometry::radial_direction(frame, place.theta);
  const Vec3 around = geometry::radial_direction(frame, place.theta + 0.5 * pi);
  const double steep = std::max(0.2, sample.normal.dot(outwards));
  place.tilt = std::atan2(sample.normal.dot(around), steep);
  const double stretch = std::max(0.1, 1.0 - place.rho_mm * axis.curvature_vector(sample.s_mm).dot(outwards));
  place.slope = -sample.normal.dot(frame.tangent) / steep * stretch;
  return place;
}

std::vector<WallPlace> wall_places(const VesselLumen& vessel, double from_mm, double to_mm) {
  std::vector<WallPlace> places;
  for (const SurfaceSample& sample : vessel.samples)
    if (sample.origin != SampleOrigin::cap && sample.s_mm >= from_mm && sample.s_mm <= to_mm)
      places.push_back(wall_place(*vessel.axis, sample));
  return places;
}

namespace {

// A drawn wall beside a place: mean angle and radius of what lies nearest to it on one side.
struct BackgroundTask {
  double turn = 0.0, rho_mm = 0.0;
};

std::optional<BackgroundTask> drawn_beside(const std::vector<WallPlace>& kept, double s_mm, double theta,
                                           double side, double window_mm) {
  constexpr double farthest = 130.0 / 180.0 * pi, nearest = 0.17, width = 0.35;
  double least = farthest;
  const auto turn_of = [&](const WallPlace& place) { return side * angle_between(place.theta, theta); };
  const auto counts = [&](const WallPlace& place) {
    return place.sample->origin == SampleOrigin::edit && std::abs(place.sample->s_mm - s_mm) < window_mm &&
           turn_of(place) > nearest;
  };
  for (const WallPlace& place : kept)
    if (counts(place)) least = std::min(least, turn_of(place));
  if (!(least < farthest)) return std::nullopt;
  BackgroundTask mean;
  double sum = 0.0;
  for (const WallPlace& place : kept) {
    if (!counts(place) || turn_of(place) > least + width) continue;
    const double near = 1.0 - std::abs(place.sample->s_mm - s_mm) / window_mm;
    const double weight = near * near;
    mean.turn += weight * turn_of(place);
    mean.rho_mm += weight * place.rho_mm;
    sum += weight;
  }
  if (!(sum > 1e-12)) return std::nullopt;
  return BackgroundTask{side * mean.turn / sum, mean.rho_mm / sum};
}

// d rho / d theta at the middle place of a + b cos + c sin through three places.
double slope_of_circle(double rho, const BackgroundTask& a, const BackgroundTask& b) {
  const double c1 = std::cos(a.turn) - 1.0, s1 = std::sin(a.turn), d1 = a.rho_mm - rho;
  const double c2 = std::cos(b.turn) - 1.0, s2 = std::sin(b.turn), d2 = b.rho_mm - rho;
  const double determinant = c1 * s2 - c2 * s1;
  return std::abs(determinant) > 1e-3 ? (c1 * d2 - c2 * d1) / determinant : 0.0;
}

}  // namespace

double tilt_at(const std::vector<WallPlace>& before, const std::vector<WallPlace>& kept, double s_mm,
               double theta, double rho_mm, double spacing_mm) {
  constexpr double steepest = 50.0 / 180.0 * pi;
  const double window = 1.2 * spacing_mm;
  const auto right = drawn_beside(kept, s_mm, theta, 1.0, window);
  const auto left = drawn_beside(kept, s_mm, theta, -1.0, window);
  if (right && left) {
    const double slope = slope_of_circle(rho_mm, *right, *left);
    return std::clamp(-std::atan2(slope, rho_mm), -steepest, steepest);
  }
  double sum = 0.0, tilt = 0.0;
  for (const WallPlace& place : before) {
    const double along = std::abs(place.sample->s_mm - s_mm) / (1.5 * spacing_mm);
    const double aside = std::abs(angle_between(place.theta, theta)) / (0.25 * pi);
    if (along >= 1.0 || aside >= 1.0) continue;
    const double weight = (1.0 - along) * (1.0 - aside);
    tilt += weight * place.tilt;
    sum += weight;
  }
  return sum > 1e-9 ? std::clamp(tilt / sum, -steepest, steepest) : 0.0;
}

std::vector<SurfaceSample> WallChange::kept() const {
  std::vector<SurfaceSample> samples;
  for (std::size_t i = 0; i < gone_.size(); ++i)
    if (!gone_[i]) samples.push_back(vessel_->samples[i]);
  return samples;
}

void WallChange::remove_crowded(double share_of_spacing) {
  const AxisCurve& axis = *vessel_->axis;
  std::vector<double> nearest;  // a new sample's
  double widest = 0.0;
  for (const SurfaceSample& sample : added_) {
    const double rho = (sample.position - axis.point(sample.s_mm)).norm();
    nearest.push_back(share_of_spacing * sample_spacing_mm(*vessel_, rho));
    widest = std::max(widest, nearest.back());
  }
  geometry::Box3 box;
  for (const SurfaceSample& sample : added_) box.extend(sample.position);
  for (std::size_t i = 0; i < gone_.size(); ++i) {
    const SurfaceSample& old = vessel_->samples[i];
    if (gone_[i] || box.isEmpty() || box.exteriorDistance(old.position) > widest) continue;
    for (std::size_t k = 0; k < added_.size(); ++k) {
      const double distance = (added_[k].position - old.position).norm();
      if (distance < 1e-3 || (distance < nearest[k] && added_[k].normal.dot(old.normal) > 0.0))
        gone_[i] = true;
    }
  }
}

WallEdit::WallEdit(const LumenModel& model, std::int32_t vessel_id, const std::string& op)
    : model_(&model), what_(object_of(model, vessel_id, op)), stretches_(owned_stretches(model, vessel_id)) {}

const OwnedStretch& WallEdit::stretch_at(double s_mm) const {
  for (const OwnedStretch& stretch : stretches_)
    if (s_mm < stretch.to_mm) return stretch;
  return stretches_.back();
}

WallChange& WallEdit::of(std::int32_t owner) {
  const auto found = changes_.find(owner);
  if (found != changes_.end()) return found->second;
  return changes_.emplace(owner, WallChange(lumen::vessel(*model_, owner))).first->second;
}

namespace {

void check_not_inside_out(const AxisCurve& axis, const SurfaceSample& sample, const std::string& what) {
  const geometry::Frame frame = axis.frame(sample.s_mm);
  const Vec3 offset = sample.position - axis.point(sample.s_mm);
  const double across = (offset - offset.dot(frame.tangent) * frame.tangent).norm();
  if (sample.origin != SampleOrigin::cap && across < least_radius_mm)
    throw InvalidInput(what + ": at " + mm_text(sample.s_mm) + " along the vessel the wall would be " +
                       mm_text(across) + " from the axis; keep it at least " + mm_text(least_radius_mm) +
                       " away, or move the axis first");
  if (!(sample.normal.dot(offset) > 0.0))
    throw InvalidInput(what + ": at " + mm_text(sample.s_mm) +
                       " along the vessel the wall would be inside out; draw it less steeply");
}

}  // namespace

EditOutcome WallEdit::outcome() && {
  EditOutcome outcome{*model_, {}, std::move(notes)};
  for (const auto& [owner, change] : changes_) {
    const VesselLumen& before = change.vessel();
    VesselChange report;
    report.vessel = owner;
    for (std::size_t i = 0; i < before.samples.size(); ++i)
      if (change.removed(i)) report.removed.push_back(before.samples[i].id);
    for (SurfaceSample sample : change.added()) {
      check_not_inside_out(*before.axis, sample, what_);
      sample.id = outcome.model.next_sample_id++;
      report.added.push_back(sample);
    }
    if (report.removed.empty() && report.added.empty()) continue;
    VesselLumen after = before;
    after.samples = change.kept();
    after.samples.insert(after.samples.end(), report.added.begin(), report.added.end());
    std::sort(after.samples.begin(), after.samples.end(), canonical_order);
    std::sort(report.removed.begin(), report.removed.end());
    std::sort(report.added.begin(), report.added.end(), canonical_order);
    for (auto& shared : outcome.model.vessels)
      if (shared->vessel == owner) shared = std::make_shared<const VesselLumen>(std::move(after));
    outcome.changes.push_back(std::move(report));
  }
  return outcome;
}

}  // namespace ostia::lumen
