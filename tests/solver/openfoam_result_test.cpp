#include "ostia/solver/openfoam_result.h"

#include "solver_test_support.h"

namespace ostia::solver {
namespace {

namespace fs = std::filesystem;

fs::path field(const std::string& body, const std::string& type = "volVectorField") {
  const fs::path file = testing::temporary_folder("result") / "U";
  core::write_file(file, "/*/ head\n */ FoamFile\n{\n version 2.0; format ascii; class " + type +
                             "; // a field\n location \"0\"; object U;\n}\ndimensions [0 1 -1 0 0 0 0];\n" +
                             body);
  return file;
}

TEST(OpenfoamResult, ReadsUniformAndOtherValues) {
  const OpenfoamField read = read_openfoam_field(
      field("internalField nonuniform List<vector> 2((1 2 2)\n(-3e-1 0 4));\nboundaryField\n{\n"
            " wall { type noSlip; }\n inlet_a\n {\n type fixedValue; curve table ((0 1) (1 2));\n"
            " value nonuniform List<vector> \n1\n(\n(0 0 5)\n)\n;\n }\n"
            " outlet_a { type x; value uniform (1 0 0); }\n procBoundary0to1 { type processor; value uniform "
            "(0 0 0); }\n}\n"),
      2, {{"wall", 3}, {"inlet_a", 1}, {"outlet_a", 2}});
  EXPECT_EQ(read.components, 3u);
  EXPECT_EQ(read.cells, (std::vector<double>{1, 2, 2, -0.3, 0, 4}));
  EXPECT_EQ(read.magnitude(read.cells, 0), 3.0);
  EXPECT_EQ(read.patches.size(), 2u);
  EXPECT_EQ(read.patches.at("inlet_a"), (std::vector<double>{0, 0, 5}));
  EXPECT_EQ(read.patches.at("outlet_a"), (std::vector<double>{1, 0, 0, 1, 0, 0}));
  const OpenfoamField scalar =
      read_openfoam_field(field("internalField uniform 7;\nboundaryField\n{\n}\n", "volScalarField"), 3, {});
  EXPECT_EQ(scalar.cells, (std::vector<double>{7, 7, 7}));
}

TEST(OpenfoamResult, RefusesByFileAndLine) {
  const auto refused = [](const fs::path& file, const std::vector<std::string>& parts) {
    expect_refusal([&] { read_openfoam_field(file, 2, {{"wall", 1}}); }, parts);
  };
  refused(field("internalField nonuniform List<vector> 1((1 2 3));\n"), {"U", "line 8", "1 values", "2"});
  refused(field("internalField nonuniform List<vector> 1e300((1 2 3));\n"), {"1e+300 values"});
  refused(field("internalField uniform (nan 0 0);\n"), {"\"nan\"", "diverge"});
  refused(field("internalField uniform (0 0 0);\nboundaryField { wall { value uniform (0 0 0);"), {"ends"});
  refused(field("internalField uniform (0 0 0);\nboundaryField { wall { type {"), {"ends"});
  refused(field("internalField uniform 1", "surfaceScalarField"), {"no volScalarField"});
  const fs::path binary = testing::temporary_folder("result") / "p";
  core::write_file(binary, "FoamFile { format binary; class volScalarField; }");
  refused(binary, {"p", "writeFormat ascii"});
}

TEST(OpenfoamResult, FindsTheLastTime) {
  const fs::path folder = testing::temporary_folder("times");
  for (const char* name : {"0", "constant", "0.1", "12", "9.5e-1", "12.old"})
    fs::create_directory(folder / name);
  EXPECT_EQ(last_time(folder).filename(), "12");
  const fs::path fresh = testing::temporary_folder("fresh");
  fs::create_directory(fresh / "0");
  expect_refusal([&] { last_time(fresh); }, {"Allrun"});
}

}  // namespace
}  // namespace ostia::solver
