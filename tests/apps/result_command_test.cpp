// `ostia result` on a case whose results are made up by hand, and on what is none.

#include "duct_mesh.h"
#include "program.h"

#include "ostia/core/files.h"
#include "ostia/io/mesh_export.h"
#include "ostia/io/surface_fields.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace ostia::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

std::string field(const std::string& type, const std::string& value) {
  return "FoamFile { format ascii; class " + type + "; }\ninternalField uniform " + value +
         ";\nboundaryField { wall { type calculated; value uniform " + value + "; } }\n";
}

void write(const fs::path& file, const std::string& text) {
  fs::create_directories(file.parent_path());
  core::write_file(file, text);
}

/// A case in `flow` with results: 1 Pa on the whole wall, 0.5 ml/s in and `out_ml_s` out.
Setting with_results(double out_ml_s = 0.5) {
  const Setting in{temporary_folder("result"), ""};
  io::export_mesh(duct(), io::MeshFormat::vtu, in.folder / "mesh.vtu");
  const Outcome made = ostia({"case", "mesh.vtu", "-o", "flow", "--flow", "0.5", "--density", "1000"}, in);
  EXPECT_EQ(made.code, 0) << made.err;
  const fs::path flow = in.folder / "flow";
  write(flow / "7/U", field("volVectorField", "(0 0 0.25)"));
  write(flow / "7/pressureInPascal", field("volScalarField", "40"));
  write(flow / "7/wallShearStress", field("volVectorField", "(0 0 -1e-3)"));
  write(flow / "log.simpleFoam", "SIMPLE solution converged in 7 iterations\n");
  const auto series = [&](const std::string& name, const std::string& value) {
    write(flow / "postProcessing" / name / "0/surfaceFieldValue.dat", "# Time v\n7 " + value + "\n");
  };
  series("flow_inlet_a", "-5e-7");
  series("flow_outlet_a", std::to_string(out_ml_s) + "e-6");
  series("pressure_inlet_a", "0.0533289549660");  // 0.4 mmHg
  series("pressure_outlet_a", "0");
  return in;
}

TEST(ResultCommand, MakesAFolderOfAFinishedRunOnce) {
  const Setting in = with_results();
  const Outcome done = ostia({"result", "flow", "-o", "out"}, in);
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_THAT(done.out, HasSubstr("simpleFoam, 7 iterations, converged"));
  EXPECT_THAT(done.out, HasSubstr("inlet_a: 0.5 ml/s, 53.33 Pa (0.4 mmHg)"));
  EXPECT_THAT(done.out, HasSubstr("1 Pa in the mean"));
  EXPECT_EQ(names_in(in.folder / "out"),
            (std::vector<std::string>{"faces.csv", "manifest.json", "result.json", "result.vtu", "speed.png",
                                      "wall.vtp", "wall_shear_stress.png"}));
  const io::PointFields wall = io::read_surface_with_fields(in.folder / "out/wall.vtp").points;
  for (const double shear : wall.at("wall_shear_stress_Pa").values) EXPECT_NEAR(shear, 1.0, 1e-12);
  EXPECT_NEAR(wall.at("wall_shear_stress_vector_Pa").values[2], 1.0, 1e-12) << "with the flow";
  const Outcome again = ostia({"result", "flow", "-o", "out", "--json"}, in);
  EXPECT_EQ(again.code, 0);
  EXPECT_THAT(again.err, HasSubstr("done already"));
  EXPECT_EQ(nlohmann::json::parse(again.out)["walls"][0]["wall_shear_stress_Pa"]["mean"], 1.0);
  const Outcome other = ostia({"result", "flow", "-o", "out", "--json", "--low-shear", "2"}, in);
  EXPECT_EQ(nlohmann::json::parse(other.out)["walls"][0]["low_share"], 1.0);
}

TEST(ResultCommand, APoorRunIsDoneWithCodeFour) {
  const Setting lost = with_results(0.49);
  const Outcome done = ostia({"result", "flow", "-o", "out"}, lost);
  EXPECT_EQ(done.code, 4);
  EXPECT_THAT(done.err, HasSubstr("differ by 2 %"));
  EXPECT_TRUE(fs::exists(lost.folder / "out/result.json"));
  const Setting open = with_results();
  core::write_file(open.folder / "flow/log.simpleFoam", "Time = 7\n");
  const Outcome ended = ostia({"result", "flow", "-o", "out", "--json"}, open);
  EXPECT_EQ(ended.code, 4);
  EXPECT_THAT(ended.err, HasSubstr("residual"));
  EXPECT_FALSE(nlohmann::json::parse(ended.out)["run"]["converged"].get<bool>());
}

TEST(ResultCommand, RefusesByName) {
  const Setting in = with_results();
  const auto refused = [&](const std::vector<std::string>& arguments, const std::string& part) {
    const Outcome done = ostia(std::vector<std::string>{"result"} + arguments, in);
    EXPECT_EQ(done.code, 3) << part;
    EXPECT_THAT(done.err, HasSubstr(part));
    EXPECT_FALSE(fs::exists(in.folder / "out")) << part;
  };
  refused({"none", "-o", "out"}, "no folder none");
  refused({".", "-o", "out"}, "no case of `ostia case`");
  refused({"flow", "-o", "out", "--low-shear", "9"}, "limits of low and high");
  fs::create_directories(in.folder / "flow/processor0/9");
  refused({"flow", "-o", "out"}, "reconstructPar");
  fs::remove_all(in.folder / "flow/processor0");
  refused({"flow", "-o", "flow"}, "not an earlier result's");
  fs::remove_all(in.folder / "flow/7");
  refused({"flow", "-o", "out"}, "Allrun");
}

}  // namespace
}  // namespace ostia::testing
