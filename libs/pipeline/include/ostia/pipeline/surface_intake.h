#pragma once
/// \file A surface of any origin made ready for centerlines and meshing: what is wrong is mended and told.
/// See docs/methods/foreign-surfaces.md.

#include "ostia/centerline/known_surface.h"
#include "ostia/core/task_context.h"
#include "ostia/geometry/tri_mesh.h"
#include "ostia/meshing/flat_caps.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace ostia::pipeline {

struct IntakeOptions {
  /// mm in the file's unit of length; nothing: told by the calibre (unit_by_calibre).
  std::optional<double> unit_mm;
  bool strict = false;    ///< faults are refused instead of mended; caps are taken off all the same
  bool for_axes = false;  ///< centerlines come next: what they take longest for is begun on the way
};

/// What came of it. All lengths are mm.
struct TakenSurface {
  geometry::TriMesh lumen;              ///< manifold, outward; may have several parts and open ends
  std::vector<meshing::GivenEnd> ends;  ///< caps that were taken off, with the names that the file gave them
  /// Ends of the file that `lumen` has none at: labels that were no caps, open rims that mending took away.
  std::vector<meshing::GivenEnd> lost;
  double unit_mm = 1.0;           ///< of the file
  std::vector<std::string> told;  ///< a line for each kind of thing that was done, for a person
  /// What was found out about `lumen`; null where it was mended or caps were taken off.
  std::shared_ptr<const centerline::KnownSurface> known;
};

/// Unit of length by the mean calibre 4 V / A of a closed surface and its extent, both as numbers: no
/// coronary tree is 0.6 mm wide in the mean and 40 mm long, but all are when they are written in centimetres
/// (as SimVascular does) or metres. 1, 10 or 1000 mm. Where this leaves centimetres open, take_surface asks
/// the widths of the ends.
double unit_by_calibre(double calibre, double extent);

/// In this order: triangles without a finite place go, units become mm, equal points join, what only touches
/// is taken apart, each part is turned outward, spikes of one point are pulled in, flaps and folds are cut
/// out and closed (pipeline::repaired), outer walls about a lumen and specks go, holes in the wall are
/// closed, flat caps come off. `what` names the surface in messages. Throws GeometryError where strict and
/// something is wrong, or nothing is left; InvalidInput for sizes that no vessel has in any unit; Cancelled.
TakenSurface take_surface(geometry::FacedSurface surface, const std::string& what,
                          const IntakeOptions& options = {}, const core::TaskContext& task = core::no_task());

}  // namespace ostia::pipeline
