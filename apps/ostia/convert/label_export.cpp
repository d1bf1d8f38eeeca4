#include "convert/label_export.h"

#include "options/model_options.h"
#include "output/outputs.h"
#include "output/refusal.h"

#include "ostia/core/error.h"
#include "ostia/core/log.h"
#include "ostia/imaging/image_axes.h"
#include "ostia/imaging/image_file.h"
#include "ostia/session/case_file.h"
#include "ostia/session/label_volume.h"

#include <nlohmann/json.hpp>

#include <cstdio>
#include <string>
#include <utility>

namespace ostia::app {
namespace {

using session::VoxelLabels;

VoxelLabels labels_of(const std::string& word) {
  if (word == "segments") return VoxelLabels::segments;
  if (word == "wall") return VoxelLabels::wall;
  if (word == "plaque") return VoxelLabels::plaque;
  return VoxelLabels::lumen;
}

/// A CT is read in full where walls are to be found in it; of anything else the header is enough.
struct Grid {
  imaging::Geometry geometry;
  pipeline::Source ct;
};
Grid grid_of(const std::filesystem::path& file, bool whole, const core::TaskContext& task) {
  Grid grid;
  const pipeline::SourceKind kind = pipeline::classify(file);
  if (kind == pipeline::SourceKind::surface)
    throw InvalidInput(own_name(file) + " is a surface and has no grid; give the CT, or a mask on its grid");
  if (whole || kind == pipeline::SourceKind::dicom) {
    pipeline::SourceOptions reading;
    reading.dicom.assume_axial = true;  // the case says how the patient lies
    grid.ct = pipeline::load_ct(file, reading, task);
    for (const std::string& warning : grid.ct.warnings) core::log_warning(warning);
    grid.geometry = grid.ct.image->geometry;
  } else {
    grid.geometry = imaging::read_image_header(file).geometry;
  }
  return grid;
}

void print_counts(const session::LabelVolume& labels, bool as_json) {
  if (!as_json) {
    for (const session::LabelCount& one : labels.counts)
      std::printf("%3d  %-20s %lld voxels\n", one.value, one.name.c_str(),
                  static_cast<long long>(one.voxels));
    return;
  }
  nlohmann::ordered_json counts = nlohmann::ordered_json::array();
  for (const session::LabelCount& one : labels.counts)
    counts.push_back({{"value", one.value}, {"name", one.name}, {"voxels", one.voxels}});
  std::puts(nlohmann::ordered_json{
      {"v", 1}, {"kind", "conversion"}, {"labels", counts}, {"warnings", labels.warnings}}
                .dump(2)
                .c_str());
}

}  // namespace

bool converts_to_labels(const ConvertCommand& options) {
  const bool is_case = options.input.input.extension() == ".ostia";
  const bool is_image = has_extension(options.output, image_outputs);
  if (!options.grid.empty() && !(is_case && is_image))
    throw UsageError("--grid is for labels of a case: ostia convert CASE.ostia LABELS.nii.gz --grid CT");
  if (!options.labels.empty() && options.grid.empty())
    throw UsageError("--labels needs --grid, the CT on whose voxels they are to be");
  if (is_case && is_image && options.grid.empty())
    throw UsageError("labels of a case need --grid, the CT on whose voxels they are to be");
  return is_case && is_image;
}

ExitCode convert_to_labels(const ConvertCommand& options, const core::TaskContext& task) {
  const VoxelLabels what = labels_of(options.labels);
  const bool walls = what == VoxelLabels::wall || what == VoxelLabels::plaque;
  require_output(options.output, image_outputs);
  task.set_stage("reading");
  const auto opened = session::CaseFile::open(options.input.input, session::OpenMode::read_only);
  Grid grid = grid_of(options.grid, walls, task.sub(0.0, 0.2));
  const std::optional<session::ImageReference> own = opened.image();
  // What a person said of the CT's axes is in the case and not in its file.
  const imaging::AxesGiven as_file = imaging::given_axes(grid.geometry, {});
  const imaging::AxesGiven as_case = imaging::given_axes(grid.geometry, own ? own->axes : std::string());
  if (grid.ct.image && own && !own->axes.empty())
    grid.ct.image =
        std::make_shared<const imaging::ImageVolume>(imaging::laid(*grid.ct.image, as_file, as_case));
  if (grid.ct.image && own && own->sha256 != grid.ct.sha256)
    core::log_warning(own_name(options.grid) + " is not the image that the case was made of");
  const session::LabelVolume labels = naming(options.grid, [&] {
    return session::label_volume(*opened.model(), as_case.grid, what, walls ? grid.ct.image.get() : nullptr,
                                 {}, task.sub(0.2, 0.9));
  });
  for (const std::string& warning : labels.warnings) core::log_warning(warning);
  task.set_stage("writing");
  imaging::write_image(options.output, imaging::laid(labels.volume, as_case, as_file));
  task.set_progress(1.0);
  print_counts(labels, options.json);
  return ExitCode::ok;
}

}  // namespace ostia::app
