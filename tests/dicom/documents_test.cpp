#include "ostia/dicom/documents.h"

#include "made_series.h"

#include "ostia/core/error.h"
#include "ostia/dicom/presentation.h"

#include <bit>

namespace ostia::dicom {
namespace {

using namespace testing;
using ::testing::HasSubstr;

geometry::TriMesh tetrahedron() {
  geometry::TriMesh mesh;
  mesh.points = {{1.5, -2.25, 3.0}, {2.5, -2.25, 3.0}, {1.5, -1.25, 3.0}, {1.5, -2.25, 4.0}};
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  return mesh;
}

TEST(DicomDocuments, ThePdfIsByteForByteInIt) {
  const MadeSeries made = made_series(grid_with(Mat3::Identity()));
  const std::string pdf = "%PDF-1.5 odd";  // 12 bytes
  for (const std::string& one : {pdf, pdf + "1"}) {
    const DicomDataset d = encapsulated_pdf(made.source, one, "Report");
    const auto read = imaging::require_dicom_object(written(d, made.folder, "pdf.dcm"));
    EXPECT_EQ(read.data.find(0x00420011)->value.substr(0, *read.data.u32(0x00420015)), one);
    EXPECT_EQ(read.data.text(0x00420012), "application/pdf");
    EXPECT_EQ(read.data.items(0x00420013).size(), 7U);
  }
  EXPECT_THAT(refusal([&] { encapsulated_pdf(made.source, "text", "Report"); }), HasSubstr("no PDF"));
}

TEST(DicomDocuments, TheSurfaceLiesWhereItLayInMillimetres) {
  const MadeSeries made = made_series(grid_with(oblique()));
  const geometry::TriMesh mesh = tetrahedron();
  const DicomDataset d = encapsulated_stl(made.source, mesh, "Lumen");
  EXPECT_EQ(d.text(0x00200052), made.source.frame_of_reference);
  EXPECT_EQ(code_of(d, 0x004008EA)->value, "mm");
  const std::string& stl = d.find(0x00420011)->value;
  ASSERT_EQ(stl.size(), 84U + 4 * 50);
  const auto number = [&](std::size_t at) {
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < 4; ++i)
      bits |= static_cast<std::uint32_t>(static_cast<unsigned char>(stl[at + i])) << (8 * i);
    return bits;
  };
  EXPECT_EQ(number(80), 4U);
  for (std::size_t t = 0; t < 4; ++t)
    for (std::size_t corner = 0; corner < 3; ++corner)
      for (std::size_t axis = 0; axis < 3; ++axis)
        EXPECT_FLOAT_EQ(std::bit_cast<float>(number(84 + 50 * t + 12 + 12 * corner + 4 * axis)),
                        static_cast<float>(mesh.points[static_cast<std::size_t>(mesh.triangles[t][corner])]
                                                      [static_cast<Eigen::Index>(axis)]));
}

TEST(DicomDocuments, APictureHasItsPixels) {
  const MadeSeries made = made_series(grid_with(Mat3::Identity()));
  const CapturedPicture picture{2, 1, {255, 0, 0, 0, 0, 255}, "LAD"};
  const DicomDataset d = secondary_capture(made.source, picture);
  EXPECT_EQ(d.text(0x00280004), "RGB");
  EXPECT_EQ(*d.u16(0x00280010), 1);
  EXPECT_EQ(*d.u16(0x00280011), 2);
  EXPECT_EQ(d.find(0x7FE00010)->value, std::string("\xff\0\0\0\0\xff", 6));
  EXPECT_THAT(refusal([&] {
                secondary_capture(made.source, {2, 2, {0, 0, 0}, ""});
              }),
              HasSubstr("does not fill"));
}

TEST(DicomDocuments, TextsOfOursKeepToTheCharacterSetOfThePatient) {
  const MadeSeries plain = made_series(grid_with(Mat3::Identity()));
  EXPECT_EQ(plain.source.identity.text(0x00080005), "ISO_IR 192");  // ASCII is UTF-8, too
  ObjectOptions options;
  options.series_description = "Gef\xc3\xa4\xc3\x9f";
  EXPECT_EQ(encapsulated_pdf(plain.source, "%PDF-", "Bericht", options).text(0x0008103E),
            "Gef\xc3\xa4\xc3\x9f");

  // A name in ISO 2022 stays byte for byte, and what is ours is reduced to what every set holds.
  MadeSeries other = plain;
  const std::string name = "Yamada^Tarou=\x1b$B;3ED\x1b(B^\x1b$BB@O:\x1b(B";
  other.source.identity.set_text(0x00080005, "CS", "\\ISO 2022 IR 87");
  other.source.identity.set_text(0x00100010, "PN", name);
  const DicomDataset d = encapsulated_pdf(other.source, "%PDF-", "Bericht", options);
  EXPECT_EQ(d.text(0x00100010), name);
  EXPECT_EQ(d.text(0x00080005), "\\ISO 2022 IR 87");
  EXPECT_EQ(d.text(0x0008103E), "Gef??");
}

TEST(DicomSource, FilesOfTwoPatientsAreRefused) {
  MadeSeries a = made_series(grid_with(Mat3::Identity()));
  const MadeSeries b = made_series(grid_with(Mat3::Identity()), "ROE^RICHARD");
  a.series.files[3] = b.series.files[3];
  EXPECT_THAT(refusal([&] { source_of(a.series); }), HasSubstr("another patient, study or series"));
}

TEST(DicomSource, APseudonymIsSaidToBeOne) {
  const SourceSeries source = pseudonymous_source("image-12345678", "digest");
  EXPECT_TRUE(source.pseudonym);
  EXPECT_EQ(source.identity.text(0x00100020), "image-12345678");
  EXPECT_EQ(source.identity.text(0x00120062), "YES");
  EXPECT_EQ(pseudonymous_source("image-12345678", "digest").study_uid, source.study_uid);
}

TEST(PresentationState, ItsWindowIsRead) {
  const MadeSeries made = made_series(grid_with(Mat3::Identity()));
  DicomDataset d;
  d.set_text(0x00080016, "UI", "1.2.840.10008.5.1.4.1.1.11.1");
  d.set_text(0x00080018, "UI", "1.2.3");
  DicomDataset& window = d.add_item(0x00283110);
  window.set_text(0x00281050, "DS", "250");
  window.set_text(0x00281051, "DS", "900");
  window.add_item(0x00081140).set_text(0x00081155, "UI", "1.2.3.4");
  const auto read = read_presented_windows(written(d, made.folder, "pr.dcm"));
  ASSERT_EQ(read.size(), 1U);
  EXPECT_DOUBLE_EQ(read[0].centre, 250.0);
  EXPECT_DOUBLE_EQ(read[0].width, 900.0);
  EXPECT_EQ(read[0].instances, std::vector<std::string>{"1.2.3.4"});
  d.find(0x00283110)->items[0].set_text(0x00281051, "DS", "0,5");
  EXPECT_THAT(refusal([&] { read_presented_windows(written(d, made.folder, "pr.dcm")); }),
              HasSubstr("WindowWidth (0028,1051)"));
  EXPECT_THAT(refusal([&] { read_presented_windows(made.series.files.front()); }),
              HasSubstr("no presentation state"));
}

}  // namespace
}  // namespace ostia::dicom
