#include "ostia/core/csv.h"
#include "ostia/core/text.h"
#include "ostia/figure/plot.h"
#include "ostia/session/vessel_fat.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace ostia::session {
namespace {

using core::significant_text;
using Json = nlohmann::ordered_json;

Json mean_of(double mean_hu, std::int64_t voxels) {
  return voxels > 0 ? Json(mean_hu) : Json(nullptr);
}

Json at_120_kv(const CaseFat& fat, double mean_hu, std::int64_t voxels) {
  if (!fat.tube_kv || voxels == 0) return nullptr;
  const auto value = analysis::fat_hu_at_120_kv(mean_hu, *fat.tube_kv);
  return value ? Json(*value) : Json(nullptr);
}

Json vessel_json(const CaseFat& fat, const VesselFat& one) {
  const analysis::FatAmount& amount = one.profile.fat;
  return {{"name", one.name},
          {"from_mm", one.profile.from_mm - one.origin_mm},
          {"to_mm", one.profile.to_mm - one.origin_mm},
          {"origin_mm", one.origin_mm},
          {"diameter_mm", one.profile.diameter_mm},
          {"mean_hu", mean_of(amount.mean_hu, amount.voxels)},
          {"sd_hu", mean_of(amount.sd_hu, amount.voxels)},
          {"voxels", amount.voxels},
          {"all_mean_hu", mean_of(amount.all_mean_hu, amount.all_voxels)},
          {"all_voxels", amount.all_voxels},
          {"volume_mm3", amount.volume_mm3},
          {"all_mean_at_120_kv_hu", at_120_kv(fat, amount.all_mean_hu, amount.all_voxels)},
          {"seen_share", one.seen_share}};
}

std::string csv_mean(double mean_hu, std::int64_t voxels) {
  return voxels > 0 ? significant_text(mean_hu, 6) : "";
}

}  // namespace

std::string fat_json(const CaseFat& fat) {
  const analysis::FatOptions options =
      fat.vessels.empty() ? analysis::FatOptions() : fat.vessels[0].profile.options;
  Json out{{"v", 1},
           {"kind", "fat"},
           {"from_hu", options.from_hu},
           {"to_hu", options.to_hu},
           {"reach_diameters", options.reach_diameters},
           {"edge_mm", options.edge_mm},
           {"tube_kv", fat.tube_kv ? Json(*fat.tube_kv) : Json(nullptr)}};
  out["vessels"] = Json::array();
  for (const VesselFat& one : fat.vessels) out["vessels"].push_back(vessel_json(fat, one));
  out["warnings"] = fat.warnings;
  return out.dump(1) + "\n";
}

std::string fat_csv(const CaseFat& fat) {
  std::string out = core::csv_line({"vessel", "from_mm", "to_mm", "diameter_mm", "mean_hu", "sd_hu", "voxels",
                                    "all_mean_hu", "all_voxels", "volume_mm3"});
  for (const VesselFat& one : fat.vessels) {
    const analysis::FatAmount& amount = one.profile.fat;
    out += core::csv_line({one.name, significant_text(one.profile.from_mm - one.origin_mm, 6),
                           significant_text(one.profile.to_mm - one.origin_mm, 6),
                           significant_text(one.profile.diameter_mm, 6),
                           csv_mean(amount.mean_hu, amount.voxels), csv_mean(amount.sd_hu, amount.voxels),
                           std::to_string(amount.voxels), csv_mean(amount.all_mean_hu, amount.all_voxels),
                           std::to_string(amount.all_voxels), significant_text(amount.volume_mm3, 6)});
  }
  return out;
}

std::string fat_map_csv(const CaseFat& fat) {
  std::string out = core::csv_line(
      {"vessel", "from_mm", "to_mm", "from_theta_deg", "mean_hu", "voxels", "all_mean_hu", "all_voxels"});
  for (const VesselFat& one : fat.vessels)
    for (const analysis::FatPiece& piece : one.profile.pieces)
      out += core::csv_line({one.name, significant_text(piece.from_mm - one.origin_mm, 6),
                             significant_text(piece.to_mm - one.origin_mm, 6),
                             significant_text(piece.from_theta * 180.0 / std::numbers::pi, 6),
                             csv_mean(piece.fat.mean_hu, piece.fat.voxels), std::to_string(piece.fat.voxels),
                             csv_mean(piece.fat.all_mean_hu, piece.fat.all_voxels),
                             std::to_string(piece.fat.all_voxels)});
  return out;
}

std::optional<figure::Picture> fat_picture(const CaseFat& fat) {
  std::vector<figure::Series> curves;
  bool any = false;
  for (const VesselFat& one : fat.vessels) {
    figure::Series curve;
    curve.name = one.name;
    const double slab_mm = one.profile.options.slab_mm;
    for (std::size_t i = 0; i < one.profile.slabs.size(); ++i) {
      const analysis::FatAmount& amount = one.profile.slabs[i];
      curve.x.push_back(one.profile.from_mm - one.origin_mm + (static_cast<double>(i) + 0.5) * slab_mm);
      curve.y.push_back(amount.voxels > 0 ? amount.mean_hu : std::numeric_limits<double>::quiet_NaN());
      any = any || amount.voxels > 0;
    }
    curves.push_back(std::move(curve));
  }
  if (!any) return std::nullopt;
  figure::PlotOptions options;
  options.title = "Fat about the arteries";
  options.x_label = "mm along the vessel";
  options.y_label = "mean of the fat (HU)";
  return figure::line_plot(curves, options);
}

}  // namespace ostia::session
