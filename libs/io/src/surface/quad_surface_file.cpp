#include "ostia/io/quad_surface_file.h"

#include "surface_formats.h"
#include "text_writer.h"
#include "vtk/xml.h"

#include "ostia/core/files.h"
#include "ostia/geometry/stl.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkNew.h>
#include <vtkPolyDataWriter.h>
#include <vtkStringArray.h>

#include <new>
#include <utility>

namespace ostia::io {
namespace fs = std::filesystem;
namespace {

using geometry::Quad;

void check(const fs::path& path, const QuadSurface& surface) {
  const auto fail = [&](const std::string& what) {
    throw InvalidInput("cannot write " + path.string() + ": " + what);
  };
  const auto points = static_cast<std::int64_t>(surface.points.size());
  for (std::size_t q = 0; q < surface.quads.size(); ++q)
    for (const std::int32_t p : surface.quads[q])
      if (p < 0 || p >= points)
        fail("quadrilateral " + std::to_string(q) + " names point " + std::to_string(p) + ", but there are " +
             std::to_string(points) + " points");
  for (const auto& [ids, what] : {std::pair{&surface.branch_ids, "branch"}, {&surface.face_ids, "face"}})
    if (!ids->empty() && ids->size() != surface.quads.size())
      fail(std::to_string(ids->size()) + " " + what + " ids for " + std::to_string(surface.quads.size()) +
           " quadrilaterals");
}

vtkSmartPointer<vtkPolyData> polydata_of(const QuadSurface& surface) {
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(to_vtk(surface.points));
  vtkNew<vtkCellArray> polygons;
  const auto count = static_cast<vtkIdType>(surface.quads.size());
  polygons->AllocateExact(count, 4 * count);
  for (const Quad& q : surface.quads) polygons->InsertNextCell({q[0], q[1], q[2], q[3]});
  data->SetPolys(polygons);
  if (!surface.face_ids.empty()) {
    add_array(*data->GetCellData(), "CellEntityIds", surface.face_ids);
    add_faces(*data, surface.faces);
  }
  if (!surface.branch_ids.empty()) add_array(*data->GetCellData(), "BranchIds", surface.branch_ids);
  return data;
}

std::string legacy_text(vtkPolyData& data) {
  vtkNew<vtkPolyDataWriter> writer;
  writer->SetInputData(&data);
  writer->SetHeader("Ostia surface, axes LPS, unit mm");
  writer->SetFileVersion(42);  // the newer layout of cells is unknown to many tools
  writer->SetFileTypeToBinary();
  writer->WriteToOutputStringOn();
  if (writer->Write() != 1) throw std::bad_alloc();  // in memory nothing else can fail
  return writer->GetOutputStdString();
}

const std::string& name_of_face(const QuadSurface& surface, std::int32_t id) {
  static const std::string none;
  for (const geometry::Face& face : surface.faces)
    if (face.id == id) return face.name;
  return none;
}

std::string ply_header(const QuadSurface& surface) {
  std::string out = "ply\nformat binary_little_endian 1.0\ncomment Ostia surface, axes LPS, unit mm\n";
  for (const geometry::Face& face : surface.faces)
    out += "comment face " + std::to_string(face.id) + " " + face.name + "\n";
  out += "element vertex " + std::to_string(surface.points.size()) +
         "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
         std::to_string(surface.quads.size()) + "\nproperty list uchar int vertex_indices\n";
  if (!surface.branch_ids.empty()) out += "property int branch\n";
  if (!surface.face_ids.empty()) out += "property int face\n";
  return out + "end_header\n";
}

std::string ply_text(const QuadSurface& surface) {
  std::string out = ply_header(surface);
  const auto append = [&out](const auto& value) {
    out.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  for (const geometry::Vec3& p : surface.points)
    for (const double value : p) append(value);
  for (std::size_t q = 0; q < surface.quads.size(); ++q) {
    append(std::uint8_t{4});
    for (const std::int32_t p : surface.quads[q]) append(p);
    if (!surface.branch_ids.empty()) append(surface.branch_ids[q]);
    if (!surface.face_ids.empty()) append(surface.face_ids[q]);
  }
  return out;
}

/// "g wall branch_3": all groups that the faces from here on are in; "" without any.
std::string groups_of(const QuadSurface& surface, std::size_t q) {
  std::string out;
  if (!surface.face_ids.empty()) {
    const std::string& name = name_of_face(surface, surface.face_ids[q]);
    out += " " + (name.empty() ? "face_" + std::to_string(surface.face_ids[q]) : name);
  }
  if (!surface.branch_ids.empty()) out += " branch_" + std::to_string(surface.branch_ids[q]);
  return out.empty() ? out : "g" + out + "\n";
}

void write_obj(const fs::path& path, const QuadSurface& surface, const core::TaskContext& task) {
  TextWriter out(path, task);
  out.text("# Ostia surface, axes LPS, unit mm\n");
  for (const geometry::Vec3& p : surface.points) {
    out.text("v");
    for (const double value : p) out.number(' ', value);
    out.text("\n");
  }
  std::string last;
  for (std::size_t q = 0; q < surface.quads.size(); ++q) {
    std::string groups = groups_of(surface, q);
    if (groups != last) out.text(groups);
    last = std::move(groups);
    out.text("f");
    for (const std::int32_t p : surface.quads[q]) {
      out.text(" ");
      out.whole(std::int64_t{p} + 1);
    }
    out.text("\n");
  }
  out.commit();
}

std::string stl_text_of(const QuadSurface& surface) {
  geometry::TriMesh mesh{surface.points, {}};
  mesh.triangles.reserve(2 * surface.quads.size());
  for (const Quad& q : surface.quads) {
    mesh.triangles.push_back({q[0], q[1], q[2]});
    mesh.triangles.push_back({q[0], q[2], q[3]});
  }
  return geometry::binary_stl(mesh);
}

}  // namespace

QuadSurface quads_of_pairs(const geometry::FacedSurface& halves, std::vector<geometry::Vec3> points,
                           std::vector<std::int32_t> branch_ids) {
  QuadSurface out;
  out.points = std::move(points);
  out.branch_ids = std::move(branch_ids);
  out.faces = halves.faces;
  for (std::size_t first = 0; first + 1 < halves.mesh.triangles.size(); first += 2) {
    const geometry::Triangle &a = halves.mesh.triangles[first], &b = halves.mesh.triangles[first + 1];
    out.quads.push_back({a[0], a[1], a[2], b[2]});
    out.face_ids.push_back(halves.face_ids[first]);
  }
  return out;
}

std::vector<std::string> write_quad_surface(const fs::path& path, const QuadSurface& surface,
                                            const core::TaskContext& task) {
  const std::string extension = upper(path.extension().string());
  check(path, surface);
  task.throw_if_cancelled();
  if (extension == ".OBJ") {
    write_obj(path, surface, task);
  } else if (extension == ".VTP" || extension == ".VTK") {
    const vtkSmartPointer<vtkPolyData> data = polydata_of(surface);
    core::write_file(path, extension == ".VTP" ? polydata_text(*data) : legacy_text(*data));
  } else if (extension == ".PLY") {
    core::write_file(path, ply_text(surface));
  } else if (extension == ".STL") {
    core::write_file(path, stl_text_of(surface));
    return {"STL holds triangles alone: quadrilaterals were split, and names of branches and faces left out"};
  } else {
    throw InvalidInput("cannot write " + path.string() +
                       ": quadrilaterals are written as .vtp, .vtk, .ply, .obj or .stl");
  }
  return {};
}

}  // namespace ostia::io
