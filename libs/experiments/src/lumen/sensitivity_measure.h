#pragma once
/// \file Known lumina, and how they are measured on the sections of their true axes.

#include "ostia/experiments/sensitivity.h"
#include "ostia/geometry/axis_curve.h"

#include <vector>

namespace ostia::experiments {

/// What a plane across an axis shows of a lumen.
struct LumenSection {
  double area_mm2 = 0.0;
  geometry::Vec3 centroid = geometry::Vec3::Zero();
};

/// Planes across the true axes, clear of free ends and of junctions, and what the truth shows there.
struct TrueSections {
  struct Plane {
    std::size_t tube = 0;
    double s_mm = 0.0;
    geometry::Vec3 point, tangent;
  };
  std::vector<geometry::AxisCurve> axes;         ///< one a tube
  std::vector<std::pair<double, double>> reach;  ///< of the planes on each tube: from, to
  std::vector<Plane> planes;
  std::vector<LumenSection> sections;  ///< one a plane
  double step_mm = 0.0;
};
TrueSections true_sections(const geometry::AnalyticShape& shape, double step_mm);

/// The closed outline about (or nearest to) each plane's point.
std::vector<LumenSection> sections_of(const geometry::TriMesh& surface, const TrueSections& truth);
LumenFigures figures_of(const TrueSections& truth, const std::vector<LumenSection>& found);

LumenFigures level_set_figures(const KnownLumen& lumen, const TrueSections& truth,
                               const segmentation::SegmentOptions& how);
LumenFigures boundary_figures(const KnownLumen& lumen, const TrueSections& truth,
                              const segmentation::LumenBoundaryOptions& how);

}  // namespace ostia::experiments
