#include "motion/phase_surface.h"

#include "motion/motion_input.h"
#include "output/refusal.h"

#include "ostia/core/log.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/io/surface_file.h"
#include "ostia/lumen/tree_surface.h"
#include "ostia/meshing/poisson_surface.h"
#include "ostia/pipeline/source.h"
#include "ostia/segmentation/segment.h"
#include "ostia/session/case_file.h"

#include <algorithm>
#include <string_view>

namespace ostia::app {
namespace fs = std::filesystem;
namespace {

std::size_t parts_of(const geometry::TriMesh& mesh) {
  const std::vector<std::int32_t> of = geometry::components(mesh);
  return of.empty() ? 0 : static_cast<std::size_t>(*std::ranges::max_element(of)) + 1;
}

void warn_of_breaks(const fs::path& path, const geometry::TriMesh& stairs, const geometry::TriMesh& smooth) {
  const std::size_t before = parts_of(stairs), after = parts_of(smooth);
  if (after > before)
    core::log_warning(path.filename().string() + ": the Poisson surface is in " + std::to_string(after) +
                      " parts, the mask in " + std::to_string(before) +
                      ": what is thinner than about three voxels breaks; --surface isosurface keeps it");
}

geometry::TriMesh mask_surface(const fs::path& path, MaskSurface how, const core::TaskContext& task) {
  if (pipeline::classify(path) == pipeline::SourceKind::image)
    throw InvalidInput(path.string() +
                       " is an image and no mask: give the lumen's surface at one phase with --template, or "
                       "make one of each, with `ostia segment`");
  const pipeline::Source source = pipeline::load(path);
  if (std::ranges::none_of(source.mask->voxels, [](auto v) { return v != 0; })) return {};
  return naming(path, [&] {
    const geometry::TriMesh surface = segmentation::segment_mask(*source.mask, {}, task.sub(0.0, 0.2));
    if (how == MaskSurface::isosurface) return surface;
    meshing::PoissonOptions options;
    options.cell_mm = source.mask->geometry.spacing.minCoeff();
    geometry::TriMesh smooth = meshing::poisson_surface(surface, options, task.sub(0.2, 1.0));
    warn_of_breaks(path, surface, smooth);
    return smooth;
  });
}

geometry::TriMesh case_surface(const fs::path& path) {
  const auto model = session::CaseFile::open(path, session::OpenMode::read_only).model();
  if (!model || model->vessels.empty()) return {};
  return naming(path, [&] { return lumen::surface_of(*model); });
}

}  // namespace

bool is_image_name(const std::string& name) {
  for (const std::string_view end : {".nrrd", ".nhdr", ".mhd", ".mha", ".nii", ".nii.gz"})
    if (name.ends_with(end)) return true;
  return false;
}

geometry::TriMesh phase_surface(const fs::path& path, const std::string& units, MaskSurface how,
                                const core::TaskContext& task) {
  if (is_image_name(path.filename().string())) return mask_surface(path, how, task);
  if (path.extension() == ".ostia") return case_surface(path);
  geometry::TriMesh mesh;
  try {
    mesh = io::read_surface(path).surface.mesh;
  } catch (const io::EmptySurface&) {
    return {};
  }
  for (geometry::Vec3& p : mesh.points) p *= unit_mm(units);
  return mesh;
}

std::vector<pipeline::PhaseSurface> read_phases(const std::vector<PhaseFile>& files, const std::string& units,
                                                MaskSurface how, const core::TaskContext& task) {
  std::vector<pipeline::PhaseSurface> phases;
  for (const PhaseFile& one : files) {
    task.throw_if_cancelled();
    const double done = static_cast<double>(phases.size()), all = static_cast<double>(files.size());
    phases.push_back({one.phase, name_of(one),
                      phase_surface(one.file, units, how, task.sub(done / all, (done + 1.0) / all))});
    task.set_progress((done + 1.0) / all);
  }
  return phases;
}

double unit_mm(const std::string& units) {
  return units == "m" ? 1000.0 : units == "cm" ? 10.0 : 1.0;
}

}  // namespace ostia::app
