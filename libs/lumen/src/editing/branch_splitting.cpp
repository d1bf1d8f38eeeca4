// Vessels cut in two, and two made one (docs/methods/axis-editing.md).

#include "editing/edit_kinds.h"
#include "editing/tree_editing.h"
#include "editing/wall_editing.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ostia::lumen {
namespace {

using core::mm_text;
using std::numbers::pi;
/// So far, in spacings of the samples, a part's wall runs on within the other one before it closes.
constexpr double overlap_spacings = 2.0;
constexpr double wall_window_mm = 1.5, wall_step_mm = 0.25;
/// What closes a part stays within this share of the wall, so that it bulges out nowhere.
constexpr double inner_share = 0.85;
constexpr double normal_step = 1e-3;
/// What closes a part keeps this share of the spacing from its other samples.
constexpr double free_share = 0.55;

/// Where a wall is cut.
struct Seam {
  double s_mm = 0.0;        ///< on the axis before
  double spacing_mm = 0.0;  ///< of the samples there
  double overlap_mm = 0.0;
  double height_mm = 0.0;  ///< of what closes a part beyond its overlap
};

const geometry::Vessel& path_of(const geometry::VesselTree& tree, std::int32_t id) {
  const auto found = std::find_if(tree.vessels.begin(), tree.vessels.end(),
                                  [&](const geometry::Vessel& v) { return v.id == id; });
  if (found == tree.vessels.end()) throw InvalidInput("the model has no vessel " + std::to_string(id));
  return *found;
}

const geometry::Vessel& owner_of(const geometry::VesselTree& tree, std::int32_t segment) {
  return *std::find_if(tree.vessels.begin(), tree.vessels.end(), [&](const geometry::Vessel& v) {
    return std::find(v.segments.begin(), v.segments.end(), segment) != v.segments.end();
  });
}

/// The wall of all samples as r(s, theta) between two abscissas.
class WallAround {
 public:
  WallAround(const VesselLumen& lumen, double from_mm, double to_mm, double window_mm) : from_(from_mm) {
    const int cells = std::max(1, static_cast<int>(std::ceil((to_mm - from_mm) / wall_step_mm)));
    step_ = (to_mm - from_mm) / cells;
    for (int i = 0; i <= cells; ++i) {
      const double s = from_mm + step_ * i;
      walls_.push_back(local_wall(*lumen.axis, lumen.samples, s, window_mm, lumen.axis->radius(s)));
    }
  }
  double at(double s_mm, double theta) const {
    const double x = std::clamp((s_mm - from_) / step_, 0.0, static_cast<double>(walls_.size() - 1));
    const std::size_t i = std::min(walls_.size() - 2, static_cast<std::size_t>(x));
    const double t = x - static_cast<double>(i);
    return (1.0 - t) * walls_[i].at(theta) + t * walls_[i + 1].at(theta);
  }

 private:
  double from_, step_ = 1.0;
  std::vector<LocalWall> walls_;
};

/// Half an ellipsoid that leaves the wall at `at_mm` and ends `height_mm` farther on (proximal of it where
/// negative), within the wall all the way: rings about the axis and its tip.
std::vector<SurfaceSample> closing(const AxisCurve& axis, const WallAround& wall, double at_mm,
                                   double height_mm, double spacing_mm) {
  const auto place = [&](double polar, double theta) -> Vec3 {
    const double s = at_mm + height_mm * std::sin(polar);
    return axis.place(s, theta, inner_share * wall.at(s, theta) * std::cos(polar));
  };
  const Vec3 centre = axis.point(at_mm);
  double mean = 0.0;
  for (int k = 0; k < 8; ++k) mean += wall.at(at_mm, 0.25 * pi * k) / 8.0;
  const int steps =
      std::max(2, static_cast<int>(std::lround(0.5 * pi * std::max(mean, std::abs(height_mm)) / spacing_mm)));
  std::vector<SurfaceSample> samples;
  SurfaceSample sample;
  sample.origin = SampleOrigin::cap;
  for (int k = 1; k < steps; ++k) {
    const double polar = 0.5 * pi * k / steps, around = 2.0 * pi * mean * std::cos(polar);
    const int count = std::max(5, static_cast<int>(std::ceil(around / spacing_mm - 1e-6)));
    for (int i = 0; i < count; ++i) {
      const double theta = 2.0 * pi * (i + (k % 2 ? 0.5 : 0.0)) / count;
      sample.position = place(polar, theta);
      const Vec3 along = place(polar + normal_step, theta) - place(polar - normal_step, theta);
      const Vec3 aside = place(polar, theta + normal_step) - place(polar, theta - normal_step);
      sample.normal = along.cross(aside).normalized();
      if (sample.normal.dot(sample.position - centre) < 0.0) sample.normal = -sample.normal;
      sample.s_mm = at_mm + height_mm * std::sin(polar);
      samples.push_back(sample);
    }
  }
  sample.position = axis.point(at_mm + height_mm);
  sample.normal = (height_mm > 0.0 ? 1.0 : -1.0) * axis.frame(at_mm + height_mm).tangent;
  sample.s_mm = at_mm + height_mm;
  samples.push_back(sample);
  return samples;
}

/// The seam at s; throws InvalidInput where a part would be shorter than what closes the other.
Seam seam_at(const VesselLumen& lumen, double s_mm, const std::string& what) {
  const double from = lumen.own_from_mm, to = lumen.axis->length();
  Seam seam;
  const double inside = std::isfinite(s_mm) ? std::clamp(s_mm, from, to) : from;
  const double radius =
      local_wall(*lumen.axis, lumen.samples, inside, wall_window_mm, lumen.axis->radius(inside)).mean_mm;
  seam.spacing_mm = sample_spacing_mm(lumen, radius);
  const double least = radius + seam.spacing_mm;
  if (!(s_mm >= from + least) || !(s_mm <= to - least)) {
    const std::string where =
        what + ": the place at " + mm_text(s_mm) + " is not within the vessel's own stretch";
    if (to - from < 2.0 * least)
      throw InvalidInput(where + ", and that is too short to be split, " + mm_text(from) + " to " +
                         mm_text(to) + "; each part needs " + mm_text(least));
    throw InvalidInput(where + " or too near to its end; choose " + mm_text(from + least) + " to " +
                       mm_text(to - least));
  }
  seam.s_mm = s_mm;
  seam.overlap_mm = overlap_spacings * seam.spacing_mm;
  const double room = std::min(s_mm - from, to - s_mm);
  seam.overlap_mm = std::min(seam.overlap_mm, 0.5 * room);
  seam.height_mm = std::min(radius, 0.95 * (room - seam.overlap_mm));
  return seam;
}

/// The samples of one part: its own, copies of those next to it on the other part, and what closes it there.
/// The part's axis begins at `from_mm` of the one before.
std::vector<SurfaceSample> part_of(TreeEdit& tree, const VesselLumen& before, const VesselLumen& after,
                                   const Seam& seam, bool proximal, double from_mm = 0.0) {
  const double sign = proximal ? 1.0 : -1.0;
  const auto beyond_mm = [&](const SurfaceSample& s) { return sign * (s.s_mm - seam.s_mm); };
  const auto own = [&](const SurfaceSample& s) { return (s.s_mm <= seam.s_mm) == proximal; };
  VesselLumen part = before;
  std::erase_if(part.samples, [&](const SurfaceSample& s) { return !own(s); });
  if (part.samples.empty())
    throw InvalidInput("no sample would be left of " + std::string(proximal ? "the proximal" : "the distal") +
                       " part; split it elsewhere");
  std::vector<SurfaceSample> samples = standing_samples_from(part, after, from_mm);
  const auto add = [&](SurfaceSample sample) {
    sample.id = tree.new_sample_id();
    sample.origin = SampleOrigin::cap;
    const double reach = 1.0 + (sample.position - before.axis->point(sample.s_mm)).norm();
    const double guess = std::clamp(sample.s_mm - from_mm, 0.0, after.axis->length());
    sample.s_mm = refound(*after.axis, sample.position, guess, reach);
    samples.push_back(sample);
  };
  for (const SurfaceSample& sample : before.samples) {
    if (!own(sample) && sample.origin != SampleOrigin::cap && beyond_mm(sample) <= seam.overlap_mm)
      add(sample);
  }
  const double at = seam.s_mm + sign * seam.overlap_mm, height = sign * seam.height_mm;
  const WallAround wall(before, std::min(at, at + height), std::max(at, at + height), seam.spacing_mm);
  const double least = free_share * seam.spacing_mm;
  const std::size_t standing = samples.size();
  for (const SurfaceSample& sample : closing(*before.axis, wall, at, height, seam.spacing_mm)) {
    const bool crowded = std::any_of(
        samples.begin(), samples.begin() + static_cast<std::ptrdiff_t>(standing),
        [&](const SurfaceSample& s) { return (s.position - sample.position).squaredNorm() < least * least; });
    if (!crowded) add(sample);
  }
  return samples;
}

std::string new_name(const LumenModel& model, std::int32_t vessel, const std::string& wanted_name) {
  if (!wanted_name.empty()) return wanted_name;
  const std::string name = path_of(model.tree, vessel).name + " distal";
  const auto in_use = [&](const std::string& wanted) {
    return std::any_of(model.tree.vessels.begin(), model.tree.vessels.end(),
                       [&](const geometry::Vessel& v) { return v.name == wanted; });
  };
  std::string free = name;
  for (int k = 2; in_use(free); ++k) free = name + " " + std::to_string(k);
  return free;
}

/// A vessel that has become two.
struct TwoParts {
  Seam seam;
  std::int32_t node = 0, distal = 0;  ///< where, and the new vessel
  std::size_t keep = 0;               ///< segments of the way that both have
};

TwoParts in_two(TreeEdit& tree, std::int32_t id, double s_mm, const std::string& wanted_name) {
  const LumenModel& model = tree.before();
  const std::string name = new_name(model, id, wanted_name);
  check_name(model, name, -1, tree.what());
  const VesselLumen& lumen = vessel(model, id);
  TwoParts parts;
  parts.seam = seam_at(lumen, s_mm, tree.what());
  parts.node = tree.split(id, tree.locate(id, s_mm));
  const Vec3 at = tree.node(parts.node).position;
  if (const auto foot = lumen.axis->foot_near(at, s_mm, 1.0)) parts.seam.s_mm = foot->s_mm;

  std::vector<geometry::Vessel>& vessels = tree.tree().vessels;
  const auto proximal =
      std::find_if(vessels.begin(), vessels.end(), [&](const geometry::Vessel& v) { return v.id == id; });
  geometry::Vessel distal{tree.new_tree_id(), name, proximal->segments};
  parts.keep = 1;
  while (parts.keep < distal.segments.size() &&
         tree.segment(distal.segments[parts.keep - 1]).to != parts.node)
    ++parts.keep;
  if (parts.keep >= distal.segments.size())
    throw InvalidInput(tree.what() + ": the axis has an end at " + mm_text(s_mm) + "; split it elsewhere");
  parts.distal = distal.id;
  proximal->segments.resize(parts.keep);
  tree.made_from(distal.id, model.vessels[static_cast<std::size_t>(proximal - vessels.begin())]);
  vessels.insert(proximal + 1, std::move(distal));  // before what leaves it: it owns its segments
  tree.way_changed(id);
  return parts;
}

/// Makes the two segments at a node one, where it is the end of one and the beginning of one other that the
/// same vessels pass.
void fuse(TreeEdit& tree, std::int32_t node) {
  std::vector<std::int32_t> in, out;
  for (const geometry::TreeSegment& s : tree.tree().segments) {
    if (s.to == node) in.push_back(s.id);
    if (s.from == node) out.push_back(s.id);
  }
  if (in.size() != 1 || out.size() != 1 || tree.through(in) != tree.through(out)) return;
  geometry::TreeSegment& first = tree.segment(in.front());
  const geometry::TreeSegment& second = tree.segment(out.front());
  const Vec3 normal = first.axis.frames.empty() ? Vec3(Vec3::Zero()) : first.axis.frames.front().normal;
  first.axis.points.insert(first.axis.points.end(), second.axis.points.begin() + 1, second.axis.points.end());
  first.axis.radius.insert(first.axis.radius.end(), second.axis.radius.begin() + 1, second.axis.radius.end());
  geometry::complete(first.axis, normal);
  first.to = second.to;
  std::erase_if(tree.tree().segments, [&](const geometry::TreeSegment& s) { return s.id == out.front(); });
  for (geometry::Vessel& v : tree.tree().vessels)
    std::erase_if(v.segments, [&](std::int32_t s) { return s == out.front(); });
}

/// The walls of both as one, on the distal one's axis, without what closed them towards each other.
std::shared_ptr<const VesselLumen> joined(const VesselLumen& parent, const VesselLumen& child) {
  auto both = std::make_shared<VesselLumen>(child);
  both->vessel = parent.vessel;
  both->own_from_mm = parent.own_from_mm;
  both->interpolation = parent.interpolation;
  both->interpolation.support_radius_mm =
      std::max(parent.interpolation.support_radius_mm, child.interpolation.support_radius_mm);
  const double middle = 0.5 * (child.own_from_mm + child.axis->length());
  std::erase_if(both->samples,
                [&](const SurfaceSample& s) { return s.origin == SampleOrigin::cap && s.s_mm < middle; });
  VesselLumen open = parent;
  const double half = 0.5 * (parent.own_from_mm + parent.axis->length());
  std::erase_if(open.samples,
                [&](const SurfaceSample& s) { return s.origin == SampleOrigin::cap && s.s_mm > half; });
  const std::vector<SurfaceSample> proximal = standing_samples(open, child);
  both->samples.insert(both->samples.end(), proximal.begin(), proximal.end());
  return both;
}

}  // namespace

std::optional<std::int32_t> merge_parent(const geometry::VesselTree& tree, std::int32_t vessel) {
  const geometry::Vessel& path = path_of(tree, vessel);
  std::size_t shared = 0;
  while (shared < path.segments.size() && owner_of(tree, path.segments[shared]).id != vessel) ++shared;
  if (shared == 0 || shared == path.segments.size()) return std::nullopt;
  const geometry::Vessel& parent = owner_of(tree, path.segments[shared - 1]);
  if (parent.segments.back() != path.segments[shared - 1]) return std::nullopt;
  return parent.id;
}

bool leads_through(const geometry::VesselTree& tree, std::int32_t vessel, std::int32_t other) {
  static_cast<void>(path_of(tree, other));
  const std::vector<std::int32_t>& way = path_of(tree, vessel).segments;
  return std::any_of(way.begin(), way.end(),
                     [&](std::int32_t segment) { return owner_of(tree, segment).id == other; });
}

EditOutcome apply_to(const LumenModel& model, const BranchSplit& edit) {
  TreeEdit tree(model, "branch.split", edit.vessel);
  const TwoParts parts = in_two(tree, edit.vessel, edit.s_mm, edit.name);
  return std::move(tree).finish([&](const VesselLumen& before, const VesselLumen& after) {
    if (before.vessel != edit.vessel) return standing_samples(before, after);
    return part_of(tree, before, after, parts.seam, after.vessel == edit.vessel);
  });
}

EditOutcome apply_to(const LumenModel& model, const BranchCut& edit) {
  TreeEdit tree(model, "branch.cut", edit.vessel);
  const TwoParts parts = in_two(tree, edit.vessel, edit.s_mm, edit.name);
  // What lies distal begins at a node of its own, at the same place.
  const std::int32_t first = tree.vessel(parts.distal).segments[parts.keep];
  const geometry::TreeNode root{tree.new_tree_id(), tree.node(parts.node).position};
  tree.tree().nodes.push_back(root);
  tree.segment(first).from = root.id;
  const std::set<std::int32_t> off = tree.through({first});
  for (geometry::Vessel& v : tree.tree().vessels) {
    if (!off.contains(v.id)) continue;
    v.segments.erase(v.segments.begin(), std::find(v.segments.begin(), v.segments.end(), first));
    tree.way_changed(v.id);
  }
  return std::move(tree).finish([&](const VesselLumen& before, const VesselLumen& after) {
    if (!off.contains(after.vessel)) {
      if (before.vessel != edit.vessel) return standing_samples(before, after);
      return part_of(tree, before, after, parts.seam, true);
    }
    const double from = before.axis->length() - after.axis->length();
    if (before.vessel != edit.vessel) return standing_samples_from(before, after, from);
    return part_of(tree, before, after, parts.seam, false, from);
  });
}

EditOutcome apply_to(const LumenModel& model, const BranchMerge& edit) {
  TreeEdit tree(model, "branch.merge", edit.vessel);
  const auto parent = merge_parent(model.tree, edit.vessel);
  if (!parent)
    throw InvalidInput(tree.what() +
                       ": it does not go on from the end of another vessel; only a vessel that begins where "
                       "another ends can be joined with it");
  const std::int32_t node = tree.segment(tree.vessel(*parent).segments.back()).to;
  tree.vessel(*parent).segments = tree.vessel(edit.vessel).segments;
  tree.drop({edit.vessel});
  tree.made_from(*parent, joined(vessel(model, *parent), vessel(model, edit.vessel)));
  fuse(tree, node);
  return std::move(tree).finish(standing_samples);
}

}  // namespace ostia::lumen
