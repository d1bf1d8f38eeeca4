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

TEST(CaseCommand, ACaseGoesOnForMoreIterations) {
  const Setting in = with_mesh();
  const std::vector<std::string> words{"case", "mesh.vtu", "-o", "flow", "--flow", "0.5"};
  ASSERT_EQ(ostia(words, in).code, 0);
  std::filesystem::create_directory(in.folder / "flow/2000");  // where it ended
  const auto end_is = [&](const std::string& iterations) {
    EXPECT_THAT(core::read_file(in.folder / "flow/system/controlDict"),
                HasSubstr("endTime         " + iterations + ";"));
  };
  const Outcome more = ostia({"case", "flow", "--iterations", "3000"}, in);
  EXPECT_EQ(more.code, 0) << more.err;
  EXPECT_THAT(more.out, HasSubstr("goes on from 2000 to 3000 iterations"));
  end_is("3000");
  // The command that made it, with more.
  const Outcome again = ostia(words + std::vector<std::string>{"--iterations", "4000"}, in);
  EXPECT_EQ(again.code, 0) << again.err;
  end_is("4000");
  EXPECT_TRUE(std::filesystem::exists(in.folder / "flow/2000"));

  const Outcome less = ostia({"case", "flow", "--iterations", "1000"}, in);
  EXPECT_EQ(less.code, 3);
  EXPECT_THAT(less.err, HasSubstr("has come to 2000 iterations already"));
  const Outcome other = ostia({"case", "flow", "--iterations", "5000", "--viscosity", "4"}, in);
  EXPECT_EQ(other.code, 2);
  EXPECT_THAT(other.err, HasSubstr("--viscosity would make another case"));
  const Outcome another =
      ostia({"case", "mesh.vtu", "-o", "flow", "--flow", "0.6", "--iterations", "5000"}, in);
  EXPECT_EQ(another.code, 3);
  EXPECT_THAT(another.err, HasSubstr("another case (its 0/U is different)"));
  EXPECT_EQ(ostia({"case", "mesh.vtu"}, in).code, 2);
  end_is("4000");
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
  refused({"--compliance", "1"}, 3, "give a waveform and outlets with resistance");
  refused({"--waveform", "aorta"}, 3, "coronary-left");
  core::write_file(in.folder / "wave.csv", "t,flow_ml_s\n0,1\n1,2\n2,1\n");
  refused({"--waveform", "wave.csv"}, 3, "no column time_s");
  core::write_file(in.folder / "wave.csv", "time_s,flow_ml_s\n0,1\n1,two\n2,1\n");
  refused({"--waveform", "wave.csv"}, 3, "line 3");
}

}  // namespace
}  // namespace ostia::testing
