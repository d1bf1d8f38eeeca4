// Exodus II, CGNS, XDMF and OpenFOAM's polyMesh, read back. The writers are held against other programs in
// mesh_export_readers_test.cpp.

#include "io_test_support.h"
#include "mesh_export_meshes.h"

#include "ostia/geometry/mixed_mesh_split.h"
#include "ostia/io/mesh_export.h"
#include "ostia/io/volume_mesh_file.h"

namespace ostia::io {
namespace {

namespace fs = std::filesystem;
using geometry::MixedMesh;

constexpr double tolerance = 1e-6;  // relative

struct VolumeMeshReadersSample {
  std::string name;
  MixedMesh mesh;
};

std::vector<VolumeMeshReadersSample> linear_samples() {
  return {{"tetrahedra", column_of_tetrahedra()},
          {"both", column_with_prisms()},
          {"prisms", ring_of_prisms()},
          {"split", geometry::split_prisms(column_with_prisms())}};
}

std::vector<VolumeMeshReadersSample> all_samples() {
  std::vector<VolumeMeshReadersSample> samples = linear_samples();
  for (std::size_t i = 0; i < 4; ++i)
    samples.push_back({"quadratic " + samples[i].name, quadratic(samples[i].mesh)});
  return samples;
}

/// Names, kinds and (where the format has them) ids of the faces; counts, volume, areas and their vectors.
void expect_same(const MixedMesh& read, const MixedMesh& mesh, bool ids) {
  ASSERT_EQ(read.faces.size(), mesh.faces.size());
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    EXPECT_EQ(read.faces[f].name, mesh.faces[f].name);
    EXPECT_EQ(read.faces[f].kind, mesh.faces[f].kind);
    EXPECT_EQ(read.faces[f].id, ids ? mesh.faces[f].id : static_cast<std::int32_t>(f) + 1);
  }
  EXPECT_EQ(read.quadratic(), mesh.quadratic());
  const MeshMeasure measured = measure(read), expected = measure(mesh);
  EXPECT_EQ(measured.tetrahedra, expected.tetrahedra);
  EXPECT_EQ(measured.prisms, expected.prisms);
  EXPECT_NEAR(measured.volume, expected.volume, tolerance * expected.volume);
  for (const auto& [name, face] : expected.faces) {
    ASSERT_TRUE(measured.faces.contains(name)) << name;
    const FaceMeasure& same = measured.faces.at(name);
    EXPECT_EQ(same.triangles, face.triangles) << name;
    EXPECT_EQ(same.quads, face.quads) << name;
    EXPECT_NEAR(same.area, face.area, tolerance * face.area) << name;
    EXPECT_LE((same.vector_area - face.vector_area).norm(), tolerance * face.area) << name;
  }
}

void round_trip(MeshFormat format, const std::string& file,
                const std::vector<VolumeMeshReadersSample>& samples, bool ids) {
  const fs::path folder = testing::temporary_folder("readers");
  for (std::size_t i = 0; i < samples.size(); ++i) {
    SCOPED_TRACE(samples[i].name);
    const fs::path path = folder / (std::to_string(i) + file);
    export_mesh(samples[i].mesh, format, path);
    EXPECT_TRUE(is_volume_mesh(path));
    const MixedMesh read = read_volume_mesh(path);
    expect_same(read, samples[i].mesh, ids);
    // What was read is a whole mesh again: elements, boundary and second-order nodes belong together.
    EXPECT_NO_THROW(export_mesh(read, MeshFormat::vtu, folder / (std::to_string(i) + ".vtu")));
  }
}

void expect_refused(const fs::path& path, const std::string& part) {
  try {
    read_volume_mesh(path);
    FAIL() << path << " was read";
  } catch (const InvalidInput& error) {
    EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find(path.filename().string()), std::string::npos) << error.what();
  }
}

void replace(const fs::path& file, const std::string& from, const std::string& to) {
  std::string text = core::read_file(file);
  const std::size_t at = text.find(from);
  ASSERT_NE(at, std::string::npos) << from;
  core::write_file(file, text.replace(at, from.size(), to));
}

TEST(VolumeMeshReaders, ExodusComesBackAsItWas) {
  round_trip(MeshFormat::exodus, ".exo", all_samples(), true);
}

TEST(VolumeMeshReaders, AbaqusComesBackAsItWas) {
  std::vector<VolumeMeshReadersSample> samples = linear_samples();  // it has no prism of 18 nodes
  samples.push_back({"quadratic tetrahedra", quadratic(column_of_tetrahedra())});
  round_trip(MeshFormat::abaqus, ".inp", samples, true);
}

TEST(VolumeMeshReaders, FluentComesBackAsItWas) {
  round_trip(MeshFormat::fluent, ".msh", linear_samples(), true);
}

TEST(VolumeMeshReaders, FaultsOfAFluentMeshAreTold) {
  const fs::path folder = testing::temporary_folder("readers");
  const auto refused = [&](const std::string& from, const std::string& to, const std::string& part) {
    const fs::path path = folder / "spoiled.msh";
    export_mesh(column_of_tetrahedra(), MeshFormat::fluent, path);
    replace(path, from, to);
    expect_refused(path, part);
  };
  refused("(13 (1 ", "(13 (1 0 ", "more entries");
  refused("(13 (1 ", "(14 (1 ", "no tetrahedron, prism or hexahedron");
  refused("(10 (1 1", "(10 (1 x", "no hexadecimal number");
  refused("(10 (1 1", "(9 (1 1", "of 0");
  core::write_file(folder / "cut.msh", "(0 \"a Fluent mesh\")\n(10 (1 1 2 1 3)(\n0 0 0\n");
  expect_refused(folder / "cut.msh", "is no number");
  core::write_file(folder / "none.msh", "(0 \"a Fluent mesh\")");
  expect_refused(folder / "none.msh", "no tetrahedra");
}

TEST(VolumeMeshReaders, CgnsComesBackAsItWas) {
  round_trip(MeshFormat::cgns, ".cgns", all_samples(), true);
}

TEST(VolumeMeshReaders, XdmfComesBackAsItWas) {
  round_trip(MeshFormat::xdmf, "", all_samples(), true);
}

TEST(VolumeMeshReaders, OpenfoamComesBackWithItsPatchesNumberedInTheirOrder) {
  round_trip(MeshFormat::openfoam, "", linear_samples(), false);
}

TEST(VolumeMeshReaders, FilesTellTheTetrahedraOfLayers) {
  const fs::path folder = testing::temporary_folder("readers");
  const MixedMesh column = column_with_prisms();
  MeshExportOptions options;
  options.layer_tetrahedra = 3 * column.prisms.size();
  for (const MixedMesh& mesh : {geometry::split_prisms(column), geometry::split_prisms(quadratic(column))}) {
    std::vector<bool> expected(mesh.tetrahedra.size(), false);
    std::fill(expected.end() - static_cast<std::ptrdiff_t>(options.layer_tetrahedra), expected.end(), true);
    for (const MeshFormat format :
         {MeshFormat::vtu, MeshFormat::gmsh2, MeshFormat::gmsh4, MeshFormat::exodus, MeshFormat::abaqus,
          MeshFormat::cgns, MeshFormat::xdmf, MeshFormat::openfoam}) {
      if (mesh.quadratic() && format == MeshFormat::openfoam) continue;
      SCOPED_TRACE(name_of(format));
      const std::string extension(extension_of(format));
      const fs::path path = folder / (std::string(name_of(format)) + extension);
      export_mesh(mesh, format, path, options);
      const LayeredMesh read = read_layered_mesh(path);
      EXPECT_EQ(read.in_layers, expected);
      expect_same(read.mesh, mesh, format != MeshFormat::openfoam);
      fs::remove_all(path);  // another folder's files are not replaced
      export_mesh(mesh, format, path);
      EXPECT_TRUE(read_layered_mesh(path).in_layers.empty());
      fs::remove_all(path);
    }
  }
}

TEST(VolumeMeshReaders, ZonesOfLayersAreReadAsOpenfoamWritesThem) {
  const fs::path folder = testing::temporary_folder("readers") / "case";
  const MixedMesh mesh = column_of_tetrahedra();
  export_mesh(mesh, MeshFormat::openfoam, folder);
  const auto with_zones = [&](const std::string& zones) {
    core::write_file(folder / "constant" / "polyMesh" / "cellZones",
                     "FoamFile { format ascii; class regIOobject; object cellZones; }\n" + zones);
    return folder;
  };
  const std::vector<bool> marks =
      read_layered_mesh(with_zones("3 (rotor { type cellZone; cellLabels List<label> 1(2); }\n"
                                   "a_layers { type cellZone; cellLabels List<label> 2(0 3); }\n"
                                   "b_layers { type cellZone; cellLabels List<label> 1{1}; })"))
          .in_layers;
  ASSERT_EQ(marks.size(), mesh.tetrahedra.size());
  EXPECT_EQ(std::vector<bool>(marks.begin(), marks.begin() + 5),
            (std::vector<bool>{true, true, false, true, false}));
  EXPECT_THROW(
      read_layered_mesh(with_zones("1 (a_layers { type cellZone; cellLabels List<label> 1(900000); })")),
      InvalidInput);
}

TEST(VolumeMeshReaders, NumbersAndElementsAreTheSameToTheBit) {
  const fs::path folder = testing::temporary_folder("readers");
  const MixedMesh mesh = column_with_prisms();
  for (const auto& [format, file] :
       {std::pair{MeshFormat::exodus, "a.exo"}, {MeshFormat::cgns, "a.cgns"}, {MeshFormat::xdmf, "a"}}) {
    export_mesh(mesh, format, folder / file);
    const MixedMesh read = read_volume_mesh(folder / file);
    EXPECT_EQ(read.points, mesh.points) << file;
    EXPECT_EQ(read.tetrahedra, mesh.tetrahedra) << file;
    EXPECT_EQ(read.prisms, mesh.prisms) << file;
  }
}

TEST(VolumeMeshReaders, ACaseIsFoundByItsFolderItsConstantAndItsPolyMesh) {
  const fs::path folder = testing::temporary_folder("readers") / "case";
  const MixedMesh mesh = column_of_tetrahedra();
  export_mesh(mesh, MeshFormat::openfoam, folder);
  for (const fs::path& path : {folder, folder / "constant", folder / "constant" / "polyMesh"}) {
    ASSERT_TRUE(is_volume_mesh(path)) << path;
    EXPECT_EQ(read_volume_mesh(path).tetrahedra.size(), mesh.tetrahedra.size());
  }
  EXPECT_FALSE(is_volume_mesh(folder.parent_path()));
}

TEST(VolumeMeshReaders, WhatIsNoSuchFileIsRefusedByName) {
  const fs::path folder = testing::temporary_folder("readers");
  for (const std::string name : {"no.exo", "no.cgns", "no.xdmf", "no.inp"}) {
    core::write_file(folder / name, "neither this nor that");
    expect_refused(folder / name, "cannot read");
  }
}

TEST(VolumeMeshReaders, CutFilesAreRefused) {
  const fs::path folder = testing::temporary_folder("readers");
  const MixedMesh mesh = column_with_prisms();
  for (const auto& [format, file] : {std::pair{MeshFormat::exodus, "a.exo"}, {MeshFormat::cgns, "a.cgns"}}) {
    export_mesh(mesh, format, folder / file);
    const std::string whole = core::read_file(folder / file);
    core::write_file(folder / file, whole.substr(0, whole.size() / 2));
    EXPECT_THROW(read_volume_mesh(folder / file), InvalidInput) << file;
  }
  export_mesh(mesh, MeshFormat::xdmf, folder / "x");
  fs::remove(folder / "x" / "mesh.h5");
  EXPECT_THROW(read_volume_mesh(folder / "x"), InvalidInput);
}

TEST(VolumeMeshReaders, FaultsOfAPolyMeshAreToldByFileAndPlace) {
  const fs::path folder = testing::temporary_folder("readers");
  const auto spoiled = [&](const std::string& name, const std::string& file, const std::string& from,
                           const std::string& to) {
    export_mesh(column_of_tetrahedra(), MeshFormat::openfoam, folder / name);
    replace(folder / name / "constant" / "polyMesh" / file, from, to);
    return folder / name;
  };
  const auto refused = [&](const fs::path& path, const std::string& part) {
    try {
      read_volume_mesh(path);
      ADD_FAILURE() << part << ": was read";
    } catch (const InvalidInput& error) {
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
  };
  refused(spoiled("binary", "points", "ascii", "binary"), "writeFormat ascii");
  refused(spoiled("five", "faces", "\n3(", "\n5("), "5 corners");
  refused(spoiled("patch", "boundary", "startFace       ", "startFace       9"), "beyond the last");
  refused(spoiled("owner", "owner", "\n(\n0", "\n(\n-3"), "no cell -3");
  refused(spoiled("moved", "owner", "\n(\n0\n", "\n(\n1\n"), "no tetrahedron, prism or hexahedron");
}

}  // namespace
}  // namespace ostia::io
