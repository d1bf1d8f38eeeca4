#include "ostia/session/vessel_fat.h"

#include "ostia/analysis/aha_segments.h"
#include "ostia/core/error.h"
#include "ostia/core/text.h"
#include "ostia/geometry/vessel_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace ostia::session {
namespace {

constexpr double least_measured_mm = 5.0;
constexpr double usual_kv = 120.0;

const geometry::Vessel* vessel_called(const geometry::VesselTree& tree, const std::string& name) {
  for (const geometry::Vessel& vessel : tree.vessels)
    if (analysis::usual_name(vessel.name) == name) return &vessel;
  return nullptr;
}

/// How far two vessels have their way in common, mm.
double common_way(const geometry::VesselTree& tree, const geometry::Vessel* a, const geometry::Vessel* b) {
  if (a == nullptr || b == nullptr) return 0.0;
  double length = 0.0;
  for (std::size_t i = 0; i < std::min(a->segments.size(), b->segments.size()); ++i) {
    if (a->segments[i] != b->segments[i]) break;
    length += geometry::segment(tree, a->segments[i]).axis.abscissa.back();
  }
  return length;
}

/// Nothing, and why, where too little of the range was seen.
std::optional<VesselFat> fat_of(const VesselWalls& walls, const std::string& name, double origin_mm,
                                const imaging::ImageVolume& image, const CaseFatOptions& options,
                                const core::TaskContext& task) {
  const analysis::FatRange range = *analysis::fat_range(name);
  const segmentation::LumenBoundary& outer = walls.outer.surface;
  VesselFat out;
  out.vessel = walls.vessel;
  out.name = name;
  out.origin_mm = origin_mm;
  out.asked_mm = range.to_mm - range.from_mm;
  out.seen_share = walls.outer.seen_share;
  analysis::FatStretch stretch;
  stretch.from_mm = std::max(origin_mm + range.from_mm, outer.from_mm);
  stretch.to_mm = std::min(
      {origin_mm + range.to_mm, outer.from_mm + (outer.rows() - 1) * outer.step_mm, walls.axis->length()});
  if (stretch.to_mm - stretch.from_mm < least_measured_mm) return std::nullopt;
  stretch.outer_mm = [&outer](double s, double theta) { return static_cast<double>(outer.at(s, theta)); };
  out.profile = analysis::fat_profile(*walls.axis, stretch, image, options.fat, task);
  return out;
}

void tell_voltage(CaseFat& fat) {
  if (!fat.tube_kv)
    fat.warnings.push_back(
        "the tube voltage is not known: fat is darker at less than 120 kV (by about a quarter at 80), and "
        "bounds of studies hold for theirs");
  else if (std::abs(*fat.tube_kv - usual_kv) > 0.5)
    fat.warnings.push_back(
        "the scan was taken at " + core::rounded_text(*fat.tube_kv, 0) +
        " kV: compare its values with those of other voltages only as estimated at 120 kV");
}

}  // namespace

void validate(const CaseFatOptions& options) {
  analysis::validate(options.fat);
  validate(options.walls);
  if (options.tube_kv && !(*options.tube_kv >= 40.0 && *options.tube_kv <= 200.0))
    throw InvalidInput("fat: tube_kv is " + core::rounded_text(*options.tube_kv, 1) +
                       "; it has to be in [40, 200] kV");
}

CaseFat case_fat(const lumen::LumenModel& model, const analysis::SurfaceOfVessel& surface_of,
                 const imaging::ImageVolume& image, const CaseFatOptions& options,
                 const core::TaskContext& task) {
  validate(options);
  CaseFat out;
  out.tube_kv = options.tube_kv;
  const geometry::VesselTree& tree = model.tree;
  const double left_main_mm = common_way(tree, vessel_called(tree, "LAD"), vessel_called(tree, "LCX"));
  const std::array<const char*, 3> names{"RCA", "LAD", "LCX"};
  for (std::size_t n = 0; n < names.size(); ++n) {
    const std::string name = names[n];
    const core::TaskContext part =
        task.sub(static_cast<double>(n) / names.size(), static_cast<double>(n + 1) / names.size());
    const geometry::Vessel* vessel = vessel_called(tree, name);
    if (vessel == nullptr) {
      out.warnings.push_back("no vessel is named " + name);
      continue;
    }
    auto walls = vessel_walls(model, surface_of, vessel->id, image, options.walls, part.sub(0.0, 0.7));
    const double origin_mm = name == "RCA" ? 0.0 : left_main_mm;
    std::optional<VesselFat> fat;
    if (walls) fat = fat_of(*walls, name, origin_mm, image, options, part.sub(0.7, 1.0));
    if (!fat) {
      out.warnings.push_back(name + ": less than 5 mm of its range were measured");
      continue;
    }
    const double measured_mm = fat->profile.to_mm - fat->profile.from_mm;
    if (measured_mm < 0.9 * fat->asked_mm)
      out.warnings.push_back(name + ": " + core::rounded_text(measured_mm, 1) + " of " +
                             core::rounded_text(fat->asked_mm, 0) + " mm were measured");
    if (fat->profile.fat.voxels == 0)
      out.warnings.push_back(name + ": no fat was found that is clear of edges");
    fat->walls = std::make_shared<const VesselWalls>(std::move(*walls));
    out.vessels.push_back(std::move(*fat));
  }
  tell_voltage(out);
  return out;
}

}  // namespace ostia::session
