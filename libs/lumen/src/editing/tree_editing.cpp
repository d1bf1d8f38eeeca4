#include "editing/tree_editing.h"

#include "editing/wall_editing.h"
#include "start/start_walls.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace ostia::lumen {
namespace {

constexpr double map_step_mm = 0.5, map_window_mm = 4.0;
/// A node is put on a control point that is so near.
constexpr double node_snap_mm = 0.3;
/// Abscissas that differ by less are the same: the rounding of a foot found twice.
constexpr double same_abscissa_mm = 1e-9;
/// New wall keeps this share of the spacing from what stands.
constexpr double free_end_share = 0.55;

template <class Items>
auto& item(Items& items, std::int32_t id, const char* kind) {
  const auto found = std::find_if(items.begin(), items.end(), [&](const auto& i) { return i.id == id; });
  if (found == items.end())
    throw InvalidInput("the model has no " + std::string(kind) + " " + std::to_string(id));
  return *found;
}

geometry::Centerline cut(const geometry::Centerline& line, std::size_t first, std::size_t last) {
  geometry::Centerline part;
  for (std::size_t i = first; i <= last; ++i) {
    part.points.push_back(line.points[i]);
    part.radius.push_back(line.radius[i]);
  }
  geometry::complete(part, line.frames.empty() ? Vec3(Vec3::Zero()) : line.frames[first].normal);
  return part;
}

bool same(const SurfaceSample& a, const SurfaceSample& b) {
  return a.position == b.position && a.normal == b.normal && a.s_mm == b.s_mm && a.origin == b.origin;
}

/// What an edit made of one vessel's samples.
VesselChange change_of(std::int32_t vessel, const std::vector<SurfaceSample>& before,
                       const std::vector<SurfaceSample>& after) {
  VesselChange change;
  change.vessel = vessel;
  change.axis_changed = true;
  std::map<std::int64_t, const SurfaceSample*> old;
  for (const SurfaceSample& sample : before) old.emplace(sample.id, &sample);
  for (const SurfaceSample& sample : after) {
    const auto found = old.find(sample.id);
    if (found != old.end() && same(*found->second, sample)) {
      old.erase(found);
      continue;
    }
    change.added.push_back(sample);
  }
  for (const SurfaceSample& sample : before) {
    if (old.contains(sample.id)) change.removed.push_back(sample.id);
  }
  return change;
}

}  // namespace

AbscissaMap::AbscissaMap(const AxisCurve& before, const AxisCurve& after,
                         const std::function<Vec3(double)>& went, double from_mm, double to_mm)
    : from_(from_mm) {
  const double length = std::max(1e-6, before.length() - from_mm);
  const int cells = std::max(1, static_cast<int>(std::ceil(length / map_step_mm)));
  step_ = length / cells;
  double guess = to_mm;
  Vec3 last = went(from_mm);
  for (int i = 0; i <= cells; ++i) {
    const Vec3 place = went(from_mm + step_ * i);
    guess += (place - last).norm();
    last = place;
    const auto foot = after.foot_near(place, guess, map_window_mm);
    guess = foot ? foot->s_mm : std::min(guess, after.length());
    values_.push_back(guess);
  }
}

double AbscissaMap::operator()(double s_mm) const {
  const double x = (s_mm - from_) / step_;
  if (x <= 0.0) return values_.front() + (s_mm - from_);
  const auto i = std::min(values_.size() - 2, static_cast<std::size_t>(x));
  const double t = std::min(1.0, x - static_cast<double>(i));
  return (1.0 - t) * values_[i] + t * values_[i + 1];
}

double refound(const AxisCurve& axis, const Vec3& place, double guess_mm, double reach_mm) {
  const auto foot = axis.foot_near(place, guess_mm, reach_mm);
  const double s = foot ? foot->s_mm : std::clamp(guess_mm, 0.0, axis.length());
  return s;
}

double LocalWall::at(double theta) const {
  double r = mean_mm;
  for (int k = 0; k < 2; ++k)
    r += harmonics[2 * k] * std::cos((k + 1) * theta) + harmonics[2 * k + 1] * std::sin((k + 1) * theta);
  return std::max(0.3 * mean_mm, r);
}

LocalWall local_wall(const AxisCurve& axis, const std::vector<SurfaceSample>& samples, double s_mm,
                     double window_mm, double fallback_mm) {
  Eigen::Matrix<double, 5, 5> system = Eigen::Matrix<double, 5, 5>::Zero();
  Eigen::Matrix<double, 5, 1> right = Eigen::Matrix<double, 5, 1>::Zero();
  int count = 0;
  double sum = 0.0;
  for (const SurfaceSample& sample : samples) {
    if (sample.origin == SampleOrigin::cap || std::abs(sample.s_mm - s_mm) > window_mm) continue;
    const Vec3 offset = sample.position - axis.point(sample.s_mm);
    const double theta = geometry::angle_of(axis.frame(sample.s_mm), offset), rho = offset.norm();
    Eigen::Matrix<double, 5, 1> row;
    row << 1.0, std::cos(theta), std::sin(theta), std::cos(2.0 * theta), std::sin(2.0 * theta);
    system += row * row.transpose();
    right += rho * row;
    sum += rho;
    ++count;
  }
  LocalWall wall;
  wall.mean_mm = count > 0 ? sum / count : fallback_mm;
  if (count < 6) return wall;
  for (int k = 1; k < 5; ++k) system(k, k) += 0.5;  // sides that no sample tells of stay round
  const Eigen::Matrix<double, 5, 1> found = system.ldlt().solve(right);
  wall.mean_mm = found[0];
  wall.harmonics = {found[1], found[2], found[3], found[4]};
  return wall;
}

void check_name(const LumenModel& model, const std::string& name, std::int32_t self,
                const std::string& what) {
  const bool blank = std::all_of(name.begin(), name.end(), [](unsigned char c) { return c <= ' '; });
  const bool control =
      std::any_of(name.begin(), name.end(), [](unsigned char c) { return c < ' ' || c == 127; });
  if (blank || control) throw InvalidInput(what + ": a vessel needs a name of printable characters");
  for (const geometry::Vessel& v : model.tree.vessels) {
    if (v.id != self && v.name == name)
      throw InvalidInput(what + ": the name " + name + " is in use by vessel " + std::to_string(v.id) +
                         "; choose another");
  }
}

TreeEdit::TreeEdit(const LumenModel& before, const std::string& op, std::int32_t vessel)
    : before_(&before), after_(before) {
  what_ = op + " on " + vessel_label(item(after_.tree.vessels, vessel, "vessel"));
}

TreeEdit::TreeEdit(const LumenModel& before, const std::string& op)
    : before_(&before), after_(before), what_(op) {}

std::string TreeEdit::names_of(const std::set<std::int32_t>& vessels) {
  std::string names;
  for (const std::int32_t id : vessels) {
    const std::string& name = vessel(id).name;
    names += (names.empty() ? "" : ", ") + (name.empty() ? "vessel " + std::to_string(id) : name);
  }
  return names;
}

geometry::TreeSegment& TreeEdit::segment(std::int32_t id) {
  return item(after_.tree.segments, id, "segment");
}
geometry::Vessel& TreeEdit::vessel(std::int32_t id) {
  return item(after_.tree.vessels, id, "vessel");
}
geometry::TreeNode& TreeEdit::node(std::int32_t id) {
  return item(after_.tree.nodes, id, "node");
}

void TreeEdit::axis_changed(std::int32_t id) {
  geometry::Centerline& axis = segment(id).axis;
  for (std::size_t i = 1; i < axis.points.size(); ++i) {
    if (!((axis.points[i] - axis.points[i - 1]).norm() > 1e-6))
      throw InvalidInput(what_ + ": two points of the axis would coincide; choose another place");
  }
  geometry::complete(axis, axis.frames.empty() ? Vec3(Vec3::Zero()) : axis.frames.front().normal);
  for (const std::int32_t v : through({id})) rebuilt_.insert(v);
}

std::set<std::int32_t> TreeEdit::through(const std::vector<std::int32_t>& segments) const {
  std::set<std::int32_t> found;
  for (const geometry::Vessel& v : after_.tree.vessels) {
    for (const std::int32_t id : v.segments) {
      if (std::find(segments.begin(), segments.end(), id) != segments.end()) found.insert(v.id);
    }
  }
  return found;
}

std::vector<std::int32_t> TreeEdit::own_segments(std::int32_t id) const {
  std::set<std::int32_t> taken;
  for (const geometry::Vessel& v : after_.tree.vessels) {
    if (v.id != id) {
      taken.insert(v.segments.begin(), v.segments.end());
      continue;
    }
    std::vector<std::int32_t> own;
    for (const std::int32_t s : v.segments) {
      if (!taken.contains(s)) own.push_back(s);
    }
    return own;
  }
  return {};
}

void TreeEdit::drop(const std::set<std::int32_t>& vessels) {
  std::erase_if(after_.tree.vessels, [&](const geometry::Vessel& v) { return vessels.contains(v.id); });
  std::erase_if(after_.vessels, [&](const auto& v) { return vessels.contains(v->vessel); });
}

void TreeEdit::prune() {
  std::set<std::int32_t> bare, passed, joined;  // segments that no vessel passed before stay
  for (const geometry::TreeSegment& s : before_->tree.segments) bare.insert(s.id);
  for (const geometry::Vessel& v : before_->tree.vessels) {
    for (const std::int32_t s : v.segments) bare.erase(s);
  }
  for (const geometry::Vessel& v : after_.tree.vessels) passed.insert(v.segments.begin(), v.segments.end());
  std::erase_if(after_.tree.segments, [&](const geometry::TreeSegment& s) {
    return !passed.contains(s.id) && !bare.contains(s.id);
  });
  for (const geometry::TreeSegment& s : after_.tree.segments) joined.insert({s.from, s.to});
  std::erase_if(after_.tree.nodes, [&](const geometry::TreeNode& n) { return !joined.contains(n.id); });
}

TreePlace TreeEdit::locate(std::int32_t id, double s_mm) const {
  const AxisCurve& axis = *lumen::vessel(*before_, id).axis;
  const auto& path = item(after_.tree.vessels, id, "vessel").segments;
  double chords = 0.0;
  for (const std::int32_t s : path) chords += geometry::segment(after_.tree, s).axis.abscissa.back();
  TreePlace place;
  place.s_mm = s_mm;
  double left = s_mm * chords / axis.length();
  for (std::size_t i = 0; i < path.size(); ++i) {
    const double length = geometry::segment(after_.tree, path[i]).axis.abscissa.back();
    place.segment = i;
    place.along_mm = std::clamp(left, 0.0, length);
    if (left <= length) break;
    left -= length;
  }
  return place;
}

TreePlace TreeEdit::locate(std::int32_t id, const Vec3& where) const {
  if (!where.allFinite()) throw InvalidInput(what_ + ": a place is not finite");
  const AxisCurve& axis = *lumen::vessel(*before_, id).axis;
  const geometry::AxisFoot foot = axis.nearest_foot(where);
  if (foot.rho_mm > farthest_from_axis_mm)
    throw InvalidInput(what_ + ": a place is " + core::mm_text(foot.rho_mm) + " from the axis of vessel " +
                       std::to_string(id) + "; choose one within " + core::mm_text(farthest_from_axis_mm));
  TreePlace place = locate(id, foot.s_mm);
  place.off_mm = foot.rho_mm;
  place.past_end = foot.past_end;
  return place;
}

std::int32_t TreeEdit::split(std::int32_t id, const TreePlace& place) {
  const std::int32_t old_id = vessel(id).segments[place.segment];
  geometry::TreeSegment& old = segment(old_id);
  const auto upper = std::lower_bound(old.axis.abscissa.begin(), old.axis.abscissa.end(), place.along_mm);
  auto at = static_cast<std::size_t>(upper - old.axis.abscissa.begin());
  at = std::min(at, old.axis.size() - 1);
  if (at > 0 && place.along_mm - old.axis.abscissa[at - 1] < old.axis.abscissa[at] - place.along_mm) --at;
  if (std::abs(old.axis.abscissa[at] - place.along_mm) > node_snap_mm) {
    // On the smooth axis, so that it runs as before.
    const AxisCurve& axis = *lumen::vessel(*before_, id).axis;
    at = static_cast<std::size_t>(upper - old.axis.abscissa.begin());
    old.axis.points.insert(old.axis.points.begin() + static_cast<std::ptrdiff_t>(at), axis.point(place.s_mm));
    old.axis.radius.insert(old.axis.radius.begin() + static_cast<std::ptrdiff_t>(at),
                           axis.radius(place.s_mm));
    axis_changed(old_id);
  }
  if (at == 0) return old.from;
  if (at + 1 == old.axis.size()) return old.to;
  const std::int32_t middle = new_tree_id();
  geometry::TreeSegment distal;
  distal.id = new_tree_id();
  distal.from = middle;
  distal.to = old.to;
  distal.axis = cut(old.axis, at, old.axis.size() - 1);
  const Vec3 position = old.axis.points[at];
  old.axis = cut(old.axis, 0, at);
  old.to = middle;
  after_.tree.nodes.push_back({middle, position});
  const std::int32_t distal_id = distal.id;
  after_.tree.segments.push_back(std::move(distal));
  for (geometry::Vessel& v : after_.tree.vessels) {
    const auto found = std::find(v.segments.begin(), v.segments.end(), old_id);
    if (found != v.segments.end()) v.segments.insert(found + 1, distal_id);
  }
  return middle;
}

std::shared_ptr<const VesselLumen> TreeEdit::built(const geometry::Vessel& path, const VesselLumen* old,
                                                   const Samples& samples) {
  VesselLumen lumen;
  lumen.vessel = path.id;
  if (old) {
    lumen.axis = checked_axis(after_.tree, path);
    lumen.own_from_mm = own_from_mm(after_.tree, path.id);
    lumen.interpolation = old->interpolation;
    lumen.samples = samples(*old, lumen);
    std::stable_sort(lumen.samples.begin(), lumen.samples.end(), canonical_order);
    if (lumen.samples.empty())
      throw InvalidInput(what_ + ": no sample of " + vessel_label(path) + " would be left");
    return std::make_shared<const VesselLumen>(std::move(lumen));
  }
  const StartVessel start = start_vessel(after_.tree, path);
  lumen.axis = start.axis;
  lumen.own_from_mm = start.own_from_mm;
  const auto wall = walls_.find(path.id);
  lumen.samples =
      samples_of(*start.axis, wall == walls_.end() ? tube_of(start) : wall_of(wall->second, start),
                 start.own_from_mm, start.axis->length(), after_.next_sample_id);
  after_.next_sample_id += static_cast<std::int64_t>(lumen.samples.size());
  lumen.interpolation.support_radius_mm = default_support_radius(lumen.samples);
  return std::make_shared<const VesselLumen>(std::move(lumen));
}

EditOutcome TreeEdit::finish(const Samples& samples) && {
  try {
    prune();
    if (auto fault = geometry::find_fault(after_.tree))
      throw InvalidInput("the tree would be unsound: " + *fault);
    std::map<std::int32_t, std::shared_ptr<const VesselLumen>> old, kept;
    for (const auto& v : before_->vessels) old.emplace(v->vessel, v);
    for (const auto& v : after_.vessels) kept.emplace(v->vessel, v);
    EditOutcome outcome;
    std::vector<std::shared_ptr<const VesselLumen>> made;
    for (const geometry::Vessel& path : after_.tree.vessels) {
      const auto found = kept.find(path.id);
      if (found != kept.end() && !rebuilt_.contains(path.id)) {
        made.push_back(found->second);
        continue;
      }
      const VesselLumen* before = found == kept.end() ? nullptr : found->second.get();
      const auto source = sources_.find(path.id);
      made.push_back(built(path, source == sources_.end() ? before : source->second.get(), samples));
      outcome.changes.push_back(
          change_of(path.id, before ? before->samples : std::vector<SurfaceSample>{}, made.back()->samples));
    }
    for (const auto& [id, lumen] : old) {
      if (!kept.contains(id)) outcome.changes.push_back(change_of(id, lumen->samples, {}));
    }
    std::stable_sort(outcome.changes.begin(), outcome.changes.end(),
                     [](const VesselChange& a, const VesselChange& b) { return a.vessel < b.vessel; });
    after_.vessels = std::move(made);
    outcome.model = std::move(after_);
    outcome.notes = std::move(notes);
    return outcome;
  } catch (const InvalidInput& error) {
    const std::string message = error.what();
    if (message.starts_with(what_)) throw;
    throw InvalidInput(what_ + ": " + message);
  }
}

void grow(TreeEdit& edit, const VesselLumen& lumen, const NewStretch& stretch,
          std::vector<SurfaceSample>& samples) {
  double mean = 0.0;
  for (int k = 0; k < 8; ++k) mean += stretch.wall(stretch.to_mm, 0.25 * k * std::numbers::pi) / 8.0;
  SamplingOptions options;  // as dense as the wall that stands
  options.spacing_mm = std::clamp(sample_spacing_mm(lumen, mean), 0.2, 5.0);
  options.least_spacing_mm = std::min(options.least_spacing_mm, options.spacing_mm);
  const double around = 2.0 * std::numbers::pi * mean / options.least_around;
  const double least = free_end_share * std::min(options.spacing_mm, around);
  const std::size_t standing = samples.size();
  const double middle = 0.5 * (stretch.from_mm + stretch.to_mm);
  for (SurfaceSample sample :
       samples_of(*lumen.axis, stretch.wall, stretch.from_mm, stretch.to_mm, 1, options)) {
    const bool wanted = sample.s_mm < middle ? stretch.cap_before : stretch.cap_beyond;
    if (sample.origin == SampleOrigin::cap && !wanted) continue;
    const bool crowded = std::any_of(
        samples.begin(), samples.begin() + static_cast<std::ptrdiff_t>(standing),
        [&](const SurfaceSample& s) { return (s.position - sample.position).squaredNorm() < least * least; });
    if (crowded) continue;
    sample.id = edit.new_sample_id();
    samples.push_back(sample);
  }
}

std::vector<SurfaceSample> standing_samples(const VesselLumen& before, const VesselLumen& after) {
  return standing_samples_from(before, after, 0.0);
}

std::vector<SurfaceSample> standing_samples_from(const VesselLumen& before, const VesselLumen& after,
                                                 double from_mm) {
  const AbscissaMap map(
      *before.axis, *after.axis, [&](double s) { return before.axis->point(s); }, from_mm, 0.0);
  std::vector<SurfaceSample> samples = before.samples;
  for (SurfaceSample& sample : samples) {
    const double reach = 1.0 + (sample.position - before.axis->point(sample.s_mm)).norm();
    const double s = refound(*after.axis, sample.position, map(sample.s_mm), reach);
    if (std::abs(s - sample.s_mm) > same_abscissa_mm) sample.s_mm = s;
  }
  return samples;
}

}  // namespace ostia::lumen
