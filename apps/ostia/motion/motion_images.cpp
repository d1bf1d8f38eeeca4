#include "motion/motion_images.h"

#include "input/input_digest.h"

#include "ostia/core/error.h"
#include "ostia/core/log.h"
#include "ostia/pipeline/source.h"

#include <algorithm>
#include <cmath>

namespace ostia::app {
namespace fs = std::filesystem;
namespace {

bool is_image(const PhaseFile& one) {
  if (one.series || fs::is_directory(one.file)) return true;
  if (one.file.extension() == ".ostia" || one.file.extension() == ".vtk") return false;
  return pipeline::classify(one.file) == pipeline::SourceKind::image;
}

std::shared_ptr<const imaging::ImageVolume> image_of(const PhaseFile& one, const core::TaskContext& task) {
  if (one.series) {
    imaging::LoadedImage<std::int16_t> loaded = imaging::read_dicom_series(*one.series, {}, task);
    for (const std::string& warning : loaded.header.warnings)
      core::log_warning(name_of(one) + ": " + warning);
    return std::make_shared<const imaging::ImageVolume>(std::move(loaded.volume));
  }
  pipeline::Source source = pipeline::load_ct(one.file, {}, task);
  for (const std::string& warning : source.warnings) core::log_warning(name_of(one) + ": " + warning);
  return source.image;
}

}  // namespace

bool are_images(const std::vector<PhaseFile>& files) {
  const PhaseFile* image = nullptr;
  const PhaseFile* other = nullptr;
  for (const PhaseFile& one : files) (is_image(one) ? image : other) = &one;
  if (image && other)
    throw InvalidInput(
        name_of(*image) + " is an image, " + name_of(*other) +
        " is none: with --template a folder holds either images, or surfaces, masks and cases");
  return image != nullptr;
}

std::string digest_of(const PhaseFile& one, const core::TaskContext& task) {
  return one.series ? imaging::series_digest(*one.series, task) : digest_of(one.file);
}

pipeline::ImagePhases phases_in_images(const std::vector<PhaseFile>& files, const geometry::TriMesh& shape,
                                       const pipeline::ImagePhasesOptions& options,
                                       const core::TaskContext& task) {
  std::vector<pipeline::PhaseView> views;
  for (const PhaseFile& one : files)
    views.push_back(
        {one.phase, name_of(one), [one](const core::TaskContext& own) { return image_of(one, own); }});
  return pipeline::surfaces_from_images(shape, std::move(views), options, task);
}

void put_template(geometry::TriMesh shape, double phase, const std::string& name,
                  std::vector<pipeline::PhaseSurface>& phases) {
  if (shape.triangles.empty()) throw InvalidInput(name + ": the template holds no vessel");
  // Percents are given rounded: what is of the same moment is replaced, and keeps its own phase.
  for (pipeline::PhaseSurface& one : phases)
    if (pipeline::is_same_phase(one.phase, phase)) {
      one = {one.phase, name, std::move(shape)};
      return;
    }
  phases.push_back({phase, name, std::move(shape)});
}

}  // namespace ostia::app
