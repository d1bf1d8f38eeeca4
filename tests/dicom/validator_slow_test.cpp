// PixelMed's validator of structured reports, whose rules take it a while.

#include "made_series.h"

#include "ostia/dicom/measurement_report.h"

namespace ostia::dicom {
namespace {

using namespace testing;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(DicomValidator, TheReportIsOneOfTemplate1500) {
  const MadeSeries made = made_series(grid_with(oblique()));
  if (!shell_run(made.folder, "command -v DicomSRValidator").good)
    GTEST_SKIP() << "needs DicomSRValidator (pixelmed-apps)";
  MeasurementReport report;
  report.groups.push_back({"S1",
                           codes::stenosis,
                           segment_site(6),
                           {{codes::lumen_diameter, 1.25, codes::millimetre, codes::minimum},
                            {codes::fractional_flow_reserve, 0.78, codes::ratio, {}}},
                           {{{"vessel_name", "99OSTIA", "Name of the vessel"}, {}, "LAD"}}});
  report.statements.push_back({cad_assessment, cad_rads_codes("3")->assessment, {}});
  written(measurement_report(made.source, report), made.folder, "sr.dcm");
  core::ChildLimits limits;
  limits.memory_bytes = 64ULL << 30;  // of addresses: Java takes many and uses few
  // Newer Java bounds the size of style sheets; the validator's own are larger.
  const ShellRun run =
      shell_run(made.folder,
                "JAVA_TOOL_OPTIONS='-Djdk.xml.xpathTotalOpLimit=0 -Djdk.xml.xpathExprOpLimit=0 "
                "-Djdk.xml.xpathExprGrpLimit=0' DicomSRValidator sr.dcm",
                limits);
  EXPECT_THAT(run.output, HasSubstr("TID_1500"));
  EXPECT_THAT(run.output, Not(HasSubstr("Error")));
}

}  // namespace
}  // namespace ostia::dicom
