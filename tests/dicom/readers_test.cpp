// What others say of our objects: the checkers of dicom3tools and PixelMed, DCMTK's readers of reports and
// pictures, GDCM, pydicom.

#include "made_series.h"

#include "ostia/dicom/documents.h"
#include "ostia/dicom/measurement_report.h"

#include <algorithm>

namespace ostia::dicom {
namespace {

using namespace testing;
using ::testing::HasSubstr;
using ::testing::Not;

bool has_program(const fs::path& folder, const std::string& name) {
  return shell_run(folder, "command -v " + name).good;
}

/// One of each kind.
std::vector<fs::path> one_of_each(const MadeSeries& made) {
  const fs::path folder = made.folder / "objects";
  fs::create_directory(folder);
  const MaskVolume mask = lopsided_mask(made.series.geometry);
  SegmentationOptions shares;
  shares.fractional = true;
  geometry::TriMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  MeasurementReport report;
  report.groups.push_back({"S1",
                           codes::stenosis,
                           segment_site(6),
                           {{codes::lumen_diameter, 1.25, codes::millimetre, codes::minimum},
                            {codes::lesion_length, 8.5, codes::millimetre, {}},
                            {codes::lumen_area, 1.3, codes::square_millimetre, codes::minimum},
                            {codes::diameter_stenosis, 62.0, codes::percent, {}},
                            {codes::area_stenosis, 80.0, codes::percent, {}},
                            {codes::plaque_volume, 40.0, codes::cubic_millimetre, {}},
                            {codes::fractional_flow_reserve, 0.78, codes::ratio, {}}},
                           {{{"vessel_name", "99OSTIA", "Name of the vessel"}, {}, "LAD"}}});
  report.statements.push_back({cad_assessment, cad_rads_codes("3")->assessment, {}});
  return {
      written(segmentation(made.source, mask, two_segments()), folder, "seg.dcm"),
      written(segmentation(made.source, mask, {two_segments().front()}, shares), folder, "fractional.dcm"),
      written(encapsulated_pdf(made.source, "%PDF-1.5\n%%EOF\n", "Report"), folder, "pdf.dcm"),
      written(encapsulated_stl(made.source, mesh, "Lumen"), folder, "stl.dcm"),
      written(measurement_report(made.source, report), folder, "sr.dcm"),
      written(secondary_capture(made.source, {2, 1, {255, 0, 0, 0, 0, 255}, "LAD"}), folder, "sc.dcm")};
}

TEST(DicomReaders, DciodvfyFindsNoError) {
  const MadeSeries made = made_series(grid_with(oblique()));
  if (!has_program(made.folder, "dciodvfy")) GTEST_SKIP() << "needs dciodvfy (dicom3tools)";
  for (const fs::path& file : one_of_each(made)) {
    const ShellRun run = shell_run(made.folder, "dciodvfy '" + file.string() + "'");
    EXPECT_THAT(run.output, Not(HasSubstr("Error"))) << file << "\n" << run.output;
  }
}

TEST(DicomReaders, DsrdumpReadsTheReport) {
  const MadeSeries made = made_series(grid_with(oblique()));
  if (!has_program(made.folder, "dsrdump")) GTEST_SKIP() << "needs dsrdump (dcmtk)";
  one_of_each(made);
  const ShellRun run = shell_run(made.folder, "dsrdump objects/sr.dcm");
  EXPECT_TRUE(run.good) << run.output;
  EXPECT_THAT(run.output, HasSubstr("Fractional flow reserve"));
  EXPECT_THAT(run.output, HasSubstr("\"0.78\""));
  EXPECT_THAT(run.output, HasSubstr("3 - Moderate stenosis"));
}

TEST(DicomReaders, GdcmReadsAllAndTheSizesOfThePictures) {
  const MadeSeries made = made_series(grid_with(oblique()));
  if (!has_program(made.folder, "gdcmdump") || !has_program(made.folder, "gdcminfo"))
    GTEST_SKIP() << "needs gdcmdump and gdcminfo (libgdcm-tools)";
  for (const fs::path& file : one_of_each(made)) {
    const ShellRun run = shell_run(made.folder, "gdcmdump '" + file.string() + "'");
    EXPECT_TRUE(run.good) << run.output;
    const auto object = imaging::require_dicom_object(file);
    EXPECT_THAT(run.output, HasSubstr(object.data.text(0x00080018))) << file;
    EXPECT_THAT(run.output, HasSubstr("DOE^JANE")) << file;
  }
  // gdcminfo does not know the kinds of the surface and of the report.
  const std::pair<std::string, std::string> sizes[] = {{"seg.dcm", "Dimensions: (13,10,"},
                                                       {"fractional.dcm", "Dimensions: (13,10,"},
                                                       {"sc.dcm", "Dimensions: (2,1,1)"},
                                                       {"pdf.dcm", "Encapsulated PDF Storage"}};
  for (const auto& [name, said] : sizes)
    EXPECT_THAT(shell_run(made.folder, "gdcminfo objects/" + name).output, HasSubstr(said)) << name;
}

TEST(DicomReaders, DcmtkDrawsThePictures) {
  const MadeSeries made = made_series(grid_with(oblique()));
  const std::string program = has_program(made.folder, "dcm2img") ? "dcm2img" : "dcmj2pnm";
  if (!has_program(made.folder, program)) GTEST_SKIP() << "needs dcm2img or dcmj2pnm (dcmtk)";
  one_of_each(made);
  // The program scales as a window would: what is nothing is black, what is there is white.
  const std::string draw = program + " --min-max-window --write-raw-pnm objects/";
  const ShellRun seg = shell_run(made.folder, draw + "seg.dcm seg.pgm");
  ASSERT_TRUE(seg.good) << seg.output;
  const std::string frame = core::read_file(made.folder / "seg.pgm");
  ASSERT_THAT(frame, ::testing::StartsWith("P5\n13 10\n255\n"));
  EXPECT_EQ(std::count(frame.end() - 130, frame.end(), '\xff'), 15) << "the first frame's 5 x 3 voxels";
  EXPECT_EQ(std::count(frame.end() - 130, frame.end(), '\0'), 115);
  const ShellRun picture = shell_run(made.folder, program + " --write-raw-pnm objects/sc.dcm sc.ppm");
  ASSERT_TRUE(picture.good) << picture.output;
  EXPECT_EQ(core::read_file(made.folder / "sc.ppm"), std::string("P6\n2 1\n255\n\xff\0\0\0\0\xff", 17));
  EXPECT_TRUE(shell_run(made.folder, draw + "fractional.dcm fractional.pgm").good);
}

TEST(DicomReaders, PydicomFindsEveryVoxelIn48Orientations) {
  const fs::path folder = ostia::testing::temporary_folder("orientations");
  if (!shell_run(folder, "/usr/bin/python3 -c 'import pydicom, numpy'").good)
    GTEST_SKIP() << "needs pydicom and numpy (python3-pydicom)";
  int number = 0;
  for (const bool upright : {true, false})
    for (const Mat3& turned : axis_rotations()) {
      const MaskVolume mask = lopsided_mask(grid_with(upright ? turned : Mat3(oblique() * turned)));
      const std::string name = std::to_string(++number);
      written(segmentation(pseudonymous_source("nobody", name), mask, two_segments()), folder, name + ".dcm");
      std::string truth;
      for (const std::uint8_t label : {1, 2})
        for (const Vec3& p : places_of(mask, label))
          truth += std::to_string(int{label}) + " " + std::to_string(p.x()) + " " + std::to_string(p.y()) +
                   " " + std::to_string(p.z()) + "\n";
      core::write_file(folder / (name + ".txt"), truth);
    }
  core::write_file(folder / "places.py", R"(import pydicom, numpy as np
for n in range(1, 49):
    d = pydicom.dcmread(f'{n}.dcm')
    bits = np.unpackbits(np.frombuffer(d.PixelData, np.uint8), bitorder='little')
    frames = bits[:d.NumberOfFrames * d.Rows * d.Columns].reshape(d.NumberOfFrames, d.Rows, d.Columns)
    shared = d.SharedFunctionalGroupsSequence[0]
    o = np.array(shared.PlaneOrientationSequence[0].ImageOrientationPatient, float)
    between = shared.PixelMeasuresSequence[0].PixelSpacing
    found = []
    for frame, groups in zip(frames, d.PerFrameFunctionalGroupsSequence):
        at = np.array(groups.PlanePositionSequence[0].ImagePositionPatient, float)
        segment = groups.SegmentIdentificationSequence[0].ReferencedSegmentNumber
        for r, c in np.argwhere(frame):
            found.append([segment, *(at + o[:3] * between[1] * c + o[3:] * between[0] * r)])
    found, truth = np.array(found), np.loadtxt(f'{n}.txt')
    assert found.shape == truth.shape, (n, found.shape)
    for row in truth:
        same = found[found[:, 0] == row[0], 1:]
        assert np.linalg.norm(same - row[1:], axis=1).min() < 0.01, (n, row)
print('all 48')
)");
  const ShellRun run = shell_run(folder, "PYTHONDONTWRITEBYTECODE=1 /usr/bin/python3 places.py");
  EXPECT_THAT(run.output, HasSubstr("all 48"));
}

TEST(DicomReaders, PydicomReadsAll) {
  const MadeSeries made = made_series(grid_with(oblique()));
  if (!shell_run(made.folder, "/usr/bin/python3 -c 'import pydicom'").good)
    GTEST_SKIP() << "needs pydicom (python3-pydicom)";
  for (const fs::path& file : one_of_each(made)) {
    const ShellRun run =
        shell_run(made.folder, "/usr/bin/python3 -c \"import pydicom; d = pydicom.dcmread('" + file.string() +
                                   "'); str(d); print(d.PatientName, d.StudyInstanceUID)\"");
    EXPECT_TRUE(run.good) << run.output;
    EXPECT_THAT(run.output, HasSubstr("DOE^JANE " + made.source.study_uid));
  }
}

}  // namespace
}  // namespace ostia::dicom
