#include "follow_up/carry_axes.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"
#include "ostia/geometry/axis_curve.h"
#include "ostia/geometry/polyline.h"
#include "ostia/imaging/sampling.h"
#include "ostia/lumen/lumen_model.h"
#include "ostia/segmentation/minimal_path.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

namespace ostia::session {
namespace {

using geometry::Vec3;
using geometry::VesselTree;

constexpr double lumen_within_mm = 2.0;      // of the mapped axis, at most: where lumen is looked for
constexpr double off_others_mm = 0.5;        // of another vessel's wall: its lumen is not this one's
constexpr double seen_contrast = 0.35;       // of the tree's, above tissue: as minimal paths have it
constexpr double least_contrast_hu = 130.0;  // of contrast, as registrations have it
constexpr double tissue_hu = 50.0;           // of vessels' walls and muscle
constexpr double unseen_end_mm = 3.0;        // that an end may have
constexpr double behind_fork_mm = 3.0;       // that a vessel keeps behind its last branch
constexpr double least_vessel_mm = 5.0;      // seen, to be carried
constexpr double least_unseen_mm = 1.0;      // a shorter one is noise
constexpr double ostium_mm = 2.0;            // that is not centred, as in the search
constexpr double clear_mm = 0.5;  // between the walls of parent and branch, where it begins to be centred
constexpr double most_fixed_share = 0.5;  // of a branch
constexpr double fading_mm = 10.0;        // over which a branch forgets how its parent was pulled
constexpr double least_pulled_mm = 2.0;   // of an axis that can be pulled
constexpr double narrow_reach_mm = 1.0;   // of a second try
constexpr double least_step = 0.25;       // of a step's former length
constexpr double least_length = 0.8, most_length = 1.25;
constexpr double least_radius_mm = 0.1;

/// What the later scan shows about a tree that lies nearly right.
struct SeenLumen {
  const imaging::ImageVolume& image;
  double lumen_hu = 0.0;

  double contrast(const Vec3& place) const {
    if (!image.geometry.contains(place)) return 0.0;
    return (imaging::sample(image, place) - tissue_hu) / std::max(lumen_hu - tissue_hu, 1.0);
  }
  /// The most about a place.
  double most_about(const Vec3& place, double within_mm) const {
    double most = contrast(place);
    for (const double distance : {0.5 * within_mm, within_mm})
      for (int n = 0; n < 27; ++n) {
        const Vec3 way(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1);
        if (way.squaredNorm() > 0.0) most = std::max(most, contrast(place + distance * way.normalized()));
      }
    return most;
  }
};

std::vector<CarriedLine> own_lines(const VesselTree& tree) {
  std::vector<CarriedLine> lines;
  std::set<std::int32_t> owned;
  for (std::size_t v = 0; v < tree.vessels.size(); ++v) {
    CarriedLine line;
    line.vessel = v;
    line.told.vessel = tree.vessels[v].id;
    line.told.name = tree.vessels[v].name;
    for (const std::int32_t id : tree.vessels[v].segments) {
      if (!owned.insert(id).second) continue;
      const geometry::Centerline& axis = geometry::segment(tree, id).axis;
      const std::ptrdiff_t shared = line.points.empty() ? 0 : 1;
      line.points.insert(line.points.end(), axis.points.begin() + shared, axis.points.end());
      line.radius_mm.insert(line.radius_mm.end(), axis.radius.begin() + shared, axis.radius.end());
      line.segments.push_back(id);
      line.last.push_back(line.points.size() - 1);
    }
    line.told.before_mm = geometry::length(line.points);
    line.kept = line.points.size();
    lines.push_back(std::move(line));
  }
  return lines;
}

void map_lines(std::vector<CarriedLine>& lines, const analysis::PointMap& map) {
  for (CarriedLine& line : lines)
    for (Vec3& point : line.points) {
      point = map(point);
      if (!point.allFinite())
        throw InvalidInput("the map between the scans gives no place for one on " + line.told.name);
    }
}

/// The brighter half of the mapped places tells what lumen is: some lie beside it.
double lumen_of(const std::vector<CarriedLine>& lines, const imaging::ImageVolume& image) {
  std::vector<double> values;
  for (const CarriedLine& line : lines)
    for (const Vec3& point : line.points)
      if (image.geometry.contains(point)) values.push_back(imaging::sample(image, point));
  if (values.empty())
    throw InvalidInput("all of the tree lies outside the later scan: the scans do not overlap there");
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(values.size() * 3 / 4);
  std::nth_element(values.begin(), at, values.end());
  if (*at < least_contrast_hu)
    throw InvalidInput("where the vessels should be, the later scan has " + core::rounded_text(*at, 0) +
                       " HU: it is without contrast, of another patient, or of another part of the body");
  return *at;
}

/// Stretches without contrast that are shorter than noise makes them, as seen.
void close_small_gaps(const std::vector<double>& s, std::vector<char>& seen) {
  for (std::size_t i = 0; i < seen.size();) {
    std::size_t next = i;
    while (next < seen.size() && seen[next] == seen[i]) ++next;
    const double from = s[i > 0 ? i - 1 : 0], to = s[std::min(next, seen.size() - 1)];
    if (!seen[i] && to - from < least_unseen_mm)
      std::fill(seen.begin() + static_cast<std::ptrdiff_t>(i),
                seen.begin() + static_cast<std::ptrdiff_t>(next), 1);
    i = next;
  }
}

/// How far each line is kept, daughters before their parents: where the scan shows them, and as far as what
/// leaves them.
class Extents {
 public:
  Extents(const VesselTree& tree, std::vector<CarriedLine>& lines, const SeenLumen& seen, double reach_mm)
      : tree_(tree), lines_(lines), seen_(seen), within_mm_(std::min(reach_mm, lumen_within_mm)) {}

  void find() {
    for (auto line = lines_.rbegin(); line != lines_.rend(); ++line) find(*line);
    leave_out_hanging();
  }

 private:
  void find(CarriedLine& line) {
    const std::vector<double> s = geometry::abscissas(line.points);
    std::size_t inside = 0;
    while (inside < line.points.size() && seen_.image.geometry.contains(line.points[inside])) ++inside;
    line.seen.assign(line.points.size(), 1);
    double seen_mm = 0.0, free_mm = 0.0;
    std::size_t last_seen = 0;
    for (std::size_t i = 0; i < inside; ++i) {
      const double within_mm = std::min(within_mm_, away_from_others_mm(line, line.points[i]));
      if (within_mm > 0.0)
        line.seen[i] = seen_.most_about(line.points[i], within_mm) >= seen_contrast ? 1 : 0;
      if (line.seen[i]) last_seen = i;
      if (i == 0 || !(within_mm > 0.0)) continue;
      free_mm += s[i] - s[i - 1];
      if (line.seen[i]) seen_mm += s[i] - s[i - 1];
    }
    const double fork_mm = last_fork_mm(line, s);
    if (inside < 2 || (fork_mm < 0.0 && seen_mm < std::min(least_vessel_mm, 0.5 * free_mm))) {
      line.kept = 0;
      line.told.notes.emplace_back(inside < 2 ? "it begins outside the later scan"
                                              : "the later scan shows no lumen where it should be");
      return;
    }
    std::size_t to = inside - 1;
    if (s[to] - s[last_seen] > unseen_end_mm) to = last_seen;
    while (to + 1 < inside && s[to] < fork_mm + behind_fork_mm) ++to;
    line.kept = std::max<std::size_t>(to + 1, 2);
    line.told.cut_mm = s.back() - s[line.kept - 1];
    if (line.kept == line.points.size()) return;
    line.told.notes.push_back(
        "its last " + core::mm_text(line.told.cut_mm, 1) +
        (line.kept == inside ? " lie outside the later scan" : " are not seen in the later scan"));
  }

  /// From a place to the nearest wall of another vessel, less a margin: lumen that is farther off is not its.
  double away_from_others_mm(const CarriedLine& line, const Vec3& place) const {
    double least = within_mm_;
    for (const CarriedLine& other : lines_) {
      if (&other == &line) continue;
      for (std::size_t i = 0; i < other.points.size(); ++i)
        least = std::min(least, (other.points[i] - place).norm() - other.radius_mm[i] - off_others_mm);
    }
    return least;
  }

  /// Where the last kept vessel leaves it; negative where none does.
  double last_fork_mm(const CarriedLine& line, const std::vector<double>& s) const {
    double last = -1.0;
    for (const CarriedLine& other : lines_) {
      if (&other == &line || other.kept == 0 || other.segments.empty()) continue;
      const std::int32_t from = geometry::segment(tree_, other.segments.front()).from;
      for (std::size_t k = 0; k < line.segments.size(); ++k) {
        const geometry::TreeSegment& segment = geometry::segment(tree_, line.segments[k]);
        if (segment.to == from) last = std::max(last, s[line.last[k]]);
      }
    }
    return last;
  }

  /// What begins on a vessel that ends before it.
  void leave_out_hanging() {
    std::map<std::int32_t, bool> kept_node;
    for (CarriedLine& line : lines_) {
      if (line.segments.empty()) continue;
      const auto start = kept_node.find(geometry::segment(tree_, line.segments.front()).from);
      if (line.kept > 0 && start != kept_node.end() && !start->second) {
        line.kept = 0;
        line.told.notes.emplace_back("the vessel that it leaves is not carried so far");
      }
      for (std::size_t k = 0; k < line.segments.size(); ++k)
        kept_node[geometry::segment(tree_, line.segments[k]).to] = line.last[k] < line.kept;
    }
  }

  const VesselTree& tree_;
  std::vector<CarriedLine>& lines_;
  const SeenLumen& seen_;
  double within_mm_;
};

/// A line as the image has it, by the abscissas of its mapped points.
struct Pulled {
  std::vector<Vec3> points;
  std::vector<double> radius_mm;
  std::vector<char> seen;
};

/// Feet of a line's points on a way that runs beside it, rising by a quarter of their steps at least; beyond
/// its end where the way is the shorter one.
std::vector<double> feet_along(const std::vector<Vec3>& line, const std::vector<double>& s,
                               const geometry::AxisCurve& way) {
  constexpr double window_mm = 5.0;
  std::vector<double> feet{0.0};
  for (std::size_t i = 1; i < line.size(); ++i) {
    const double step = s[i] - s[i - 1];
    const auto foot = way.foot_near(line[i], feet.back() + step, window_mm);
    feet.push_back(std::max(foot ? foot->s_mm : feet.back() + step, feet.back() + least_step * step));
  }
  return feet;
}

/// Where the image shows nothing, the mapped line, moved as both its neighbours are.
void bridge_unseen(const std::vector<Vec3>& line, const std::vector<double>& s, Pulled& pulled) {
  for (std::size_t i = 0; i < line.size();) {
    if (pulled.seen[i]) {
      ++i;
      continue;
    }
    std::size_t next = i;
    while (next < line.size() && !pulled.seen[next]) ++next;
    const Vec3 before = i > 0 ? Vec3(pulled.points[i - 1] - line[i - 1]) : Vec3(Vec3::Zero());
    const Vec3 behind = next < line.size() ? Vec3(pulled.points[next] - line[next]) : before;
    const double from = i > 0 ? s[i - 1] : s.front(), to = next < line.size() ? s[next] : s.back();
    for (; i < next; ++i) {
      const double t = to > from ? (s[i] - from) / (to - from) : 0.0;
      pulled.points[i] = line[i] + (1.0 - t) * before + t * behind;
    }
  }
}

/// The way beside a line; throws what path_along throws.
Pulled pulled_to(const imaging::ImageVolume& image, const std::vector<Vec3>& line,
                 const std::vector<double>& former_radius_mm, double fixed_mm, double reach_mm,
                 const core::TaskContext& task) {
  segmentation::PathAlongOptions along;
  along.corridor_mm = reach_mm;
  along.fixed_start_mm = fixed_mm;
  const segmentation::MinimalPath way = segmentation::path_along(image, line, along, task);
  const std::vector<double> s = geometry::abscissas(line);
  if (way.length_mm < least_length * s.back() - least_pulled_mm ||
      way.length_mm > most_length * s.back() + least_pulled_mm)
    throw GeometryError("the way along it in the later scan is " + core::mm_text(way.length_mm, 1) +
                        " long, not " + core::mm_text(s.back(), 1));
  geometry::Centerline curve;
  curve.points = way.points;
  curve.radius = way.radius_mm;
  geometry::complete(curve);
  const geometry::AxisCurve axis(curve);
  const std::vector<double> feet = feet_along(line, s, axis);
  Pulled out;
  for (std::size_t i = 0; i < line.size(); ++i) {
    // A dim end is kept: it goes along with what is before it.
    const bool beyond = i > 0 && feet[i] > axis.length();
    out.points.push_back(beyond ? Vec3(line[i] + out.points[i - 1] - line[i - 1]) : axis.point(feet[i]));
    out.radius_mm.push_back(axis.radius(feet[i]));
    const auto at = std::min(way.contrast.size() - 1,
                             static_cast<std::size_t>(std::lround(
                                 feet[i] / axis.length() * static_cast<double>(way.contrast.size() - 1))));
    const bool measured = feet[i] >= fixed_mm;
    out.seen.push_back(!measured || way.contrast[at] >= seen_contrast || way.near_calcium[at] ? 1 : 0);
    if ((out.points[i] - line[i]).norm() > reach_mm + 1.0)
      throw GeometryError("the way along it in the later scan leaves it by " +
                          core::mm_text((out.points[i] - line[i]).norm(), 1));
  }
  close_small_gaps(s, out.seen);
  bridge_unseen(line, s, out);
  for (std::size_t i = 0; i < line.size(); ++i)
    if (!out.seen[i]) out.radius_mm[i] = former_radius_mm[i];
  return out;
}

/// Pulls lines one after the other, parents before what leaves them.
class Pulling {
 public:
  Pulling(const VesselTree& before, std::vector<CarriedLine>& lines, const imaging::ImageVolume& image,
          const CarryOptions& options)
      : before_(before), lines_(lines), image_(image), options_(options) {}

  void pull_all(const core::TaskContext& task) {
    const auto count = static_cast<double>(lines_.size());
    for (std::size_t v = 0; v < lines_.size(); ++v) {
      task.throw_if_cancelled();
      if (lines_[v].kept > 0 && !lines_[v].segments.empty()) pull(lines_[v], task);
      task.set_progress(static_cast<double>(v + 1) / count);
    }
  }

 private:
  void pull(CarriedLine& line, const core::TaskContext& task) {
    line.points.resize(line.kept);
    line.radius_mm.resize(line.kept);
    line.seen.resize(line.kept);
    const std::vector<double> s = geometry::abscissas(line.points);
    const auto joint = joints_.find(geometry::segment(before_, line.segments.front()).from);
    double fixed_mm = ostium_mm;
    if (joint != joints_.end()) {
      const Vec3 moved = joint->second - line.points.front();
      for (std::size_t i = 0; i < line.kept; ++i)
        line.points[i] += std::max(0.0, 1.0 - s[i] / fading_mm) * moved;
      line.points.front() = joint->second;
      fixed_mm = clear_from_mm(line, s);
    }
    follow(line, fixed_mm, task);
    line.told.after_mm = geometry::length(line.points);
    for (std::size_t k = 0; k < line.segments.size(); ++k)
      if (line.last[k] < line.kept)
        joints_[geometry::segment(before_, line.segments[k]).to] = line.points[line.last[k]];
  }

  /// Where a branch is clear of what was pulled before it.
  double clear_from_mm(const CarriedLine& line, const std::vector<double>& s) const {
    std::size_t i = 0;
    const auto clear = [&](const CarriedLine& other) {
      for (std::size_t k = 0; k < other.kept; ++k)
        if ((other.points[k] - line.points[i]).norm() < other.radius_mm[k] + line.radius_mm[i] + clear_mm)
          return false;
      return true;
    };
    while (i + 1 < line.kept &&
           !std::all_of(lines_.begin(), lines_.begin() + static_cast<std::ptrdiff_t>(line.vessel), clear))
      ++i;
    return std::min(s[i], most_fixed_share * s.back());
  }

  void follow(CarriedLine& line, double fixed_mm, const core::TaskContext& task) {
    line.told.how = CarriedHow::as_mapped;
    if (geometry::length(line.points) < fixed_mm + least_pulled_mm) {
      line.told.notes.emplace_back("too short by itself to be pulled to the image");
      return;
    }
    std::string why;
    for (const double reach_mm : {options_.reach_mm, std::min(options_.reach_mm, narrow_reach_mm)}) {
      try {
        take(line, pulled_to(image_, line.points, line.radius_mm, fixed_mm, reach_mm, task.sub(0.0, 0.0)));
        return;
      } catch (const GeometryError& error) {
        why = error.what();
      } catch (const InvalidInput&) {  // in words for one who clicks
        why = "the later scan shows no way along it through lumen, from its beginning to its end";
      }
    }
    line.told.notes.push_back("kept where the map has carried it: " + why);
  }

  static void take(CarriedLine& line, Pulled&& pulled) {
    line.told.how = CarriedHow::followed;
    double sum = 0.0, unseen = 0.0;
    const std::vector<double> s = geometry::abscissas(line.points);
    for (std::size_t i = 0; i < line.points.size(); ++i) {
      const double shift = (pulled.points[i] - line.points[i]).norm();
      sum += shift;
      line.told.largest_shift_mm = std::max(line.told.largest_shift_mm, shift);
      if (i > 0 && !pulled.seen[i]) unseen += s[i] - s[i - 1];
    }
    line.told.shift_mm = sum / static_cast<double>(line.points.size());
    line.told.unseen_mm = unseen;
    if (unseen > 0.0)
      line.told.notes.push_back("no lumen is seen for " + core::mm_text(unseen, 1) +
                                " of it: axis and wall are the former ones there");
    line.points = std::move(pulled.points);
    line.radius_mm = std::move(pulled.radius_mm);
    line.seen = std::move(pulled.seen);
  }

  const VesselTree& before_;
  std::vector<CarriedLine>& lines_;
  const imaging::ImageVolume& image_;
  const CarryOptions& options_;
  std::map<std::int32_t, Vec3> joints_;  // by node
};

/// The kept lines as a tree with the former one's ids.
VesselTree tree_of(const VesselTree& before, const std::vector<CarriedLine>& lines) {
  VesselTree tree;
  std::map<std::int32_t, Vec3> places;
  std::set<std::int32_t> kept;
  for (const CarriedLine& line : lines) {
    std::size_t first = 0;
    for (std::size_t k = 0; k < line.segments.size() && first + 1 < line.kept; ++k) {
      const std::size_t last = std::min(line.last[k], line.kept - 1);
      geometry::TreeSegment segment = geometry::segment(before, line.segments[k]);
      geometry::Centerline axis;
      for (std::size_t i = first; i <= last; ++i) {
        axis.points.push_back(line.points[i]);
        axis.radius.push_back(std::max(line.radius_mm[i], least_radius_mm));
      }
      geometry::complete(axis);
      segment.axis = std::move(axis);
      places.try_emplace(segment.from, line.points[first]);
      places[segment.to] = line.points[last];
      kept.insert(segment.id);
      tree.segments.push_back(std::move(segment));
      first = last;
    }
  }
  for (const geometry::TreeNode& node : before.nodes)
    if (const auto place = places.find(node.id); place != places.end())
      tree.nodes.push_back({node.id, place->second});
  for (std::size_t v = 0; v < before.vessels.size(); ++v) {
    if (lines[v].kept == 0) continue;
    geometry::Vessel vessel = before.vessels[v];
    std::erase_if(vessel.segments, [&](std::int32_t id) { return !kept.contains(id); });
    tree.vessels.push_back(std::move(vessel));
  }
  return tree;
}

}  // namespace

CarriedTree carried_tree(const VesselTree& before, const imaging::ImageVolume& image,
                         const analysis::PointMap& map, const CarryOptions& options,
                         const core::TaskContext& task) {
  CarriedTree out;
  out.lines = own_lines(before);
  map_lines(out.lines, map);
  const SeenLumen seen{image, lumen_of(out.lines, image)};
  Extents(before, out.lines, seen, options.reach_mm).find();
  if (std::ranges::none_of(out.lines, [](const CarriedLine& line) { return line.kept > 0; }))
    throw InvalidInput(
        "the later scan shows none of the vessels where they should be: it is of another patient, or of "
        "another part of the body");
  Pulling(before, out.lines, image, options).pull_all(task);
  out.tree = tree_of(before, out.lines);
  return out;
}

}  // namespace ostia::session
