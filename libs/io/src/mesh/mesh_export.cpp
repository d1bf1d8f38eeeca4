#include "ostia/io/mesh_export.h"

#include "mesh/formats.h"
#include "replaced_folder.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"

#include <algorithm>
#include <mutex>
#include <set>

namespace ostia::io {
namespace fs = std::filesystem;
namespace {

using geometry::MixedMesh;

constexpr std::size_t longest_name = 32;  // CGNS and Exodus II hold no more

enum class Second { none, tetrahedra, all };  // which second-order elements a format knows

/// All that is known of a format; the command line and the window take it from here.
struct Format {
  MeshFormat format;
  std::string_view name, title, extension;
  bool usual;  // for a file of its extension, or for a folder; of each extension one is
  bool prisms;
  Second second;
  void (*write)(const PreparedMesh&, const fs::path&);
  std::string_view in_words = title;  // in a sentence
};

constexpr std::array<Format, mesh_formats.size()> formats = {{
    {MeshFormat::vtu, "vtu", "VTU", ".vtu", true, true, Second::all, write_vtu},
    {MeshFormat::stl, "stl", "STL, a file for each face", "", false, true, Second::none, write_stl_faces,
     "STL"},
    {MeshFormat::openfoam, "openfoam", "OpenFOAM", "", true, true, Second::none, write_openfoam,
     "OpenFOAM's polyMesh"},
    {MeshFormat::mesh_complete, "mesh-complete", "SimVascular (mesh-complete)", "", false, false,
     Second::none, write_mesh_complete, "SimVascular's mesh-complete"},
    {MeshFormat::gmsh2, "gmsh2", "Gmsh 2.2", ".msh", false, true, Second::all, write_gmsh2},
    {MeshFormat::gmsh4, "gmsh4", "Gmsh 4.1", ".msh", true, true, Second::all, write_gmsh4},
    {MeshFormat::fluent, "fluent", "Fluent", ".msh", false, true, Second::none, write_fluent,
     "Fluent's mesh"},
    {MeshFormat::abaqus, "abaqus", "Abaqus", ".inp", true, true, Second::tetrahedra, write_abaqus},
    {MeshFormat::xdmf, "xdmf", "XDMF (FEniCS)", "", false, true, Second::all, write_xdmf, "XDMF"},
    {MeshFormat::exodus, "exodus", "Exodus II", ".exo", true, true, Second::all, write_exodus},
    {MeshFormat::cgns, "cgns", "CGNS", ".cgns", true, true, Second::all, write_cgns},
}};

const Format& entry(MeshFormat format) {
  return *std::ranges::find(formats, format, &Format::format);
}

[[noreturn]] void refuse_format(const Format& format, const std::string& element,
                                const std::string& way_out) {
  throw InvalidInput("cannot export the mesh as " + std::string(format.name) + ": " +
                     std::string(format.in_words) + " cannot hold " + element + "; " + way_out);
}

bool letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

std::string safe_name(const geometry::Face& face) {
  std::string name;
  for (const char c : face.name) {
    if ((static_cast<unsigned char>(c) & 0xC0) == 0x80) continue;  // the rest of a UTF-8 character
    name += letter(c) || (c >= '0' && c <= '9') || c == '_' || c == '-' ? c : '_';
  }
  if (name.empty()) name = std::to_string(face.id);
  if (!letter(name.front())) name = "face_" + name;
  return name.substr(0, longest_name);
}

/// Messages name what the user asked for, not the hidden file that is written first.
template <class Failure>
[[noreturn]] void rethrow_shown(const Failure& failure, const fs::path& staged, const fs::path& path) {
  std::string message = failure.what();
  if (const auto at = message.find(staged.string()); at != std::string::npos)
    message.replace(at, staged.string().size(), path.string());
  throw Failure(message);
}

void write_staged(const Format& format, const PreparedMesh& mesh, const fs::path& staged,
                  const fs::path& path) {
  // HDF5 and CGNS keep a state that threads of one process share.
  static std::mutex one_at_a_time;
  const std::lock_guard lock(one_at_a_time);
  try {
    format.write(mesh, staged);
  } catch (const IoError& failure) {
    rethrow_shown(failure, staged, path);
  } catch (const ResourceError& failure) {
    rethrow_shown(failure, staged, path);
  }
}

std::string lower(std::string text) {
  std::ranges::transform(text, text.begin(),
                         [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  return text;
}

}  // namespace

std::string_view name_of(MeshFormat format) {
  return entry(format).name;
}

MeshFormat mesh_format(std::string_view name) {
  const auto found = std::ranges::find(formats, name, &Format::name);
  if (found != formats.end()) return found->format;
  std::string known;
  for (const Format& format : formats) known += (known.empty() ? "" : ", ") + std::string(format.name);
  throw InvalidInput("there is no mesh format \"" + std::string(name) + "\"; there are " + known);
}

std::string_view title_of(MeshFormat format) {
  return entry(format).title;
}

std::string_view extension_of(MeshFormat format) {
  return entry(format).extension;
}

bool shares_extension(MeshFormat format) {
  const std::string_view extension = extension_of(format);
  return !extension.empty() && std::ranges::count(formats, extension, &Format::extension) > 1;
}

std::optional<MeshFormat> usual_mesh_format(std::string_view extension) {
  for (const Format& format : formats)
    if (format.usual && format.extension == extension) return format.format;
  return std::nullopt;
}

std::vector<std::string> safe_face_names(const std::vector<geometry::Face>& faces) {
  std::vector<std::string> names;
  std::set<std::string> taken;
  for (const geometry::Face& face : faces) {
    std::string name = safe_name(face);
    for (int more = 0; !taken.insert(lower(name)).second; ++more) {
      const std::string tail =
          "_" + std::to_string(face.id) + (more > 0 ? "_" + std::to_string(more) : std::string());
      name = safe_name(face).substr(0, longest_name - tail.size()) + tail;
    }
    names.push_back(std::move(name));
  }
  return names;
}

void require_holds(MeshFormat format, bool prisms, bool quadratic) {
  const Format& to = entry(format);
  if (quadratic && to.second == Second::none) {
    refuse_format(to,
                  prisms ? "quadratic elements (10-node tetrahedra, 18-node prisms)"
                         : "quadratic elements (10-node tetrahedra)",
                  "mesh with linear ones (--order 1) or take vtu, gmsh4 or xdmf");
  }
  if (prisms && !to.prisms)
    refuse_format(to, "prisms beside tetrahedra (one cell type per mesh)",
                  "split the prisms into tetrahedra (--split-prisms) or mesh without layers");
  if (prisms && quadratic && to.second == Second::tetrahedra)
    refuse_format(to, "18-node prisms",
                  "split the prisms into tetrahedra (--split-prisms), mesh with linear elements (--order 1), "
                  "or take vtu, gmsh4 or xdmf");
}

MeshExportResult export_mesh(const MixedMesh& mesh, MeshFormat format, const fs::path& path,
                             const MeshExportOptions& options) {
  const Format& to = entry(format);
  require_holds(format, !mesh.prisms.empty(), mesh.quadratic());
  const PreparedMesh prepared = prepare(mesh, options.title, options.layer_tetrahedra);
  if (to.extension.empty()) {
    core::StagedFolder folder(path);
    write_staged(to, prepared, folder.temporary(), path);
    require_nothing_lost(folder.temporary(), path, "cannot export the mesh as " + std::string(to.name));
    folder.commit();
  } else {
    core::StagedFile file(path);
    write_staged(to, prepared, file.temporary(), path);
    file.commit();
  }
  MeshExportResult result{prepared.names, {}};
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    if (mesh.faces[f].name != prepared.names[f])
      result.warnings.push_back("face " + std::to_string(mesh.faces[f].id) + " '" + mesh.faces[f].name +
                                "' is written as " + prepared.names[f]);
  }
  return result;
}

}  // namespace ostia::io
