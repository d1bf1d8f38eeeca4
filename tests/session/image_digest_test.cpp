#include "ostia/session/image_digest.h"

#include "case_tools.h"
#include "dicom_writer.h"
#include "zip_writer.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/imaging/image_file.h"
#include "ostia/pipeline/source.h"

#include <gtest/gtest.h>

namespace ostia::session {
namespace {

using namespace testing;
using ostia::testing::CtSlice;

/// A folder as a DICOM series may lie: files in it and below it.
void write_files(const fs::path& folder) {
  fs::create_directories(folder / "below");
  for (int i = 0; i < 5; ++i) write_bytes(folder / ("slice" + std::to_string(i)), std::string(1000 + i, 'x'));
  write_bytes(folder / "below" / "last", "y");
}

void write_phase(const fs::path& folder, const std::string& uid) {
  fs::create_directories(folder / uid);
  ostia::testing::write_series(folder / uid, 4, 0.5, [&](CtSlice& slice, int) {
    slice.series = uid;
    slice.sop_instance += "." + uid;
  });
}

/// What a command of the command line calls it.
ImageReference of_command(const fs::path& path, const std::string& series_uid = {}) {
  pipeline::SourceOptions options;
  options.dicom.series_uid = series_uid;
  const pipeline::Source source = pipeline::load(path, options);
  return {source.sha256, source.pseudonym};
}

void expect_same(const ImageReference& a, const ImageReference& b) {
  EXPECT_EQ(a.sha256, b.sha256);
  EXPECT_EQ(a.pseudonym, b.pseudonym);
}

TEST(ImageDigest, IsTheOneOfTheCommandLine) {
  const TempFolder folder;
  const fs::path file = folder / "heart.nrrd";
  imaging::ImageVolume volume;
  volume.geometry.size = {8, 7, 6};
  for (int i = 0; i < 8 * 7 * 6; ++i) volume.voxels.push_back(static_cast<std::int16_t>(i));
  imaging::write_image(file, volume);
  const ImageReference image = image_reference(file);
  EXPECT_EQ(image.pseudonym, "image-" + image.sha256.substr(0, 8));
  expect_same(of_command(file), image);
  write_phase(folder / "series", "1.2.3");
  expect_same(of_command(folder / "series"), image_reference(folder / "series"));
}

TEST(ImageDigest, OfTwoSeriesInAFolderEachHasItsOwn) {
  const TempFolder folder;
  write_phase(folder / "study", "1.2.3");
  write_phase(folder / "study", "1.2.4");
  const imaging::DicomFolder found = imaging::scan_dicom(folder / "study");
  ASSERT_EQ(found.series.size(), 2U);
  for (const imaging::DicomSeries& series : found.series) {
    const ImageReference image = image_reference(series);
    EXPECT_EQ(image.pseudonym, "image-" + image.sha256.substr(0, 8));
    expect_same(of_command(folder / "study", series.uid), image);
    // As if the other did not lie beside it; from one of its files, too.
    expect_same(image_reference(folder / "study" / series.uid), image);
    expect_same(of_command(series.files.front()), image);
  }
  EXPECT_NE(image_reference(found.series[0]).sha256, image_reference(found.series[1]).sha256);
}

TEST(ImageDigest, AZipIsKnownByTheSeriesInIt) {
  const TempFolder folder;
  write_phase(folder / "series", "1.2.3");
  std::vector<ostia::testing::ZipMember> members;
  for (const auto& entry : fs::recursive_directory_iterator(folder / "series")) {
    if (entry.is_regular_file())
      members.push_back({entry.path().filename().string(), bytes_of_file(entry.path())});
  }
  const fs::path zip = folder / "packed.dcm";  // what it is called does not matter
  write_bytes(zip, ostia::testing::zip_bytes(members));
  expect_same(of_command(zip), image_reference(folder / "series"));
  expect_same(image_reference(imaging::scan_dicom(zip).series.at(0)), image_reference(folder / "series"));
}

TEST(ImageDigest, IsThatOfTheContentAlone) {
  // The digest of "abc" as the standard's examples give it.
  const TempFolder folder;
  write_bytes(folder / "abc", "abc");
  EXPECT_EQ(image_reference(folder / "abc").sha256,
            "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  write_files(folder / "a");
  write_files(folder / "b");
  fs::rename(folder / "b" / "slice0", folder / "b" / "another name");
  EXPECT_EQ(image_reference(folder / "a").sha256, image_reference(folder / "b").sha256);
  write_bytes(folder / "b" / "slice1", "changed");
  EXPECT_NE(image_reference(folder / "a").sha256, image_reference(folder / "b").sha256);
}

TEST(ImageDigest, TellsHowFarItIsAndCanBeCancelled) {
  const TempFolder folder;
  write_files(folder / "series");
  const core::TaskContext task;
  image_reference(folder / "series", task.sub(0.0, 0.5));
  EXPECT_DOUBLE_EQ(task.progress(), 0.5);
  task.cancel();
  EXPECT_THROW(image_reference(folder / "series", task), Cancelled);
}

TEST(ImageDigest, RefusesWhatIsNoImage) {
  const TempFolder folder;
  EXPECT_THROW(image_reference(folder / "none"), IoError);
  fs::create_directory(folder / "empty");
  EXPECT_THROW(image_reference(folder / "empty"), InvalidInput);
  EXPECT_THROW(image_reference("/dev/null"), InvalidInput);
  write_bytes(folder / "nothing", "");
  EXPECT_NO_THROW(image_reference(folder / "nothing"));
}

}  // namespace
}  // namespace ostia::session
