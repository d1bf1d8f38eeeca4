#pragma once
/// \file Annotated sections: stretches of vessels whose lumen is judged, healthy and diseased apart.

#include "ostia/geometry/contour_set.h"
#include "ostia/imaging/volume.h"
#include "ostia/phantom/coronary_tree.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ostia::phantom {

/// A stretch of one vessel, clear of every bifurcation.
struct AnnotatedSection {
  std::string key;          ///< "s01", "s02", ... within the case
  std::int32_t vessel = 0;  ///< CoronaryVessel::id
  double s_from_mm = 0.0, s_to_mm = 0.0;
  geometry::Health health = geometry::Health::healthy;
  double length_mm() const { return s_to_mm - s_from_mm; }
};

/// Abscissas [from, to] on a vessel.
struct Stretch {
  double from_mm = 0.0, to_mm = 0.0;
  double length_mm() const { return to_mm - from_mm; }
};

/// The parts of a vessel where a contour across it meets that vessel alone: behind the bifurcation it comes
/// from, clear of the branches that leave it (their outer walls apart), of flat ends, and inside `image`
/// with `margin_mm` around the outer wall; ascending.
std::vector<Stretch> free_stretches(const CoronaryTree& tree, std::int32_t vessel,
                                    const std::optional<imaging::Geometry>& image = {},
                                    double margin_mm = 1.0);
/// Where a vessel bears a stenosis or plaque, joined where they overlap or lie within 1 mm; ascending.
std::vector<Stretch> diseased_stretches(const CoronaryVessel& vessel);
/// 1 where the vessel is diseased, 0 where it is healthy, smooth over 2 mm beside a lesion.
double disease_at(const CoronaryVessel& vessel, double s_mm);

/// How many sections a case has and how long they are in all.
struct SectionQuota {
  int healthy = 3, diseased = 1;
  double healthy_mm = 0.0, diseased_mm = 0.0;
};
/// The quota of a case of the suite, by its seed: of any 18 seeds in a row, 6 have five sections (three of
/// them healthy) and 12 have four (three of them healthy); in all 78 sections of 1,880 mm healthy and 670 mm
/// diseased lumen, as in Wels et al. (18 data sets of the Rotterdam framework).
SectionQuota section_quota(std::uint64_t seed);

struct SectionOptions {
  SectionQuota quota;
  std::optional<imaging::Geometry> image;  ///< sections lie inside it; none: anywhere
  double least_length_mm = 8.0;            ///< a section is no shorter, > 0
  double least_radius_mm = 0.75;           ///< the lumen's healthy radius: thinner vessels are not annotated
  std::uint64_t seed = 1;
};
void validate(const SectionOptions& options);  ///< throws InvalidInput

struct SectionPlan {
  std::vector<AnnotatedSection> sections;  ///< by vessel, then by abscissa
  std::vector<std::string> warnings;       ///< "healthy sections: 88.2 mm of 104.4 mm asked for; ..."
};
/// Chooses sections to the quota. A diseased section is a window over a lesion that covers at least half of
/// it; a healthy one bears no lesion. What the tree or the image cannot give is said in the warnings.
SectionPlan plan_sections(const CoronaryTree& tree, const SectionOptions& options);

/// Where a lesion has to be put so that `plan_sections` finds its diseased sections; empty when the tree's
/// own suffice. Vessel and abscissa of the middle, and length.
struct LesionSite {
  std::int32_t vessel = 0;
  double s_centre_mm = 0.0, length_mm = 0.0;
};
std::vector<LesionSite> missing_lesions(const CoronaryTree& tree, const SectionOptions& options);

const CoronaryVessel& vessel_of(const CoronaryTree& tree, std::int32_t id);  ///< throws InvalidInput

}  // namespace ostia::phantom
