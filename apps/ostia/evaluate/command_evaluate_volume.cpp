#include "evaluate/covered_region.h"
#include "evaluate/evaluate.h"

#include "ostia/dicom/label_object.h"
#include "ostia/evaluation/label_scores.h"
#include "ostia/evaluation/volume_overlap.h"
#include "ostia/imaging/image_file.h"
#include "ostia/io/surface_file.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <optional>
#include <vector>

namespace ostia::app {
namespace fs = std::filesystem;
namespace {

bool is_surface(const fs::path& path) {
  return io::is_surface_file(path);
}

Json figures(const evaluation::VolumeOverlap& v) {
  return {{"dice", v.dice},
          {"jaccard", v.jaccard},
          {"reference_mm3", v.reference_mm3},
          {"result_mm3", v.result_mm3},
          {"both_mm3", v.both_mm3},
          {"relative_difference", v.relative_difference}};
}

Json volume_number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json label_row(const evaluation::LabelScore& score) {
  Json row{{"label", score.label}, {"in_reference", score.in_reference}, {"in_result", score.in_result}};
  row.update(figures(score.overlap));
  row["relative_difference"] = volume_number(score.overlap.relative_difference);
  row["difference_mm3"] = score.difference_mm3;
  row["msd_mm"] = volume_number(score.boundary.msd_mm);
  row["rms_sd_mm"] = volume_number(score.boundary.rms_sd_mm);
  row["hd95_mm"] = volume_number(score.boundary.hd95_mm);
  row["hausdorff_mm"] = volume_number(score.boundary.max_sd_mm);
  row["signed_mean_mm"] = volume_number(score.boundary.signed_mean_mm);
  return row;
}

/// A segmentation holds the slices alone that it has frames of, in its own order of axes: laid on the grid
/// whose voxels it has. As it is where they are others.
imaging::ImageVolume laid_on(const imaging::MaskVolume& labels, const imaging::Geometry& grid) {
  constexpr double same_voxel = 0.01;
  const imaging::Geometry& own = labels.geometry;
  imaging::ImageVolume out{grid, std::vector<std::int16_t>(static_cast<std::size_t>(grid.voxels()), 0)};
  for (std::int64_t k = 0; k < own.size[2]; ++k)
    for (std::int64_t j = 0; j < own.size[1]; ++j)
      for (std::int64_t i = 0; i < own.size[0]; ++i) {
        if (labels(i, j, k) == 0) continue;
        const auto at =
            grid.index(own.world({static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)}));
        const geometry::Vec3 near = at.array().round();
        if ((at - near).cwiseAbs().maxCoeff() > same_voxel || !grid.contains(grid.world(near)))
          return {own, {labels.voxels.begin(), labels.voxels.end()}};
        out(std::lround(near.x()), std::lround(near.y()), std::lround(near.z())) = labels(i, j, k);
      }
  return out;
}

bool is_label_object(const fs::path& path) {
  return dicom::label_object_kind(path) != dicom::LabelObjectKind::none;
}

/// One of the two, read after the other where that says on which grid it lies.
imaging::ImageVolume labels_on(const fs::path& path, const std::optional<imaging::Geometry>& grid,
                               const core::TaskContext& task) {
  if (!is_label_object(path)) return imaging::read_image(path, task).volume;
  const imaging::MaskVolume labels = dicom::read_labels(path, task, grid).volume;
  return laid_on(labels, grid.value_or(labels.geometry));
}

/// Masks and label volumes: all labels together as one mask, then each where there are several.
Json voxel_figures(const fs::path& reference, const fs::path& result, const core::TaskContext& task) {
  imaging::ImageVolume a, b;
  if (is_label_object(reference)) {
    b = labels_on(result, {}, task);
    a = labels_on(reference, b.geometry, task);
  } else {
    a = labels_on(reference, {}, task);
    b = labels_on(result, a.geometry, task);
  }
  const std::vector<evaluation::LabelScore> labels = evaluation::compare_labels(a, b, {}, task);
  for (imaging::ImageVolume* image : {&a, &b})
    for (std::int16_t& v : image->voxels) v = v != 0;
  Json out = label_row(evaluation::compare_labels(a, b, {}, task).front());
  for (const char* key : {"label", "in_reference", "in_result"}) out.erase(key);
  out["labels"] = Json::array();
  for (const evaluation::LabelScore& score : labels) out["labels"].push_back(label_row(score));
  return out;
}

}  // namespace

ExitCode run_evaluate_volume(const EvaluateCommand& command, const core::TaskContext& task) {
  require_pair(command);
  const std::vector<std::string> names{"lumen.vtp", "lumen.stl", "lumen.ply", "mask.nrrd", "labels.nrrd"};
  const fs::path reference = file_in(command.reference, names, "surface or mask");
  const std::vector<fs::path> parts = files_in(command.result, names, "surface or mask");
  const fs::path& result = parts.front();
  if (is_surface(reference) != is_surface(result))
    throw InvalidInput("cannot compare " + reference.string() + " and " + result.string() +
                       ": one is a surface and the other a mask");
  Json out{{"v", 1}, {"kind", "volume"}};
  if (!is_surface(reference)) {
    if (command.covered_only) throw UsageError("--covered is for surfaces of models");
    out["method"] = "voxels";
    out.update(voxel_figures(reference, result, task));
    return finish(command, out);
  }
  evaluation::Region region;
  if (command.covered_only) {
    if (!fs::is_directory(command.result))
      throw UsageError(
          "--covered needs the folder of a model as RESULT: its centerlines tell what it covers");
    region = covered_region(lines_of_parts(
        files_in(command.result, {"centerlines.vtp", "centerlines.csv"}, "centerlines"), command.units));
  }
  out["method"] = "lines";
  out["resolution_mm"] = command.resolution_mm;
  out["covered_only"] = command.covered_only;
  out.update(figures(evaluation::compare_enclosed(surface_from(reference, command.units),
                                                  surface_of_parts(parts, command.units),
                                                  command.resolution_mm, region, task)));
  task.set_progress(1.0);
  return finish(command, out);
}

}  // namespace ostia::app
