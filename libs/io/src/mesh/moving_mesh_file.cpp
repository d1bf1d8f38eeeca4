#include "ostia/io/moving_mesh_file.h"

#include "mesh/text.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/core/text.h"

namespace ostia::io {
namespace fs = std::filesystem;
namespace {

using geometry::Vec3;

constexpr double metres_per_mm = 1e-3;
constexpr int time_digits = 10;

void put_header(TextFile& out, const std::string& type, const std::string& location,
                const std::string& object) {
  out << "FoamFile\n{\n    version     2.0;\n    format      ascii;\n    class       " << type
      << ";\n    location    \"" << location << "\";\n    object      " << object << ";\n}\n\n";
}

void put_vectors(TextFile& out, const std::vector<Vec3>& values) {
  out << values.size() << "\n(\n";
  for (const Vec3& v : values)
    out << '(' << v[0] * metres_per_mm << ' ' << v[1] * metres_per_mm << ' ' << v[2] * metres_per_mm << ")\n";
  out << ')';
}

}  // namespace

void write_pvd(const fs::path& path, const std::vector<MeshAtTime>& times) {
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" "
      "byte_order=\"LittleEndian\">\n  <Collection>\n";
  for (const MeshAtTime& one : times)
    text += "    <DataSet timestep=\"" + core::significant_text(one.seconds, time_digits) +
            "\" part=\"0\" file=\"" + one.file + "\"/>\n";
  core::write_file(path, text + "  </Collection>\n</VTKFile>\n");
}

std::string openfoam_time(double seconds) {
  return core::significant_text(seconds, time_digits);
}

void write_openfoam_points(const fs::path& case_folder, double seconds, const geometry::MixedMesh& mesh,
                           const std::vector<Vec3>& points) {
  if (points.size() != mesh.points.size())
    throw InvalidInput("cannot write points of the time " + openfoam_time(seconds) + ": " +
                       std::to_string(points.size()) + " of " + std::to_string(mesh.points.size()));
  const std::string time = openfoam_time(seconds);
  make_folders(case_folder / time / "polyMesh");
  TextFile places(case_folder / time / "polyMesh" / "points");
  put_header(places, "vectorField", time + "/polyMesh", "points");
  put_vectors(places, points);
  places << '\n';
  places.close();
  std::vector<Vec3> displacement(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) displacement[i] = points[i] - mesh.points[i];
  TextFile moved(case_folder / time / "pointDisplacement");
  put_header(moved, "pointVectorField", time, "pointDisplacement");
  moved << "dimensions      [0 1 0 0 0 0 0];\n\ninternalField   nonuniform List<vector>\n";
  put_vectors(moved, displacement);
  moved << ";\n\nboundaryField\n{\n    \".*\"\n    {\n        type            calculated;\n    }\n}\n";
  moved.close();
}

void write_openfoam_times(const fs::path& case_folder, double step_seconds, double end_seconds) {
  make_folders(case_folder / "system");
  TextFile out(case_folder / "system" / "controlDict");
  put_header(out, "dictionary", "system", "controlDict");
  out << "application     moveDynamicMesh;\nstartFrom       startTime;\nstartTime       0;\nstopAt          "
         "endTime;\nendTime         "
      << openfoam_time(end_seconds) << ";\ndeltaT          " << openfoam_time(step_seconds)
      << ";\nwriteControl    timeStep;\nwriteInterval   1;\ntimePrecision   " << time_digits << ";\n";
  out.close();
}

}  // namespace ostia::io
