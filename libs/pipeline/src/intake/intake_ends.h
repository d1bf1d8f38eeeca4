#pragma once
/// \file Ends of a surface that are none any more once it was mended.

#include "ostia/geometry/tri_mesh.h"
#include "ostia/meshing/flat_caps.h"

#include <string>
#include <vector>

namespace ostia::pipeline {

/// "(1.0, 2.0, 3.0) mm".
std::string place_text(const geometry::Vec3& p);
/// "cap_LAD at (1.0, 2.0, 3.0) mm, 2.10 mm wide".
std::string words_of(const meshing::GivenEnd& end);

/// The open rims that may be ends: 0.4 mm wide or more.
std::vector<meshing::GivenEnd> open_rims(const geometry::TriMesh& mesh);

/// Takes off the caps of a surface that is to be mended, those that labels name or that are seen to be flat,
/// where it is manifold; returns their ends. Its triangles keep their labels.
std::vector<meshing::GivenEnd> take_caps_off(geometry::FacedSurface& surface);

/// Open rims of the surface as it came that the mended one neither has nor has as holes in its wall; rims of
/// parts that were left out, which is told, are none.
std::vector<meshing::GivenEnd> rims_gone(const geometry::TriMesh& came, const geometry::TriMesh& mended);

/// Labels of a surface that had to be mended that face one way as a cap does, where no end is left.
std::vector<meshing::GivenEnd> labels_without_end(const geometry::FacedSurface& came,
                                                  const std::vector<meshing::GivenEnd>& ends);

/// Warnings that name labels no end came of, and what settles it.
std::vector<std::string> warnings_of(const std::vector<meshing::LabelNotTaken>& labels);

}  // namespace ostia::pipeline
