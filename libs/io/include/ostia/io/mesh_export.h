#pragma once
/// \file Volume meshes for solvers: one mesh to all formats. What each keeps: docs/reference/mesh-formats.md.

#include "ostia/geometry/mixed_mesh.h"

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ostia::io {

enum class MeshFormat {
  vtu,            ///< VTK unstructured grid, appended, compressed
  stl,            ///< a folder: <face>.stl, binary, single precision
  openfoam,       ///< a case folder: constant/polyMesh, in metres
  mesh_complete,  ///< SimVascular's folder
  gmsh2,          ///< MSH 2.2, ASCII
  gmsh4,          ///< MSH 4.1, ASCII
  fluent,         ///< Fluent .msh, ASCII
  abaqus,         ///< Abaqus .inp
  xdmf,           ///< a folder: mesh.xdmf, facets.xdmf and mesh.h5, as FEniCS reads them
  exodus,         ///< Exodus II on netCDF with 64-bit offsets
  cgns,           ///< CGNS on HDF5
};

inline constexpr std::array<MeshFormat, 11> mesh_formats = {
    MeshFormat::vtu,   MeshFormat::stl,    MeshFormat::openfoam, MeshFormat::mesh_complete,
    MeshFormat::gmsh2, MeshFormat::gmsh4,  MeshFormat::fluent,   MeshFormat::abaqus,
    MeshFormat::xdmf,  MeshFormat::exodus, MeshFormat::cgns};

/// As a user writes it: `vtu`, `stl`, `openfoam`, `mesh-complete`, `gmsh2`, `gmsh4`, `fluent`, `abaqus`,
/// `xdmf`, `exodus`, `cgns`.
std::string_view name_of(MeshFormat format);
/// Throws InvalidInput that lists the formats for any other name.
MeshFormat mesh_format(std::string_view name);
/// As lists show it: what the program calls itself, "Gmsh 4.1", "SimVascular (mesh-complete)".
std::string_view title_of(MeshFormat format);
/// The usual extension with its point (`.vtu`); empty for a format that is a folder.
std::string_view extension_of(MeshFormat format);
/// Whether files of other formats have it, too.
bool shares_extension(MeshFormat format);
/// What a file of this extension (with its point) is written as where no format is named, or a folder for an
/// empty one; nothing where it is no format's.
std::optional<MeshFormat> usual_mesh_format(std::string_view extension);

/// Throws InvalidInput, as export_mesh does, when the format cannot hold a mesh with prisms or of quadratic
/// elements: to be asked before a mesh is made.
void require_holds(MeshFormat format, bool prisms, bool quadratic);

struct MeshExportOptions {
  /// Of the volume: its physical group, zone, block or part, made safe as the faces' names are
  /// and at most 16 characters.
  std::string title = "mesh";
  /// How many of the tetrahedra, the last ones, are layers' prisms that were split; formats that have a place
  /// for it tell them apart: docs/reference/mesh-formats.md.
  std::size_t layer_tetrahedra = 0;
};

struct MeshExportResult {
  std::vector<std::string> face_names;  ///< as written, one a face of the mesh
  std::vector<std::string> warnings;    ///< "face 2 'inlet a' is written as inlet_a"
};

/// Names that every format can hold, in all formats the same: ASCII letters, digits, `_` and `-`, all else
/// (one character each) becomes `_`; beginning with a letter (else `face_` is put before it), at most 32
/// characters, and unlike another one's even where case is ignored (else `_<id>` is put behind the later
/// one).
std::vector<std::string> safe_face_names(const std::vector<geometry::Face>& faces);

/// Writes `mesh` (LPS, mm) to `path`, a file or a folder as the format is, whole or not at all. An existing
/// one is replaced; a folder that holds anything else is refused. Throws InvalidInput, before anything is
/// written, when the format cannot hold the elements (named, with the way out), and when the mesh is not
/// sound: no elements, coordinates that are not finite, indices out of range, points of no element, face ids
/// without a face or the reverse, boundary that is not exactly the elements' free sides, outward. IoError
/// when `path` cannot be written, ResourceError when the disk is full.
MeshExportResult export_mesh(const geometry::MixedMesh& mesh, MeshFormat format,
                             const std::filesystem::path& path, const MeshExportOptions& options = {});

}  // namespace ostia::io
