#include "motion/motion.h"
#include "motion/motion_input.h"
#include "motion/phase_surface.h"

#include "ostia/core/log.h"
#include "ostia/evaluation/surface_motion.h"
#include "ostia/motion/moving_cage.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace ostia::app {
namespace {

namespace fs = std::filesystem;
using geometry::CageMotion;
using geometry::PhaseOrigin;

constexpr double same_phase = 1e-6;
constexpr double told_phase = 1e-4;  // messages have percents to two digits

double off(const geometry::CagePhase& one, double phase) {
  const double d = std::abs(one.phase - phase);
  return std::min(d, 1.0 - d);
}

bool is_at(const geometry::CagePhase& one, double phase) {
  return off(one, phase) < same_phase;
}

/// The motion's phase that a user has written, as messages have it perhaps.
const geometry::CagePhase& phase_at(const CageMotion& motion, double percent) {
  const double phase = percent / 100.0 - std::floor(percent / 100.0);
  const auto nearest =
      std::ranges::min_element(motion.phases, {}, [&](const auto& one) { return off(one, phase); });
  if (off(*nearest, phase) <= told_phase) return *nearest;
  std::string all;
  for (const geometry::CagePhase& one : motion.phases)
    all += (all.empty() ? "" : ", ") + pipeline::percent_text(one.phase);
  throw InvalidInput("--keep: the motion has no phase " + pipeline::percent_text(phase) + "; it has " + all);
}

/// The motion with those phases alone that are asked for.
CageMotion kept(const CageMotion& motion, const MotionEvaluateCommand& c) {
  CageMotion out = motion;
  out.phases.clear();
  for (const double percent : c.keep) {
    if (!std::isfinite(percent)) throw UsageError("--keep takes percents of the cycle, numbers");
    const geometry::CagePhase& found = phase_at(motion, percent);
    if (std::ranges::none_of(out.phases, [&](const auto& p) { return p.phase == found.phase; }))
      out.phases.push_back(found);
  }
  std::ranges::sort(out.phases, {}, &geometry::CagePhase::phase);
  if (c.keep.empty())
    for (std::size_t k = 0; k < motion.phases.size(); k += static_cast<std::size_t>(std::max(c.every, 1)))
      out.phases.push_back(motion.phases[k]);
  if (out.phases.size() < 3)
    throw InvalidInput("a motion needs three phases at least; " + std::to_string(out.phases.size()) + " of " +
                       std::to_string(motion.phases.size()) + " are kept");
  return out;
}

Json fit_number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

/// Means over phases.
struct Means {
  std::size_t phases = 0;
  double msd = 0.0, worst_msd = 0.0, largest = 0.0, dice = 0.0;

  void add(const evaluation::SurfacePhaseError& e) {
    ++phases;
    msd += e.msd_mm;
    worst_msd = std::max(worst_msd, e.msd_mm);
    largest = std::max(largest, e.max_sd_mm);
    dice += e.dice;
  }
  Json json() const {
    if (phases == 0) return nullptr;
    const auto n = static_cast<double>(phases);
    return {{"phases", phases},
            {"msd_mm", msd / n},
            {"worst_msd_mm", worst_msd},
            {"hausdorff_mm", largest},
            {"dice", fit_number(dice / n)}};
  }
};

/// What the cage makes of the surface, beside what is true.
evaluation::SurfaceMotionError compared(const CageMotion& motion, const geometry::TriMesh& surface,
                                        std::vector<pipeline::PhaseSurface> truth,
                                        const MotionEvaluateCommand& c, const core::TaskContext& task) {
  const motion::MovingCage cage(motion);
  const motion::CarriedPoints carried(cage.grid(), surface.points);
  evaluation::SurfaceMotion reference, result;
  for (pipeline::PhaseSurface& one : truth) {
    reference.names.push_back(pipeline::percent_text(one.phase));
    reference.phases.push_back(std::move(one.surface));
    result.phases.push_back({carried.places(cage.at(one.phase)), surface.triangles});
  }
  result.names = reference.names;
  return evaluation::compare_surface_motion(
      reference, result, {.sample_mm = c.common.sample_mm, .resolution_mm = c.common.resolution_mm}, task);
}

std::vector<pipeline::PhaseSurface> reference_of(const MotionEvaluateCommand& c,
                                                 const core::TaskContext& task) {
  auto truth = read_phases(phase_files(c.reference, c.frames), c.common.units, MaskSurface::isosurface, task);
  std::erase_if(truth, [](const pipeline::PhaseSurface& one) {
    if (one.surface.triangles.empty())
      core::log_warning("phase " + pipeline::percent_text(one.phase) +
                        " of the reference holds no vessel: it is left out");
    return one.surface.triangles.empty();
  });
  return truth;
}

}  // namespace

ExitCode run_motion_evaluate(const MotionEvaluateCommand& c, const core::TaskContext& task) {
  task.set_stage("reading");
  const io::CageMotionFile file = io::read_cage_motion(motion_path(c.motion));
  const CageMotion motion = kept(file.motion, c);
  const geometry::TriMesh surface =
      surface_from(template_path(c.motion, file, c.surface), c.surface.empty() ? "mm" : c.common.units);
  std::vector<pipeline::PhaseSurface> truth = reference_of(c, task.sub(0.0, 0.1));
  std::vector<bool> was_kept;
  for (const pipeline::PhaseSurface& one : truth)
    was_kept.push_back(std::ranges::any_of(motion.phases, [&](const geometry::CagePhase& p) {
      return is_at(p, one.phase) && p.origin != PhaseOrigin::bridged;
    }));
  task.set_stage("comparing");
  const evaluation::SurfaceMotionError e = compared(motion, surface, std::move(truth), c, task.sub(0.1, 1.0));
  Json out{{"v", 1},
           {"kind", "motion"},
           {"method", "cage"},
           {"used_phases", motion.phases.size()},
           {"corresponding", e.corresponding},
           {"msd_mm", e.msd_mm},
           {"hausdorff_mm", e.max_sd_mm},
           {"dice", fit_number(e.dice)},
           {"displacement_mm", fit_number(e.displacement_mm)}};
  Means of_kept, of_left_out;
  Json phases = Json::array();
  for (std::size_t k = 0; k < e.phases.size(); ++k) {
    const evaluation::SurfacePhaseError& p = e.phases[k];
    (was_kept[k] ? of_kept : of_left_out).add(p);
    phases.push_back({{"phase", p.name},
                      {"kept", static_cast<bool>(was_kept[k])},
                      {"msd_mm", p.msd_mm},
                      {"hausdorff_mm", p.max_sd_mm},
                      {"dice", fit_number(p.dice)},
                      {"displacement_mm", fit_number(p.displacement_mm)}});
  }
  out["kept"] = of_kept.json();
  out["left_out"] = of_left_out.json();
  out["phases"] = std::move(phases);
  task.set_progress(1.0);
  return finish(c.common, out);
}

}  // namespace ostia::app
