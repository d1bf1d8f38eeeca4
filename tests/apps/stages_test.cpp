// One command after another on a small image.

#include "program.h"

#include "ostia/core/files.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace ostia::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using Json = nlohmann::json;

TEST(Stages, ChainFromImageToMesh) {
  const SmallCase small = small_case();
  const Setting in{small.folder, ""};
  const Outcome info =
      ostia({"info", "heart.nrrd", "--json", "--preview", "slices", "--preview-slices", "2"}, in);
  ASSERT_EQ(info.code, 0) << info.err;
  EXPECT_NEAR(Json::parse(info.out)["spacing_mm"][0].get<double>(), 0.6, 1e-9);
  EXPECT_TRUE(std::filesystem::exists(small.folder / "slices" / "planes.png"));

  ASSERT_EQ(ostia({"import", "heart.nrrd", "-o", "heart.mha"}, in).code, 0);
  ASSERT_EQ(ostia({"convert", "heart.mha", "heart.mhd"}, in).code, 0);

  const Outcome segment =
      ostia(std::vector<std::string>{"segment", "heart.mhd", "-o", "lumen.vtp", "--levelset", "levels.nrrd"} +
                small.branch_arguments,
            in);
  ASSERT_EQ(segment.code, 0) << segment.err;
  EXPECT_THAT(segment.out, ::testing::AllOf(::testing::StartsWith("lumen: "), HasSubstr(" triangles")));
  const Json surface = Json::parse(ostia({"info", "lumen.vtp", "--json"}, in).out);
  EXPECT_EQ(surface["components"], 1);
  EXPECT_EQ(surface["self_intersections"], 0);

  const auto ends =
      [&](const std::vector<std::string>& branches) {  // "--branch", "from:to", "--branch", "from:to2"
        std::vector<std::string> out{"--source", branches[1].substr(0, branches[1].find(':'))};
        for (std::size_t i = 1; i < branches.size(); i += 2)
          out.insert(out.end(), {"--target", branches[i].substr(branches[i].find(':') + 1)});
        return out;
      };
  const Outcome lines = ostia(
      std::vector<std::string>{"centerline", "lumen.vtp", "-o", "lines.vtp"} + ends(small.branch_arguments),
      in);
  ASSERT_EQ(lines.code, 0) << lines.err;
  ASSERT_EQ(ostia({"convert", "lines.vtp", "lines.csv"}, in).code, 0);
  EXPECT_THAT(core::read_file(small.folder / "lines.csv"),
              ::testing::StartsWith("vessel,x,y,z,radius,abscissa\n"));

  const Outcome mesh = ostia(
      {"mesh", "lumen.vtp", "-o", "mesh", "--centerline", "lines.vtp", "--edge-ratio", "0.8", "--json"}, in);
  ASSERT_TRUE(mesh.code == 0 || mesh.code == 4) << mesh.err;
  const Json quality = Json::parse(mesh.out);
  EXPECT_EQ(quality["volume"]["inverted"], 0);
  EXPECT_EQ(quality["surface"]["open_edges"], 0);
  EXPECT_EQ(quality["verdict"]["passed"], mesh.code == 0);

  const Outcome check = ostia({"mesh", "--check", "mesh/mesh.vtu", "--json"}, in);
  EXPECT_EQ(check.code, mesh.code) << check.err;
  EXPECT_EQ(Json::parse(check.out)["volume"]["tetrahedra"], quality["volume"]["tetrahedra"]);
  const Outcome check_surface = ostia({"mesh", "--check", "mesh/lumen.stl", "--json"}, in);
  EXPECT_EQ(Json::parse(check_surface.out)["surface"]["triangles"], quality["surface"]["triangles"]);

  // The same in other frames.
  const auto segment_in = [&](const std::string& frame, const std::vector<std::string>& branches) {
    const Outcome done = ostia(
        std::vector<std::string>{"segment", "heart.nrrd", "-o", frame + ".stl", "--coords", frame} + branches,
        in);
    EXPECT_EQ(done.code, 0) << done.err;
    return Json::parse(ostia({"info", frame + ".stl", "--json"}, in).out);
  };
  const Json ras = segment_in("ras", small.branch_arguments_ras),
             ijk = segment_in("ijk", small.branch_arguments_ijk);
  EXPECT_EQ(ras["triangles"], surface["triangles"]);
  EXPECT_EQ(ijk["triangles"], surface["triangles"]);
  EXPECT_NEAR(ras["volume_mm3"].get<double>(), surface["volume_mm3"].get<double>(), 1e-3);
  EXPECT_NEAR(ijk["volume_mm3"].get<double>(), surface["volume_mm3"].get<double>(), 1e-3);
}

TEST(Stages, SegmentTakesItsFilters) {
  const SmallCase small = small_case();
  const Setting in{small.folder, ""};
  const auto volume = [&](const std::vector<std::string>& options) {
    const Outcome done = ostia(
        std::vector<std::string>{"segment", "heart.nrrd", "-o", "s.vtp"} + options + small.branch_arguments,
        in);
    EXPECT_EQ(done.code, 0) << done.err;
    return Json::parse(ostia({"info", "s.vtp", "--json"}, in).out)["volume_mm3"].get<double>();
  };
  const double plain = volume({});
  for (const std::vector<std::string>& options :
       std::vector<std::vector<std::string>>{{"--curvature-term", "minimal"},
                                             {"--feature", "gaussian", "--sigma", "0.5"},
                                             {"--balloon", "--balloon-tau", "0.3", "--balloon-sigma", "60"},
                                             {"--denoise", "flux"},
                                             {"--denoise", "gradient", "--denoise-iterations", "2"},
                                             {"--denoise", "curvature", "--denoise-contrast", "100"},
                                             {"--remove", "bone,calcium,skin", "--smooth", "5"}}) {
    SCOPED_TRACE(options.back());
    const double filtered = volume(options);
    EXPECT_NEAR(filtered, plain, 0.25 * plain);
    EXPECT_NE(filtered, plain);
  }
  const auto refused = [&](const std::vector<std::string>& options, const std::string& name) {
    const Outcome done = ostia(
        std::vector<std::string>{"segment", "heart.nrrd", "-o", "t.vtp"} + options + small.branch_arguments,
        in);
    EXPECT_EQ(done.code, 2) << done.err;
    EXPECT_THAT(done.err, HasSubstr(name));
    EXPECT_FALSE(std::filesystem::exists(small.folder / "t.vtp"));
  };
  refused({"--curvature-term", "gauss"}, "--curvature-term");
  refused({"--denoise", "median"}, "--denoise");
  refused({"--denoise-iterations", "3"}, "--denoise");
  refused({"--balloon-mean", "350"}, "--balloon");
  refused({"--remove", "skull"}, "--remove");
}

}  // namespace
}  // namespace ostia::testing
