#include "ostia/analysis/measurement.h"

#include "calcium/ring_hu.h"

#include "ostia/analysis/stenosis.h"
#include "ostia/core/error.h"
#include "ostia/core/quantity_text.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ostia::analysis {
namespace {

constexpr const char* no_kind = "its kind is none of those there are";
constexpr double least_ring_mm = 0.05, widest_ring_mm = 20.0;

std::optional<std::string> points_fault(const Measurement& measurement, const MeasureTraits& traits) {
  const std::size_t count = measurement.points.size();
  if (count < traits.points || (count > traits.points && !traits.more_points))
    return std::string(traits.fault);
  if (measurement.kind == MeasureKind::angle &&
      (measurement.points[0] == measurement.points[1] || measurement.points[2] == measurement.points[1]))
    return "an angle needs two points that are not its vertex";
  for (const Vec3& p : measurement.points) {
    if (!p.allFinite()) return "a point is not finite";
  }
  return std::nullopt;
}

std::vector<MeasuredValue> measured_angle(const std::vector<Vec3>& points) {
  const Vec3 a = points[0] - points[1], b = points[2] - points[1];
  return {{"angle", std::atan2(a.cross(b).norm(), a.dot(b)) * 180.0 / std::numbers::pi, "deg"}};
}

/// Newell's formula: of a line that is not flat, the area that it shows along its mean normal. With an image
/// also its CT numbers.
std::vector<MeasuredValue> measured_area(const std::vector<Vec3>& points, const MeasureContext& context) {
  Vec3 doubled = Vec3::Zero();
  double length = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3 &a = points[i], &b = points[(i + 1) % points.size()];
    doubled += (a - points[0]).cross(b - points[0]);
    length += (b - a).norm();
  }
  std::vector<MeasuredValue> values{{"area", 0.5 * doubled.norm(), "mm2"}, {"perimeter", length, "mm"}};
  if (context.image == nullptr) return values;
  const RingStatistics hu = area_statistics(points, *context.image);
  if (hu.samples > 0)
    values.insert(values.end(), {{"mean", hu.mean, "HU"},
                                 {"SD", hu.deviation, "HU"},
                                 {"least", hu.least, "HU"},
                                 {"largest", hu.largest, "HU"}});
  return values;
}

const LumenProfile& profile_for(const Measurement& measurement, const MeasureContext& context) {
  if (context.model != nullptr) lumen::vessel(*context.model, measurement.vessel);  // throws
  if (!context.profile_of)
    throw InvalidInput("a " + to_string(measurement.kind) + " needs the vessel's lumen profile");
  const LumenProfile& profile = context.profile_of(measurement.vessel);
  if (profile.vessel != measurement.vessel)
    throw InvalidInput("vessel " + std::to_string(measurement.vessel) + " has no lumen profile");
  if (!(measurement.from_mm >= 0.0) || !(measurement.to_mm <= profile.length_mm + 1e-6))
    throw InvalidInput("a " + to_string(measurement.kind) + " from " + std::to_string(measurement.from_mm) +
                       " to " + std::to_string(measurement.to_mm) + " mm is not within vessel " +
                       std::to_string(measurement.vessel) + ", " + std::to_string(profile.length_mm) +
                       " mm long");
  return profile;
}

std::vector<MeasuredValue> measured_stenosis(const Measurement& measurement, const MeasureContext& context) {
  const Stenosis stenosis =
      stenosis_between(profile_for(measurement, context), measurement.from_mm, measurement.to_mm);
  return {{"percent diameter", stenosis.diameter_percent, "%"},
          {"percent area", stenosis.area_percent, "%"},
          {"MLD", stenosis.least_diameter_mm, "mm"},
          {"MLA", stenosis.least_area_mm2, "mm2"},
          {"reference diameter", stenosis.reference_diameter_mm, "mm"},
          {"reference area", stenosis.reference_area_mm2, "mm2"},
          {"length", stenosis.length_mm(), "mm"}};
}

std::vector<MeasuredValue> measured_volume(const Measurement& measurement, const MeasureContext& context) {
  const LumenProfile& profile = profile_for(measurement, context);
  const double volume = volume_mm3(profile, measurement.from_mm, measurement.to_mm);
  const double length = measurement.to_mm - measurement.from_mm;
  return {{"volume", volume, "mm3"}, {"length", length, "mm"}, {"mean area", volume / length, "mm2"}};
}

std::vector<MeasuredValue> measured_ring(const Measurement& measurement, const MeasureContext& context) {
  if (context.image == nullptr) throw InvalidInput("CT numbers about a lumen need the image");
  if (context.model == nullptr || !context.surface_of)
    throw InvalidInput("CT numbers about a lumen need its model and walls");
  const MeasuredSection section =
      measured_section(*context.model, context.surface_of, measurement.vessel, measurement.from_mm);
  const std::string place =
      " at " + std::to_string(measurement.from_mm) + " mm of vessel " + std::to_string(measurement.vessel);
  if (!section.measures.found)
    throw InvalidInput("there is no lumen" + place + " to measure CT numbers about");
  const RingStatistics ring =
      ring_statistics(section, measurement.inner_mm, measurement.outer_mm, *context.image);
  if (ring.samples == 0)
    throw InvalidInput("the ring" + place + " lies outside the image; choose a place that the image shows");
  return {{"mean", ring.mean, "HU"},
          {"SD", ring.deviation, "HU"},
          {"least", ring.least, "HU"},
          {"largest", ring.largest, "HU"},
          {"samples", static_cast<double>(ring.samples), ""}};
}

std::string number_text(double value, const std::string& unit) {
  if (unit == "mm") return core::calibre_text(value);
  if (unit == "mm2") return core::area_text(value);
  if (unit == "mm3") return core::volume_text(value);
  if (unit == "deg") return core::measured_angle_text(value);
  if (unit == "HU") return core::hu_text(value);
  return core::percent_text(value);
}

std::string shown_unit(const std::string& unit) {
  if (unit == "mm2") return " mm\u00b2";
  if (unit == "mm3") return " mm\u00b3";
  if (unit == "deg") return "\u00b0";
  return unit.empty() ? "" : " " + unit;
}

}  // namespace

std::optional<std::string> find_fault(const Measurement& measurement) {
  const MeasureTraits* traits = find_traits(measurement.kind);
  if (!traits) return no_kind;
  if (auto fault = points_fault(measurement, *traits)) return fault;
  if (!traits->of_vessel) return std::nullopt;
  const std::string what = to_string(measurement.kind);
  if (measurement.vessel <= 0) return "a " + what + " needs a vessel";
  if (!(std::isfinite(measurement.from_mm) && measurement.from_mm >= 0.0))
    return "a " + what + " begins at an abscissa that is not on a vessel";
  if (measurement.kind == MeasureKind::ring_hu) {
    const double inner = measurement.inner_mm, outer = measurement.outer_mm;
    if (!(inner >= 0.0 && outer - inner >= least_ring_mm && outer <= widest_ring_mm))
      return "a ring about the lumen needs an inner distance of at least 0 and an outer one of at most 20 "
             "mm, "
             "0.05 mm or more apart";
    return std::nullopt;
  }
  if (!(std::isfinite(measurement.to_mm) && measurement.to_mm > measurement.from_mm))
    return "a " + what + " needs a distal place beyond its proximal one";
  return std::nullopt;
}

std::vector<MeasuredValue> measured(const Measurement& measurement, const MeasureContext& context) {
  if (const auto fault = find_fault(measurement)) throw InvalidInput(*fault);
  const std::vector<Vec3>& points = measurement.points;
  switch (measurement.kind) {
    case MeasureKind::distance:
      return {{"length", (points[1] - points[0]).norm(), "mm"}};
    case MeasureKind::diameter:
      return {{"diameter", (points[1] - points[0]).norm(), "mm"}};
    case MeasureKind::angle:
      return measured_angle(points);
    case MeasureKind::area:
      return measured_area(points, context);
    case MeasureKind::stenosis:
      return measured_stenosis(measurement, context);
    case MeasureKind::volume:
      return measured_volume(measurement, context);
    case MeasureKind::ring_hu:
      return measured_ring(measurement, context);
    case MeasureKind::arrow:
    case MeasureKind::note:
      return {};
  }
  throw InvalidInput(no_kind);
}

std::string to_text(const MeasuredValue& value) {
  if (!std::isfinite(value.value)) return "-";
  const double shown = std::abs(value.value) < 1e15 ? value.value : std::copysign(1e15, value.value);
  return number_text(shown, value.unit) + shown_unit(value.unit);
}

}  // namespace ostia::analysis
