#pragma once
/// \file What is known of a case: contours of lumen and outer wall, what observers would have drawn,
/// reference lines as the Rotterdam centerline challenge has them.

#include "ostia/geometry/contour_set.h"
#include "ostia/io/rotterdam_file.h"
#include "ostia/phantom/coronary_tree.h"
#include "ostia/phantom/sections.h"
#include "ostia/phantom/vessel_field.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ostia::phantom {

struct ContourOptions {
  double spacing_mm = 0.5;           ///< of the true contours, along the axis, at most; > 0
  double observer_spacing_mm = 1.0;  ///< of the observers': they do not draw on every slice
  int points = 64;                   ///< a contour, 8 to 1,024
};
void validate(const ContourOptions& options);  ///< throws InvalidInput

/// How far observers are from the truth. What an observer draws lies beside it by a smooth Gaussian field
/// over (s, theta): a shift of the whole contour (35 % of the variance, correlated over 8 mm), too wide or
/// too narrow (30 %, 5 mm), oval and triangular (25 %, 4 mm), finer waves (10 %, 2 mm). With independent
/// observers the mean distance between two is 2 / sqrt(pi) = 1.13 deviations: about 0.15 mm healthy and 0.23
/// mm diseased with the defaults.
struct ObserverOptions {
  int count = 3;              ///< 0 to 9
  double healthy_mm = 0.13;   ///< deviation of the radius that is drawn, in [0, 2]
  double diseased_mm = 0.20;  ///< in a lesion; between them smooth over 2 mm
  /// Of each of the two components in which a traced axis deviates, in [0, 2]; where the lumen's radius is
  /// below 1.5 mm, in proportion less.
  double axis_mm = 0.19;
  double axis_length_mm = 10.0;  ///< correlation length of that; > 0
  std::uint64_t seed = 1;
};
void validate(const ObserverOptions& options);  ///< throws InvalidInput

/// By how much observer 1, 2, ... draws the lumen's radius too large at an abscissa, mm.
struct RadialDeviation {
  double mean = 0.0;
  std::array<double, 7> cosine{}, sine{};  ///< waves of 1 to 6 periods a turn
  double at(double theta) const;
};
RadialDeviation radial_deviation(const CoronaryVessel& vessel, int observer, double s_mm,
                                 const ObserverOptions& options);
/// The radius that the observer draws: r + d, for d < 0 r exp(d / r), so that it stays positive.
double observed_radius(double radius_mm, double deviation_mm);

/// A point on the exact boundary.
Vec3 boundary_point(const CoronaryVessel& vessel, Boundary boundary, double s_mm, double theta);
/// The contour across the vessel at an abscissa: `points` angles from theta = 0.
geometry::Contour true_contour(const CoronaryVessel& vessel, Boundary boundary, double s_mm, int points);

/// For every section the true lumen and outer wall (observer "truth") and the lumina of "observer1", ...;
/// section by section. Contours at equal distances, both ends of a section among them.
geometry::ContourSet annotate(const CoronaryTree& tree, const std::vector<AnnotatedSection>& sections,
                              const ContourOptions& contours, const ObserverOptions& observers);

/// One of the four vessels of a data set.
struct ChallengeVessel {
  int number = 0;                    ///< the M of vesselM: 0 RCA, 1 LAD, 2 LCX, 3 the largest side branch
  std::string name;                  ///< "LAD"
  std::vector<std::int32_t> path;    ///< vessel ids from the ostium on: {LM, LAD}
  io::RotterdamReference reference;  ///< at 0.03 mm
  std::vector<std::vector<Vec3>> observers;  ///< what they traced, at 0.1 mm
  Vec3 point_a = Vec3::Zero();               ///< in the distal part: names the vessel without doubt
  Vec3 point_b = Vec3::Zero();               ///< about 30 mm from the start
  Vec3 point_s = Vec3::Zero(), point_e = Vec3::Zero();  ///< start and end
  bool cut_by_image = false;
};
struct ChallengeVessels {
  std::vector<ChallengeVessel> vessels;
  std::vector<std::string> warnings;  ///< vessels that the image does not hold, or not whole
};
/// RCA, LAD and LCX from the ostium to their ends and the side branch with the largest calibre at its origin
/// (Schaap et al. 2009, section 3). A vessel that leaves the image is cut to its longest part inside; one
/// with less than 12 mm inside, or less than 5 mm behind its parents, is left out.
ChallengeVessels challenge_vessels(const CoronaryTree& tree, const ObserverOptions& observers,
                                   const std::optional<imaging::Geometry>& image = {});

/// The axis from the ostium to the vessel's end: parents up to where the next leaves them; no point twice.
geometry::Centerline path_from_ostium(const CoronaryTree& tree, std::int32_t vessel);

/// CAD-RADS category of a diameter stenosis (Cury et al. 2016): 0 none, 1 below 25 %, 2 below 50 %, 3 below
/// 70 %, 4 below 100 %, 5 closed.
int stenosis_category(double diameter_stenosis);

}  // namespace ostia::phantom
