#include "ostia/io/mesh_export.h"

#include "io_test_support.h"
#include "mesh_export_meshes.h"

#include "ostia/geometry/mixed_mesh_split.h"

#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <set>
#include <string_view>

namespace ostia::io {
namespace {

namespace fs = std::filesystem;
using geometry::MixedMesh;

fs::path mesh_export_target(const std::string& name) {
  return testing::temporary_folder("export") / name;
}

void expect_export_refused(const MixedMesh& mesh, MeshFormat format, const std::vector<std::string>& parts) {
  const fs::path path = mesh_export_target("out");
  try {
    export_mesh(mesh, format, path);
    ADD_FAILURE() << name_of(format) << " accepted it";
  } catch (const InvalidInput& error) {
    for (const std::string& part : parts)
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
  }
  EXPECT_TRUE(fs::is_empty(path.parent_path())) << "something was left behind";
}

TEST(MeshExport, TheTestMeshesAreWhatTheirGeometrySays) {
  const double hexagon = 1.5 * std::sqrt(3.0);
  const double whole = hexagon * column_radius * column_radius, core = hexagon * core_radius * core_radius;
  const MeshMeasure column = measure(column_with_prisms());
  EXPECT_NEAR(column.volume, whole * column_length, 1e-10);
  EXPECT_NEAR(column.faces.at("wall").area, 6.0 * column_radius * column_length, 1e-10);
  EXPECT_NEAR(column.faces.at("inlet_rca").vector_area.z(), -whole, 1e-10);
  EXPECT_NEAR(column.faces.at("outlet_rca").vector_area.z(), whole, 1e-10);
  EXPECT_EQ(column.faces.at("outlet_rca").quads, 6u);
  EXPECT_NEAR(measure(column_of_tetrahedra()).volume, core * column_length, 1e-10);
  EXPECT_NEAR(measure(ring_of_prisms()).volume, (whole - core) * column_length, 1e-10);
  EXPECT_GT(std::abs(measure(quadratic(column_with_prisms())).volume - whole * column_length), 0.01);
}

TEST(MeshExport, NamesItsFormatsBothWays) {
  for (const MeshFormat format : mesh_formats) EXPECT_EQ(mesh_format(name_of(format)), format);
  try {
    mesh_format("step");
    ADD_FAILURE();
  } catch (const InvalidInput& error) {
    EXPECT_NE(std::string(error.what()).find("mesh-complete"), std::string::npos) << error.what();
  }
}

TEST(MeshExport, OfEachExtensionOneFormatIsTheUsual) {
  for (const auto& [extension, usual] : {std::pair(".vtu", MeshFormat::vtu),
                                         {".msh", MeshFormat::gmsh4},
                                         {".inp", MeshFormat::abaqus},
                                         {".exo", MeshFormat::exodus},
                                         {".cgns", MeshFormat::cgns},
                                         {"", MeshFormat::openfoam}})
    EXPECT_EQ(usual_mesh_format(extension), usual) << extension;
  EXPECT_FALSE(usual_mesh_format(".step"));
  EXPECT_FALSE(usual_mesh_format("vtu"));  // without its point
  std::set<std::string_view> titles;
  for (const MeshFormat format : mesh_formats) {
    const auto usual = usual_mesh_format(extension_of(format));
    ASSERT_TRUE(usual) << name_of(format);
    EXPECT_EQ(extension_of(*usual), extension_of(format));
    EXPECT_EQ(shares_extension(format), extension_of(format) == ".msh") << name_of(format);
    EXPECT_TRUE(titles.insert(title_of(format)).second) << title_of(format);
  }
}

TEST(MeshExport, MakesNamesSafe) {
  const std::vector<std::string> names = safe_face_names({{1, "wall"},
                                                          {2, "inlet \"left\" main"},
                                                          {3, "INLET__left__MAIN"},
                                                          {4, "2nd"},
                                                          {5, ""},
                                                          {6, "Ausl\xC3\xA4ufer/1"},
                                                          {7, std::string(60, 'x')},
                                                          {8, std::string(70, 'x')}});
  EXPECT_EQ(names[0], "wall");
  EXPECT_EQ(names[1], "inlet__left__main");
  EXPECT_EQ(names[2], "INLET__left__MAIN_3");
  EXPECT_EQ(names[3], "face_2nd");
  EXPECT_EQ(names[4], "face_5");
  EXPECT_EQ(names[5], "Ausl_ufer_1");
  EXPECT_EQ(names[6], std::string(32, 'x'));
  EXPECT_EQ(names[7], std::string(30, 'x') + "_8");
}

TEST(MeshExport, TellsWhichNamesItChanged) {
  MixedMesh mesh = column_of_tetrahedra();
  mesh.faces[1].name = "inlet of 'RCA'";
  for (const MeshFormat format : mesh_formats) {
    const MeshExportResult result = export_mesh(mesh, format, mesh_export_target("out"));
    EXPECT_EQ(result.face_names[1], "inlet_of__RCA_") << name_of(format);
    ASSERT_EQ(result.warnings.size(), 1u);
    EXPECT_EQ(result.warnings[0], "face 4 'inlet of 'RCA'' is written as inlet_of__RCA_");
  }
}

TEST(MeshExport, NamesTheVolumeAsTold) {
  const fs::path path = mesh_export_target("m.msh");
  MeshExportOptions options;
  options.title = "left coronary artery";
  export_mesh(column_of_tetrahedra(), MeshFormat::gmsh2, path, options);
  EXPECT_NE(core::read_file(path).find("3 8 \"left_coronary_ar\""), std::string::npos);
  options.title = "Wall";
  export_mesh(column_of_tetrahedra(), MeshFormat::gmsh2, path, options);
  EXPECT_NE(core::read_file(path).find("3 8 \"Wall_0\""), std::string::npos);
}

TEST(MeshExport, RefusesWhatAFormatCannotHold) {
  const MixedMesh prisms = column_with_prisms(), curved = quadratic(column_of_tetrahedra());
  expect_export_refused(prisms, MeshFormat::mesh_complete, {"mesh-complete", "prisms", "split"});
  for (const MeshFormat format :
       {MeshFormat::stl, MeshFormat::openfoam, MeshFormat::mesh_complete, MeshFormat::fluent}) {
    expect_export_refused(curved, format, {std::string(name_of(format)), "10-node", "--order 1"});
    expect_export_refused(quadratic(prisms), format, {std::string(name_of(format)), "18-node", "--order 1"});
  }
  expect_export_refused(quadratic(prisms), MeshFormat::abaqus, {"Abaqus", "18-node prisms", "split"});
}

TEST(MeshExport, SaysBeforehandWhatAFormatCannotHold) {
  const MixedMesh prisms = column_with_prisms(), tetrahedra = column_of_tetrahedra();
  for (const MeshFormat format : mesh_formats) {
    for (const MixedMesh* linear : {&prisms, &tetrahedra}) {
      for (const bool second : {false, true}) {
        const MixedMesh mesh = second ? quadratic(*linear) : *linear;
        std::string beforehand, writing;
        try {
          require_holds(format, !mesh.prisms.empty(), second);
        } catch (const InvalidInput& error) {
          beforehand = error.what();
        }
        try {
          export_mesh(mesh, format, mesh_export_target("out"));
        } catch (const InvalidInput& error) {
          writing = error.what();
        }
        EXPECT_EQ(beforehand, writing) << name_of(format);
      }
    }
  }
}

TEST(MeshExport, RefusesMeshesThatAreNotSound) {
  const MixedMesh good = column_with_prisms();
  const auto refused = [&](const std::vector<std::string>& parts, const auto& spoil) {
    MixedMesh mesh = good;
    spoil(mesh);
    for (const MeshFormat format : {MeshFormat::vtu, MeshFormat::gmsh4, MeshFormat::exodus})
      expect_export_refused(mesh, format, parts);
  };
  refused({"no elements"}, [](MixedMesh& m) { m = {}; });
  refused({"point 5", "not finite"},
          [](MixedMesh& m) { m.points[5].y() = std::numeric_limits<double>::quiet_NaN(); });
  refused({"tetrahedron 2", "point 9999"}, [](MixedMesh& m) { m.tetrahedra[2][1] = 9999; });
  refused({"point 65 belongs to no element"}, [](MixedMesh& m) { m.points.emplace_back(1, 2, 3); });
  refused({"face id 5"}, [](MixedMesh& m) { m.triangle_face_ids[3] = 5; });
  refused({"8 'ghost'", "no boundary"}, [](MixedMesh& m) { m.faces.push_back({8, "ghost"}); });
  refused({"two faces", "id 4"}, [](MixedMesh& m) { m.faces[2].id = 4; });
  refused({"face id 0"}, [](MixedMesh& m) { m.faces[2].id = 0; });
  refused({"boundary lacks it"}, [](MixedMesh& m) {
    m.quads.pop_back();
    m.quad_face_ids.pop_back();
  });
  refused({"outward side"}, [](MixedMesh& m) { std::swap(m.triangles[0][0], m.triangles[0][1]); });
  refused({"2 elements and 1 boundary"}, [](MixedMesh& m) {
    const auto& p = m.prisms[0];
    m.triangles.push_back({p[0], p[1], p[2]});
    m.triangle_face_ids.push_back(1);
  });
  refused({"face ids of quadrilaterals"}, [](MixedMesh& m) { m.quad_face_ids.pop_back(); });
  MixedMesh curved = quadratic(good);
  std::swap(curved.quad_nodes[2][0], curved.quad_nodes[3][0]);
  expect_export_refused(curved, MeshFormat::vtu, {"second-order nodes", "not its element's"});
  refused({"prisms with second-order nodes"}, [](MixedMesh& m) {
    m.tetrahedron_nodes.assign(m.tetrahedra.size(), {0, 0, 0, 0, 0, 0});
  });
}

TEST(MeshExport, LeavesWhatItCannotReplace) {
  const MixedMesh mesh = column_of_tetrahedra();
  for (const MeshFormat format : mesh_formats)
    EXPECT_THROW(export_mesh(mesh, format, "/proc/nowhere/at/all"), IoError) << name_of(format);
  const fs::path folder = mesh_export_target("case");
  fs::create_directories(folder / "system");
  core::write_file(folder / "system" / "controlDict", "mine");
  try {
    export_mesh(mesh, MeshFormat::openfoam, folder);
    ADD_FAILURE() << "took away the case's settings";
  } catch (const InvalidInput& error) {
    EXPECT_NE(std::string(error.what()).find("system"), std::string::npos) << error.what();
  }
  EXPECT_EQ(core::read_file(folder / "system" / "controlDict"), "mine");
}

/// Content of a file, or of all files of a folder with their names.
std::string all_of(const fs::path& path) {
  if (!fs::is_directory(path)) return core::read_file(path);
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(path)) {
    if (entry.is_regular_file()) files[entry.path().string()] = core::read_file(entry.path());
  }
  std::string all;
  for (const auto& [name, content] : files) all += name + '\n' + content;
  return all;
}

/// In a process that may write 1000 bytes a file: 0 when the export was refused as for a full disk.
int export_without_room(const MixedMesh& mesh, MeshFormat format, const fs::path& path) {
  const pid_t child = ::fork();
  if (child == 0) {
    ::signal(SIGXFSZ, SIG_IGN);
    const rlimit room{1000, 1000};
    ::setrlimit(RLIMIT_FSIZE, &room);
    int outcome = 1;
    try {
      export_mesh(mesh, format, path);
    } catch (const ResourceError&) {
      outcome = 0;
    } catch (const std::exception&) {
      outcome = 2;
    }
    ::_exit(outcome);
  }
  int status = -1;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 100 + WTERMSIG(status);
}

TEST(MeshExport, KeepsTheOldOneWhenTheDiskIsFull) {
  for (const MeshFormat format : mesh_formats) {
    const fs::path path = mesh_export_target("out");
    export_mesh(column_of_tetrahedra(), format, path);
    const std::string before = all_of(path);
    const MixedMesh other = geometry::split_prisms(column_with_prisms());
    EXPECT_EQ(export_without_room(other, format, path), 0) << name_of(format);
    EXPECT_EQ(all_of(path), before) << name_of(format);
    const auto entries = fs::directory_iterator(path.parent_path());
    EXPECT_EQ(std::distance(begin(entries), end(entries)), 1) << name_of(format) << " left something behind";
  }
}

TEST(MeshExport, ReplacesItsOwnAndIsTheSameEachTime) {
  const MixedMesh mesh = column_with_prisms();
  const fs::path a = mesh_export_target("a.msh"), folder = mesh_export_target("case");
  export_mesh(column_of_tetrahedra(), MeshFormat::gmsh4, a);
  export_mesh(mesh, MeshFormat::gmsh4, a);
  const std::string first = core::read_file(a);
  export_mesh(mesh, MeshFormat::gmsh4, a);
  EXPECT_EQ(core::read_file(a), first);
  export_mesh(column_of_tetrahedra(), MeshFormat::openfoam, folder);
  export_mesh(mesh, MeshFormat::openfoam, folder);
  EXPECT_NE(core::read_file(folder / "constant/polyMesh/owner")
                .find("nCells:" + std::to_string(mesh.tetrahedra.size() + mesh.prisms.size())),
            std::string::npos);
}

}  // namespace
}  // namespace ostia::io
