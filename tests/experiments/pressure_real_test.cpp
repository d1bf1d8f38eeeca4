// A real patient's tree as a case of the pressure experiment.

#include "pressure/pressure_compare.h"
#include "pressure/pressure_patients.h"
#include "shared_data.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>

#include <set>

namespace ostia::experiments {
namespace {

class PressurePatients : public ::testing::TestWithParam<const char*> {};

TEST_P(PressurePatients, TheTreeHasANetworkThatCarriesItsFlow) {
  OSTIA_REQUIRE_SHARED(file, "coronary/patient-masks/" + std::string(GetParam()) + ".nrrd");
  const PressurePatient patient = pressure_patient(file.parent_path(), GetParam(), core::no_task());
  EXPECT_GE(patient.model.vessels.size(), 4u);
  EXPECT_GT(patient.planned.diameter_mm, 1.5);
  EXPECT_LT(patient.planned.diameter_mm, 7.0);
  EXPECT_LE(patient.planned.reynolds, 600.0 + 1e-6);
  std::set<std::string> names;
  PressureRun run;
  for (const geometry::Vessel& vessel : patient.model.tree.vessels) {
    EXPECT_TRUE(names.insert(vessel.name).second) << vessel.name;
    run.outlets_ml_s[vessel.name] =
        patient.planned.flow_ml_s / static_cast<double>(patient.model.tree.vessels.size());
  }
  const PressureProblem problem =
      problem_of(patient.planned, measured_network(patient.model, core::no_task()), run);
  EXPECT_EQ(problem.outlet_names.size(), patient.model.vessels.size());
  for (const auto& branch : pressures_1d(problem, compared_model()))
    for (const double pa : branch) EXPECT_TRUE(std::isfinite(pa));
}

INSTANTIATE_TEST_SUITE_P(ImageCas, PressurePatients,
                         ::testing::Values("patient001", "patient010", "patient171"),
                         [](const auto& one) { return std::string(one.param); });

TEST(PressurePatientFiles, OneThatIsNotThereIsNamed) {
  EXPECT_THROW(pressure_patient("/nowhere", "patient001", core::no_task()), IoError);
}

}  // namespace
}  // namespace ostia::experiments
