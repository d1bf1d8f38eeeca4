#include "coronaries/axis_place.h"
#include "scan/smooth_process.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"
#include "ostia/geometry/polyline.h"
#include "ostia/phantom/truth.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ostia::phantom {
namespace {

using geometry::Centerline;

constexpr double reference_step_mm = 0.03;
constexpr double observer_step_mm = 0.1;
constexpr double least_inside_mm = 12.0;
constexpr double least_own_mm = 5.0;      // of the vessel itself, behind its parents
constexpr double least_spread_mm = 0.05;  // io is a distance that scores are divided by
constexpr double point_a_share = 0.85;    // of the way
constexpr double point_b_mm = 30.0;
constexpr double image_margin_mm = 1.0;

std::vector<std::int32_t> path_ids(const CoronaryTree& tree, std::int32_t id) {
  std::vector<std::int32_t> ids{id};
  while (vessel_of(tree, ids.back()).parent >= 0) {
    ids.push_back(vessel_of(tree, ids.back()).parent);
    if (ids.size() > tree.vessels.size()) throw InvalidInput("the coronary tree's parents run in a circle");
  }
  std::reverse(ids.begin(), ids.end());
  return ids;
}

const CoronaryVessel* named(const CoronaryTree& tree, const std::string& name) {
  for (const CoronaryVessel& vessel : tree.vessels)
    if (vessel.name == name) return &vessel;
  return nullptr;
}

/// The side branch with the largest calibre where it has left its parent.
const CoronaryVessel* largest_branch(const CoronaryTree& tree) {
  const CoronaryVessel* best = nullptr;
  double largest = 0.0;
  for (const CoronaryVessel& vessel : tree.vessels) {
    if (vessel.parent < 0 || vessel.name == "LM" || vessel.name == "RCA" || vessel.name == "LAD" ||
        vessel.name == "LCX")
      continue;
    if (vessel.axis.size() < 2 || vessel.axis.abscissa.back() < least_inside_mm) continue;
    const double calibre = vessel.lumen.mean_at(vessel.s_free_mm);
    if (calibre > largest) {
      largest = calibre;
      best = &vessel;
    }
  }
  return best;
}

bool within(const imaging::Geometry& image, const Vec3& point) {
  const Vec3 index = image.index(point);
  for (int a = 0; a < 3; ++a) {
    const double need = image_margin_mm / image.spacing[a];
    if (index[a] < need || index[a] > static_cast<double>(image.size[static_cast<std::size_t>(a)] - 1) - need)
      return false;
  }
  return true;
}

/// First and last index of the longest run of points inside the image.
std::pair<std::size_t, std::size_t> longest_inside(const Centerline& line,
                                                   const std::optional<imaging::Geometry>& image) {
  if (!image) return {0, line.size() - 1};
  std::pair<std::size_t, std::size_t> best{0, 0};
  for (std::size_t begin = 0; begin < line.size(); ++begin) {
    std::size_t end = begin;
    while (end < line.size() && within(*image, line.points[end])) ++end;
    if (end == begin) continue;
    if (end - 1 - begin > best.second - best.first) best = {begin, end - 1};
    begin = end;  // outside
  }
  return best;
}

Centerline part(const Centerline& line, std::size_t first, std::size_t last) {
  Centerline out;
  for (std::size_t i = first; i <= last; ++i) {
    out.points.push_back(line.points[i]);
    out.radius.push_back(line.radius[i]);
  }
  geometry::complete(out, line.frames[first].normal);
  return out;
}

/// Thin vessels are traced more closely: nobody clicks outside of them.
double share_at(double radius_mm) {
  constexpr double full_at_mm = 1.5;
  return std::min(1.0, radius_mm / full_at_mm);
}

/// Where an observer's trace lies beside the axis of a wide vessel, along the frame's normal and binormal.
geometry::Vec2 trace_deviation(int vessel, int observer, double s, const ObserverOptions& options) {
  const auto stream =
      (1ULL << 20) + (static_cast<std::uint64_t>(vessel) << 8) + 2 * static_cast<std::uint64_t>(observer);
  return options.axis_mm *
         geometry::Vec2(smooth_process(options.seed, stream, s, options.axis_length_mm),
                        smooth_process(options.seed, stream + 1, s, options.axis_length_mm));
}

/// How far the observers' traces are from the axis of a wide vessel in the mean.
double spread_at(int vessel, double s, const ObserverOptions& observers) {
  double sum = 0.0;
  for (int observer = 1; observer <= observers.count; ++observer)
    sum += trace_deviation(vessel, observer, s, observers).norm();
  return observers.count > 0 ? sum / observers.count : 0.0;
}

io::RotterdamReference reference_of(const Centerline& line, int number, const ObserverOptions& observers) {
  io::RotterdamReference out;
  const Centerline fine = geometry::resample(line, reference_step_mm);
  out.points = fine.points;
  out.radius = fine.radius;
  out.observer_spread.reserve(fine.size());
  const double knot_mm = 0.02 * observers.axis_length_mm;  // the spread is smooth: linear between knots
  double from = 0.0, first = spread_at(number, from, observers);
  double next = spread_at(number, from + knot_mm, observers);
  for (std::size_t i = 0; i < fine.size(); ++i) {
    const double s = fine.abscissa[i];
    while (s > from + knot_mm) {
      from += knot_mm;
      first = next;
      next = spread_at(number, from + knot_mm, observers);
    }
    const double spread = first + (next - first) * (s - from) / knot_mm;
    out.observer_spread.push_back(std::max(least_spread_mm, share_at(fine.radius[i]) * spread));
  }
  return out;
}

std::vector<Vec3> traced(const Centerline& line, int number, int observer, const ObserverOptions& observers) {
  const Centerline coarse = geometry::resample(line, observer_step_mm);
  std::vector<Vec3> out;
  for (std::size_t i = 0; i < coarse.size(); ++i) {
    const geometry::Vec2 d =
        share_at(coarse.radius[i]) * trace_deviation(number, observer, coarse.abscissa[i], observers);
    out.push_back(coarse.points[i] + d.x() * coarse.frames[i].normal + d.y() * coarse.frames[i].binormal);
  }
  return out;
}

void add(ChallengeVessels& out, const CoronaryTree& tree, int number, const CoronaryVessel* vessel,
         const ObserverOptions& observers, const std::optional<imaging::Geometry>& image) {
  const std::string folder = "vessel" + std::to_string(number);
  if (vessel == nullptr) {
    out.warnings.push_back(folder + " left out: the tree has no such vessel");
    return;
  }
  const Centerline whole = path_from_ostium(tree, vessel->id);
  const auto [first, last] = longest_inside(whole, image);
  const double inside = whole.abscissa[last] - whole.abscissa[first];
  if (inside < least_inside_mm) {
    out.warnings.push_back(folder + " (" + vessel->name + ") left out: the image holds " +
                           core::fixed_text(inside, 0) + " mm of its " +
                           core::fixed_text(whole.abscissa.back(), 0) + " mm");
    return;
  }
  const double own = whole.abscissa[last] - (whole.abscissa.back() - vessel->axis.abscissa.back());
  if (own < least_own_mm) {
    out.warnings.push_back(folder + " (" + vessel->name +
                           ") left out: the image holds little of it but the vessel it leaves");
    return;
  }
  ChallengeVessel made;
  made.number = number;
  made.name = vessel->name;
  made.path = path_ids(tree, vessel->id);
  made.cut_by_image = first > 0 || last + 1 < whole.size();
  if (made.cut_by_image) {
    out.warnings.push_back(folder + " (" + vessel->name +
                           ") is cut by the image: " + core::fixed_text(inside, 0) + " mm of " +
                           core::fixed_text(whole.abscissa.back(), 0) + " mm");
  }
  const Centerline line = made.cut_by_image ? part(whole, first, last) : whole;
  const double length = line.abscissa.back();
  made.reference = reference_of(line, number, observers);
  for (int observer = 1; observer <= observers.count; ++observer)
    made.observers.push_back(traced(line, number, observer, observers));
  made.point_s = line.points.front();
  made.point_e = line.points.back();
  made.point_a = place_at(line, point_a_share * length).point;
  made.point_b = place_at(line, std::min(point_b_mm, 0.5 * length)).point;
  out.vessels.push_back(std::move(made));
}

}  // namespace

geometry::Centerline path_from_ostium(const CoronaryTree& tree, std::int32_t id) {
  const std::vector<std::int32_t> ids = path_ids(tree, id);
  Centerline out;
  const auto append = [&](const Vec3& point, double radius) {
    if (!out.points.empty() && (out.points.back() - point).norm() < 1e-6) return;
    out.points.push_back(point);
    out.radius.push_back(radius);
  };
  for (std::size_t k = 0; k < ids.size(); ++k) {
    const Centerline& axis = vessel_of(tree, ids[k]).axis;
    const double until = k + 1 < ids.size() ? vessel_of(tree, ids[k + 1]).parent_s_mm : axis.abscissa.back();
    for (std::size_t i = 0; i < axis.size() && axis.abscissa[i] <= until + 1e-9; ++i)
      append(axis.points[i], axis.radius[i]);
  }
  geometry::complete(out, vessel_of(tree, ids.front()).axis.frames.front().normal);
  return out;
}

ChallengeVessels challenge_vessels(const CoronaryTree& tree, const ObserverOptions& observers,
                                   const std::optional<imaging::Geometry>& image) {
  validate(observers);
  ChallengeVessels out;
  const std::array<const CoronaryVessel*, 4> vessels{named(tree, "RCA"), named(tree, "LAD"),
                                                     named(tree, "LCX"), largest_branch(tree)};
  for (std::size_t i = 0; i < vessels.size(); ++i)
    add(out, tree, static_cast<int>(i), vessels[i], observers, image);
  return out;
}

}  // namespace ostia::phantom
