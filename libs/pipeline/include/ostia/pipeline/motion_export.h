#pragma once
/// \file A surface and a volume mesh over one beat, time by time, for solvers and pictures. See
/// docs/methods/motion.md.

#include "ostia/core/task_context.h"
#include "ostia/geometry/mixed_mesh.h"
#include "ostia/motion/moving_cage.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace ostia::pipeline {

enum class MotionFormat {
  vtp,       ///< the surface: surface_000.vtp ..., surface.pvd
  stl,       ///< the surface: surface_000.stl ...
  vtu,       ///< the mesh: mesh_000.vtu ..., mesh.pvd
  openfoam,  ///< the mesh: openfoam/constant/polyMesh, <time>/polyMesh/points, <time>/pointDisplacement
  csv,       ///< displacement_000.csv ...: of the mesh's points where there is one, else the surface's
  json,      ///< points.json (docs/schemas/motion.schema.json) of the same points
};
/// As a user writes it. Throws InvalidInput that lists the formats.
MotionFormat motion_format(std::string_view name);
std::string_view name_of(MotionFormat format);

struct MotionExportOptions {
  std::vector<MotionFormat> formats = {MotionFormat::vtp};
  int times = 20;           ///< evenly spaced over the cycle from the R peak on; in [1, 10000]
  double rr_seconds = 0.8;  ///< length of the cycle, in [0.1, 10]
  std::string surface_name = "the surface", mesh_name = "the mesh";  ///< in messages
  /// Of the mesh's tetrahedra, the last ones: layers' prisms that were split (io::MeshExportOptions).
  std::size_t layer_tetrahedra = 0;
};
/// Throws InvalidInput; for a mesh that OpenFOAM cannot hold, and formats of a mesh without one, too.
void validate(const MotionExportOptions& options, const geometry::MixedMesh* mesh);

struct MotionTime {
  double phase = 0.0, seconds = 0.0;
  /// Of the points that are exported, from where the template has them.
  double mean_displacement_mm = 0.0, max_displacement_mm = 0.0;
  std::size_t inverted = 0;          ///< elements of the mesh; 0 without one
  double min_scaled_jacobian = 1.0;  ///< of them
};

struct MotionExport {
  std::vector<MotionTime> times;
  std::size_t outside = 0;  ///< points beyond the cage: they go as its nearest place does
  std::size_t inverted() const;
  std::vector<std::string> warnings;
};

/// Elements of a mesh whose Jacobian is not positive everywhere, and the least scaled Jacobian.
struct CarriedQuality {
  std::size_t inverted = 0;
  double min_scaled_jacobian = 1.0;
};
CarriedQuality carried_quality(const geometry::MixedMesh& mesh,
                               const core::TaskContext& task = core::no_task());

/// Writes into `folder`, which exists, and times.csv with a row a time. `surface` and `mesh` (null: none) are
/// as the template's phase has them; triangles and elements stay the same over all times. Point data:
/// `displacement_mm` from there, `velocity_mm_s`. Warns where points of either lie outside of the cage.
/// Throws as `validate`; InvalidInput where more than half of them do (motion::judge_outside) and for a point
/// that is not finite, IoError, ResourceError, Cancelled.
MotionExport export_motion(const std::filesystem::path& folder, const motion::MovingCage& cage,
                           const geometry::TriMesh& surface, const geometry::MixedMesh* mesh,
                           const MotionExportOptions& options,
                           const core::TaskContext& task = core::no_task());

}  // namespace ostia::pipeline
