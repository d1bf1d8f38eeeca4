#pragma once
/// \file The plots of the smoothness experiment ([Luboz] figure 5).

#include "ostia/experiments/smoothness.h"
#include "ostia/figure/picture.h"

namespace ostia::experiments {

/// The orientation that VTK's filters were tried on; empty without one.
std::string compared_at(const std::vector<SurfaceFigures>& surfaces);
/// Figure 5(a) and (b): each scan at each level; against the number of triangles.
figure::Picture distances_plot(const std::vector<SurfaceFigures>& surfaces);
/// Figure 5(c) and (d): curvature against the number of triangles, and while the isosurface is smoothed.
figure::Picture bends_plot(const std::vector<SurfaceFigures>& surfaces);

}  // namespace ostia::experiments
