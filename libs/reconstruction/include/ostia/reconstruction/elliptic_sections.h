#pragma once
/// \file Cross-sections that are ellipses ([Luboz] 2.2, "circular or elliptic"), and how they are found.

#include "ostia/core/task_context.h"
#include "ostia/geometry/tri_mesh.h"
#include "ostia/geometry/vessel_graph.h"

#include <array>
#include <cstddef>
#include <vector>

namespace ostia::reconstruction {

/// The shape of a cross-section; its size is the radius of the circle with the same area.
struct EllipticSection {
  double ratio = 1.0;  ///< minor to major semi-axis, in [0.1, 1]; 1: a circle
  /// Along the major semi-axis, of any length but 0; only its part across the vessel counts, and without one
  /// the section is a circle.
  geometry::Vec3 major = geometry::Vec3::UnitX();
};

/// Of a VesselGraph whose radii are sqrt(major * minor): of each edge at its two ends, as the radii are.
/// Where two edges follow each other, the mean of both counts.
struct EllipticSections {
  std::vector<std::array<EllipticSection, 2>> of_edge;
};
/// Throws InvalidInput that names the edge where there is not one for each edge, for a ratio out of range and
/// for a direction that is not finite or 0.
void validate(const EllipticSections& sections, const geometry::VesselGraph& graph);

struct SectionFitOptions {
  int rays = 48;            ///< across the vessel, from its axis; in [8, 256]
  double step = 0.25;       ///< from section to section, in radii; in [0.05, 2]
  double most_off = 0.4;    ///< a section whose radius is off by more than this part is left out; in (0, 1)
  double most_rough = 0.1;  ///< and one that is off its ellipse by more of its radius, RMS; in (0, 1)
};
void validate(const SectionFitOptions& options);  ///< throws InvalidInput

struct FittedSections {
  geometry::VesselGraph graph;  ///< the given one with radii of circles with the sections' areas
  EllipticSections sections;
  std::size_t cut = 0, used = 0;  ///< sections across the vessels, and those that were good
};

/// Ellipses with the area and the second moments of the sections of `wall`, a closed surface around the
/// network: they are cut on rays across the branches' axes, and about each point of the network the mean
/// counts, falling to nothing at its neighbours; shapes by their tensors' logarithms, in frames that do not
/// turn about the vessel. Sections that are open or run into another vessel, as beside forks, are left out;
/// where none is left the nearest good one of the branch counts, and a branch without any keeps its radii and
/// has circles. Same for any number of threads. Throws InvalidInput for options, a graph that is not sound
/// and a surface without triangles; Cancelled.
FittedSections fit_elliptic_sections(const geometry::VesselGraph& graph, const geometry::TriMesh& wall,
                                     const SectionFitOptions& options = {},
                                     const core::TaskContext& task = core::no_task());

}  // namespace ostia::reconstruction
