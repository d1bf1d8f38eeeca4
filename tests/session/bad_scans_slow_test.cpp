// Scans that are hard to read: no grade from what cannot be judged, and every missing artery named.

#include "kept_scan.h"
#include "shared_data.h"

#include "ostia/core/error.h"
#include "ostia/imaging/image_file.h"
#include "ostia/phantom/moving_case.h"
#include "ostia/session/case_report.h"
#include "ostia/session/found_model.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <functional>
#include <optional>
#include <set>
#include <string>

namespace ostia::session {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr double same_lesion_mm = 8.0, counts_percent = 25.0;

/// The report of what the program finds by itself; nothing where it refuses the scan.
std::optional<CaseReport> report_of_scan(const imaging::ImageVolume& image) {
  try {
    const FoundModel found = found_model(image);
    ReportOptions options;
    options.certainty = found.found.certainty;
    return make_case_report(found.model, solved_surfaces(found.model), {}, {}, &image, options);
  } catch (const GeometryError& refusal) {
    EXPECT_FALSE(std::string(refusal.what()).empty());
    return std::nullopt;
  }
}

struct BadScan {
  const char* name;
  std::function<void(phantom::CaseOptions&)> spoil;
};

class BadScans : public ::testing::TestWithParam<BadScan> {};

bool is_true_lesion(const phantom::CoronaryTree& tree, const ReportStenosis& one,
                    const geometry::Vec3& throat) {
  for (const phantom::CoronaryVessel& vessel : tree.vessels)
    for (const phantom::Stenosis& lesion : vessel.stenoses) {
      const auto i = static_cast<std::size_t>(std::lround(lesion.s_throat_mm / vessel.axis.abscissa.back() *
                                                          static_cast<double>(vessel.axis.size() - 1)));
      if ((vessel.axis.points[i] - throat).norm() < same_lesion_mm) return true;
    }
  ADD_FAILURE() << one.vessel_name << ": " << one.stenosis.diameter_percent << " % at "
                << one.stenosis.throat_mm << " mm is no lesion of the patient's";
  return false;
}

/// Grades true lesions alone, and names missing arteries, on page 1 too.
void expect_nothing_untrue(const CaseReport& report, const phantom::CoronaryTree& tree) {
  std::set<std::string> names;
  for (const ReportVessel& vessel : report.vessels) names.insert(vessel.name);
  std::string missing;
  for (const std::string& one : report.not_found) missing += one + "\n";
  for (const char* artery : {"LAD", "LCX", "RCA"})
    if (!names.count(artery)) {
      EXPECT_THAT(missing, HasSubstr(artery));
    }
  const std::string document = report_html(report, {}),
                    page_1 = document.substr(0, document.find("Stenoses</h2>"));
  ASSERT_LT(page_1.size(), document.size());
  for (const std::string& one : report.not_found)
    EXPECT_THAT(page_1, HasSubstr(one.substr(0, one.find(": not found")) + ": not found"));
  for (const ReportStenosis& one : report.stenoses) {
    if (!one.graded || one.stenosis.diameter_percent < counts_percent) continue;
    const analysis::LumenProfile& profile = report.profiles.at(one.stenosis.vessel);
    EXPECT_TRUE(is_true_lesion(tree, one, analysis::at(profile, one.stenosis.throat_mm).centroid));
  }
  if (!report.not_found.empty()) {
    EXPECT_TRUE(report.category.not_diagnostic);
  }
}

TEST_P(BadScans, GradeTrueLesionsAloneAndNameWhatIsMissing) {
  phantom::CaseOptions patient;
  patient.preset = phantom::Preset::small;
  GetParam().spoil(patient);
  const phantom::CasePlan plan = phantom::plan_case(patient);
  const imaging::ImageVolume image = ostia::testing::kept_scan(plan).image;
  const auto report = report_of_scan(image);
  if (!report) return;  // nothing is graded
  expect_nothing_untrue(*report, plan.tree);
}

INSTANTIATE_TEST_SUITE_P(
    , BadScans,
    ::testing::Values(BadScan{"AsItIs", [](phantom::CaseOptions&) {}},
                      BadScan{"Noise", [](phantom::CaseOptions& o) { o.scan.noise_hu = 60.0; }},
                      BadScan{"MuchNoise", [](phantom::CaseOptions& o) { o.scan.noise_hu = 120.0; }},
                      BadScan{"Moved", [](phantom::CaseOptions& o) { o.scan.motion_mm = 3.0; }},
                      BadScan{"MuchMoved", [](phantom::CaseOptions& o) { o.scan.motion_mm = 6.0; }},
                      BadScan{"Coarse",
                              [](phantom::CaseOptions& o) {
                                o.scan.psf_fwhm_mm = 2.0;
                                o.scan.psf_fwhm_z_mm = 3.0;
                              }},
                      BadScan{"HardlyContrast",
                              [](phantom::CaseOptions& o) {
                                o.variant.contrast_hu = 150.0;
                                o.scan.noise_hu = 40.0;
                              }},
                      BadScan{"Steps", [](phantom::CaseOptions& o) { o.scan.stair_step_mm = 5.0; }},
                      BadScan{"MuchCalcium", [](phantom::CaseOptions& o) { o.variant.calcium = 10.0; }},
                      BadScan{"ClosedOstium",
                              [](phantom::CaseOptions& o) {
                                o.variant.anatomy = phantom::Anatomy::right_ostium_closed;
                              }}),
    [](const auto& test) { return std::string(test.param.name); });

/// Slabs of a scan: voxels [from, to) of each axis, as shares of its size.
imaging::ImageVolume part_of(const imaging::ImageVolume& image, const geometry::Vec3& from,
                             const geometry::Vec3& to) {
  imaging::Region region;
  for (int axis = 0; axis < 3; ++axis) {
    const auto all = static_cast<double>(image.geometry.size[axis]);
    region.lower[axis] = std::lround(from[axis] * all);
    region.upper[axis] = std::lround(to[axis] * all);
  }
  return imaging::cropped(image, region);
}

struct CutScan {
  const char* name;
  geometry::Vec3 from, to;
  bool has_root;  ///< the aorta's root lies in it
};

class CutScans : public ::testing::TestWithParam<CutScan> {};

TEST_P(CutScans, AreRefusedOrNameWhatTheyDoNotShow) {
  phantom::CaseOptions patient;
  patient.preset = phantom::Preset::small;
  const phantom::CasePlan plan = phantom::plan_case(patient);
  const imaging::ImageVolume image =
      part_of(ostia::testing::kept_scan(plan).image, GetParam().from, GetParam().to);
  const auto report = report_of_scan(image);
  if (!report) return;  // nothing is graded
  expect_nothing_untrue(*report, plan.tree);
  EXPECT_TRUE(GetParam().has_root || report->category.not_diagnostic);
  for (const ReportStenosis& one : report->stenoses) {
    EXPECT_TRUE(GetParam().has_root || !one.graded) << one.vessel_name;
  }
}

INSTANTIATE_TEST_SUITE_P(, CutScans,
                         ::testing::Values(CutScan{"UpperHalf", {0.0, 0.0, 0.5}, {1.0, 1.0, 1.0}, true},
                                           CutScan{"LeftHalf", {0.5, 0.0, 0.0}, {1.0, 1.0, 1.0}, true},
                                           CutScan{"RightHalf", {0.0, 0.0, 0.0}, {0.5, 1.0, 1.0}, true},
                                           CutScan{"RootOutside", {0.0, 0.0, 0.0}, {1.0, 1.0, 0.5}, false}),
                         [](const auto& test) { return std::string(test.param.name); });

/// In the middle of systole, and blurred by the heart's own motion meanwhile.
TEST(BadScansMoving, TheWrongPhaseIsGradedWhereItIsTrueAlone) {
  phantom::CaseOptions patient;
  patient.preset = phantom::Preset::small;
  patient.scan.motion_mm = 4.0;
  const phantom::CasePlan plan = phantom::plan_case(patient);
  const phantom::BeatPhase systole = phantom::heartbeat_of(plan).phase(20.0);
  const phantom::Body body(plan.heart, plan.tree, phantom::body_of(plan.options));
  phantom::CoronaryTree moved = plan.tree;
  for (phantom::CoronaryVessel& vessel : moved.vessels)
    for (geometry::Vec3& place : vessel.axis.points) place = systole.at(place);
  const auto report = report_of_scan(phantom::scan_phase(plan, body, systole).image);
  if (!report) return;
  expect_nothing_untrue(*report, moved);
  EXPECT_NE(report->quality->grade, ScanGrade::good);
}

TEST(BadScansReal, OfADissectedAortaInWideVoxelsNothingIsGraded) {
  OSTIA_REQUIRE_SHARED(path, "cta/totalsegmentator-aorta-cta/ct_cropped.nii.gz");
  const imaging::ImageVolume image = imaging::read_image(path).volume;
  const auto report = report_of_scan(image);
  ASSERT_TRUE(report);
  for (const ReportStenosis& one : report->stenoses) EXPECT_FALSE(one.graded) << one.vessel_name;
  EXPECT_EQ(to_string(report->category), "N");
  // What runs where an artery may be is no artery that can be judged; one that nothing was taken for, or
  // what is hardly an artery, is named.
  for (const std::string artery : {"LAD", "LCX", "RCA"}) {
    const auto found = std::find_if(report->vessels.begin(), report->vessels.end(),
                                    [&](const ReportVessel& one) { return one.name == artery; });
    if (found == report->vessels.end() || found->unlikely) {
      EXPECT_THAT(report->not_found,
                  ::testing::Contains(::testing::AllOf(HasSubstr(artery), HasSubstr(": not found"))));
      continue;
    }
    ASSERT_FALSE(found->evaluable.empty()) << artery;
    for (const analysis::EvaluableStretch& one : found->evaluable)
      EXPECT_NE(one.grade, analysis::Evaluability::evaluable) << artery << " from " << one.from_mm;
  }
  EXPECT_FALSE(report->not_judged.empty());
  EXPECT_EQ(report->quality->grade, ScanGrade::poor);
}

TEST(BadScansReal, AChestWithoutTheRootIsRefused) {
  OSTIA_REQUIRE_SHARED(path, "cta/rider-pilot-chest-pe-cta/heart-crop.nrrd");
  EXPECT_FALSE(report_of_scan(imaging::read_image(path).volume));
}

}  // namespace
}  // namespace ostia::session
