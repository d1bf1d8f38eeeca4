#pragma once
/// \file Prisms into tetrahedra, for formats and solvers that know one kind of element.

#include "ostia/geometry/mixed_mesh.h"

namespace ostia::geometry {

/// A boundary quadrilateral as two triangles, along the diagonal through its corner of the smallest index:
/// the diagonal that `split_prisms` takes there. Outward as the quadrilateral is.
std::array<Triangle, 2> split_quad(const Quad& quad);

/// Each prism as three tetrahedra. Every quadrilateral is cut along the diagonal through its corner of the
/// smallest global index, so that neighbours agree without knowing of each other (Dompierre, Labbe, Vallet
/// and Camarero 1999). The tetrahedra of the mesh come first and keep their places, then three for each prism
/// in turn; boundary triangles likewise. Points stay as they are: the node in the middle of a quadrilateral
/// becomes that of its diagonal. A quadratic prism with a bent side can give a tetrahedron whose Jacobian is
/// not positive, though the prism's is.
MixedMesh split_prisms(const MixedMesh& mesh);

}  // namespace ostia::geometry
