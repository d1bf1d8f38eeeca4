#pragma once
/// \file Smooth axes and calibres of a patient's arteries.

#include "ostia/geometry/centerline.h"
#include "ostia/phantom/patient_tree.h"

#include <vector>

namespace ostia::phantom {

/// A smooth axis of 0.1 mm steps through points that begin where it begins: a smoothing spline that is made
/// stiffer until no bend is tighter than twice the outer wall's radius there, and at most 1e5 mm^3 stiff.
/// `radius_mm`: the lumen's, one a point.
geometry::Centerline smooth_axis(const std::vector<Vec3>& points, const std::vector<double>& radius_mm,
                                 const Vec3& first_normal);

/// The calibre that a vessel has without lesions, one a point: the radii less the rim, evened along the
/// vessel (deviation 4 mm), never wider downstream (the nearest such line in the sense of least squares,
/// Barlow et al. 1972), evened again (2 mm), and no less than 0.45 mm.
std::vector<double> healthy_calibre(const std::vector<Vec3>& points, const std::vector<double>& radius_mm,
                                    double rim_mm);

}  // namespace ostia::phantom
