#include "duct_mesh.h"
#include "program.h"

#include "ostia/core/files.h"
#include "ostia/io/mesh_export.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace ostia::testing {
namespace {

using ::testing::HasSubstr;

Setting with_mesh() {
  const Setting in{temporary_folder("case"), ""};
  io::export_mesh(duct(), io::MeshFormat::vtu, in.folder / "mesh.vtu");
  return in;
}

TEST(CaseCommand, WritesASteadyCaseOnce) {
  const Setting in = with_mesh();
  const Outcome done = ostia({"case", "mesh.vtu", "-o", "flow", "--flow", "inlet_a=0.5"}, in);
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_THAT(done.out, HasSubstr("inlet_a: 3.39 mm wide, 0.5 ml/s"));  // the circle of 9 mm2
  EXPECT_THAT(core::read_file(in.folder / "flow/system/controlDict"), HasSubstr("simpleFoam"));
  EXPECT_THAT(core::read_file(in.folder / "flow/0/U"), HasSubstr("fixedValue"));
  const Outcome again = ostia({"case", "mesh.vtu", "-o", "flow"}, in);
  EXPECT_EQ(again.code, 3);
  EXPECT_THAT(again.err, HasSubstr("holds something already"));
}

TEST(CaseCommand, TakesAWaveformFromATable) {
  const Setting in = with_mesh();
  // The last sample repeats the first: the period is 1 s.
  core::write_file(in.folder / "wave.csv", "time_s,flow_ml_s\n0,0.5\n0.25,1.5\n0.75,0.4\n1,0.5\n");
  const Outcome done =
      ostia({"case", "mesh.vtu", "-o", "flow", "--waveform", "wave.csv", "--cycles", "2"}, in);
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_THAT(core::read_file(in.folder / "flow/system/controlDict"), HasSubstr("endTime         2;"));
  // Trapezia: (0.25 x 2 + 0.5 x 1.9 + 0.25 x 0.9) / 2 ml/s.
  EXPECT_THAT(done.out, HasSubstr("0.8375 ml/s in the mean"));
  EXPECT_TRUE(std::filesystem::exists(in.folder / "flow/constant/boundaryData/inlet_a/1.99/U"));
}

TEST(CaseCommand, WritesInputOfSvmultiphysics) {
  const Setting in = with_mesh();
  const Outcome done = ostia({"case", "mesh.vtu", "-o", "sv", "--solver", "svmultiphysics", "--outlets",
                              "resistance", "--compliance", "0.01"},
                             in);
  ASSERT_EQ(done.code, 0) << done.err;
  const auto read = nlohmann::json::parse(core::read_file(in.folder / "sv/boundary_conditions.json"));
  EXPECT_EQ(read["boundary_conditions"][1]["bc_type"], "RCR");
  EXPECT_TRUE(std::filesystem::exists(in.folder / "sv/mesh-complete/mesh-surfaces/outlet_a.vtp"));
}

TEST(CaseCommand, RefusesByName) {
  const Setting in = with_mesh();
  const auto refused = [&](const std::vector<std::string>& more, int code, const std::string& part) {
    const Outcome done = ostia(std::vector<std::string>{"case", "mesh.vtu", "-o", "flow"} + more, in);
    EXPECT_EQ(done.code, code) << part;
    EXPECT_THAT(done.err, HasSubstr(part));
    EXPECT_FALSE(std::filesystem::exists(in.folder / "flow")) << part;
  };
  refused({"--flow", "inlet_moon=1"}, 3, "mesh.vtu: there is no inlet \"inlet_moon\"");
  refused({"--flow", "much"}, 3, "--flow: \"much\" is no number");
  refused({"--viscosity", "0.0035"}, 3, "viscosity_mpa_s");
  refused({"--compliance", "1"}, 2, "svmultiphysics");
  refused({"--waveform", "aorta"}, 3, "coronary-left");
  core::write_file(in.folder / "wave.csv", "t,flow_ml_s\n0,1\n1,2\n2,1\n");
  refused({"--waveform", "wave.csv"}, 3, "no column time_s");
  core::write_file(in.folder / "wave.csv", "time_s,flow_ml_s\n0,1\n1,two\n2,1\n");
  refused({"--waveform", "wave.csv"}, 3, "line 3");
}

}  // namespace
}  // namespace ostia::testing
