// `ostia motion`: from phases to a surface that beats, and what is done with it.

#include "beating_tree.h"
#include "program.h"

#include "ostia/core/files.h"
#include "ostia/geometry/aabb_tree.h"
#include "ostia/imaging/image_file.h"
#include "ostia/io/cage_motion_file.h"
#include "ostia/io/centerline_file.h"
#include "ostia/io/surface_file.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <csignal>
#include <set>

namespace ostia::testing {
namespace {

namespace fs = std::filesystem;
using geometry::TriMesh;
using geometry::Vec3;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::json;
using motion::testing::amount_at;
using motion::testing::still_tree;

constexpr int phases = 8;

/// A folder `phases` with a surface a phase.
fs::path folder_of_phases() {
  const fs::path folder = temporary_folder("motion");
  fs::create_directory(folder / "phases");
  for (const auto& one : motion::testing::beating_tree(phases)) {
    // 12.5 % and its like: names may have decimals.
    const std::string percent = std::to_string(100.0 * one.phase);
    io::write_surface(folder / "phases" / ("tree_" + percent.substr(0, percent.find('.') + 2) + ".vtp"),
                      one.surface);
  }
  return folder;
}

const std::vector<std::string> coarse{"--depth", "3", "--json"};

/// Fitted once; nobody changes it.
const fs::path& fitted_folder() {
  static const fs::path folder = [] {
    const fs::path made = folder_of_phases();
    const Outcome done =
        ostia(std::vector<std::string>{"motion", "fit", "phases", "-o", "beating"} + coarse, {made, ""});
    EXPECT_EQ(done.code, 0) << done.err;
    return made;
  }();
  return folder;
}

std::string refusal(const std::vector<std::string>& arguments, const fs::path& folder, int code = 3) {
  const Outcome done = ostia(arguments, {folder, ""});
  EXPECT_EQ(done.code, code) << done.err;
  EXPECT_EQ(std::count(done.err.begin(), done.err.end(), '\n'), 1) << done.err;
  return done.err;
}

class EveryMotionCommand : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(MotionCommand, EveryMotionCommand,
                         ::testing::Values("fit", "apply", "evaluate", "export"));

TEST_P(EveryMotionCommand, ExplainsItselfWithAnExample) {
  const Outcome done = ostia({"motion", GetParam(), "--help"});
  EXPECT_EQ(done.code, 0);
  EXPECT_THAT(done.out, HasSubstr("Example:\n  ostia motion " + std::string(GetParam()) + " "));
  EXPECT_EQ(ostia({"motion", GetParam(), "--no-such-option"}).code, 2);
}

TEST(MotionCommand, FitMakesAWholeFolder) {
  const fs::path folder = fitted_folder() / "beating";
  EXPECT_THAT(names_in(folder), ::testing::ElementsAre("manifest.json", "motion.json", "report.csv",
                                                       "report.json", "template.vtp"));
  const io::CageMotionFile file = io::read_cage_motion(folder / "motion.json");
  EXPECT_EQ(file.surface, "template.vtp");
  EXPECT_EQ(file.motion.phases.size(), phases);
  EXPECT_EQ(file.motion.grid.cells, 8);
  EXPECT_EQ(file.motion.template_phase, 0.75);
  const Json report = Json::parse(core::read_file(folder / "report.json"));
  EXPECT_EQ(report["fitted"], phases - 1);
  EXPECT_EQ(report["new_self_intersections"], 0);
  EXPECT_GT(report["least_jacobian"], 0.0);
  EXPECT_EQ(report["phases"].size(), phases);
  EXPECT_EQ(report["phases"][1]["percent"], 12.5);
  EXPECT_EQ(report["phases"][6]["origin"], "at_rest");
  const std::string table = core::read_file(folder / "report.csv");
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), phases + 1);
  const Json manifest = Json::parse(core::read_file(folder / "manifest.json"));
  EXPECT_EQ(manifest["command"], "motion fit");
  EXPECT_EQ(manifest["inputs"].size(), phases);
  EXPECT_EQ(manifest["parameters"]["depth"], 3);
  EXPECT_THAT(core::read_file(folder / "manifest.json"), Not(HasSubstr("tree_")));
}

TEST(MotionCommand, FitIsDoneOnce) {
  const Outcome again = ostia(std::vector<std::string>{"motion", "fit", "phases", "-o", "beating"} + coarse,
                              {fitted_folder(), ""});
  EXPECT_EQ(again.code, 0);
  EXPECT_THAT(again.err, HasSubstr("nothing to do"));
  EXPECT_EQ(Json::parse(again.out)["fitted"], phases - 1);
}

TEST(MotionCommand, AppliesToSurfacesAndLinesAtAnyTime) {
  const fs::path folder = fitted_folder(), out = temporary_folder("applied");
  const auto apply = [&](const fs::path& input, const fs::path& output, const std::string& phase) {
    return ostia({"motion", "apply", "beating", input.string(), "-o", output.string(), "--phase", phase},
                 {folder, ""});
  };
  const fs::path shape = folder / "beating" / "template.vtp";
  for (const double percent : {30.0, 130.0}) {
    const Outcome done = apply(shape, out / "at.vtp", std::to_string(percent));
    ASSERT_EQ(done.code, 0) << done.err;
    const TriMesh carried = io::read_surface(out / "at.vtp").surface.mesh;
    EXPECT_EQ(carried.triangles, still_tree().triangles);
    EXPECT_LE(motion::testing::vertex_error(still_tree(), carried, amount_at(0.3)).mean, 0.35);
  }
  core::write_file(out / "line.csv", "x,y,z,radius\n20,10,20,1\n20,10,25,1\n20,10,30,1\n");
  ASSERT_EQ(apply(out / "line.csv", out / "moved.csv", "25").code, 0);
  const geometry::VesselTree tree = io::read_centerlines(out / "moved.csv");
  const auto& axis = tree.segments.front().axis;
  ASSERT_EQ(axis.size(), 3U);
  EXPECT_LE((axis.points[2] - motion::testing::beat(Vec3(20, 10, 30), amount_at(0.25))).norm(), 1.0);
  EXPECT_NEAR(axis.abscissa[1], (axis.points[1] - axis.points[0]).norm(), 1e-9);
}

TEST(MotionCommand, EvaluatesWithPhasesLeftOut) {
  const Outcome done = ostia({"motion", "evaluate", "beating", "phases", "--every", "2", "--json",
                              "--resolution", "0.5", "--sample", "0.5", "--require", "msd_mm<=0.3"},
                             {fitted_folder(), ""});
  ASSERT_EQ(done.code, 0) << done.err;
  const Json result = Json::parse(done.out);
  EXPECT_EQ(result["used_phases"], 4);
  EXPECT_EQ(result["kept"]["phases"], 4);
  EXPECT_EQ(result["left_out"]["phases"], 4);
  EXPECT_LE(result["kept"]["msd_mm"], 0.1);
  EXPECT_LE(result["left_out"]["msd_mm"], 0.3);
  EXPECT_GT(result["left_out"]["msd_mm"], result["kept"]["msd_mm"]);
  EXPECT_FALSE(result["phases"][1]["kept"].get<bool>());
  const Outcome kept = ostia({"motion", "evaluate", "beating", "phases", "--keep", "0,25,50,75", "--json",
                              "--resolution", "0.5", "--sample", "0.5", "--require", "msd_mm<=0.0001"},
                             {fitted_folder(), ""});
  EXPECT_EQ(kept.code, 4);
  EXPECT_EQ(Json::parse(kept.out)["msd_mm"], result["msd_mm"]);
}

TEST(MotionCommand, ExportsTimes) {
  const fs::path folder = fitted_folder(), out = temporary_folder("exported");
  const std::vector<std::string> command{
      "motion", "export",   "beating",      "-o",    (out / "moving").string(), "--times", "5", "--rr",
      "0.75",   "--format", "vtp,csv,json", "--json"};
  const Outcome done = ostia(command, {folder, ""});
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_THAT(names_in(out / "moving"),
              AllOf(Contains("surface_004.vtp"), Contains("surface.pvd"), Contains("displacement_000.csv"),
                    Contains("points.json"), Contains("times.csv"), Contains("export.json"),
                    Contains("manifest.json")));
  const Json result = Json::parse(done.out);
  EXPECT_EQ(result["times"].size(), 5U);
  EXPECT_NEAR(result["times"][1]["seconds"].get<double>(), 0.15, 1e-12);
  const TriMesh at = io::read_surface(out / "moving" / "surface_002.vtp").surface.mesh;
  EXPECT_LE(motion::testing::vertex_error(still_tree(), at, amount_at(0.4)).mean, 0.35);
  // Moving points as `evaluate motion` takes them.
  const Outcome same =
      ostia({"evaluate", "motion", "points.json", "points.json", "--json"}, {out / "moving", ""});
  EXPECT_EQ(Json::parse(same.out)["max_mm"], 0.0);
  EXPECT_THAT(ostia(command, {folder, ""}).err, HasSubstr("nothing to do"));
}

/// That of the masks below at 75 %, half axes 6, 5 and 4 mm about (10, 10, 11.5): distance from it, mm, RMS,
/// to first order.
void expect_ellipsoid(const TriMesh& mesh, double within) {
  double squares = 0.0;
  for (const Vec3& point : mesh.points) {
    const Vec3 p = point - Vec3(10.0, 10.0, 11.5), half(6.0, 5.0, 4.0);
    const double k = p.cwiseQuotient(half).norm();
    const double slope = p.cwiseQuotient(half.cwiseProduct(half)).norm() / k;
    squares += std::pow((k - 1.0) / slope, 2) / static_cast<double>(mesh.points.size());
  }
  EXPECT_LT(std::sqrt(squares), within);
}

TEST(MotionCommand, TakesMasksAndFoldersOfASuiteCase) {
  const fs::path folder = temporary_folder("inputs");
  fs::create_directories(folder / "masks");
  for (int k = 0; k < 4; ++k) {
    imaging::MaskVolume mask;
    mask.geometry.size = {40, 40, 40};
    mask.geometry.spacing = Vec3::Constant(0.5 + 0.1 * (k % 2));  // other grids
    mask.voxels.assign(40 * 40 * 40, 0);
    const Vec3 centre(10.0, 10.0, 10.0 + 0.5 * k);
    for (int z = 0; z < 40; ++z)
      for (int y = 0; y < 40; ++y)
        for (int x = 0; x < 40; ++x) {
          const Vec3 p = mask.geometry.spacing.x() * Vec3(x, y, z) - centre;
          if (Vec3(p.x() / 6.0, p.y() / 5.0, p.z() / 4.0).norm() < 1.0)
            mask.voxels[static_cast<std::size_t>(x + 40 * (y + 40 * z))] = 1;
        }
    if (k == 1) mask.voxels.assign(mask.voxels.size(), 0);  // no vessel
    imaging::write_image(folder / "masks" / ("m" + std::to_string(25 * k) + ".nrrd"), mask);
  }
  const Outcome masks =
      ostia({"motion", "fit", "masks", "-o", "from-masks", "--depth", "2", "--json"}, {folder, ""});
  EXPECT_EQ(masks.code, 4) << masks.err;
  EXPECT_THAT(masks.err, AllOf(HasSubstr("phase 25 %"), HasSubstr("no vessel"), HasSubstr("bridged")));
  EXPECT_EQ(Json::parse(masks.out)["bridged"], 1);
  const Outcome smooth =
      ostia({"motion", "fit", "masks", "-o", "smooth", "--depth", "2", "--surface", "poisson", "--json"},
            {folder, ""});
  EXPECT_EQ(smooth.code, 4) << smooth.err;
  EXPECT_EQ(Json::parse(smooth.out)["bridged"], 1);
  expect_ellipsoid(io::read_surface(folder / "from-masks" / "template.vtp").surface.mesh, 0.12);
  expect_ellipsoid(io::read_surface(folder / "smooth" / "template.vtp").surface.mesh,
                   0.08);  // without stairs
  for (const auto& one : motion::testing::beating_tree(3)) {
    const fs::path phase = folder / "case" / ("phase-" + std::to_string(static_cast<int>(100.0 * one.phase)));
    fs::create_directories(phase);
    io::write_surface(phase / "lumen.vtp", one.surface);
  }
  core::write_file(folder / "case" / "heartbeat.json",
                   R"({"phases": [{"folder": "phase-33", "percent": 33.5}]})");
  const Outcome suite =
      ostia({"motion", "fit", "case", "-o", "from-case", "--depth", "2", "--json"}, {folder, ""});
  EXPECT_EQ(suite.code, 0) << suite.err;
  EXPECT_EQ(Json::parse(suite.out)["phases"][1]["percent"], 33.5);
  EXPECT_THAT(suite.err, HasSubstr("there is no phase 75 %: 66 % is the template"));
  const Outcome none = ostia({"motion", "fit", "case", "-o", "no", "--surface", "poisson"}, {folder, ""});
  EXPECT_EQ(none.code, 2);
  EXPECT_THAT(none.err, AllOf(HasSubstr("--surface poisson"), HasSubstr("no mask")));
  const Outcome carried = ostia({"motion", "fit", "case", "-o", "no", "--by", "b-splines"}, {folder, ""});
  EXPECT_EQ(carried.code, 2);
  EXPECT_THAT(carried.err, AllOf(HasSubstr("--by"), HasSubstr("no template")));
}

TEST(MotionCommand, FramesAreCountedWhereThatIsSaid) {
  const fs::path folder = temporary_folder("frames");
  fs::create_directory(folder / "cine");
  const auto tree = motion::testing::beating_tree(4);
  for (std::size_t k = 0; k < tree.size(); ++k)
    io::write_surface(folder / "cine" / ("frame_00" + std::to_string(k) + ".stl"), tree[k].surface);
  EXPECT_THAT(refusal({"motion", "fit", "cine", "-o", "out"}, folder),
              AllOf(HasSubstr("frame_000.stl"), HasSubstr("--frames 4")));
  const Outcome done =
      ostia({"motion", "fit", "cine", "-o", "out", "--frames", "4", "--depth", "2", "--json"}, {folder, ""});
  EXPECT_EQ(done.code, 0) << done.err;
  EXPECT_EQ(Json::parse(done.out)["phases"][1]["percent"], 25.0);
}

TEST(MotionCommand, PhasesThatDoNotFitAreRefusedInOneMessage) {
  const fs::path folder = temporary_folder("bad");
  const auto tree = motion::testing::beating_tree(4);
  const auto fill = [&](const std::string& name, const std::function<TriMesh(std::size_t)>& surface) {
    fs::create_directory(folder / name);
    for (std::size_t k = 0; k < tree.size(); ++k)
      if (const TriMesh mesh = surface(k); !mesh.triangles.empty())
        io::write_surface(folder / name / ("p" + std::to_string(25 * k) + ".stl"), mesh);
    return refusal({"motion", "fit", name, "-o", "out", "--depth", "2"}, folder);
  };
  const auto scaled = [&](std::size_t k, double factor, double shift) {
    TriMesh mesh = tree[k].surface;
    for (Vec3& p : mesh.points) p = factor * p + Vec3(shift, 0, 0);
    return mesh;
  };
  EXPECT_THAT(fill("one", [&](std::size_t k) { return k == 0 ? tree[k].surface : TriMesh(); }),
              HasSubstr("three phases"));
  EXPECT_THAT(fill("metres", [&](std::size_t k) { return scaled(k, 0.001, 0.0); }), HasSubstr("--units"));
  EXPECT_THAT(fill("mixed", [&](std::size_t k) { return scaled(k, k == 1 ? 0.1 : 1.0, 0.0); }),
              AllOf(HasSubstr("p25.stl"), HasSubstr("different units")));
  EXPECT_THAT(fill("far", [&](std::size_t k) { return scaled(k, 1.0, k == 2 ? 900.0 : 0.0); }),
              AllOf(HasSubstr("p50.stl"), HasSubstr("another patient")));
  fs::create_directory(folder / "twice");
  for (const char* name : {"a_10.stl", "b_010.stl", "c_30.stl", "d_60.stl"})
    io::write_surface(folder / "twice" / name, tree[0].surface);
  EXPECT_THAT(refusal({"motion", "fit", "twice", "-o", "out"}, folder),
              AllOf(HasSubstr("a_10.stl"), HasSubstr("b_010.stl"), HasSubstr("both phase 10 %")));
  fs::create_directory(folder / "nothing");
  EXPECT_THAT(refusal({"motion", "fit", "nothing", "-o", "out"}, folder), HasSubstr("holds no phases"));
  EXPECT_THAT(refusal({"motion", "fit", "one/p0.stl", "-o", "out"}, folder), HasSubstr("is no folder"));
  core::write_file(folder / "twice" / "e_80.stl", "solid broken");
  fs::remove(folder / "twice" / "b_010.stl");
  EXPECT_THAT(refusal({"motion", "fit", "twice", "-o", "out"}, folder), HasSubstr("e_80.stl"));
  EXPECT_FALSE(fs::exists(folder / "out"));
}

TEST(MotionCommand, RefusesWhatIsNoMotion) {
  const fs::path folder = temporary_folder("bad");
  const std::string motion = (fitted_folder() / "beating").string();
  io::write_surface(folder / "a.vtp", still_tree());
  core::write_file(folder / "motion.json", "{\"v\": 1, \"kind\": \"cage-motion\", \"unit\": \"m\"}");
  EXPECT_THAT(refusal({"motion", "apply", "motion.json", "a.vtp", "-o", "b.vtp", "--phase", "0"}, folder),
              AllOf(HasSubstr("motion.json"), HasSubstr("unit is not mm")));
  EXPECT_THAT(refusal({"motion", "apply", "missing.json", "a.vtp", "-o", "b.vtp", "--phase", "0"}, folder),
              HasSubstr("missing.json"));
  TriMesh far = still_tree();
  for (Vec3& p : far.points) p.y() += 300.0;
  io::write_surface(folder / "far.vtp", far);
  EXPECT_THAT(refusal({"motion", "apply", motion, "far.vtp", "-o", "b.vtp", "--phase", "0"}, folder),
              AllOf(HasSubstr("far.vtp"), HasSubstr("100.0 % of its points lie outside")));
  EXPECT_EQ(ostia({"motion", "apply", motion, "a.vtp", "-o", "b.txt", "--phase", "0"}, {folder, ""}).code, 2);
  EXPECT_EQ(ostia({"motion", "apply", motion, "a.vtp", "-o", "b.vtp"}, {folder, ""}).code, 2);
  EXPECT_EQ(ostia({"motion", "export", motion, "-o", "out", "--format", "vtu"}, {folder, ""}).code, 2);
  EXPECT_EQ(ostia({"motion", "fit", folder.string(), "-o", "out", "--weights", "1,2"}, {folder, ""}).code, 2);
  EXPECT_THAT(
      refusal({"motion", "evaluate", motion, (fitted_folder() / "phases").string(), "--keep", "0,10,50"},
              folder),
      HasSubstr("no phase 10 %"));
  EXPECT_THAT(
      refusal({"motion", "evaluate", motion, (fitted_folder() / "phases").string(), "--every", "4"}, folder),
      HasSubstr("three phases"));
}

TEST(MotionCommand, LeavesNothingWhenInterrupted) {
  const fs::path folder = temporary_folder("stop");
  double seconds = 0.0;
  const Outcome done =
      interrupted({"motion", "fit", (fitted_folder() / "phases").string(), "-o", "out", "--depth", "5"},
                  {folder, ""}, SIGINT, 1.0, seconds);
  EXPECT_EQ(done.code, 130) << done.err;
  EXPECT_THAT(names_in(folder), ::testing::IsEmpty());
}

TEST(MotionExperimentCommand, DoesTheReportAgainWhereMoreIsKept) {
  const fs::path folder = temporary_folder("motion-experiment");
  const auto run = [&](const std::string& out, const std::string& depths) {
    return ostia(
        {"experiment", "motion", "-o", out, "--keep", "runs", "--hearts", "1", "--phases", "4", "--depths",
         depths, "--depth", "1", "--methods", "none", "--compared-phases", "25", "--json"},
        {folder, ""});
  };
  const auto depths_of = [](const Outcome& done) {
    EXPECT_EQ(done.code, 0) << done.err;
    std::set<int> depths;
    const Json all = Json::parse(done.out);
    for (const Json& row : all["rows"]) depths.insert(row["depth"].get<int>());
    depths.erase(0);
    return depths;
  };
  EXPECT_EQ(depths_of(run("first", "1")), (std::set<int>{1}));
  const Outcome same = run("first", "1");
  EXPECT_EQ(depths_of(same), (std::set<int>{1}));
  EXPECT_NE(same.err.find("nothing to do"), std::string::npos) << same.err;
  EXPECT_EQ(depths_of(run("second", "1,2")), (std::set<int>{1, 2}));
  const Outcome again = run("first", "1");
  EXPECT_EQ(depths_of(again), (std::set<int>{1, 2})) << "of all that is kept";
  EXPECT_EQ(again.err.find("nothing to do"), std::string::npos) << again.err;
}

}  // namespace
}  // namespace ostia::testing
