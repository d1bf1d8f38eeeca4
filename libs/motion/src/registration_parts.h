#pragma once
/// \file What the registrations by a cage have in common.

#include "surface_pairs.h"

#include "ostia/motion/cage_registration.h"

#include <string>
#include <vector>

namespace ostia::motion {

/// No cell's Jacobian may become less.
inline constexpr double least_jacobian_allowed = 0.02;
/// Of a step.
inline constexpr int most_halvings = 12;

[[noreturn]] void refuse_registration(const std::string& what);
void check_cage_options(int depth, double margin, double max_angle_deg, const HyperelasticWeights& energy);
void check_surfaces(const geometry::TriMesh& source, const geometry::TriMesh& target);

std::vector<geometry::CagePoint> cage_points(const geometry::CageGrid& grid,
                                             const std::vector<geometry::Vec3>& points);
std::vector<geometry::Vec3> carried_points(const std::vector<geometry::CagePoint>& places,
                                           const geometry::CageGrid& grid,
                                           const std::vector<geometry::Vec3>& control_points);
geometry::TriMesh carried_mesh(const geometry::TriMesh& mesh, const std::vector<geometry::CagePoint>& places,
                               const geometry::CageGrid& grid,
                               const std::vector<geometry::Vec3>& control_points);
/// Share of the source's surface that the pairs of its points have, and their mean distance.
void tell_pairs(const geometry::TriMesh& source, const std::vector<SurfacePair>& pairs,
                RegistrationReport& report);

}  // namespace ostia::motion
