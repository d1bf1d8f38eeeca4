#include "motion.h"
#include "motion_input.h"
#include "outputs.h"
#include "refusal.h"

#include "ostia/core/log.h"
#include "ostia/io/centerline_file.h"
#include "ostia/io/mesh_export.h"
#include "ostia/io/surface_file.h"
#include "ostia/io/volume_mesh_file.h"
#include "ostia/motion/moving_cage.h"
#include "ostia/pipeline/motion_export.h"

#include <cmath>
#include <optional>

namespace ostia::app {
namespace {

namespace fs = std::filesystem;
using geometry::Vec3;
using Points = std::vector<Vec3>;

/// The cage at one phase.
class AtPhase {
 public:
  AtPhase(const motion::MovingCage& cage, double phase) : grid_(cage.grid()), control_(cage.at(phase)) {}

  /// Throws InvalidInput where none of the points lies in the cage; warns of those that do not.
  Points carried(const Points& points, const fs::path& of) const {
    const motion::CarriedPoints carried(grid_, points);
    if (!points.empty() && carried.outside() == points.size())
      throw InvalidInput(own_name(of) +
                         ": none of its points lies in the motion's cage; it is of another heart, unit or "
                         "frame");
    if (carried.outside() > 0)
      core::log_warning(own_name(of) + ": " + std::to_string(carried.outside()) + " of " +
                        std::to_string(points.size()) +
                        " points lie outside of the motion's cage; they go as its nearest place does");
    return carried.places(control_);
  }

 private:
  geometry::CageGrid grid_;
  Points control_;
};

ExitCode apply_to_mesh(const MotionApplyCommand& c, const AtPhase& cage) {
  require_output(c.output, {".vtu"});
  geometry::MixedMesh mesh = io::read_volume_mesh(c.input);
  mesh.points = cage.carried(mesh.points, c.input);
  const pipeline::CarriedQuality quality = pipeline::carried_quality(mesh);
  io::export_mesh(mesh, io::MeshFormat::vtu, c.output);
  if (quality.inverted == 0) return ExitCode::ok;
  core::log_warning("quality control failed: " + std::to_string(quality.inverted) +
                    " elements are inverted at this phase");
  return ExitCode::quality_failed;
}

ExitCode apply_to_lines(const MotionApplyCommand& c, const AtPhase& cage) {
  require_output(c.output, line_outputs);
  geometry::VesselTree tree = io::read_centerlines(c.input);
  Points all;  // nodes first, so that they and the ends of axes stay together
  for (const geometry::TreeNode& node : tree.nodes) all.push_back(node.position);
  for (const geometry::TreeSegment& segment : tree.segments)
    all.insert(all.end(), segment.axis.points.begin(), segment.axis.points.end());
  const Points moved = cage.carried(all, c.input);
  auto next = moved.begin();
  for (geometry::TreeNode& node : tree.nodes) node.position = *next++;
  for (geometry::TreeSegment& segment : tree.segments) {
    for (Vec3& p : segment.axis.points) p = *next++;
    geometry::complete(segment.axis);
  }
  io::write_centerlines(c.output, tree);
  return ExitCode::ok;
}

/// Nothing for a file that holds no triangles: lines, perhaps.
std::optional<geometry::FacedSurface> surface_of(const fs::path& path) {
  if (!io::is_surface_file(path)) return std::nullopt;
  try {
    return io::read_surface(path).surface;
  } catch (const io::EmptySurface&) {
    return std::nullopt;
  }
}

}  // namespace

ExitCode run_motion_apply(const MotionApplyCommand& c, const core::TaskContext& task) {
  if (!std::isfinite(c.percent)) throw UsageError("--phase is percent of the cycle, a number");
  require_output(c.output, {".vtp", ".stl", ".ply", ".vtu", ".csv"});
  task.set_stage("reading");
  const io::CageMotionFile file = io::read_cage_motion(motion_path(c.motion));
  const AtPhase cage(motion::MovingCage(file.motion), c.percent / 100.0);
  task.set_progress(0.5);
  task.throw_if_cancelled();
  ExitCode code = ExitCode::ok;
  if (auto surface = surface_of(c.input)) {
    require_output(c.output, surface_outputs);
    surface->mesh.points = cage.carried(surface->mesh.points, c.input);
    if (has_extension(c.output, {".vtp"}))
      io::write_surface(c.output, *surface);
    else
      io::write_surface(c.output, surface->mesh);
  } else if (io::is_volume_mesh(c.input)) {
    code = apply_to_mesh(c, cage);
  } else {
    code = apply_to_lines(c, cage);
  }
  task.set_progress(1.0);
  return code;
}

}  // namespace ostia::app
