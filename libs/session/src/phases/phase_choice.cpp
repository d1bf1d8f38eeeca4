#include "ostia/session/phase_choice.h"

#include "ostia/core/error.h"

#include <functional>
#include <stdexcept>

namespace ostia::session {
namespace {

constexpr double between_points_mm = 1.0;

using CurveOf = std::function<const geometry::AxisCurve&(std::int32_t vessel)>;
using PlaceOf = std::function<double(std::int32_t vessel, double own_mm)>;

/// `own` abscissas are those of the model, which say where a vessel's own stretch begins.
std::vector<Vec3> points_on(const lumen::LumenModel& model, const CurveOf& curve_of,
                            const PlaceOf& place_of) {
  std::vector<Vec3> points;
  for (const geometry::Vessel& vessel : model.tree.vessels) {
    if (vessel.name == "Aorta") continue;
    const geometry::AxisCurve& curve = curve_of(vessel.id);
    const double end = lumen::vessel(model, vessel.id).axis->length();
    for (double s = lumen::own_from_mm(model.tree, vessel.id); s <= end; s += between_points_mm)
      points.push_back(curve.point(place_of(vessel.id, s)));
  }
  return points;
}

}  // namespace

std::vector<Vec3> axis_points(const lumen::LumenModel& model) {
  return points_on(
      model, [&](std::int32_t id) -> const geometry::AxisCurve& { return *lumen::vessel(model, id).axis; },
      [](std::int32_t, double own_mm) { return own_mm; });
}

std::vector<Vec3> axis_points(const Beating& beating, double phase) {
  const std::shared_ptr<const ShownPhase> at = beating.at(phase);
  return points_on(
      beating.model(), [&](std::int32_t id) -> const geometry::AxisCurve& { return *at->axis(id).curve(); },
      [&](std::int32_t id, double own_mm) { return at->axis(id).here(own_mm); });
}

PhaseChoice PhaseChoiceWork::chosen(const core::TaskContext& task) const {
  PhaseChoice result;
  result.faults.resize(stack.entries.size());
  result.places = axes_mm.empty() ? SharpnessPlaces::heart
                  : beating       ? SharpnessPlaces::carried_axes
                                  : SharpnessPlaces::same_axes;
  evaluation::SharpnessOptions options;
  options.within_mm = beating ? about_carried_mm : about_same_mm;
  bool blood_known = false;
  std::vector<std::optional<evaluation::EdgeSharpness>> measured(stack.entries.size());
  for (std::size_t done = 0; done < compared.size(); ++done) {
    const std::size_t n = compared[done];
    const auto part = static_cast<double>(done) / static_cast<double>(compared.size());
    const auto next = static_cast<double>(done + 1) / static_cast<double>(compared.size());
    const core::TaskContext mine = task.sub(part, next);
    task.throw_if_cancelled();
    try {
      const StackImages::Image image =
          held.at(n) ? held[n] : read_phase_image(stack.entries[n].source, mine.sub(0.0, 0.6)).volume;
      // Blood is as bright at all phases: of the first that is read, so that all are measured alike.
      if (!blood_known) options.high_hu = evaluation::blood_level_hu(*image).value_or(options.high_hu);
      blood_known = true;
      std::vector<Vec3> points = axes_mm;
      if (beating && !axes_mm.empty()) points = axis_points(*beating, stack.entries[n].source.phase);
      measured[n] = evaluation::edge_sharpness(*image, points, options, mine.sub(0.6, 1.0));
    } catch (const Cancelled&) {
      throw;
    } catch (const std::exception& error) {
      result.faults[n] = error.what();
    }
  }
  result.best = evaluation::best_phase(measured, stack.own);
  task.set_progress(1.0);
  return result;
}

}  // namespace ostia::session
