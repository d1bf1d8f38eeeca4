#pragma once
/// \file Ends of a lumen cut flat by planes normal to the centerline ([Antiga] section 5).

#include "ostia/core/error.h"
#include "ostia/core/task_context.h"
#include "ostia/geometry/tri_mesh.h"
#include "ostia/geometry/vessel_tree.h"
#include "ostia/meshing/flat_caps.h"

#include <string>
#include <utility>
#include <vector>

namespace ostia::meshing {

/// A plane that a person has placed at an end.
struct PlacedPlane {
  std::string end;  ///< `inlet_<vessel>`, `outlet_<vessel>`; empty: the one that would be cut nearest
  geometry::Vec3 origin = geometry::Vec3::Zero();   ///< inside the lumen, mm
  geometry::Vec3 normal = geometry::Vec3::UnitZ();  ///< either way, any length but 0
};

struct ClipOptions {
  /// How far inside the axis' end the plane stands, in radii of the vessel there; so that a rounded end
  /// disappears. In [0, 10]. At most half of the end's segment.
  double inset_radii = 1.0;
  /// An end that cannot be cut there is cut at the nearest place farther inside where it can, at most so many
  /// radii from there, with a warning. In [0, 20]; 0: it is an error.
  double move_inside_radii = 0.0;
  /// Edges at the cut shorter than this fraction of the local edge are collapsed. In [0, 0.5].
  double sliver_fraction = 0.3;
  /// Nothing farther than this from the axis' end, in radii, may be cut away. In [1, 100].
  double reach_radii = 8.0;
  /// An open end stays as it is when its loop is flat within this fraction of the radius. In [0, 1].
  double flat_tolerance = 0.1;
  /// ... and its normal is within this angle of the axis. In [0, 90].
  double flat_max_angle_deg = 35.0;
  /// Every open end stays as it is, however it stands to the axis, where it is flat within half its radius.
  bool ends_as_they_are = false;
  /// Ends that the surface had as caps: they stay as they are, and the inlet takes its name from them.
  std::vector<GivenEnd> given;
  /// Planes for ends, in place of those that the program would place, and instead of an open end as it is.
  std::vector<PlacedPlane> planes;
};
void validate(const ClipOptions& options);

/// A plane at a vessel's end; the normal points out of the lumen.
struct EndPlane {
  std::string vessel;                                    ///< name of the vessel that begins or ends here
  geometry::FaceKind kind = geometry::FaceKind::outlet;  ///< inlet at a root, outlet at an end
  std::int32_t node = 0;                                 ///< id of the tree's node
  geometry::Vec3 origin = geometry::Vec3::Zero();        ///< mm
  geometry::Vec3 normal = geometry::Vec3::UnitZ();       ///< unit
  double radius_mm = 0.0;
};

/// What the end's face is called: `inlet_<vessel>` or `outlet_<vessel>`.
std::string end_name(const EndPlane& plane);

/// Where clip_ends puts its planes: roots first, then ends, each in the tree's order.
std::vector<EndPlane> end_planes(const geometry::VesselTree& tree, double inset_radii);

/// Gives each plane without an end the one of `ends` that stands nearest to it. Throws InvalidInput where an
/// end has two planes then, or none of these ends is called so.
std::vector<PlacedPlane> with_ends(std::vector<PlacedPlane> planes, const std::vector<EndPlane>& ends);

/// Ends that cannot be cut where their planes stand; the message names each, and the way out.
class EndsNotCut : public GeometryError {
 public:
  EndsNotCut(const std::string& message, std::vector<EndPlane> ends)
      : GeometryError(message), ends_(std::move(ends)) {}
  const std::vector<EndPlane>& ends() const { return ends_; }

 private:
  std::vector<EndPlane> ends_;
};

struct ClippedEnd {
  EndPlane plane;  ///< of a kept open end: the plane through its loop
  std::vector<std::int32_t>
      loop;               ///< border vertices in the order of the triangles' winding, all on the plane
  bool was_open = false;  ///< the input was open and flat here, and was kept
};

struct ClippedSurface {
  geometry::TriMesh mesh;        ///< open: one border loop an end, no other
  std::vector<ClippedEnd> ends;  ///< roots first
  std::vector<std::string> warnings;
};

/// Cuts the ends of `lumen` (manifold, oriented outward, closed or open) by one plane a root and a leaf of
/// the tree. A plane cuts only the connected loop of triangles around its own axis, so a neighbouring branch
/// is never touched. A plane that does not cut cleanly, or meets the wall in a wedge of less than 40 degrees,
/// is tried up to a radius farther inside, with a warning; one that a person placed is taken as it is,
/// however far from the axis' end. Loop points lie on their plane to round-off. Throws InvalidInput for bad
/// options or tree, or a plane for an end that is not there, EndsNotCut naming all ends that cannot be cut,
/// where each is, why (plane misses the lumen, loop is not closed, more than the end would go) and the way
/// out, GeometryError for a hole that belongs to no end.
ClippedSurface clip_ends(const geometry::TriMesh& lumen, const geometry::VesselTree& tree,
                         const ClipOptions& options = {}, const core::TaskContext& task = core::no_task());

}  // namespace ostia::meshing
