#include "heart/motion_json.h"

#include "cases/case_parts.h"

#include "ostia/phantom/moving_case.h"

#include <cmath>

namespace ostia::phantom {
namespace {

using nlohmann::json;

double rounded_motion(double value) {
  return std::round(value * 1e6) / 1e6;
}

json amplitudes_json(const BeatAmplitudes& a) {
  return {{"left_excursion_mm", rounded_motion(a.left_excursion_mm)},
          {"right_excursion_mm", rounded_motion(a.right_excursion_mm)},
          {"atrial_share", rounded_motion(a.atrial_share)},
          {"epicardial_contraction", rounded_motion(a.epicardial_contraction)},
          {"endocardial_contraction", rounded_motion(a.endocardial_contraction)},
          {"base_rotation_deg", rounded_motion(a.base_rotation_deg)},
          {"apex_rotation_deg", rounded_motion(a.apex_rotation_deg)},
          {"shift_mm",
           {rounded_motion(a.shift_mm.x()), rounded_motion(a.shift_mm.y()), rounded_motion(a.shift_mm.z())}},
          {"end_systole_percent", rounded_motion(a.end_systole_percent)}};
}

}  // namespace

json vessel_motion_json(const std::vector<VesselMotion>& vessels) {
  json out = json::array();
  for (const VesselMotion& one : vessels) {
    out.push_back({{"vessel", one.vessel},
                   {"displacement_mm", rounded_motion(one.displacement_mm)},
                   {"largest_displacement_mm", rounded_motion(one.largest_displacement_mm)},
                   {"speed_mm_per_s", rounded_motion(one.speed_mm_per_s)},
                   {"largest_speed_mm_per_s", rounded_motion(one.largest_speed_mm_per_s)}});
  }
  return out;
}

std::string heartbeat_json(const Heartbeat& beat, const std::vector<double>& percents,
                           const std::vector<VesselMotion>& vessels) {
  json out;
  out["v"] = 1;
  out["units"] = "mm";
  out["axes"] = "LPS";
  out["template_percent"] = template_percent;
  out["heart_rate_per_min"] = rounded_motion(beat.amplitudes().heart_rate_per_min);
  out["rr_ms"] = rounded_motion(beat.rr_ms());
  out["amplitudes"] = amplitudes_json(beat.amplitudes());
  out["phases"] = json::array();
  for (const double percent : percents) {
    out["phases"].push_back({{"percent", rounded_motion(percent)},
                             {"folder", phase_name(percent)},
                             {"trigger_ms", rounded_motion(0.01 * percent * beat.rr_ms())}});
  }
  out["vessels"] = vessel_motion_json(vessels);
  return out.dump(1) + "\n";
}

std::string motion_json(const CoronaryTree& tree, const Heartbeat& beat,
                        const std::vector<double>& percents) {
  const std::vector<Vec3> points = axis_points(tree);
  json out{{"v", 1}, {"unit", "mm"}, {"axes", "LPS"}, {"phases", json::array()}};
  for (const double percent : percents) {
    json places = json::array();
    for (const Vec3& p : moved(points, beat.phase(percent)))
      places.push_back({rounded_motion(p.x()), rounded_motion(p.y()), rounded_motion(p.z())});
    out["phases"].push_back({{"percent", rounded_motion(percent)}, {"points", std::move(places)}});
  }
  return out.dump() + "\n";
}

}  // namespace ostia::phantom
