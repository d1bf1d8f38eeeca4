#pragma once
/// \file A surface's unit of length, by its calibre and by what its ends say.

#include "ostia/geometry/tri_mesh.h"
#include "ostia/meshing/flat_caps.h"
#include "ostia/pipeline/surface_intake.h"

#include <optional>
#include <string>

namespace ostia::pipeline {

/// Widths of a surface's ends, open or under flat caps, in the file's own unit.
struct EndWidths {
  double thinnest = 0.0, widest = 0.0;
};
/// Nothing where it has no such ends, or is too broken to tell. `sound`: manifold and outward as it is; then
/// the surface without its caps is kept.
std::optional<EndWidths> end_widths(const geometry::FacedSurface& surface, bool sound,
                                    std::optional<meshing::OpenedCaps>& kept);

/// Outlets that no vessel has in millimetres, from a trunk as an aorta has it in centimetres.
bool speak_for_cm(const EndWidths& widths);
/// Thin as hardly any end of a tree in millimetres, and much thinner than its trunk: it may be either.
bool leave_cm_open(const EndWidths& widths);

/// Outward as what it bounds is seen, its open ends closed.
geometry::TriMesh turned_outward(geometry::TriMesh mesh);

/// 4 V / A: the diameter of a tube.
double calibre_of_closed(const geometry::TriMesh& closed);

/// The surface in mm, `out` with its unit and what is to be told. `known_calibre`: of the surface with its
/// holes filled, where that is known; it then is sound. Throws InvalidInput for sizes that no vessel has;
/// `what` names the surface. Returns the surface without its flat caps, where they came off on the way and it
/// stays as it is.
std::optional<meshing::OpenedCaps> to_mm(geometry::FacedSurface& surface, std::optional<double> known_calibre,
                                         const IntakeOptions& options, TakenSurface& out,
                                         const std::string& what);

}  // namespace ostia::pipeline
