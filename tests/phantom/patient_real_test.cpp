#include "shared_data.h"

#include "ostia/imaging/image_file.h"
#include "ostia/phantom/body.h"
#include "ostia/phantom/patient_heart.h"
#include "ostia/phantom/phantom_case.h"
#include "ostia/session/patient_tree.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>

namespace ostia::phantom {
namespace {

/// Ten patients' masks drawn by hand for a public data set.
class HeartAroundPatient : public ::testing::TestWithParam<const char*> {};

TEST_P(HeartAroundPatient, LiesUnderTheArteriesAndIsACase) {
  OSTIA_REQUIRE_SHARED(file, "coronary/patient-masks/" + std::string(GetParam()) + ".nrrd");
  auto tree = std::make_shared<PatientTree>(session::patient_of_mask(imaging::read_labels(file).volume));
  tree->rim_mm = 0.5;
  CaseOptions options;
  options.preset = Preset::small;
  options.patient = tree;
  const CasePlan plan = plan_case(options);
  const PatientRecord& record = *plan.patient;
  EXPECT_GT(record.least_jacobian, 0.2);
  EXPECT_LT(record.height_left_mm, 3.5);
  EXPECT_LT(record.height_left_mm, record.height_mm);
  EXPECT_LT(record.groove_left_mm, 10.0);
  EXPECT_EQ(geometry::find_fault(vessel_tree(plan.tree)).value_or("none"), "none");
  for (const char* name : {"LAD", "LCX", "RCA"})
    EXPECT_EQ(std::ranges::count(plan.tree.vessels, std::string(name), &CoronaryVessel::name), 1) << name;
  const Body body(plan.heart, plan.tree, body_of(plan.options), plan.warp);
  for (const CoronaryVessel& vessel : plan.tree.vessels) {
    if (vessel.parent >= 0) continue;
    const geometry::Centerline& axis = vessel.axis;
    EXPECT_EQ(body.at(axis.points.front() - 1.5 * axis.frames.front().tangent).label, Label::aorta)
        << vessel.name;
  }
  EXPECT_EQ(plan.challenge.vessels.size(), 4U);
}

INSTANTIATE_TEST_SUITE_P(ImageCas, HeartAroundPatient,
                         ::testing::Values("patient001", "patient002", "patient010", "patient075",
                                           "patient171", "patient401", "patient491", "patient561",
                                           "patient595", "patient627"),
                         [](const auto& one) { return std::string(one.param); });

}  // namespace
}  // namespace ostia::phantom
