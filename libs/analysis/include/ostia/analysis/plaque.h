#pragma once
/// \file What lies between a vessel's lumen and its outer wall (docs/methods/plaque.md).

#include "ostia/analysis/stenosis.h"
#include "ostia/core/task_context.h"
#include "ostia/geometry/axis_curve.h"

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace ostia::analysis {

/// Bounds of CT numbers as consensus and large trials have them (Shaw et al. 2021; Chang et al. 2018).
enum class PlaqueClass { low_attenuation, fibrofatty, fibrous, calcified };
inline constexpr std::size_t plaque_classes = 4;
std::string to_string(PlaqueClass one);  ///< "low attenuation", "fibrofatty", "fibrous", "calcified"

/// How thick the wall of a healthy coronary artery is: on the straight line between the ends of what Podesser
/// et al. (1998) measured in hearts without disease, from 0.08 mm at 0.1 mm of outer radius to 0.8 mm at 3
/// mm, solved for the lumen's diameter. Throws InvalidInput for a negative or infinite one.
double healthy_wall_mm(double lumen_diameter_mm);

struct PlaqueOptions {
  double low_attenuation_hu = 30.0;  ///< low attenuation is below; [-200, 400], ascending
  double fibrofatty_hu = 130.0;      ///< fibrofatty is up to here
  double fibrous_hu = 350.0;         ///< fibrous is up to here, calcified above
  /// A wall thinner than that is counted as wall alone: a scan does not resolve what it is made of (0.7 mm:
  /// a usual scan's width at half maximum). [0, 3]
  double thin_wall_mm = 0.7;
  /// So is a wall that is thicker by less than that than a healthy one of the vessel's calibre: about the
  /// error that an outer wall is found with. [0, 1]
  double healthy_margin_mm = 0.2;
  double step_mm = 0.25;       ///< of slabs along the axis, [0.02, 2]
  int around = 96, deep = 12;  ///< pieces of a slab around the axis and through the wall, [8, 1024], [1, 256]
  /// The scanner's point spread (standard deviation), [0, 1.5]: what it mixes into the wall from lumen and
  /// fat is taken away before CT numbers are classed. 0: CT numbers as they stand.
  double blur_sigma_mm = 0.3;
};
void validate(const PlaqueOptions& options);  ///< throws InvalidInput

/// A vessel's two walls about its axis, by abscissa and geometry::radial_direction's angle.
struct WallRadii {
  double from_mm = 0.0, to_mm = 0.0;
  std::function<double(double s_mm, double theta)> lumen_mm, outer_mm;
  /// How bright lumen and fat are there; not needed without a blur.
  std::function<double(double s_mm)> lumen_hu = {}, fat_hu = {};
  /// The lumen's diameter as it would be without disease; empty: not known, PlaqueOptions::thin_wall_mm alone
  /// tells plaque from wall.
  std::function<double(double s_mm)> calibre_mm = {};
};

/// Volumes of a stretch, mm^3.
struct PlaqueVolumes {
  double length_mm = 0.0;
  double lumen_mm3 = 0.0, vessel_mm3 = 0.0;        ///< vessel: all within the outer wall
  std::array<double, plaque_classes> class_mm3{};  ///< plaque: where the wall is thicker than a healthy one
  double thin_wall_mm3 = 0.0;                      ///< healthy or thin wall, in no class
  double of(PlaqueClass one) const { return class_mm3[static_cast<std::size_t>(one)]; }
  double plaque_mm3() const;  ///< of all classes
  double wall_mm3() const { return vessel_mm3 - lumen_mm3; }
  double burden_percent() const;  ///< 100 plaque / vessel: 0 of a healthy vessel, and of nothing
  double wall_percent() const;    ///< 100 wall / vessel, which ultrasound calls burden; 0 of nothing
};

void add(PlaqueVolumes& sum, const PlaqueVolumes& one, double share = 1.0);

/// What a plaque is made of, as a report names it.
enum class PlaqueType { none, non_calcified, mixed, calcified };
/// Calcified from half of the plaque's volume on, as Hausleiter et al. (2006) have it of its area;
/// non-calcified below 5 %, which is what noise and rims of other tissue make; none without any plaque.
PlaqueType plaque_type(const PlaqueVolumes& volumes);
std::string to_string(PlaqueType type);  ///< "none", "non-calcified", "mixed", "calcified"

/// A slab across the axis: volumes over its length, areas at its middle.
struct PlaqueSlab {
  double s_mm = 0.0;  ///< middle
  PlaqueVolumes volumes;
  double lumen_mm2 = 0.0, vessel_mm2 = 0.0, plaque_mm2 = 0.0;
  double area_burden_percent() const;  ///< 100 plaque / vessel; 0 of nothing
};

/// Slabs of equal length from end to end.
struct PlaqueProfile {
  double from_mm = 0.0, to_mm = 0.0;
  PlaqueOptions options;
  std::vector<PlaqueSlab> slabs;
};

/// `hu_at` is asked in the middle of pieces between the walls, from several threads; a piece's own volume is
/// exact for its bent axis. The outer wall counts from the lumen on where it lies within. Throws InvalidInput
/// for bad options, a stretch that the axis has not, missing functions or radii that are not finite, and
/// Cancelled.
PlaqueProfile plaque_profile(const geometry::AxisCurve& axis, const WallRadii& walls,
                             const std::function<double(const Vec3& place)>& hu_at,
                             const PlaqueOptions& options = {},
                             const core::TaskContext& task = core::no_task());

/// The pieces of one section: `around` rays at (a + 1/2) 2 pi / around, `deep` equal pieces on each from the
/// lumen outwards. Throws as plaque_profile does.
struct PlaqueMap {
  int around = 0, deep = 0;
  std::vector<double> lumen_mm, outer_mm;          ///< one a ray
  std::vector<std::optional<PlaqueClass>> pieces;  ///< ray by ray; nothing where the wall is thin
  /// Of the place at an angle and a distance from the axis; nothing outside the wall or where it is thin.
  std::optional<PlaqueClass> at(double theta, double rho_mm) const;
};
PlaqueMap plaque_map(const geometry::AxisCurve& axis, const WallRadii& walls, double s_mm,
                     const std::function<double(const Vec3& place)>& hu_at,
                     const PlaqueOptions& options = {});

/// Of a stretch, cut to what the profile covers; slabs at its ends count in part.
PlaqueVolumes plaque_between(const PlaqueProfile& profile, double from_mm, double to_mm);

/// Area within the outer wall, linear between slabs' middles; nothing outside the profile.
std::optional<double> vessel_area_mm2(const PlaqueProfile& profile, double s_mm);
/// Vessel area at the throat over the mean of those at the stenosis' two places of reference (Mintz et al.
/// 2001); nothing where the profile does not reach them.
std::optional<double> remodelling_index(const PlaqueProfile& profile, const Stenosis& stenosis);

}  // namespace ostia::analysis
