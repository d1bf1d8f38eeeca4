#include "motion/motion.h"
#include "motion/motion_input.h"
#include "motion/phase_surface.h"
#include "output/outputs.h"
#include "output/refusal.h"
#include "output/told.h"

#include "ostia/core/log.h"
#include "ostia/core/text.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/io/centerline_file.h"
#include "ostia/io/mesh_export.h"
#include "ostia/io/surface_file.h"
#include "ostia/io/volume_mesh_file.h"
#include "ostia/motion/moving_cage.h"
#include "ostia/pipeline/motion_export.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

namespace ostia::app {
namespace {

namespace fs = std::filesystem;
using geometry::Vec3;
using Points = std::vector<Vec3>;

/// The cage at one phase.
class AtPhase {
 public:
  AtPhase(const motion::MovingCage& cage, double phase) : grid_(cage.grid()), control_(cage.at(phase)) {}

  /// Throws InvalidInput where a point is not finite or most lie outside of the cage; warns where some do.
  Points carried(const Points& points, const fs::path& of) const {
    return naming(of, [&] {
      const motion::CarriedPoints carried(grid_, points);
      const std::string warning = motion::judge_outside(carried, "its points");
      if (!warning.empty()) core::log_warning(own_name(of) + ": " + warning);
      return carried.places(control_);
    });
  }

 private:
  geometry::CageGrid grid_;
  Points control_;
};

/// Into mm. Throws InvalidInput where no unit was given and the size is hardly that of millimetres.
void bring_to_mm(Points& points, const MotionApplyCommand& c, bool own_template) {
  constexpr double widest_mm = 100.0;  // hearts are wider than vessels
  for (Vec3& p : points) p *= unit_mm(c.units);
  // A point that is none is told when it is carried, by its number.
  const bool sound = std::ranges::all_of(points, [](const Vec3& p) { return p.allFinite(); });
  if (c.units.empty() && !own_template && sound)
    pipeline::check_vessel_size(std::min(geometry::bounds(points).sizes().minCoeff(), widest_mm),
                                c.input.string());
}

/// What was carried, for the result's line.
struct Carried {
  std::string what;
  std::size_t points = 0, inverted = 0;
};

ExitCode apply_to_mesh(const MotionApplyCommand& c, const AtPhase& cage, Carried& carried) {
  require_output(c.output, {".vtu"});
  io::LayeredMesh layered = io::read_layered_mesh(c.input);
  geometry::MixedMesh& mesh = layered.mesh;
  bring_to_mm(mesh.points, c, false);
  mesh.points = cage.carried(mesh.points, c.input);
  const pipeline::CarriedQuality quality = pipeline::carried_quality(mesh);
  io::export_mesh(mesh, io::MeshFormat::vtu, c.output, {.layer_tetrahedra = layers_at_end(layered)});
  carried = {"volume mesh", mesh.points.size(), static_cast<std::size_t>(quality.inverted)};
  if (quality.inverted == 0) return ExitCode::ok;
  core::log_warning("quality control failed: " + std::to_string(quality.inverted) +
                    " elements are inverted at this phase");
  return ExitCode::quality_failed;
}

ExitCode apply_to_lines(const MotionApplyCommand& c, const AtPhase& cage, Carried& carried) {
  require_output(c.output, line_outputs);
  geometry::VesselTree tree = lines_from(c.input, c.units);
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
  carried = {"centerlines", moved.size(), 0};
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

bool is_template(const MotionApplyCommand& c, const io::CageMotionFile& file) {
  if (file.surface.empty()) return false;
  std::error_code none;
  return fs::equivalent(c.input, template_path(c.motion, file, {}), none);
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
  Carried carried;
  if (auto surface = surface_of(c.input)) {
    require_output(c.output, surface_outputs);
    bring_to_mm(surface->mesh.points, c, is_template(c, file));
    surface->mesh.points = cage.carried(surface->mesh.points, c.input);
    io::write_surface(c.output, *surface);
    carried = {"surface", surface->mesh.points.size(), 0};
  } else if (io::is_volume_mesh(c.input)) {
    code = apply_to_mesh(c, cage, carried);
  } else {
    code = apply_to_lines(c, cage, carried);
  }
  task.set_progress(1.0);
  tell("motion-apply",
       {{"what", carried.what},
        {"percent", c.percent},
        {"points", carried.points},
        {"inverted", carried.inverted}},
       carried.what + " at " + core::significant_text(c.percent, 5) +
           " %: " + counted(carried.points, "point") + " carried",
       c.json);
  return code;
}

}  // namespace ostia::app
