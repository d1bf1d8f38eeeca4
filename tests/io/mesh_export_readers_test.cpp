// Every format is read back by programs that share no code with the writers: VTK, meshio, Gmsh, OpenFOAM,
// CGNS' own checker, and HDF5 by the format's manual.

#include "io_test_support.h"
#include "mesh_export_meshes.h"
#include "openfoam_case.h"

#include "ostia/core/child_process.h"
#include "ostia/geometry/mixed_mesh_split.h"
#include "ostia/io/mesh_export.h"

#include <cmath>
#include <cstdlib>

namespace ostia::io {
namespace {

namespace fs = std::filesystem;
using geometry::MixedMesh;

/// Runs a line of the shell; its whole output comes back.
struct Shell {
  bool good;
  std::string output;
};
Shell shell(const std::string& line) {
  const fs::path log = testing::temporary_folder("shell") / "log";
  const core::ChildResult child =
      core::run_child("/bin/sh", {"-c", "( " + line + " ) > '" + log.string() + "' 2>&1"});
  return {child.ok(), fs::exists(log) ? core::read_file(log) : child.standard_error};
}

bool found(const std::string& line) {
  return shell(line).good;
}

/// Debian's own: its modules of VTK, meshio and h5py belong to it.
const std::string python = "PYTHONDONTWRITEBYTECODE=1 /usr/bin/python3";
const std::string openfoam = "export WM_PROJECT_DIR=/usr/share/openfoam; ";

void expect_equal_measures(const MeshMeasure& read, const MeshMeasure& truth, bool ids, double tolerance,
                           bool surface_only = false) {
  if (!surface_only) {
    EXPECT_EQ(read.tetrahedra, truth.tetrahedra);
    EXPECT_EQ(read.prisms, truth.prisms);
    EXPECT_NEAR(read.volume, truth.volume, tolerance * truth.volume);
    EXPECT_GT(read.smallest_jacobian, 0.0) << "nodes are out of order";
  }
  ASSERT_EQ(read.faces.size(), truth.faces.size());
  for (const auto& [name, expected] : truth.faces) {
    ASSERT_TRUE(read.faces.contains(name)) << name;
    const FaceMeasure& face = read.faces.at(name);
    EXPECT_EQ(face.triangles, expected.triangles) << name;
    EXPECT_EQ(face.quads, expected.quads) << name;
    EXPECT_EQ(face.id, ids ? expected.id : 0) << name;
    EXPECT_NEAR(face.area, expected.area, tolerance * expected.area) << name;
    EXPECT_LE((face.vector_area - expected.vector_area).norm(), tolerance * expected.area) << name;
  }
}

/// One of tests/io/readers on meshes of one format; their measures.
std::vector<MeshMeasure> read_with(const std::string& script, const std::string& format,
                                   const std::vector<fs::path>& paths) {
  const fs::path folder = testing::temporary_folder("read");
  const fs::path reader = fs::path(__FILE__).parent_path() / "readers" / script;
  std::string line = python + " '" + reader.string() + "' " + format;
  for (std::size_t i = 0; i < paths.size(); ++i)
    line += " '" + paths[i].string() + "' '" + (folder / std::to_string(i)).string() + "'";
  const Shell run = shell(line);
  EXPECT_TRUE(run.good) << run.output;
  std::vector<MeshMeasure> measures(paths.size());
  for (std::size_t i = 0; run.good && i < paths.size(); ++i)
    measures[i] = read_measure(folder / std::to_string(i));
  return measures;
}

struct Case {
  const char* name;
  MixedMesh mesh;
  std::size_t layer_tetrahedra = 0;
};

std::vector<Case> linear_cases() {
  const geometry::FacedSurface one = faced_tetrahedron();
  return {{"one tetrahedron",
           geometry::mixed({one.mesh.points, {{0, 1, 2, 3}}, one.mesh.triangles, one.face_ids, one.faces})},
          {"tetrahedra", column_of_tetrahedra()},
          {"prisms and tetrahedra", column_with_prisms()},
          {"prisms", ring_of_prisms()},
          {"split prisms", geometry::split_prisms(column_with_prisms())},
          {"split prisms apart", geometry::split_prisms(column_with_prisms()),
           3 * column_with_prisms().prisms.size()}};
}
std::vector<Case> all_cases() {
  std::vector<Case> cases = linear_cases();
  for (const Case& linear : linear_cases()) cases.push_back({"quadratic", quadratic(linear.mesh)});
  cases.push_back({"quadratic, then split", geometry::split_prisms(quadratic(column_with_prisms()))});
  return cases;
}
std::vector<Case> tetrahedral_cases() {
  return {linear_cases().front(),
          {"tetrahedra", column_of_tetrahedra()},
          {"split", geometry::split_prisms(column_with_prisms())}};
}

fs::path exported(const Case& c, MeshFormat format) {
  const fs::path path = testing::temporary_folder("export") / ("m" + std::string(extension_of(format)));
  MeshExportOptions options;
  options.layer_tetrahedra = c.layer_tetrahedra;
  export_mesh(c.mesh, format, path, options);
  return path;
}

std::vector<fs::path> exported(const std::vector<Case>& cases, MeshFormat format) {
  std::vector<fs::path> paths;
  for (const Case& c : cases) paths.push_back(exported(c, format));
  return paths;
}

void expect_equal_measures(const std::vector<MeshMeasure>& read, const std::vector<Case>& cases, bool ids) {
  for (std::size_t i = 0; i < cases.size(); ++i) {
    SCOPED_TRACE(cases[i].name);
    expect_equal_measures(read[i], measure(cases[i].mesh), ids, 1e-6);
  }
}

/// Writes, reads and compares each mesh.
void round_trip(const std::vector<Case>& cases, MeshFormat format, const std::string& script,
                bool ids = true) {
  SCOPED_TRACE(name_of(format));
  expect_equal_measures(read_with(script, std::string(name_of(format)), exported(cases, format)), cases, ids);
}

#define NEEDS(what, line)                        \
  if (!found(line)) {                            \
    GTEST_SKIP() << what << " is not installed"; \
  }
#define NEEDS_VTK() NEEDS("python3-vtk9", python + " -c 'import vtk, numpy'")
#define NEEDS_MESHIO() NEEDS("python3-meshio", python + " -c 'import meshio, h5py'")
#define NEEDS_H5PY() NEEDS("python3-h5py", python + " -c 'import h5py, numpy'")
#define NEEDS_OPENFOAM() NEEDS("openfoam", "command -v checkMesh")

TEST(MeshExportReaders, VtkReadsTheVtu) {
  NEEDS_VTK();
  round_trip(all_cases(), MeshFormat::vtu, "read_vtk.py");
}

TEST(MeshExportReaders, VtkReadsTheStlOfEachFace) {
  NEEDS_VTK();
  const std::vector<Case> cases = linear_cases();
  const std::vector<MeshMeasure> read = read_with("read_vtk.py", "stl", exported(cases, MeshFormat::stl));
  for (std::size_t i = 0; i < cases.size(); ++i) {
    SCOPED_TRACE(cases[i].name);
    expect_equal_measures(read[i], measure(geometry::split_prisms(cases[i].mesh)), false, 1e-5, true);
  }
}

TEST(MeshExportReaders, VtkReadsMeshComplete) {
  NEEDS_VTK();
  round_trip(tetrahedral_cases(), MeshFormat::mesh_complete, "read_vtk.py");
}

TEST(MeshExportReaders, VtkReadsThePolyMesh) {
  NEEDS_VTK();
  round_trip(linear_cases(), MeshFormat::openfoam, "read_vtk.py", false);
}

void expect_mesh_ok(const fs::path& folder, const MixedMesh& mesh, double metres_a_unit) {
  const Shell check = shell(openfoam + "checkMesh -allTopology -case '" + folder.string() + "'");
  ASSERT_TRUE(check.good) << check.output;
  EXPECT_NE(check.output.find("Mesh OK."), std::string::npos) << check.output;
  EXPECT_EQ(check.output.find("***"), std::string::npos) << check.output;
  const std::string volume = "Total volume = ";
  const std::size_t at = check.output.find(volume);
  ASSERT_NE(at, std::string::npos) << check.output;
  const double expected = measure(mesh).volume * std::pow(metres_a_unit, 3);
  EXPECT_NEAR(std::strtod(check.output.c_str() + at + volume.size(), nullptr), expected, 1e-5 * expected);
  for (const geometry::Face& face : mesh.faces) EXPECT_NE(check.output.find(face.name), std::string::npos);
}

TEST(MeshExportReaders, CheckMeshAcceptsThePolyMesh) {
  NEEDS_OPENFOAM();
  for (const Case& c : linear_cases()) {
    SCOPED_TRACE(c.name);
    const fs::path folder = exported(c, MeshFormat::openfoam);
    testing::add_control(folder);
    expect_mesh_ok(folder, c.mesh, 1e-3);
  }
}

/// A converter of OpenFOAM makes a case of a file in mm; checkMesh and VTK read that.
void expect_converts(const std::string& converter, const std::vector<Case>& cases, MeshFormat format) {
  std::vector<fs::path> folders;
  for (const Case& c : cases) {
    SCOPED_TRACE(c.name);
    folders.push_back(testing::temporary_folder("foam"));
    testing::add_control(folders.back());
    const Shell convert = shell(openfoam + converter + " -case '" + folders.back().string() + "' '" +
                                exported(c, format).string() + "'");
    ASSERT_TRUE(convert.good) << convert.output;
    expect_mesh_ok(folders.back(), c.mesh, converter.find("-scale") == std::string::npos ? 1.0 : 1e-3);
  }
  expect_equal_measures(read_with("read_vtk.py", "openfoam-mm", folders), cases, false);
}

TEST(MeshExportReaders, OpenFoamReadsTheFluentMesh) {
  NEEDS_OPENFOAM();
  NEEDS_VTK();
  expect_converts("fluent3DMeshToFoam", linear_cases(), MeshFormat::fluent);
}

TEST(MeshExportReaders, OpenFoamReadsGmsh2) {
  NEEDS_OPENFOAM();
  NEEDS_VTK();
  expect_converts("gmshToFoam", linear_cases(), MeshFormat::gmsh2);
}

/// VTK's readers of these formats give the elements, not the boundary.
void expect_equal_elements(const std::vector<MeshMeasure>& read, const std::vector<Case>& cases) {
  for (std::size_t i = 0; i < cases.size(); ++i) {
    SCOPED_TRACE(cases[i].name);
    const MeshMeasure truth = measure(cases[i].mesh);
    EXPECT_EQ(read[i].tetrahedra, truth.tetrahedra);
    EXPECT_EQ(read[i].prisms, truth.prisms);
    EXPECT_NEAR(read[i].volume, truth.volume, 1e-6 * truth.volume);
    EXPECT_GT(read[i].smallest_jacobian, 0.0);
  }
}

TEST(MeshExportReaders, VtkReadsTheCellsAndZonesOfTheFluentMesh) {
  NEEDS_VTK();
  const std::vector<Case> cases = linear_cases();
  const std::vector<MeshMeasure> read =
      read_with("read_vtk.py", "fluent", exported(cases, MeshFormat::fluent));
  expect_equal_elements(read, cases);
  for (std::size_t i = 0; i < cases.size(); ++i) {
    for (const auto& [name, face] : measure(cases[i].mesh).faces)
      EXPECT_EQ(read[i].faces.at(name).id, face.id) << name;
  }
}

TEST(MeshExportReaders, MeshioReadsGmsh) {
  NEEDS_MESHIO();
  round_trip(all_cases(), MeshFormat::gmsh2, "read_meshio.py");
  round_trip(all_cases(), MeshFormat::gmsh4, "read_meshio.py");
}

TEST(MeshExportReaders, GmshReadsAndRewritesItsOwn) {
  NEEDS("gmsh", "command -v gmsh");
  NEEDS_MESHIO();
  const std::vector<Case> cases = all_cases();
  for (const MeshFormat format : {MeshFormat::gmsh2, MeshFormat::gmsh4}) {
    SCOPED_TRACE(name_of(format));
    std::vector<fs::path> rewritten;
    for (const fs::path& file : exported(cases, format)) {
      rewritten.push_back(file.parent_path() / "again.msh");
      const Shell check = shell("gmsh -check '" + file.string() + "' && gmsh '" + file.string() +
                                "' -save -format msh41 -o '" + rewritten.back().string() + "'");
      ASSERT_TRUE(check.good) << check.output;
      EXPECT_EQ(check.output.find("Error"), std::string::npos) << check.output;
      EXPECT_EQ(check.output.find("Warning"), std::string::npos) << check.output;
    }
    expect_equal_measures(read_with("read_meshio.py", "gmsh4", rewritten), cases, true);
  }
}

TEST(MeshExportReaders, MeshioReadsAbaqus) {
  NEEDS_MESHIO();
  std::vector<Case> cases = linear_cases();
  cases.push_back({"quadratic", quadratic(column_of_tetrahedra())});
  round_trip(cases, MeshFormat::abaqus, "read_meshio.py", false);
}

TEST(MeshExportReaders, MeshioReadsXdmf) {
  NEEDS_MESHIO();
  round_trip(linear_cases(), MeshFormat::xdmf, "read_meshio.py");
  round_trip({{"quadratic", quadratic(column_of_tetrahedra())}}, MeshFormat::xdmf, "read_meshio.py");
}

TEST(MeshExportReaders, XdmfIsWhatItsManualSays) {
  NEEDS_H5PY();
  round_trip(all_cases(), MeshFormat::xdmf, "read_hdf5.py");
}

TEST(MeshExportReaders, VtkReadsExodus) {
  NEEDS_VTK();
  round_trip(all_cases(), MeshFormat::exodus, "read_vtk.py");
}

TEST(MeshExportReaders, CgnsIsWhatItsManualSays) {
  NEEDS_H5PY();
  round_trip(all_cases(), MeshFormat::cgns, "read_hdf5.py");
}

TEST(MeshExportReaders, CgnsCheckFindsNoFault) {
  NEEDS("cgns-convert", "command -v cgnscheck");
  for (const Case& c : all_cases()) {
    SCOPED_TRACE(c.name);
    const Shell check = shell("cgnscheck '" + exported(c, MeshFormat::cgns).string() + "'");
    EXPECT_TRUE(check.good) << check.output;
    EXPECT_EQ(check.output.find("ERROR"), std::string::npos) << check.output;
    EXPECT_EQ(check.output.find("WARNING"), std::string::npos) << check.output;
  }
}

TEST(MeshExportReaders, VtkReadsTheCellsOfCgns) {
  NEEDS_VTK();
  const std::vector<Case> cases = all_cases();
  expect_equal_elements(read_with("read_vtk.py", "cgns", exported(cases, MeshFormat::cgns)), cases);
}

}  // namespace
}  // namespace ostia::io
