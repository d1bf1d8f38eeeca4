// Volume meshes that are cut off, lie about their size, or leave part of their boundary without a name. The
// files are made by hand with the formats' own libraries; XDMF's HDF5 is a netCDF-4 file, which is one.

#include "io_test_support.h"
#include "mesh_export_meshes.h"

#include "ostia/io/mesh_export.h"
#include "ostia/io/volume_mesh_file.h"

#include <cgnslib.h>
#include <gmock/gmock.h>
#include <netcdf.h>

#include <algorithm>
#include <functional>
#include <map>

namespace ostia::io {
namespace {

namespace fs = std::filesystem;
using geometry::FaceKind;
using geometry::MixedMesh;
using ::testing::ElementsAre;
using ::testing::UnorderedElementsAre;

fs::path place(const std::string& name) {
  return testing::temporary_folder("bad_meshes") / name;
}

void refused(const fs::path& path, const std::string& part) {
  expect_refusal(path, [&] { read_volume_mesh(path); }, {part});
}

/// "name id facets" of each face.
std::vector<std::string> faces_of(const MixedMesh& mesh) {
  std::vector<std::string> faces;
  for (const geometry::Face& face : mesh.faces)
    faces.push_back(face.name + " " + std::to_string(face.id) + " " +
                    std::to_string(std::ranges::count(mesh.triangle_face_ids, face.id)));
  return faces;
}

void expect_whole(const MixedMesh& mesh) {
  EXPECT_NO_THROW(export_mesh(mesh, MeshFormat::vtu, place("whole.vtu")));
}

// ---- Abaqus

const std::string nodes =
    "*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 0, 1, 0\n4, 0, 0, 1\n5, 9, 0, 0\n6, 10, 0, 0\n7, 9, 1, 0\n8, 9, 0, "
    "1\n";
const std::string elements = "*ELEMENT, TYPE=C3D4\n1, 1, 2, 3, 4\n2, 5, 6, 7, 8\n";

fs::path abaqus(const std::string& text) {
  return file_with("a.inp", text);
}

TEST(BadMeshFiles, SurfacesOfOneIdStayTwoFaces) {
  const MixedMesh mesh = read_volume_mesh(
      abaqus("** face 2 inlet\n** face 2 outlet\n" + nodes + elements +
             "*SURFACE, TYPE=ELEMENT, NAME=inlet\n1, S1\n*SURFACE, TYPE=ELEMENT, NAME=outlet\n2, S1\n"));
  EXPECT_THAT(faces_of(mesh), ElementsAre("inlet 2 1", "outlet 1 1", "wall 3 6"));
  expect_whole(mesh);
}

TEST(BadMeshFiles, SidesThatNoAbaqusSurfaceNamesAreWall) {
  const std::string surfaces =
      "*SURFACE, TYPE=ELEMENT, NAME=inlet\n1, S1\n*SURFACE, TYPE=ELEMENT, NAME=outlet\n2, S1\n2, S3\n";
  const MixedMesh mesh = read_volume_mesh(abaqus(nodes + elements + surfaces));
  EXPECT_THAT(faces_of(mesh), ElementsAre("inlet 1 1", "outlet 2 2", "wall 3 5"));
  EXPECT_EQ(mesh.faces.back().kind, FaceKind::wall);
  expect_whole(mesh);
  // An id that a comment gives is no other surface's; the wall takes the least that is left.
  const MixedMesh numbered = read_volume_mesh(abaqus("** face 1 outlet\n" + nodes + elements + surfaces));
  EXPECT_THAT(faces_of(numbered), ElementsAre("inlet 2 1", "outlet 1 2", "wall 3 5"));
  const MixedMesh free =
      read_volume_mesh(abaqus("** face 4 inlet\n** face 7 outlet\n" + nodes + elements + surfaces));
  EXPECT_THAT(faces_of(free), ElementsAre("inlet 4 1", "outlet 7 2", "wall 1 5"));
}

TEST(BadMeshFiles, AnAbaqusFileThatEndsWithinAnElementIsRefused) {
  refused(abaqus(nodes + elements + "3, 1, 2, 3"), "element 3 has too few nodes");
  refused(abaqus(nodes + elements + "3, 1, 2, 3\n*ELSET, ELSET=a\n1\n"), "element 3 has too few nodes");
  refused(abaqus(nodes + elements + "3, 1,\n*ELEMENT, TYPE=C3D4\n4, 1, 2, 3, 4\n"), "element 3");
  EXPECT_EQ(read_volume_mesh(abaqus(nodes + elements + "3, 1, 2,\n3, 4")).tetrahedra.size(), 3U);
}

TEST(BadMeshFiles, GeneratedSetsOfAbaqusStayInBounds) {
  const std::string surface = "*SURFACE, TYPE=ELEMENT, NAME=inlet\nall, S1\n";
  const auto set = [](const std::string& lines) { return "*ELSET, ELSET=all, GENERATE\n" + lines + "\n"; };
  // A set may stand before its elements.
  EXPECT_THAT(faces_of(read_volume_mesh(abaqus(nodes + set("1, 2") + elements + surface))),
              ElementsAre("inlet 1 2", "wall 2 6"));
  EXPECT_THAT(faces_of(read_volume_mesh(abaqus(nodes + elements + set("2, 9, 8\n9, 1") + surface))),
              ElementsAre("inlet 1 1", "wall 2 7"));
  refused(abaqus(nodes + elements + set("1, 9000000000000000000, 9000000000000000000") + surface),
          "out of range");
  refused(abaqus(nodes + elements + set("1, 2000000000") + surface), "names element 3");
  refused(abaqus(nodes + elements + "*SURFACE, NAME=inlet\n1, S-2147483648\n"), "S1 to S5");
  refused(abaqus(nodes + elements + "*SURFACE, NAME=inlet\n1, S6\n"), "S1 to S5");
  std::string again;
  for (int i = 0; i < 500; ++i) again += "1,2\n";
  refused(abaqus(nodes + elements + set(again) + surface + "all, S2\nall, S3\nall, S4\n"), "many times");
}

// ---- Fluent

TEST(BadMeshFiles, SizesThatAFluentMeshCannotHoldAreRefused) {
  for (const std::string head : {"(10 (1 7ffffffffffffff0 7ffffffffffffff0 1 3)(", "(10 (1 100 100 1 3)(",
                                 "(13 (1 7fffffffffffffff 0 3 0)(", "(13 (1 2 0 3 0)("})
    refused(file_with("a.msh", head), "more entries");
}

// ---- Exodus

struct Array {
  std::string name;
  std::vector<std::string> dimensions;
  std::vector<double> values = {};  ///< none: never written
  std::string text = {};            ///< of an array of characters
};
using Dimensions = std::map<std::string, std::size_t>;

void netcdf(const fs::path& path, int mode, const Dimensions& dimensions, const std::vector<Array>& arrays,
            std::size_t padding = 0) {
  const auto good = [](int status) { ASSERT_EQ(status, NC_NOERR) << nc_strerror(status); };
  int file = 0;
  good(nc_create(path.c_str(), NC_CLOBBER | mode, &file));
  std::map<std::string, int> dimension, variable;
  for (const auto& [name, length] : dimensions)
    good(nc_def_dim(file, name.c_str(), length, &dimension[name]));
  for (const Array& array : arrays) {
    std::vector<int> ids;
    for (const std::string& name : array.dimensions) ids.push_back(dimension.at(name));
    int& id = variable[array.name];
    good(nc_def_var(file, array.name.c_str(), array.text.empty() ? NC_DOUBLE : NC_CHAR,
                    static_cast<int>(ids.size()), ids.data(), &id));
    if (array.name == "connect1") good(nc_put_att_text(file, id, "elem_type", 5, "TETRA"));
  }
  const std::string blanks(padding, ' ');
  if (padding > 0) good(nc_put_att_text(file, NC_GLOBAL, "title", blanks.size(), blanks.c_str()));
  good(nc_enddef(file));
  for (const Array& array : arrays) {
    if (!array.values.empty()) good(nc_put_var_double(file, variable[array.name], array.values.data()));
    if (!array.text.empty()) good(nc_put_var_text(file, variable[array.name], array.text.data()));
  }
  good(nc_close(file));
}

/// One tetrahedron; `more` and `arrays` are put in place of what it has by these names, or beside it.
fs::path exodus(const Dimensions& more, const std::vector<Array>& arrays, int mode = 0,
                std::size_t padding = 0) {
  Dimensions dimensions = more;
  dimensions.insert({{"num_nodes", 4}, {"num_el_blk", 1}, {"num_el_in_blk1", 1}, {"num_nod_per_el1", 4}});
  std::vector<Array> all = arrays;
  for (const Array& usual : {Array{"coordx", {"num_nodes"}, {0, 1, 0, 0}},
                             {"coordy", {"num_nodes"}, {0, 0, 1, 0}},
                             {"coordz", {"num_nodes"}, {0, 0, 0, 1}},
                             {"connect1", {"num_el_in_blk1", "num_nod_per_el1"}, {1, 2, 3, 4}}})
    if (std::ranges::find(arrays, usual.name, &Array::name) == arrays.end()) all.push_back(usual);
  const fs::path path = place("a.exo");
  netcdf(path, mode, dimensions, all, padding);
  return path;
}

TEST(BadMeshFiles, SidesThatNoExodusSideSetNamesAreWall) {
  const Dimensions dimensions = {
      {"num_side_sets", 2}, {"len_name", 7}, {"num_side_ss1", 1}, {"num_side_ss2", 1}};
  const std::vector<Array> sets = {{"ss_names", {"num_side_sets", "len_name"}, {}, "inlet  outlet "},
                                   {"elem_ss1", {"num_side_ss1"}, {1}},
                                   {"side_ss1", {"num_side_ss1"}, {1}},
                                   {"elem_ss2", {"num_side_ss2"}, {1}},
                                   {"side_ss2", {"num_side_ss2"}, {3}}};
  const auto with_ids = [&](double inlet, double outlet) {
    std::vector<Array> arrays = sets;
    arrays.push_back({"ss_prop1", {"num_side_sets"}, {inlet, outlet}});
    return read_volume_mesh(exodus(dimensions, arrays));
  };
  const MixedMesh mesh = with_ids(1, 2);
  EXPECT_THAT(faces_of(mesh), ElementsAre("inlet 1 1", "outlet 2 1", "wall 3 2"));
  EXPECT_EQ(mesh.faces.back().kind, FaceKind::wall);
  expect_whole(mesh);
  const MixedMesh later = with_ids(2, 3);
  EXPECT_THAT(faces_of(later), ElementsAre("inlet 2 1", "outlet 3 1", "wall 1 2"));
  expect_whole(later);
}

TEST(BadMeshFiles, ExodusSideSetsOfOneIdStayTwoFaces) {
  const Dimensions dimensions = {
      {"num_side_sets", 3}, {"len_name", 7}, {"num_side_ss1", 1}, {"num_side_ss2", 1}, {"num_side_ss3", 1}};
  std::vector<Array> sets = {{"ss_prop1", {"num_side_sets"}, {2, 2, 0}},
                             {"ss_names", {"num_side_sets", "len_name"}, {}, "inlet  outlet        "}};
  for (int i = 1; i <= 3; ++i) {
    const std::string n = std::to_string(i);
    sets.push_back({"elem_ss" + n, {"num_side_ss" + n}, {1}});
    sets.push_back({"side_ss" + n, {"num_side_ss" + n}, {static_cast<double>(i)}});
  }
  const MixedMesh mesh = read_volume_mesh(exodus(dimensions, sets));
  EXPECT_THAT(faces_of(mesh), ElementsAre("inlet 2 1", "outlet 1 1", "face_3 3 1", "wall 4 1"));
  EXPECT_EQ(mesh.faces[1].kind, FaceKind::outlet);
  expect_whole(mesh);
}

TEST(BadMeshFiles, SizesThatAnExodusFileCannotHoldAreRefused) {
  EXPECT_EQ(read_volume_mesh(exodus({}, {})).tetrahedra.size(), 1U);
  refused(exodus({{"num_side_sets", 5}, {"one", 1}}, {{"ss_prop1", {"one"}, {1}}}), "differ in number");
  refused(exodus({{"num_side_sets", 2000000000}, {"one", 1}, {"len_name", 7}},
                 {{"ss_prop1", {"one"}, {1}}, {"ss_names", {"len_name"}, {}, "inlet  "}}),
          "differ in number");
  refused(exodus({{"many", 10000}}, {{"connect1", {"many", "many"}}}, NC_NETCDF4, 20000),
          "connect1 is too large");
  refused(exodus({{"seven", 7}}, {{"connect1", {"seven"}, {1, 2, 3, 4, 1, 2, 3}}}), "ends within an element");
  refused(exodus({}, {{"connect1", {"num_nod_per_el1"}, {-2147483648.0, 2, 3, 4}}}), "names point -1");
}

// ---- CGNS

/// The column of tetrahedra, changed.
fs::path cgns(const std::function<int(int file)>& change) {
  const fs::path path = place("a.cgns");
  export_mesh(column_of_tetrahedra(), MeshFormat::cgns, path);
  int file = 0;
  EXPECT_EQ(cg_open(path.c_str(), CG_MODE_MODIFY, &file), CG_OK) << cg_get_error();
  EXPECT_EQ(change(file), CG_OK) << cg_get_error();
  EXPECT_EQ(cg_close(file), CG_OK) << cg_get_error();
  return path;
}

int go_to_condition(int file, int condition) {
  return cg_goto(file, 1, "Zone_t", 1, "ZoneBC_t", 1, "BC_t", condition, "end");
}

TEST(BadMeshFiles, FacetsThatNoCgnsConditionNamesAreWall) {
  const MixedMesh whole = column_of_tetrahedra();
  const std::string count = std::to_string(std::ranges::count(whole.triangle_face_ids, 1));
  const MixedMesh mesh = read_volume_mesh(cgns([](int file) {
    // What was the wall's id is the inlet's.
    return go_to_condition(file, 2) || cg_descriptor_write("CellEntityIds", "1") ||
           cg_goto(file, 1, "Zone_t", 1, "ZoneBC_t", 1, "end") || cg_delete_node("wall");
  }));
  EXPECT_THAT(faces_of(mesh), UnorderedElementsAre("inlet_rca 1 6", "outlet_rca 7 6", "wall 2 " + count));
  EXPECT_EQ(mesh.faces.back().kind, FaceKind::wall);
  expect_whole(mesh);
}

TEST(BadMeshFiles, ACgnsConditionWithoutIdTakesNoneThatAnotherHas) {
  const MixedMesh mesh = read_volume_mesh(cgns([](int file) {
    return go_to_condition(file, 1) || cg_descriptor_write("CellEntityIds", "2") ||
           go_to_condition(file, 2) || cg_delete_node("CellEntityIds");
  }));
  ASSERT_EQ(mesh.faces.size(), 3U);
  EXPECT_EQ(mesh.faces[0].id, 2);
  EXPECT_EQ(mesh.faces[1].id, 1);
  expect_whole(mesh);
}

TEST(BadMeshFiles, CgnsLengthsInFeetAndInchesAreMillimetres) {
  const MixedMesh whole = column_of_tetrahedra();
  for (const auto& [unit, mm] : {std::pair{CGNS_ENUMV(Foot), 304.8}, {CGNS_ENUMV(Inch), 25.4}}) {
    const MixedMesh mesh = read_volume_mesh(cgns([unit = unit](int file) {
      return cg_goto(file, 1, "end") || cg_units_write(CGNS_ENUMV(Kilogram), unit, CGNS_ENUMV(Second),
                                                       CGNS_ENUMV(Kelvin), CGNS_ENUMV(Degree));
    }));
    ASSERT_EQ(mesh.points.size(), whole.points.size());
    for (std::size_t i = 0; i < mesh.points.size(); ++i)
      ASSERT_LE((mesh.points[i] - mm * whole.points[i]).norm(), 1e-9);
  }
}

TEST(BadMeshFiles, ACgnsConditionOfPointsIsRefused) {
  refused(cgns([](int file) { return go_to_condition(file, 1) || cg_delete_node("GridLocation"); }),
          "boundary condition wall is of points");
}

TEST(BadMeshFiles, ASizeThatACgnsFileCannotHoldIsRefused) {
  const fs::path path = cgns([](int file) {
    int section = 0;
    return cg_section_partial_write(file, 1, 1, "huge", CGNS_ENUMV(TETRA_4), 10001, 20010000, 0, &section);
  });
  refused(path, "section huge is not as long as its elements");
}

// ---- XDMF

fs::path xdmf(const std::string& type, const Dimensions& dimensions, const Array& geometry) {
  const fs::path folder = testing::temporary_folder("bad_meshes");
  Dimensions all = dimensions;
  all["four"] = 4;
  netcdf(folder / "mesh.h5", NC_NETCDF4, all, {geometry, {"topology", {"four"}, {0, 1, 2, 3}}});
  core::write_file(folder / "mesh.xdmf",
                   "<Xdmf Version=\"3.0\"><Topology TopologyType=\"Tetrahedron\"><DataItem Format=\"HDF\">"
                   "mesh.h5:/topology</DataItem></Topology><Geometry GeometryType=\"" +
                       type + "\"><DataItem Format=\"HDF\">mesh.h5:/geometry</DataItem></Geometry></Xdmf>");
  return folder / "mesh.xdmf";
}

TEST(BadMeshFiles, PointsThatAnXdmfFileDoesNotHoldAreRefused) {
  const Array good = {"geometry", {"twelve"}, {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}};
  EXPECT_EQ(read_volume_mesh(xdmf("XYZ", {{"twelve", 12}}, good)).points[3], geometry::Vec3(0, 0, 1));
  refused(xdmf("XY", {{"twelve", 12}}, good), "of type XY");
  Array cut = good;
  cut.dimensions = {"thirteen"};
  cut.values.push_back(5.0);
  refused(xdmf("XYZ", {{"thirteen", 13}}, cut), "no triples");
  const fs::path unwritten = xdmf("XYZ", {{"many", 30000}}, {"geometry", {"many"}});
  expect_refusal(unwritten.parent_path() / "mesh.h5", [&] { read_volume_mesh(unwritten); },
                 {"larger than its bytes"});
}

/// What the column's facets.xdmf has between `from` and `to` becomes `text`.
MixedMesh with_facets(const std::string& from, const std::string& to, const std::string& text) {
  const fs::path folder = place("column");
  export_mesh(column_of_tetrahedra(), MeshFormat::xdmf, folder);
  std::string facets = core::read_file(folder / "facets.xdmf");
  const std::size_t begin = facets.find(from), end = facets.find(to, begin);
  EXPECT_NE(end, std::string::npos) << from << to;
  core::write_file(folder / "facets.xdmf", facets.replace(begin, end + to.size() - begin, text));
  return read_volume_mesh(folder);
}

TEST(BadMeshFiles, FacetsWithoutIdsOfAnXdmfFileAreWall) {
  const std::size_t facets = column_of_tetrahedra().triangles.size();
  const MixedMesh mesh = with_facets("<Attribute", "</Attribute>", "");
  EXPECT_THAT(faces_of(mesh), ElementsAre("wall 1 " + std::to_string(facets)));
  EXPECT_EQ(mesh.faces[0].kind, FaceKind::wall);
  expect_whole(mesh);
}

TEST(BadMeshFiles, IdsThatAreNotOneAFacetOfAnXdmfFileAreRefused) {
  EXPECT_THROW(with_facets("/facets/CellEntityIds", "<", "/mesh/CellEntityIds<"), InvalidInput);
  EXPECT_THROW(with_facets("</map>", "<", "</map><map key=\"again\" dim=\"2\">1</map><"), InvalidInput);
}

/// An attribute "layer" beside the cells of the column's mesh.xdmf.
fs::path with_layer(const std::string& center, const std::string& item) {
  const fs::path folder = place("column");
  export_mesh(column_of_tetrahedra(), MeshFormat::xdmf, folder);
  std::string text = core::read_file(folder / "mesh.xdmf");
  const std::size_t end = text.find("</Grid>");
  EXPECT_NE(end, std::string::npos);
  text.insert(end, "<Attribute Name=\"layer\" AttributeType=\"Scalar\" Center=\"" + center + "\">\n" + item +
                       "\n</Attribute>\n");
  core::write_file(folder / "mesh.xdmf", text);
  return folder;
}

TEST(BadMeshFiles, LayersOfAnXdmfFileAreOneNumberACell) {
  const fs::path of_points = with_layer("Node", "<DataItem Dimensions=\"2\" Format=\"XML\">1 1</DataItem>");
  expect_whole(read_volume_mesh(of_points));
  const fs::path other =
      with_layer("Cell", "<DataItem Dimensions=\"4\" Format=\"HDF\">mesh.h5:/mesh/topology</DataItem>");
  expect_refusal(other / "mesh.xdmf", [&] { read_volume_mesh(other); },
                 {"numbers of layer for", "one a cell is needed"});
}

// ---- folders

TEST(BadMeshFiles, PlacesThatCannotBeLookedIntoAreNoMeshes) {
  const fs::path folder = place("loops");
  fs::create_directory(folder);
  fs::create_symlink("faces", folder / "faces");  // each its own target
  fs::create_symlink("mesh.xdmf", folder / "mesh.xdmf");
  EXPECT_FALSE(is_volume_mesh(folder));
  const fs::path too_long = folder / std::string(300, 'a');
  EXPECT_FALSE(is_volume_mesh(too_long));
  EXPECT_THROW(read_volume_mesh(too_long), Error);
  EXPECT_THROW(read_volume_mesh(too_long.string() + ".xdmf"), Error);
}

}  // namespace
}  // namespace ostia::io
