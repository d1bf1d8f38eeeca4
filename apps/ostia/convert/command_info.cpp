#include "commands.h"
#include "convert/info_kinds.h"
#include "input/seeds.h"
#include "options/model_options.h"
#include "output/json_output.h"
#include "tree/tree_commands.h"

#include "ostia/core/error.h"
#include "ostia/core/log.h"
#include "ostia/dicom/label_object.h"
#include "ostia/imaging/dicom.h"
#include "ostia/imaging/image_file.h"
#include "ostia/io/graph_file.h"
#include "ostia/io/surface_file.h"
#include "ostia/pipeline/source.h"
#include "ostia/pipeline/volume_preview.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <map>
#include <vector>

namespace ostia::app {
namespace {

ImageFacts facts_of(const imaging::ImageVolume& image, std::string kind, std::vector<std::string> warnings) {
  ImageFacts facts{std::move(kind), image.geometry, 0.0, 0.0, 0.0, std::move(warnings)};
  const auto [least, largest] = std::minmax_element(image.voxels.begin(), image.voxels.end());
  facts.least = *least;
  facts.largest = *largest;
  std::vector<std::int16_t> values = image.voxels;
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                   values.end());
  facts.median = values[values.size() / 2];
  return facts;
}

/// The values of a mask but 0, and how often they are there.
std::vector<LabelFacts> labels_in(const std::filesystem::path& mask, const core::TaskContext& task) {
  std::map<int, std::size_t> voxels;  // in the order of the labels
  try {
    const auto loaded = dicom::read_labels(mask, task);
    const std::vector<std::int64_t>& names = loaded.header.file_labels;
    for (const std::uint8_t value : loaded.volume.voxels)
      ++voxels[names.empty() ? value : static_cast<int>(names[value])];
  } catch (const InvalidInput&) {  // two values of an image are no labels
    return {};
  }
  voxels.erase(0);
  std::vector<LabelFacts> labels;
  for (const auto& [label, count] : voxels) labels.push_back({label, count});
  return labels;
}

void preview(const InfoOptions& options, const imaging::ImageVolume& image) {
  pipeline::PreviewOptions how;
  how.axial_slices = options.preview_slices;
  if (!options.position.empty())
    how.position = seed_point("--position", options.position, {options.input.coords, &image.geometry});
  const std::vector<std::string> names = pipeline::write_preview(image, options.preview, how);
  core::log_info(std::to_string(names.size()) +
                 " pictures written; their rulers are world coordinates (LPS, mm)");
}

ExitCode surface_info(const InfoOptions& options) {
  const io::LoadedSurface loaded = io::read_surface(options.input.input);
  const geometry::TriMesh& mesh = loaded.surface.mesh;
  SurfaceFacts facts;
  facts.points = mesh.points.size();
  facts.triangles = mesh.triangles.size();
  facts.faults = geometry::find_faults(mesh, true);
  facts.area_mm2 = geometry::area(mesh);
  facts.volume_mm3 = facts.faults.closed_manifold() ? geometry::volume(mesh) : 0.0;
  facts.box = geometry::bounds(mesh.points);
  std::fputs(surface_text(facts, options.json).c_str(), stdout);
  return ExitCode::ok;
}

}  // namespace

ExitCode run_info(const InfoOptions& options, const core::TaskContext& task) {
  if (io::is_graph_file(options.input.input)) return tree_info(options, task);
  if (is_own_kind(options.input.input)) return own_kind_info(options, task);
  const pipeline::SourceKind kind = pipeline::classify(options.input.input);
  if (kind == pipeline::SourceKind::surface) return surface_info(options);
  if (kind == pipeline::SourceKind::dicom && options.preview.empty()) {
    const imaging::DicomFolder folder = imaging::scan_dicom(options.input.input, task);
    std::fputs(series_text(folder, options.json).c_str(), stdout);
    if (folder.series.empty()) throw InvalidInput("no DICOM image in " + options.input.input.string());
    return ExitCode::ok;
  }
  const pipeline::Source source = pipeline::load(options.input.input, source_options(options.input), task);
  imaging::ImageVolume image;
  if (source.image) {
    image = *source.image;
  } else {
    image.geometry = source.mask->geometry;
    image.voxels.assign(source.mask->voxels.begin(), source.mask->voxels.end());
  }
  ImageFacts facts = facts_of(image, pipeline::name_of(kind), source.warnings);
  if (source.mask) facts.labels = labels_in(options.input.input, task);
  std::fputs(image_text(facts, options.json).c_str(), stdout);
  if (!options.preview.empty()) preview(options, image);
  return ExitCode::ok;
}

}  // namespace ostia::app
