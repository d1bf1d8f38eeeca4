#include "ostia/session/image_digest.h"

#include "case_tools.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/pipeline/source.h"

#include <gtest/gtest.h>

namespace ostia::session {
namespace {

using namespace testing;

/// A folder as a DICOM series may lie: files in it and below it.
void write_series(const fs::path& folder) {
  fs::create_directories(folder / "below");
  for (int i = 0; i < 5; ++i) write_bytes(folder / ("slice" + std::to_string(i)), std::string(1000 + i, 'x'));
  write_bytes(folder / "below" / "last", "y");
}

TEST(ImageDigest, IsTheOneOfTheCommandLine) {
  const TempFolder folder;
  const fs::path file = folder / "heart.nrrd";
  write_bytes(file, std::string(3 << 20, 'v'));
  const ImageReference image = image_reference(file);
  EXPECT_EQ(image.sha256, pipeline::digest(file, pipeline::SourceKind::image));
  EXPECT_EQ(image.pseudonym, "image-" + image.sha256.substr(0, 8));
  write_series(folder / "series");
  EXPECT_EQ(image_reference(folder / "series").sha256,
            pipeline::digest(folder / "series", pipeline::SourceKind::dicom));
}

TEST(ImageDigest, IsThatOfTheContentAlone) {
  // The digest of "abc" as the standard's examples give it.
  const TempFolder folder;
  write_bytes(folder / "abc", "abc");
  EXPECT_EQ(image_reference(folder / "abc").sha256,
            "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  write_series(folder / "a");
  write_series(folder / "b");
  fs::rename(folder / "b" / "slice0", folder / "b" / "another name");
  EXPECT_EQ(image_reference(folder / "a").sha256, image_reference(folder / "b").sha256);
  write_bytes(folder / "b" / "slice1", "changed");
  EXPECT_NE(image_reference(folder / "a").sha256, image_reference(folder / "b").sha256);
}

TEST(ImageDigest, TellsHowFarItIsAndCanBeCancelled) {
  const TempFolder folder;
  write_series(folder / "series");
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
