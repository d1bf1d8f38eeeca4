#include "ostia/phantom/vessel_motion.h"

#include "ostia/core/parallel.h"

#include <algorithm>
#include <cmath>

namespace ostia::phantom {
namespace {

constexpr std::size_t point_step = 10;  // of the axes' 0.1 mm
constexpr std::size_t phases = 200;
constexpr int left_main = 5;  // the AHA's number

/// Points on a vessel from an abscissa to another.
std::vector<Vec3> points_of(const CoronaryVessel& vessel, double from_mm, double to_mm) {
  std::vector<Vec3> out;
  for (std::size_t i = 0; i < vessel.axis.size(); i += point_step)
    if (vessel.axis.abscissa[i] >= from_mm && vessel.axis.abscissa[i] <= to_mm)
      out.push_back(vessel.axis.points[i]);
  return out;
}

VesselMotion motion_of(std::string name, const std::vector<Vec3>& points, const Heartbeat& beat) {
  std::vector<std::vector<Vec3>> places(phases);
  core::parallel_for(phases, 4, [&](std::size_t k) {
    places[k] = moved(points, beat.phase(100.0 * static_cast<double>(k) / static_cast<double>(phases)));
  });
  const double n = static_cast<double>(points.size());
  const double step_s = 1e-3 * beat.rr_ms() / static_cast<double>(phases);
  VesselMotion out;
  out.vessel = std::move(name);
  for (std::size_t k = 0; k < phases; ++k) {
    double speed = 0.0, distance = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double one = (places[(k + 1) % phases][i] - places[k][i]).norm() / step_s;
      speed += one / n;
      out.largest_speed_mm_per_s = std::max(out.largest_speed_mm_per_s, one);
      distance += (places[k][i] - points[i]).norm() / n;
    }
    out.speed_mm_per_s = std::max(out.speed_mm_per_s, speed);
    out.distance_mm.push_back(distance);
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    double farthest = 0.0;
    for (std::size_t k = 0; k < phases; ++k)
      for (std::size_t j = 0; j < k; ++j)
        farthest = std::max(farthest, (places[k][i] - places[j][i]).squaredNorm());
    farthest = std::sqrt(farthest);
    out.displacement_mm += farthest / n;
    out.largest_displacement_mm = std::max(out.largest_displacement_mm, farthest);
  }
  return out;
}

}  // namespace

std::vector<VesselMotion> vessel_motion(const CoronaryTree& tree, const Heartbeat& beat) {
  std::vector<VesselMotion> out;
  for (const char* name : {"RCA", "LAD", "LCX"}) {
    for (const CoronaryVessel& vessel : tree.vessels) {
      if (vessel.name != name || vessel.axis.size() < 2) continue;
      double main_end = -1.0;
      for (const SegmentSpan& span : vessel.segments)
        if (span.aha == left_main) main_end = span.s_to_mm;
      const double end = vessel.axis.abscissa.back();
      if (main_end > 0.0) out.push_back(motion_of("LM", points_of(vessel, 0.0, main_end), beat));
      out.push_back(motion_of(name, points_of(vessel, std::max(0.0, main_end), end), beat));
    }
  }
  return out;
}

std::vector<Vec3> axis_points(const CoronaryTree& tree) {
  std::vector<Vec3> out;
  for (const CoronaryVessel& vessel : tree.vessels) {
    if (vessel.axis.points.empty()) continue;
    const std::vector<Vec3> own = points_of(vessel, 0.0, vessel.axis.abscissa.back());
    out.insert(out.end(), own.begin(), own.end());
  }
  return out;
}

}  // namespace ostia::phantom
