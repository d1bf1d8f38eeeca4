#include "ostia/analysis/lumen_profile.h"

#include "lesions/owned_walls.h"
#include "walls/contour_measures.h"
#include "walls/section_contour.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/core/text.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>
#include <string>

namespace ostia::analysis {
namespace {

using core::mm_text;

constexpr double same_mm = 1e-6;
constexpr std::size_t sections_per_task = 4;

SectionMeasures measures_at(const SectionPlane& plane, const SectionContour& contour, double s_mm) {
  SectionMeasures measures;
  measures.s_mm = s_mm;
  measures.normal = plane.normal;
  measures.centroid = plane.origin;
  measures.open = contour.state == SectionContour::State::open;
  if (contour.state != SectionContour::State::found) return measures;
  const ContourMeasures of = measures_of(contour.points);
  measures.found = true;
  measures.area_mm2 = of.area_mm2;
  measures.perimeter_mm = of.perimeter_mm;
  measures.diameter_mm = 2.0 * std::sqrt(std::max(0.0, of.area_mm2) / std::numbers::pi);
  measures.least_diameter_mm = of.least_width_mm;
  measures.largest_diameter_mm = of.largest_width_mm;
  measures.centroid = plane.world(of.centroid);
  return measures;
}

SectionMeasures measured(const OwnedWalls& walls, double s_mm, int around) {
  const SectionContour contour = section_contour(walls.wall(s_mm), walls.axis(), s_mm, around);
  return measures_at(SectionPlane(walls.axis(), s_mm), contour, s_mm);
}

/// Measures sections [first, last) anew.
void measure(std::vector<SectionMeasures>& sections, std::size_t first, std::size_t last, OwnedWalls& walls,
             int around, const core::TaskContext& task) {
  for (std::size_t i = first; i < last; ++i) walls.ask(sections[i].s_mm);
  std::atomic<std::size_t> done{0};
  core::parallel_for(last - first, sections_per_task, [&](std::size_t i) {
    task.throw_if_cancelled();
    SectionMeasures& section = sections[first + i];
    section = measured(walls, section.s_mm, around);
    task.set_progress(static_cast<double>(++done) / static_cast<double>(last - first));
  });
}

SectionMeasures between(const SectionMeasures& a, const SectionMeasures& b, double t) {
  SectionMeasures result;
  const auto mix = [t](double x, double y) { return (1.0 - t) * x + t * y; };
  result.s_mm = mix(a.s_mm, b.s_mm);
  result.found = a.found && b.found;
  result.open = a.open || b.open;
  result.normal = ((1.0 - t) * a.normal + t * b.normal).normalized();
  result.centroid = (1.0 - t) * a.centroid + t * b.centroid;
  if (!result.found) return result;
  result.area_mm2 = mix(a.area_mm2, b.area_mm2);
  result.perimeter_mm = mix(a.perimeter_mm, b.perimeter_mm);
  result.diameter_mm = mix(a.diameter_mm, b.diameter_mm);
  result.least_diameter_mm = mix(a.least_diameter_mm, b.least_diameter_mm);
  result.largest_diameter_mm = mix(a.largest_diameter_mm, b.largest_diameter_mm);
  return result;
}

/// Pappus: between two sections, the mean area times the centroid's way across them.
double slice_volume(const SectionMeasures& a, const SectionMeasures& b) {
  const Vec3 across = (a.normal + b.normal).normalized();
  return 0.5 * (a.area_mm2 + b.area_mm2) * (b.centroid - a.centroid).dot(across);
}

}  // namespace

void validate(const ProfileOptions& options) {
  if (!(options.step_mm >= 0.05 && options.step_mm <= 5.0))
    throw InvalidInput("sections of a profile are " + mm_text(options.step_mm, 6) +
                       " apart; choose 0.05 to 5 mm");
  if (options.around < 16 || options.around > 512)
    throw InvalidInput("a section has " + std::to_string(options.around) + " rays; choose 16 to 512");
}

LumenProfile lumen_profile(const lumen::LumenModel& model, const SurfaceOfVessel& surface_of,
                           std::int32_t vessel, const ProfileOptions& options,
                           const core::TaskContext& task) {
  validate(options);
  OwnedWalls walls(model, surface_of, vessel);
  LumenProfile profile;
  profile.vessel = vessel;
  profile.options = options;
  profile.length_mm = walls.axis().length();
  const auto steps = std::max<std::size_t>(
      1, static_cast<std::size_t>(std::ceil(profile.length_mm / options.step_mm - 1e-9)));
  profile.sections.resize(steps + 1);
  for (std::size_t i = 0; i <= steps; ++i)
    profile.sections[i].s_mm = profile.length_mm * static_cast<double>(i) / static_cast<double>(steps);
  measure(profile.sections, 0, steps + 1, walls, options.around, task);
  return profile;
}

void update_profile(LumenProfile& profile, const lumen::LumenModel& model, const SurfaceOfVessel& surface_of,
                    double from_mm, double to_mm) {
  validate(profile.options);
  OwnedWalls walls(model, surface_of, profile.vessel);
  if (profile.sections.size() < 2 || !(std::abs(walls.axis().length() - profile.length_mm) <= same_mm))
    throw InvalidInput("the profile is of an axis of " + mm_text(profile.length_mm, 6) + " and vessel " +
                       std::to_string(profile.vessel) + " has one of " + mm_text(walls.axis().length(), 6) +
                       "; measure the whole vessel anew");
  if (!(from_mm <= to_mm))
    throw InvalidInput("a profile cannot be measured again from " + mm_text(from_mm, 6) + " to " +
                       mm_text(to_mm, 6));
  const double step = profile.length_mm / static_cast<double>(profile.sections.size() - 1);
  const auto& all = profile.sections;
  const auto first = std::lower_bound(all.begin(), all.end(), from_mm - step - same_mm,
                                      [](const SectionMeasures& a, double s) { return a.s_mm < s; });
  const auto last = std::upper_bound(first, all.end(), to_mm + step + same_mm,
                                     [](double s, const SectionMeasures& a) { return s < a.s_mm; });
  std::vector<SectionMeasures> anew(first, last);
  measure(anew, 0, anew.size(), walls, profile.options.around, core::no_task());
  std::copy(anew.begin(), anew.end(), profile.sections.begin() + (first - all.begin()));
}

MeasuredSection measured_section(const lumen::LumenModel& model, const SurfaceOfVessel& surface_of,
                                 std::int32_t vessel, double s_mm, const ProfileOptions& options) {
  validate(options);
  OwnedWalls walls(model, surface_of, vessel);
  if (!(s_mm >= -same_mm && s_mm <= walls.axis().length() + same_mm))
    throw InvalidInput("vessel " + std::to_string(vessel) + " is " + mm_text(walls.axis().length(), 6) +
                       " long; it has no section at " + mm_text(s_mm, 6));
  s_mm = std::clamp(s_mm, 0.0, walls.axis().length());
  walls.ask(s_mm);
  const SectionContour contour = section_contour(walls.wall(s_mm), walls.axis(), s_mm, options.around);
  const SectionPlane plane(walls.axis(), s_mm);
  MeasuredSection section{measures_at(plane, contour, s_mm), {}};
  for (const Vec2& p : contour.points) section.contour.push_back(plane.world(p));
  return section;
}

SectionMeasures at(const LumenProfile& profile, double s_mm) {
  const auto& all = profile.sections;
  if (all.empty()) throw InvalidInput("a profile without sections has no measures");
  if (!(s_mm > all.front().s_mm)) return all.front();
  const auto next = std::lower_bound(all.begin(), all.end(), s_mm,
                                     [](const SectionMeasures& a, double s) { return a.s_mm < s; });
  if (next == all.end()) return all.back();
  const SectionMeasures &a = *(next - 1), &b = *next;
  if (b.s_mm == s_mm) return b;
  return between(a, b, (s_mm - a.s_mm) / (b.s_mm - a.s_mm));
}

double volume_mm3(const LumenProfile& profile, double from_mm, double to_mm) {
  if (!(from_mm >= -same_mm && from_mm <= to_mm && to_mm <= profile.length_mm + same_mm))
    throw InvalidInput("a volume from " + mm_text(from_mm, 6) + " to " + mm_text(to_mm, 6) +
                       " is not within the vessel, " + mm_text(profile.length_mm, 6) + " long");
  SectionMeasures before = at(profile, from_mm);
  double volume = 0.0;
  const auto add = [&](const SectionMeasures& next) {
    if (!before.found || !next.found)
      throw InvalidInput("the lumen has no measured section near " + mm_text(next.s_mm, 6) +
                         "; choose a stretch without gaps");
    volume += slice_volume(before, next);
    before = next;
  };
  for (const SectionMeasures& section : profile.sections) {
    if (section.s_mm > from_mm && section.s_mm < to_mm) add(section);
  }
  add(at(profile, to_mm));
  return volume;
}

}  // namespace ostia::analysis
