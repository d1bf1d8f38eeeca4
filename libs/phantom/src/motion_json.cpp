#include "motion_json.h"

#include "case_parts.h"

#include "ostia/phantom/moving_case.h"

#include <cmath>

namespace ostia::phantom {
namespace {

using nlohmann::json;

double rounded(double value) {
  return std::round(value * 1e6) / 1e6;
}

json amplitudes_json(const BeatAmplitudes& a) {
  return {{"left_excursion_mm", rounded(a.left_excursion_mm)},
          {"right_excursion_mm", rounded(a.right_excursion_mm)},
          {"atrial_share", rounded(a.atrial_share)},
          {"epicardial_contraction", rounded(a.epicardial_contraction)},
          {"endocardial_contraction", rounded(a.endocardial_contraction)},
          {"base_rotation_deg", rounded(a.base_rotation_deg)},
          {"apex_rotation_deg", rounded(a.apex_rotation_deg)},
          {"shift_mm", {rounded(a.shift_mm.x()), rounded(a.shift_mm.y()), rounded(a.shift_mm.z())}},
          {"end_systole_percent", rounded(a.end_systole_percent)}};
}

}  // namespace

json vessel_motion_json(const std::vector<VesselMotion>& vessels) {
  json out = json::array();
  for (const VesselMotion& one : vessels) {
    out.push_back({{"vessel", one.vessel},
                   {"displacement_mm", rounded(one.displacement_mm)},
                   {"largest_displacement_mm", rounded(one.largest_displacement_mm)},
                   {"speed_mm_per_s", rounded(one.speed_mm_per_s)},
                   {"largest_speed_mm_per_s", rounded(one.largest_speed_mm_per_s)}});
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
  out["heart_rate_per_min"] = rounded(beat.amplitudes().heart_rate_per_min);
  out["rr_ms"] = rounded(beat.rr_ms());
  out["amplitudes"] = amplitudes_json(beat.amplitudes());
  out["phases"] = json::array();
  for (const double percent : percents) {
    out["phases"].push_back({{"percent", rounded(percent)},
                             {"folder", phase_name(percent)},
                             {"trigger_ms", rounded(0.01 * percent * beat.rr_ms())}});
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
      places.push_back({rounded(p.x()), rounded(p.y()), rounded(p.z())});
    out["phases"].push_back({{"percent", rounded(percent)}, {"points", std::move(places)}});
  }
  return out.dump() + "\n";
}

}  // namespace ostia::phantom
