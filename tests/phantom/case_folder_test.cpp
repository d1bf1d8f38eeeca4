#include "ostia/phantom/case_folder.h"

#include "shared_data.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/core/parallel.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/imaging/image_file.h"
#include "ostia/io/centerline_file.h"
#include "ostia/io/contour_file.h"
#include "ostia/io/rotterdam_file.h"
#include "ostia/io/surface_file.h"

#include <gmock/gmock.h>

#include <chrono>
#include <map>
#include <thread>

namespace ostia::phantom {
namespace {
namespace fs = std::filesystem;

using ::testing::HasSubstr;
using ::testing::IsEmpty;

SuiteOptions tiny() {
  SuiteOptions options;
  options.first.preset = Preset::tiny;
  options.first.surface_spacing_mm = 1.0;
  options.first.contours.points = 16;
  options.first.scan.supersampling = 2;
  options.dicom = false;
  options.report = false;
  return options;
}

std::map<std::string, std::string> digests(const fs::path& folder) {
  std::map<std::string, std::string> out;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file())
      out[fs::relative(entry.path(), folder).string()] = core::sha256_file(entry.path());
  return out;
}

TEST(CaseFolder, IsTheSameForAnyNumberOfThreadsAndReadBackAsItWasMade) {
  const fs::path folders = testing::temporary_folder("case"), folder = folders / "two";
  const SuiteOptions options = tiny();
  core::set_max_threads(1);
  write_suite(folders / "one", options, {});
  core::set_max_threads(2);
  const SuiteRecord record = write_suite(folder, options, {});
  core::set_max_threads(0);
  EXPECT_EQ(digests(folders / "one"), digests(folder));
  ASSERT_EQ(record.cases.size(), 1u);
  const fs::path one = folder / "dataset00";
  const CasePlan plan = plan_case(options.first);

  const auto mhd = imaging::read_image(one / "image00.mhd"), nrrd = imaging::read_image(one / "image00.nrrd");
  EXPECT_TRUE(imaging::same_grid(mhd.volume.geometry, plan.options.scan.grid));
  EXPECT_TRUE(mhd.volume.voxels == nrrd.volume.voxels);
  const geometry::ContourSet contours = io::read_contours(one / "contours.json");
  EXPECT_EQ(contours.sections.size(), 5 * plan.sections.sections.size());
  ASSERT_FALSE(plan.challenge.vessels.empty());
  for (const ChallengeVessel& vessel : plan.challenge.vessels) {
    const fs::path at = one / ("vessel" + std::to_string(vessel.number));
    const io::RotterdamReference reference = io::read_rotterdam_reference(at / "reference.txt");
    ASSERT_EQ(reference.points.size(), vessel.reference.points.size());
    EXPECT_LT((reference.points[10] - vessel.reference.points[10]).norm(), 1e-4);
    EXPECT_NEAR(reference.radius[10], vessel.reference.radius[10], 1e-4);
    EXPECT_LT((io::read_rotterdam_point(at / "pointA.txt") - vessel.point_a).norm(), 1e-4);
    EXPECT_LT((io::read_rotterdam_point(at / "pointE.txt") - vessel.point_e).norm(), 1e-4);
    EXPECT_EQ(io::read_rotterdam_line(at / "observer2.txt").size(), vessel.observers[1].size());
  }
  for (const char* name : {"lumen.vtp", "wall.vtp"}) {
    const geometry::SurfaceFaults faults =
        geometry::find_faults(io::read_surface(one / name).surface.mesh, false);
    EXPECT_EQ(faults.open_edges, 0u) << name;
    EXPECT_EQ(faults.non_manifold_edges, 0u) << name;
  }
  const geometry::VesselTree tree = io::read_centerlines(one / "centerlines.vtp");
  EXPECT_EQ(tree.vessels.size(), vessel_tree(plan.tree).vessels.size());
  EXPECT_EQ(core::read_file(one / "case.json"), case_json(plan, 0, true));
  EXPECT_THAT(core::read_file(folder / "suite.json"), HasSubstr("dataset00"));
}

TEST(CaseFolder, OtherSeedsGiveOtherCases) {
  CaseOptions a, b;
  a.preset = b.preset = Preset::tiny;
  b.seed = 2;
  EXPECT_NE(case_json(plan_case(a), 0, false), case_json(plan_case(b), 0, false));
}

TEST(CaseFolder, TruthAloneHasNoImageAndAFailureLeavesNothing) {
  const fs::path folder = testing::temporary_folder("truth");
  SuiteOptions options = tiny();
  options.truth_only = true;
  bool asked = false;
  const auto finish = [&](const fs::path& made, const SuiteRecord& record) {
    asked = true;
    EXPECT_EQ(record.cases.size(), 1u);
    EXPECT_TRUE(fs::exists(made / "dataset00" / "contours.json"));
    EXPECT_TRUE(fs::exists(made / "suite.json"));
    EXPECT_FALSE(fs::exists(made / "dataset00" / "image00.mhd"));
    EXPECT_FALSE(fs::exists(made / "dataset00" / "labels.nrrd"));
    EXPECT_FALSE(fs::exists(folder / "suite")) << "not before all is there";
    throw IoError("no manifest");
  };
  EXPECT_THROW(write_suite(folder / "suite", options, finish), IoError);
  EXPECT_TRUE(asked);
  EXPECT_TRUE(fs::is_empty(folder));
}

TEST(CaseFolder, CancelledItLeavesNothing) {
  const fs::path folder = testing::temporary_folder("cancelled");
  const core::TaskContext before;
  before.cancel();
  EXPECT_THROW(write_suite(folder / "suite", tiny(), {}, before), Cancelled);
  EXPECT_TRUE(fs::is_empty(folder));
  const core::TaskContext during;
  std::thread user([&] {
    while (during.progress() < 0.1) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    during.cancel();
  });
  EXPECT_THROW(write_suite(folder / "suite", tiny(), {}, during), Cancelled);
  user.join();
  EXPECT_TRUE(fs::is_empty(folder));
}

TEST(CaseFolder, BadOptionsAreRefused) {
  const fs::path folder = testing::temporary_folder("bad") / "suite";
  const auto refused = [&](const std::function<void(SuiteOptions&)>& spoil) {
    SuiteOptions options = tiny();
    spoil(options);
    EXPECT_THROW(write_suite(folder, options, {}), InvalidInput);
    EXPECT_FALSE(fs::exists(folder));
  };
  refused([](SuiteOptions& o) { o.cases = 0; });
  refused([](SuiteOptions& o) { o.cases = 101; });
  refused([](SuiteOptions& o) { o.mhd = o.nrrd = o.dicom = false; });
  refused([](SuiteOptions& o) { o.first.disease = -1.0; });
  refused([](SuiteOptions& o) { o.first.scan.noise_hu = -5.0; });
  refused([](SuiteOptions& o) { o.first.surface_spacing_mm = 0.0; });
  refused([](SuiteOptions& o) { o.first.contours.points = 2; });
}

}  // namespace
}  // namespace ostia::phantom
