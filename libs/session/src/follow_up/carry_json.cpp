#include "ostia/registration/transform_json.h"
#include "ostia/session/carry.h"
#include "ostia/session/scan_map.h"

#include <nlohmann/json.hpp>

namespace ostia::session {
namespace {

using CarryJson = nlohmann::ordered_json;

CarryJson carried_map_json(const CarriedCase& carried) {
  const registration::Quality& quality = carried.registration.quality;
  return {{"is", scan_map(carried.registration).words},
          {"verdict", registration::name_of(quality.verdict)},
          {"reason", quality.reason},
          {"correlation", quality.correlation},
          {"overlap", quality.overlap},
          {"least_jacobian", quality.jacobian_min},
          {"largest_jacobian", quality.jacobian_max},
          {"inverse_consistency_mm", quality.inverse_consistency_mm},
          {"landmarks_mean_mm", quality.landmarks_mean_mm},
          {"landmarks_max_mm", quality.landmarks_max_mm},
          {"affine", CarryJson::parse(registration::to_json(carried.registration.affine))}};
}

CarryJson carried_vessel_json(const CarriedVessel& one) {
  return {{"id", one.vessel},
          {"name", one.name},
          {"how", to_string(one.how)},
          {"before_mm", one.before_mm},
          {"after_mm", one.after_mm},
          {"shift_mm", one.shift_mm},
          {"largest_shift_mm", one.largest_shift_mm},
          {"unseen_mm", one.unseen_mm},
          {"cut_mm", one.cut_mm},
          {"wall_kept_share", one.wall_kept_share},
          {"notes", one.notes}};
}

}  // namespace

std::string carried_json(const CarriedCase& carried) {
  CarryJson vessels = CarryJson::array(), came = CarryJson::array();
  for (const CarriedVessel& one : carried.carried.vessels) vessels.push_back(carried_vessel_json(one));
  for (const CameVessel& one : carried.came)
    came.push_back({{"name", one.name},
                    {"place", {one.place.x(), one.place.y(), one.place.z()}},
                    {"length_mm", one.length_mm},
                    {"probability", one.probability}});
  const CarryJson out{{"v", 1},
                      {"kind", "carried case"},
                      {"map", carried_map_json(carried)},
                      {"one_patient", carried.another_patient.empty()},
                      {"followed_share", carried.carried.followed_share},
                      {"vessels", vessels},
                      {"searched", carried.searched},
                      {"came", came},
                      {"not_carried", carried.carried.not_carried},
                      {"warnings", carried.warnings}};
  return out.dump(2) + "\n";
}

}  // namespace ostia::session
