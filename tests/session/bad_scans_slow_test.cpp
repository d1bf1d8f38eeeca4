// Scans that are hard to read: no grade from what cannot be judged, and every missing artery named.

#include "kept_scan.h"
#include "shared_data.h"

#include "ostia/core/error.h"
#include "ostia/imaging/image_file.h"
#include "ostia/session/case_report.h"
#include "ostia/session/found_model.h"

#include <gmock/gmock.h>

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
    return make_case_report(found.model, solved_surfaces(found.model), {}, {}, &image);
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

TEST_P(BadScans, GradeTrueLesionsAloneAndNameWhatIsMissing) {
  phantom::CaseOptions patient;
  patient.preset = phantom::Preset::small;
  GetParam().spoil(patient);
  const phantom::CasePlan plan = phantom::plan_case(patient);
  const imaging::ImageVolume image = ostia::testing::kept_scan(plan).image;
  const auto report = report_of_scan(image);
  if (!report) return;  // nothing is graded
  std::set<std::string> names;
  for (const ReportVessel& vessel : report->vessels) names.insert(vessel.name);
  std::string missing;
  for (const std::string& one : report->not_found) missing += one + "\n";
  for (const char* artery : {"LAD", "LCX", "RCA"})
    if (!names.count(artery)) {
      EXPECT_THAT(missing, HasSubstr(artery));
    }
  for (const ReportStenosis& one : report->stenoses) {
    if (!one.graded || one.stenosis.diameter_percent < counts_percent) continue;
    const analysis::LumenProfile& profile = report->profiles.at(one.stenosis.vessel);
    EXPECT_TRUE(is_true_lesion(plan.tree, one, analysis::at(profile, one.stenosis.throat_mm).centroid));
  }
  if (!report->not_found.empty()) {
    EXPECT_TRUE(report->category.not_diagnostic);
  }
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

TEST(BadScansReal, OfADissectedAortaInWideVoxelsNothingIsGraded) {
  OSTIA_REQUIRE_SHARED(path, "cta/totalsegmentator-aorta-cta/ct_cropped.nii.gz");
  const imaging::ImageVolume image = imaging::read_image(path).volume;
  const auto report = report_of_scan(image);
  ASSERT_TRUE(report);
  for (const ReportStenosis& one : report->stenoses) EXPECT_FALSE(one.graded) << one.vessel_name;
  EXPECT_EQ(to_string(report->category), "N");
  EXPECT_THAT(report->not_found, ::testing::Contains(HasSubstr("RCA: not found")));
  EXPECT_EQ(report->quality->grade, ScanGrade::poor);
}

TEST(BadScansReal, AChestWithoutTheRootIsRefused) {
  OSTIA_REQUIRE_SHARED(path, "cta/rider-pilot-chest-pe-cta/heart-crop.nrrd");
  EXPECT_FALSE(report_of_scan(imaging::read_image(path).volume));
}

}  // namespace
}  // namespace ostia::session
