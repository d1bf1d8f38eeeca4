#include "ostia/pipeline/source.h"

#include "dicom_writer.h"
#include "shared_data.h"
#include "zip_writer.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/core/log.h"
#include "ostia/core/path_digest.h"
#include "ostia/geometry/analytic_shapes.h"
#include "ostia/imaging/image_file.h"
#include "ostia/io/surface_file.h"

#include <gtest/gtest.h>

namespace ostia::pipeline {
namespace {
namespace fs = std::filesystem;

imaging::ImageVolume ramp() {
  imaging::ImageVolume image;
  image.geometry.size = {8, 7, 6};
  image.voxels.resize(8 * 7 * 6);
  for (std::size_t i = 0; i < image.voxels.size(); ++i) image.voxels[i] = static_cast<std::int16_t>(i);
  return image;
}

geometry::TriMesh source_tube() {
  return geometry::surface_of(geometry::straight_tube(10.0, 1.5), 0.5, true);
}

TEST(Source, KnowsWhatAFileIs) {
  const fs::path folder = testing::temporary_folder("source");
  imaging::write_image(folder / "ct.nrrd", ramp());
  imaging::MaskVolume mask{ramp().geometry, std::vector<std::uint8_t>(8 * 7 * 6, 1)};
  mask.voxels[3] = 0;
  imaging::write_image(folder / "mask.nrrd", mask);
  io::write_surface(folder / "a.stl", source_tube());
  core::write_file(folder / "a.txt", "hello");
  EXPECT_EQ(classify(folder / "ct.nrrd"), SourceKind::image);
  EXPECT_EQ(classify(folder / "mask.nrrd"), SourceKind::mask);
  EXPECT_EQ(classify(folder / "a.stl"), SourceKind::surface);
  EXPECT_EQ(classify(folder), SourceKind::dicom);
  EXPECT_THROW(classify(folder / "a.txt"), InvalidInput);
  EXPECT_THROW(classify(folder / "none.nrrd"), IoError);
  EXPECT_THROW(classify("/dev/null"), InvalidInput);
}

TEST(Source, IsKnownByADigestAndNotByItsPath) {
  const fs::path folder = testing::temporary_folder("DOE_JANE");
  imaging::write_image(folder / "ct.nrrd", ramp());
  const Source source = load(folder / "ct.nrrd");
  EXPECT_EQ(source.sha256, core::sha256_file(folder / "ct.nrrd"));
  EXPECT_EQ(source.pseudonym, "image-" + source.sha256.substr(0, 8));
  EXPECT_EQ(source.image->voxels, ramp().voxels);
  EXPECT_EQ(core::redacted("reading " + (folder / "ct.nrrd").string()).find("DOE_JANE"), std::string::npos);
}

TEST(Source, AZipIsWhatItsFolderIs) {
  const fs::path folder = testing::temporary_folder("zipped") / "series";
  fs::create_directory(folder);
  testing::write_series(folder, 4, 0.5, [](testing::CtSlice&, int) {});
  std::vector<testing::ZipMember> members;
  for (const auto& entry : fs::directory_iterator(folder))
    members.push_back({entry.path().filename().string(), core::read_file(entry.path()), true});
  const fs::path zip = folder.parent_path() / "anything";  // known by its first bytes
  core::write_file(zip, testing::zip_bytes(members));
  EXPECT_EQ(classify(zip), SourceKind::dicom);
  const Source of_zip = load(zip), of_folder = load(folder);
  EXPECT_EQ(of_zip.sha256, of_folder.sha256);
  EXPECT_EQ(of_zip.image->voxels, of_folder.image->voxels);
}

TEST(Source, ADicomFolderIsKnownByTheSeriesChosen) {
  const fs::path study = testing::temporary_folder("study");
  for (const std::string uid : {"1.2.3", "1.2.4"}) {
    fs::create_directory(study / uid);
    testing::write_series(study / uid, 4, 0.5, [&](testing::CtSlice& slice, int) {
      slice.series = uid;
      slice.sop_instance += "." + uid;
    });
  }
  core::write_file(study / "README.txt", "not an image");
  SourceOptions options;
  options.dicom.series_uid = "1.2.4";
  const Source source = load(study, options);
  EXPECT_EQ(source.sha256, core::sha256_of_path(study / "1.2.4"));
  EXPECT_EQ(source.pseudonym, "image-" + source.sha256.substr(0, 8));
  EXPECT_NE(source.sha256, load(study / "1.2.3").sha256);
  EXPECT_THROW(load(study), InvalidInput);  // which of the two?
}

TEST(Source, TellsTheUnitByTheCalibreAndSaysSo) {
  const fs::path folder = testing::temporary_folder("source");
  geometry::TriMesh metres = source_tube();
  for (geometry::Vec3& p : metres.points) p *= 0.001;
  io::write_surface(folder / "m.stl", metres);
  const Source told = load(folder / "m.stl");
  EXPECT_EQ(told.unit_mm, 1000.0);
  ASSERT_EQ(told.warnings.size(), 1u);
  EXPECT_NE(told.warnings[0].find("metres"), std::string::npos);
  EXPECT_NE(told.warnings[0].find("--units"), std::string::npos);
  SourceOptions options;
  options.unit_mm = 1000.0;
  EXPECT_NEAR(load(folder / "m.stl", options).surface.points.front().norm(),
              source_tube().points.front().norm(), 1e-3);
  EXPECT_THROW(check_vessel_size(120.0, "x"), InvalidInput);
  EXPECT_NO_THROW(check_vessel_size(40.0, "x"));
}

}  // namespace
}  // namespace ostia::pipeline
