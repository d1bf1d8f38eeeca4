#include "ostia/io/surface_file.h"

#include "surface_formats.h"
#include "vtk/xml.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/geometry/stl.h"

#include <algorithm>
#include <array>
#include <cctype>

namespace ostia::io {
namespace fs = std::filesystem;
namespace {

std::string lower_extension(const fs::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  return extension;
}

/// A triangle with a corner that is no point, in words; none: empty.
std::string missing_corner(const geometry::TriMesh& mesh) {
  const auto count = static_cast<std::int64_t>(mesh.points.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (const std::int32_t p : mesh.triangles[t])
      if (p < 0 || p >= count)
        return "triangle " + std::to_string(t) + " names point " + std::to_string(p) + ", but there are " +
               std::to_string(count) + " points";
  return {};
}

}  // namespace

void refuse(const fs::path& path, const std::string& what) {
  throw InvalidInput("cannot read " + path.string() + ": " + what);
}

std::string upper(std::string_view text) {
  std::string all(text);
  for (char& c : all)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  return all;
}

geometry::Face face_named(std::int32_t id, const std::string& name) {
  using geometry::FaceKind;
  return {id, name,
          name.starts_with("inlet")    ? FaceKind::inlet
          : name.starts_with("outlet") ? FaceKind::outlet
                                       : FaceKind::wall};
}

geometry::Face face_without_name(std::int32_t id) {
  using geometry::FaceKind;
  return {id, id == 1 ? "wall" : "face_" + std::to_string(id), id == 1 ? FaceKind::wall : FaceKind::outlet};
}

bool is_surface_file(const fs::path& path) {
  static constexpr std::array<std::string_view, 4> known{".stl", ".ply", ".obj", ".vtp"};
  const std::string extension = lower_extension(path);
  return std::find(known.begin(), known.end(), extension) != known.end() ||
         (extension == ".vtk" && legacy_has_polygons(path));
}

LoadedSurface read_surface(const fs::path& path) {
  std::error_code error;
  if (!fs::exists(path, error)) throw IoError("cannot read " + path.string() + ": there is no such file");
  if (fs::is_regular_file(path, error) && fs::file_size(path, error) == 0) refuse(path, "the file is empty");
  const std::string extension = lower_extension(path);
  LoadedSurface loaded;
  if (extension == ".stl")
    loaded = read_stl(path);
  else if (extension == ".ply")
    loaded = read_ply(path);
  else if (extension == ".obj")
    loaded = read_obj(path);
  else if (extension == ".vtp" || extension == ".vtk")
    loaded = read_vtp(path);
  else
    refuse(path, "a surface ends in .stl, .ply, .obj, .vtp or .vtk");
  if (loaded.surface.mesh.triangles.empty())
    throw EmptySurface("cannot read " + path.string() + ": it has no triangles");
  if (const std::string fault = missing_corner(loaded.surface.mesh); !fault.empty()) refuse(path, fault);
  return loaded;
}

void write_surface(const fs::path& path, const geometry::TriMesh& mesh) {
  write_surface(path, geometry::FacedSurface{mesh, {}, {}});
}

void write_surface(const fs::path& path, const geometry::FacedSurface& surface) {
  if (const std::string fault = missing_corner(surface.mesh); !fault.empty())
    throw InvalidInput("cannot write " + path.string() + ": " + fault);
  const std::string extension = lower_extension(path);
  if (extension == ".vtp") return core::write_file(path, vtp_text(surface));
  const bool one_face = surface.face_ids.empty() ||
                        std::all_of(surface.face_ids.begin(), surface.face_ids.end(),
                                    [&](std::int32_t id) { return id == surface.face_ids.front(); });
  if (extension != ".stl" && extension != ".ply") {
    throw InvalidInput("cannot write " + path.string() + ": a surface is written as .vtp, .stl or .ply");
  }
  if (!one_face) {
    throw InvalidInput("cannot write " + path.string() + ": " + extension +
                       " cannot hold named faces; write .vtp, or the mesh alone");
  }
  core::write_file(path, extension == ".stl" ? geometry::binary_stl(surface.mesh) : ply_text(surface.mesh));
}

}  // namespace ostia::io
