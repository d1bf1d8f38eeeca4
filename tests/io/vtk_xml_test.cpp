#include "io_test_support.h"

#include "ostia/io/surface_file.h"

#include <string>

namespace ostia::io {
namespace {

std::string vtp(const std::string& connectivity, const std::string& offsets, const std::string& points = "3",
                const std::string& polys = "1", const std::string& prolog = "") {
  return "<?xml version=\"1.0\"?>\n" + prolog +
         "<VTKFile type=\"PolyData\" version=\"0.1\" byte_order=\"LittleEndian\">\n<PolyData>\n<Piece "
         "NumberOfPoints=\"" +
         points + "\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"" + polys +
         "\">\n<Points><DataArray type=\"Float32\" NumberOfComponents=\"3\" format=\"ascii\">0 0 0 1 0 0 0 1 "
         "0</DataArray></Points>\n"
         "<Polys><DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">" +
         connectivity + "</DataArray>\n<DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">" +
         offsets + "</DataArray></Polys>\n</Piece>\n</PolyData>\n</VTKFile>\n";
}

void expect_refused(const std::string& content, const std::vector<std::string>& parts) {
  const auto path = file_with("a.vtp", content);
  expect_refusal(
      path, [&] { read_surface(path); }, parts);
}

TEST(VtkXml, ReadsASoundFile) {
  EXPECT_EQ(read_surface(file_with("a.vtp", vtp("0 1 2", "3"))).surface.mesh.triangles.size(), 1u);
}

TEST(VtkXml, EntitiesAreRefused) {
  const std::string bomb = "<!DOCTYPE lolz [<!ENTITY lol \"lol\"><!ENTITY lol2 \"&lol;&lol;&lol;\">]>\n";
  expect_refused(vtp("0 1 2", "3", "3", "1", bomb), {"entities"});
  expect_refused(vtp("0 1 2", "3", "3", "1", "<!DOCTYPE a [<!ENTITY x SYSTEM \"file:///etc/passwd\">]>\n"),
                 {"entities"});
}

TEST(VtkXml, ConnectivityOutOfRange) {
  expect_refused(vtp("0 1 7", "3"), {"point 7"});
  expect_refused(vtp("0 1 -5", "3"), {"point -5"});
  expect_refused(vtp("0 1 2000000000", "3"), {"point 2000000000"});
}

TEST(VtkXml, OffsetsOutOfRange) {
  expect_refused(vtp("0 1 2", "300"), {});
  expect_refused(vtp("0 1 2", "-3"), {});
}

TEST(VtkXml, CountsBeyondTheFile) {
  expect_refused(vtp("0 1 2", "3", "9000000000"), {"NumberOfPoints"});
  expect_refused(vtp("0 1 2", "3", "3", "9000000000"), {"NumberOfPolys"});
  expect_refused(vtp("0 1 2", "3", "-3"), {"NumberOfPoints"});
}

TEST(VtkXml, RefusesFilesThatEndVtksReader) {
  std::string strange = vtp("0 1 2", "3");
  strange.replace(strange.find("\"Int32\""), 7, "\"Str5ng\"");
  expect_refused(strange, {});
  const auto folder = testing::temporary_folder("io");
  write_surface(folder / "a.vtp", faced_tetrahedron());
  const std::string whole = core::read_file(folder / "a.vtp");
  const std::size_t data = whole.find("<AppendedData");
  for (std::size_t at = data + 20; at < whole.size();
       at += 29) {  // wherever it is damaged, it is read or refused
    std::string damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x55);
    const auto path = file_with("a.vtp", damaged);
    try {
      EXPECT_EQ(read_surface(path).surface.mesh.triangles.size(), 4u);
    } catch (const InvalidInput& error) {
      EXPECT_NE(std::string(error.what()).find("a.vtp"), std::string::npos);
    }
  }
}

TEST(VtkXml, RefusesOtherFiles) {
  expect_refused("hello", {"no VTK XML"});
  expect_refused("<VTKFile type=\"ImageData\"><ImageData></ImageData></VTKFile>", {"no PolyData"});
  const std::string whole = vtp("0 1 2", "3");
  for (const std::size_t part : {3u, 5u, 8u}) expect_refused(whole.substr(0, whole.size() * part / 10), {});
}

}  // namespace
}  // namespace ostia::io
