#include "follow_up/carry_notes.h"

#include "ostia/geometry/polyline.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace ostia::session {
namespace {

using geometry::Vec3;

constexpr double goes_along_mm = 10.0;  // from an axis: a place that is pulled with it
constexpr double least_carried_mm = 0.5;

/// Where places and abscissas of one vessel have gone.
class CarriedPlaces {
 public:
  CarriedPlaces(const geometry::VesselTree& before, const geometry::VesselTree& after, std::int32_t vessel) {
    const auto was = std::ranges::find(before.vessels, vessel, &geometry::Vessel::id);
    const auto is = std::ranges::find(after.vessels, vessel, &geometry::Vessel::id);
    if (was == before.vessels.end() || is == after.vessels.end()) return;
    before_ = geometry::vessel_axis(before, *was);
    after_ = geometry::vessel_axis(after, *is);
    count_ = std::min(before_.size(), after_.size());
  }
  bool carried() const { return count_ > 1; }

  /// Nothing beyond what is carried.
  std::optional<double> abscissa(double s_mm) const {
    if (!carried() || s_mm < 0.0 || s_mm > before_.abscissa[count_ - 1] + 1e-6) return std::nullopt;
    const auto next = std::lower_bound(before_.abscissa.begin(),
                                       before_.abscissa.begin() + static_cast<std::ptrdiff_t>(count_), s_mm);
    const auto i = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(
        next - before_.abscissa.begin(), 1, static_cast<std::ptrdiff_t>(count_) - 1));
    const double t = std::clamp(
        (s_mm - before_.abscissa[i - 1]) / (before_.abscissa[i] - before_.abscissa[i - 1]), 0.0, 1.0);
    return after_.abscissa[i - 1] + t * (after_.abscissa[i] - after_.abscissa[i - 1]);
  }

  /// The part of a stretch that is carried.
  std::optional<std::pair<double, double>> stretch(double from_mm, double to_mm) const {
    if (!carried()) return std::nullopt;
    const auto from = abscissa(from_mm), to = abscissa(std::min(to_mm, before_.abscissa[count_ - 1]));
    if (!from || !to || *to - *from < least_carried_mm) return std::nullopt;
    return std::pair(*from, *to);
  }

  /// A place by the map, and pulled as the axis near it is.
  Vec3 place(const Vec3& before, const analysis::PointMap& map) const {
    const Vec3 mapped = map(before);
    if (!carried()) return mapped;
    const std::vector<Vec3> points(before_.points.begin(),
                                   before_.points.begin() + static_cast<std::ptrdiff_t>(count_));
    const geometry::PolylineLocation foot = geometry::closest(points, before);
    if ((foot.point - before).norm() > goes_along_mm) return mapped;
    const Vec3 there = after_.points[foot.segment] +
                       foot.t * (after_.points[foot.segment + 1] - after_.points[foot.segment]);
    return mapped + there - map(foot.point);
  }

 private:
  geometry::Centerline before_, after_;
  std::size_t count_ = 0;
};

std::string carried_words(const CarriedVessel& told) {
  std::string text = "carried from the former scan, not checked";
  for (const std::string& note : told.notes) text += "; " + note;
  return text;
}

VesselMark carried_mark(const VesselMark& was, const CarriedVessel& told, const CarriedPlaces& places,
                        std::vector<std::string>& not_carried) {
  VesselMark mark;
  mark.vessel = was.vessel;
  mark.visible = was.visible;
  mark.color = was.color;
  mark.note = (was.note.empty() ? "" : was.note + "; ") + carried_words(told);
  for (const LesionWord& word : was.lesions) {
    const auto stretch = places.stretch(word.from_mm, word.to_mm);
    if (!stretch) {
      not_carried.push_back("the reader's word on a lesion of " + told.name + ": its place is not carried");
      continue;
    }
    LesionWord carried = word;
    carried.from_mm = stretch->first;
    carried.to_mm = stretch->second;
    carried.state = LesionState::open;
    if (word.state != LesionState::open)
      carried.comment = to_string(word.state) + " in the former scan" +
                        (word.comment.empty() ? std::string() : ": " + word.comment);
    mark.lesions.push_back(carried);
  }
  if (!was.evaluable.empty())
    not_carried.push_back("the reader's word on how far " + told.name +
                          " can be judged: it is of the former image");
  return mark;
}

std::optional<analysis::Measurement> carried_measurement(const analysis::Measurement& was,
                                                         const CarriedPlaces& places,
                                                         const analysis::PointMap& map) {
  analysis::Measurement one = was;
  for (Vec3& point : one.points) point = places.place(point, map);
  if (!needs_vessel(was)) return one;
  const auto from = places.abscissa(was.from_mm), to = places.abscissa(was.to_mm);
  if (!places.carried() || !from || !to) return std::nullopt;
  one.from_mm = *from;
  one.to_mm = *to;
  return one;
}

/// The vessel that a measurement stands on, or that is nearest to its first place.
std::int32_t vessel_near(const analysis::Measurement& one, const geometry::VesselTree& tree) {
  if (needs_vessel(one) || one.points.empty()) return one.vessel;
  std::int32_t nearest = one.vessel;
  double least_mm = goes_along_mm;
  for (const geometry::Vessel& vessel : tree.vessels) {
    const geometry::PolylineLocation foot =
        geometry::closest(geometry::vessel_axis(tree, vessel).points, one.points.front());
    const double off_mm = (foot.point - one.points.front()).norm();
    if (off_mm >= least_mm) continue;
    least_mm = off_mm;
    nearest = vessel.id;
  }
  return nearest;
}

std::string name_of_measurement(const analysis::Measurement& one) {
  return one.name.empty() ? "measurement " + std::to_string(one.id) : "\"" + one.name + "\"";
}

}  // namespace

Annotations carried_notes(const lumen::LumenModel& before, const Annotations& annotations,
                          const CarriedTree& carried, const analysis::PointMap& map,
                          std::vector<std::string>& not_carried) {
  Annotations out;
  for (const CarriedLine& line : carried.lines) {
    const VesselMark was = mark_or_new(annotations, line.told.vessel);
    if (line.kept == 0) {
      if (find_mark(annotations, line.told.vessel) != nullptr)
        not_carried.push_back("what was noted on " + line.told.name + ": it is left out");
      continue;
    }
    out.marks.push_back(carried_mark(
        was, line.told, CarriedPlaces(before.tree, carried.tree, line.told.vessel), not_carried));
  }
  for (const analysis::Measurement& was : annotations.measurements) {
    const CarriedPlaces places(before.tree, carried.tree, vessel_near(was, before.tree));
    if (auto one = carried_measurement(was, places, map)) {
      one->id = out.next_measurement_id++;
      out.measurements.push_back(std::move(*one));
    } else {
      not_carried.push_back(name_of_measurement(was) + ": its place on the vessel is not carried");
    }
  }
  if (!(annotations.pressure.inputs.empty() && annotations.pressure.what_ifs.empty()))
    not_carried.emplace_back("what was given for pressures: it belongs to the day of the former scan");
  return out;
}

}  // namespace ostia::session
