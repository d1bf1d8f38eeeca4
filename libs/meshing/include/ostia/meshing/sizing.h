#pragma once
/// \file Target edge lengths from the distance to the centerline ([Antiga] 6.1, equations 7-9), made shorter
/// where the surface bends, at chosen places, or as an array of the user's has it.

#include "ostia/core/task_context.h"
#include "ostia/geometry/tri_mesh.h"
#include "ostia/geometry/vessel_tree.h"
#include "ostia/meshing/size_field.h"

#include <limits>
#include <memory>
#include <vector>

namespace ostia::meshing {

/// What the tube function says of a point: the axis point that minimises |c(s) - p|^2 - r(s)^2 over all axes.
struct TubeSize {
  double distance_mm = 0.0;  ///< D_c: from the point to that axis point
  double radius_mm = 0.0;    ///< R_c: radius of the inscribed sphere there
  double tube_mm2 = 0.0;     ///< the minimum itself; negative inside the tube
  geometry::Vec3 axis_point = geometry::Vec3::Zero();
};

/// The tube function of a set of axes, prepared once. Queries are const and safe from many threads.
class TubeFunction {
 public:
  /// Throws InvalidInput when there is no segment, or a radius is not positive and finite.
  explicit TubeFunction(const geometry::VesselTree& tree);
  explicit TubeFunction(const std::vector<geometry::Centerline>& lines);
  TubeSize operator()(const geometry::Vec3& point) const;

 private:
  struct Piece {
    geometry::Vec3 a, step;
    double radius, radius_step;
  };
  struct Block {  // consecutive pieces within a ball, to skip them at once
    geometry::Vec3 centre;
    double reach, max_radius;
    std::size_t first, last;
  };
  void add(const geometry::Centerline& line);
  void build_blocks();
  std::vector<Piece> pieces_;
  std::vector<Block> blocks_;
};

/// What a vessel's size is measured by.
enum class SizeMeasure {
  distance,  ///< D_c, follows the wall
  radius,    ///< R_c, does not grow on the wall of an aneurysm
};

/// A place where edges are shorter: by `share` of their length there, by none of it from `reach_mm` on, and
/// linear between.
struct SizeFocus {
  geometry::Vec3 place = geometry::Vec3::Zero();  ///< mm
  double reach_mm = 1.0;                          ///< > 0
  double share = 0.5;                             ///< [0.05, 1]
};

/// Edge lengths that somebody else knows, one a point of a surface that need not be the one to be meshed.
struct SizeArray {
  geometry::TriMesh surface;
  std::vector<double> edge_mm;  ///< each positive and finite
};

struct SizingOptions {
  /// R_el of equation 9: edge length over vessel size. 0.4, the paper's choice, puts about 2 pi / 0.4 = 16
  /// edges around a vessel whatever its diameter. In [0.02, 2].
  double edge_ratio = 0.4;
  SizeMeasure measure = SizeMeasure::distance;
  /// Bound on D_c in inscribed radii R_c, so that a saccular aneurysm gets the edges of its vessel without an
  /// absolute length. >= 1.
  double most_distance_radii = std::numeric_limits<double>::infinity();
  /// Edge length over the surface's least radius of curvature; shorter edges than the vessel's size gives,
  /// where it bends more than around itself. 0: curvature has no say; else in [0.02, 2]. A tube bends by
  /// 1/D_c, so ratios from edge_ratio on leave it as it is.
  double curvature_ratio = 0.0;
  /// Curvature is averaged over this much of the vessel's size around a point: noise bends, too. In [0.1, 2].
  double curvature_reach = 0.4;
  std::vector<SizeFocus> foci;
  /// Share of the edge length at stenoses; `at_throats` (stenosis_sizing.h) makes foci of it. In [0.05, 1].
  double throat_share = 1.0;
  /// Where it is given, lengths are interpolated in it at the closest point, and the vessel's size has no
  /// say.
  std::shared_ptr<const SizeArray> array;
  /// Where it is given, no edge is longer than it says (field_sizing.h makes one of a solver's result).
  std::shared_ptr<const SizeField> field;
  /// Bound on the growth of the edge length along the surface, mm per mm (Dunyach et al. 2013). In [0.01, 2].
  double gradation = 0.3;
  double min_edge_mm = 0.0;                                      ///< >= 0
  double max_edge_mm = std::numeric_limits<double>::infinity();  ///< > min_edge_mm
};
void validate(const SizingOptions& options);

/// Half the width of the lumen at each point of a closed, outward surface, mm: R_c where the axes explain the
/// wall (D_c is no more than 1.5 R_c), else what rays into the lumen see, for branches and sacs that are far
/// from all axes. At most D_c.
std::vector<double> local_radii(const geometry::TriMesh& surface, const TubeFunction& tube,
                                const core::TaskContext& task = core::no_task());

/// Target edge length at each point of the surface, mm. Where the axes do not explain the wall of a closed
/// surface, the width that rays see bounds D_c: a branch that nobody gave an axis keeps its shape. Throws
/// InvalidInput (options), GeometryError for a point on the axis, Cancelled.
std::vector<double> target_edge_lengths(const geometry::TriMesh& surface, const TubeFunction& tube,
                                        const SizingOptions& options = {},
                                        const core::TaskContext& task = core::no_task());

/// Lowers the lengths where they grow faster than `gradation` mm per mm along the mesh's edges. Points of a
/// value's own neighbourhood are never raised.
void limit_gradation(const geometry::TriMesh& surface, double gradation,
                     std::vector<double>& edge_lengths_mm);

}  // namespace ostia::meshing
