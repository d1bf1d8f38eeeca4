#include "ostia/pipeline/calcium_report.h"

#include "ostia/core/csv.h"
#include "ostia/core/files.h"
#include "ostia/core/text.h"
#include "ostia/figure/slice_figure.h"
#include "ostia/imaging/image_file.h"
#include "ostia/reformat/plane_image.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <map>
#include <utility>

namespace ostia::pipeline {
namespace {

using analysis::CalciumAmount;
using analysis::CalciumLesion;
using analysis::CalciumPlace;
using analysis::CalciumScore;
using geometry::Vec3;
using Json = nlohmann::ordered_json;

constexpr double seen_about_mm = 90.0;  // half of a picture's side
constexpr std::int32_t most_numbers = 32767;

Json amount_json(const CalciumAmount& amount, const CalciumScore& score) {
  Json out{{"agatston", amount.agatston},
           {"volume_mm3", amount.volume_mm3},
           {"interpolated_volume_mm3", amount.interpolated_mm3}};
  out["mass_mg"] = score.options.calibration ? Json(amount.mass_mg) : Json(nullptr);
  return out;
}

Json lesion_json(const CalciumLesion& lesion, const CalciumScore& score) {
  Json out{{"number", lesion.number},
           {"place", analysis::to_string(lesion.place)},
           {"coronary", analysis::is_coronary(lesion.place)},
           {"assigned", lesion.assigned},
           {"proposed", analysis::to_string(lesion.proposed)},
           {"confidence", lesion.confidence},
           {"centre", {lesion.centre.x(), lesion.centre.y(), lesion.centre.z()}},
           {"peak_hu", lesion.peak_hu},
           {"slices", lesion.slices}};
  out.update(amount_json(lesion.amount, score));
  return out;
}

figure::Color color_of(CalciumPlace place) {
  switch (place) {
    case CalciumPlace::left_main:
      return figure::palette(6);
    case CalciumPlace::lad:
      return figure::palette(0);
    case CalciumPlace::lcx:
      return figure::palette(1);
    case CalciumPlace::rca:
      return figure::palette(2);
    default:
      return figure::palette(7);
  }
}

/// The borders of lesions' pixels in a slice, by place.
std::map<CalciumPlace, std::vector<std::vector<Vec3>>> outlines(const analysis::ScoredCalcium& scored,
                                                                std::int64_t k) {
  const auto& numbers = scored.lesion_numbers;
  const imaging::Geometry& grid = numbers.geometry;
  std::map<CalciumPlace, std::vector<std::vector<Vec3>>> lines;
  const auto number = [&](std::int64_t i, std::int64_t j) {
    return i < 0 || j < 0 || i >= grid.size[0] || j >= grid.size[1] ? 0 : numbers(i, j, k);
  };
  const auto corner = [&](double i, double j) { return grid.world(Vec3(i, j, static_cast<double>(k))); };
  for (std::int64_t j = 0; j < grid.size[1]; ++j)
    for (std::int64_t i = 0; i < grid.size[0]; ++i) {
      const std::int32_t here = number(i, j);
      if (here == 0) continue;
      std::vector<std::vector<Vec3>>& of =
          lines[scored.score.lesions[static_cast<std::size_t>(here - 1)].place];
      const double x = static_cast<double>(i), y = static_cast<double>(j);
      if (number(i - 1, j) != here) of.push_back({corner(x - 0.5, y - 0.5), corner(x - 0.5, y + 0.5)});
      if (number(i + 1, j) != here) of.push_back({corner(x + 0.5, y - 0.5), corner(x + 0.5, y + 0.5)});
      if (number(i, j - 1) != here) of.push_back({corner(x - 0.5, y - 0.5), corner(x + 0.5, y - 0.5)});
      if (number(i, j + 1) != here) of.push_back({corner(x - 0.5, y + 0.5), corner(x + 0.5, y + 0.5)});
    }
  return lines;
}

/// Slices by how many voxels of coronary calcium they have, then from top to bottom.
std::vector<std::int64_t> slices_to_show(const analysis::ScoredCalcium& scored, std::size_t most) {
  const imaging::Geometry& grid = scored.lesion_numbers.geometry;
  const auto per_slice = static_cast<std::size_t>(grid.size[0] * grid.size[1]);
  std::vector<std::pair<std::int64_t, std::int64_t>> found;  // voxels, slice
  for (std::int64_t k = 0; k < grid.size[2]; ++k) {
    std::int64_t count = 0;
    for (std::size_t n = 0; n < per_slice; ++n) {
      const std::int32_t number = scored.lesion_numbers.voxels[static_cast<std::size_t>(k) * per_slice + n];
      if (number > 0 &&
          analysis::is_coronary(scored.score.lesions[static_cast<std::size_t>(number - 1)].place))
        ++count;
    }
    if (count > 0) found.emplace_back(count, k);
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  found.resize(std::min(found.size(), most));
  const auto height = [&](std::int64_t k) { return grid.world(Vec3(0, 0, static_cast<double>(k))).z(); };
  std::vector<std::int64_t> slices;
  for (const auto& one : found) slices.push_back(one.second);
  std::sort(slices.begin(), slices.end(),
            [&](std::int64_t a, std::int64_t b) { return height(a) > height(b); });
  return slices;
}

/// About the middle of the coronary calcium, or of the image.
reformat::Plane plane_about(const analysis::ScoredCalcium& scored, std::int64_t k) {
  const imaging::Geometry& grid = scored.image.geometry;
  Vec3 middle = Vec3::Zero();
  double count = 0.0;
  for (const CalciumLesion& lesion : scored.score.lesions)
    if (analysis::is_coronary(lesion.place)) middle += lesion.centre, count += 1.0;
  Vec3 at = grid.index(count > 0.0 ? Vec3(middle / count) : grid.origin);
  at.z() = static_cast<double>(k);
  reformat::Plane plane;
  plane.u = grid.direction.col(0);
  plane.v = grid.direction.col(1);
  plane.pixel_mm = grid.spacing.x();
  plane.width = plane.height = static_cast<int>(2.0 * seen_about_mm / plane.pixel_mm);
  plane.origin = grid.world(at) - seen_about_mm * (plane.u + plane.v);
  return plane;
}

}  // namespace

std::string calcium_json(const ScoredScan& scan) {
  const CalciumScore& score = scan.scored.score;
  Json out{{"v", 1},
           {"kind", "calcium"},
           {"image", scan.pseudonym},
           {"tube_kv", scan.tube_kv ? Json(*scan.tube_kv) : Json(nullptr)},
           {"slice_mm", score.slice_mm},
           {"slices_averaged", score.averaged},
           {"scored_slice_mm", score.scored_slice_mm},
           {"threshold_hu", score.options.threshold_hu},
           {"least_area_mm2", score.options.least_area_mm2}};
  out["calibration"] = score.options.calibration ? Json(*score.options.calibration) : Json(nullptr);
  out["total"] = amount_json(score.total, score);
  out["category"] = analysis::to_string(score.category());
  out["cac_drs"] = analysis::cac_drs(score.total.agatston, score.vessels());
  out["vessels"] = Json::object();
  for (std::size_t n = 0; n < analysis::coronary_places; ++n)
    out["vessels"][analysis::to_string(static_cast<CalciumPlace>(n))] = amount_json(score.by_place[n], score);
  out["lesions"] = Json::array();
  for (const CalciumLesion& lesion : score.lesions) out["lesions"].push_back(lesion_json(lesion, score));
  out["chest_parts"] = score.chest_parts;
  out["warnings"] = score.warnings;
  return out.dump(1) + "\n";
}

std::string calcium_csv(const ScoredScan& scan) {
  using core::significant_text;
  const CalciumScore& score = scan.scored.score;
  std::string out =
      core::csv_line({"lesion", "place", "assigned", "proposed", "confidence", "x_mm", "y_mm", "z_mm",
                      "peak_hu", "slices", "agatston", "volume_mm3", "interpolated_volume_mm3", "mass_mg"});
  for (const CalciumLesion& l : score.lesions)
    out += core::csv_line({std::to_string(l.number), analysis::to_string(l.place), l.assigned ? "yes" : "no",
                           analysis::to_string(l.proposed), significant_text(l.confidence, 3),
                           significant_text(l.centre.x(), 6), significant_text(l.centre.y(), 6),
                           significant_text(l.centre.z(), 6), significant_text(l.peak_hu, 6),
                           std::to_string(l.slices), significant_text(l.amount.agatston, 6),
                           significant_text(l.amount.volume_mm3, 6),
                           significant_text(l.amount.interpolated_mm3, 6),
                           score.options.calibration ? significant_text(l.amount.mass_mg, 6) : ""});
  return out;
}

std::vector<figure::Picture> calcium_pictures(const ScoredScan& scan, std::size_t most) {
  std::vector<figure::Picture> pictures;
  for (const std::int64_t k : slices_to_show(scan.scored, most)) {
    std::vector<figure::SliceContour> contours;
    for (auto& [place, lines] : outlines(scan.scored, k))
      contours.push_back({std::move(lines), color_of(place), 1.4, analysis::to_string(place)});
    figure::SliceFigureOptions options;
    options.level_hu = 100.0;
    options.window_hu = 700.0;
    options.image_width_px = 420;
    pictures.push_back(figure::slice_figure(reformat::slice(scan.scored.image, plane_about(scan.scored, k)),
                                            contours, {}, options));
  }
  return pictures;
}

void write_calcium_report(const std::filesystem::path& folder, const ScoredScan& scan, const JobKey& key,
                          double seconds_before, const core::TaskContext& task) {
  const auto start = std::chrono::steady_clock::now();
  task.set_stage("report");
  core::StagedFolder staged(folder);
  core::write_file(staged.temporary() / "calcium.json", calcium_json(scan));
  core::write_file(staged.temporary() / "lesions.csv", calcium_csv(scan));
  imaging::ImageVolume numbers{scan.scored.lesion_numbers.geometry, {}};
  for (const std::int32_t number : scan.scored.lesion_numbers.voxels)
    numbers.voxels.push_back(static_cast<std::int16_t>(std::min(number, most_numbers)));
  imaging::write_image(staged.temporary() / "lesions.nrrd", numbers);
  task.set_progress(0.5);
  if (const auto pictures = calcium_pictures(scan); !pictures.empty()) {
    figure::GridOptions options;
    options.columns = static_cast<int>(std::min<std::size_t>(3, pictures.size()));
    figure::grid(pictures, options).write_png(staged.temporary() / "slices.png");
  }
  const double seconds =
      seconds_before + std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  write_manifest(staged.temporary(), {key, ExitCode::ok, seconds, scan.scored.score.warnings, "{}"});
  task.throw_if_cancelled();
  staged.commit();
  task.set_progress(1.0);
}

}  // namespace ostia::pipeline
