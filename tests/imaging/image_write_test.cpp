#include "image_files.h"
#include "shared_data.h"

#include "ostia/core/parallel.h"
#include "ostia/imaging/image_file.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <cstring>
#include <fstream>
#include <set>

namespace ostia::imaging {
namespace {
using namespace testing;

fs::path image_write_folder() {
  return ostia::testing::temporary_folder("write");
}

std::set<std::string> names_in(const fs::path& where) {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(where)) names.insert(entry.path().filename().string());
  return names;
}

template <class T, class Read>
void expect_round_trip(const Read& read) {
  for (const char* name : {"a.nrrd", "a.mhd", "a.mha"}) {
    const Volume<T> image = patterned<T>(oblique_grid(13, 11, 7));
    const fs::path path = image_write_folder() / name;
    write_image(path, image);
    const Volume<T> again = read(path).volume;
    EXPECT_EQ(again.voxels, image.voxels) << name;
    EXPECT_TRUE(same_grid(again.geometry, image.geometry, 1e-10)) << name;
    EXPECT_LT((again.geometry.direction - image.geometry.direction).norm(), 1e-14) << name;
  }
}

TEST(WriteImage, EveryFormatGivesBackTheSameImage) {
  expect_round_trip<std::int16_t>([](const fs::path& path) { return read_image(path); });
  expect_round_trip<float>([](const fs::path& path) { return read_float_image(path); });
}

TEST(WriteImage, EveryFormatGivesBackTheSameMask) {
  MaskVolume mask = patterned<std::uint8_t>(oblique_grid(13, 11, 7));
  for (std::uint8_t& v : mask.voxels) v = v > 200 ? 1 : 0;
  for (const char* name : {"a.nrrd", "a.mhd", "a.mha"}) {
    const fs::path path = image_write_folder() / name;
    write_image(path, mask);
    EXPECT_EQ(read_mask(path).volume.voxels, mask.voxels) << name;
    EXPECT_TRUE(looks_like_mask(path)) << name;
    EXPECT_EQ(read_image_header(path).pixel_type, PixelType::uint8) << name;
  }
}

TEST(WriteImage, NiftiGivesBackVoxelsAndThePlaceToAMicrometre) {
  const ImageVolume image = patterned<std::int16_t>(oblique_grid(13, 11, 7));
  for (const char* name : {"a.nii", "a.nii.gz", "A.NII.GZ"}) {
    const fs::path path = image_write_folder() / name;
    write_image(path, image);
    const auto again = read_image(path);
    EXPECT_EQ(again.header.format, "NIfTI-1") << name;
    EXPECT_TRUE(again.header.warnings.empty()) << name << ": " << again.header.warnings.front();
    EXPECT_EQ(again.volume.voxels, image.voxels) << name;
    EXPECT_TRUE(same_grid(again.volume.geometry, image.geometry, 1e-3)) << name;
  }
  const FloatVolume level = patterned<float>(oblique_grid(5, 4, 3));
  const fs::path path = image_write_folder() / "level.nii.gz";
  write_image(path, level);
  EXPECT_EQ(read_float_image(path).volume.voxels, level.voxels);
}

TEST(WriteImage, NiftiSaysItsAxesInRas) {
  ImageVolume image = patterned<std::int16_t>(oblique_grid(4, 3, 2));
  image.geometry.direction = Mat3::Identity();
  image.geometry.spacing = Vec3(0.5, 0.75, 1.25);
  image.geometry.origin = Vec3(10.0, -20.0, 30.0);
  const fs::path path = image_write_folder() / "a.nii";
  write_image(path, image);
  std::ifstream in(path, std::ios::binary);
  std::string head(348, '\0');
  in.read(head.data(), 348);
  const auto real = [&](std::size_t at) {
    float value = 0.0F;
    std::memcpy(&value, head.data() + at, sizeof value);
    return value;
  };
  EXPECT_EQ(real(280), -0.5F);  // srow_x: to the right
  EXPECT_EQ(real(292), -10.0F);
  EXPECT_EQ(real(296 + 4), -0.75F);  // srow_y: to the front
  EXPECT_EQ(real(308), 20.0F);
  EXPECT_EQ(real(312 + 8), 1.25F);  // srow_z
  EXPECT_EQ(real(324), 30.0F);
  EXPECT_EQ(real(264), 1.0F);  // quatern_d: half a turn about the head's axis
}

TEST(WriteImage, LabelsKeepTheirValues) {
  MaskVolume labels = patterned<std::uint8_t>(oblique_grid(13, 11, 7));
  for (std::uint8_t& v : labels.voxels) v = static_cast<std::uint8_t>(v % 27);
  for (const char* name : {"a.nrrd", "a.mha", "a.nii.gz"}) {
    const fs::path path = image_write_folder() / name;
    write_image(path, labels);
    EXPECT_EQ(read_labels(path).volume.voxels, labels.voxels) << name;
    EXPECT_TRUE(looks_like_labels(path)) << name;
    EXPECT_FALSE(looks_like_mask(path)) << name;
  }
  FloatVolume probability;
  probability.geometry = labels.geometry;
  for (const std::uint8_t v : labels.voxels) probability.voxels.push_back(static_cast<float>(v) / 26.0F);
  const fs::path path = image_write_folder() / "p.nrrd";
  write_image(path, probability);
  EXPECT_FALSE(looks_like_labels(path));
  const MaskVolume cut = read_labels(path).volume;
  for (std::size_t n = 0; n < cut.voxels.size(); ++n)
    EXPECT_EQ(cut.voxels[n], labels.voxels[n] >= 13 ? 1 : 0);
  ImageVolume ct = patterned<std::int16_t>(oblique_grid(13, 11, 7));
  ct.voxels.front() = 1000;
  write_image(path, ct);
  EXPECT_THROW(read_labels(path), InvalidInput);
}

TEST(WriteImage, GeometryOnTheAxesIsKeptBitForBit) {
  ImageVolume image = patterned<std::int16_t>(oblique_grid(4, 3, 2));
  image.geometry.direction = Mat3::Identity();
  image.geometry.spacing = Vec3(0.3, 1.0 / 3.0, 0.625);
  image.geometry.origin = Vec3(-0.1, 1e-7, 1234.56789012345);
  for (const char* name : {"a.nrrd", "a.mhd", "a.mha"}) {
    const fs::path path = image_write_folder() / name;
    write_image(path, image);
    const Geometry grid = read_image_header(path).geometry;
    EXPECT_EQ(grid.spacing, image.geometry.spacing) << name;
    EXPECT_EQ(grid.origin, image.geometry.origin) << name;
    EXPECT_EQ(grid.direction, image.geometry.direction) << name;
  }
}

TEST(WriteImage, SaysAxesAndUnit) {
  const fs::path here = image_write_folder();
  write_image(here / "a.nrrd", patterned<std::int16_t>(oblique_grid(4, 3, 2)));
  const std::string nrrd = read_bytes(here / "a.nrrd");
  EXPECT_NE(nrrd.find("space: left-posterior-superior\n"), std::string::npos);
  EXPECT_NE(nrrd.find("space units: \"mm\" \"mm\" \"mm\"\n"), std::string::npos);
  ImageVolume image = patterned<std::int16_t>(oblique_grid(4, 3, 2));
  image.geometry.direction << 0, -1, 0, 1, 0, 0, 0, 0, 1;  // i to posterior, j to the right
  write_image(here / "a.mha", image);
  const std::string meta = read_bytes(here / "a.mha");
  EXPECT_NE(meta.find("DistanceUnits = mm\n"), std::string::npos);
  EXPECT_NE(meta.find("AnatomicalOrientation = ALI\n"), std::string::npos);
}

TEST(WriteImage, PacksManyBlocksIntoOneStreamTheSameForAnyNumberOfThreads) {
  const fs::path here = image_write_folder();
  const ImageVolume image = patterned<std::int16_t>(oblique_grid(128, 128, 100));  // 3.1 blocks
  core::set_max_threads(1);
  write_image(here / "one.nrrd", image);
  core::set_max_threads(0);
  write_image(here / "many.nrrd", image);
  EXPECT_EQ(read_bytes(here / "one.nrrd"), read_bytes(here / "many.nrrd"));
  EXPECT_EQ(read_image(here / "one.nrrd").volume.voxels, image.voxels);
}

TEST(WriteImage, LeavesOnlyItsFiles) {
  const fs::path here = image_write_folder();
  const ImageVolume image = patterned<std::int16_t>(oblique_grid(4, 3, 2));
  write_image(here / "a.nrrd", image);
  write_image(here / "b.mhd", image);
  EXPECT_EQ(names_in(here), (std::set<std::string>{"a.nrrd", "b.mhd", "b.raw"}));
}

TEST(WriteImage, ANewPairNeverTouchesTheVoxelsOfTheOldOne) {
  const fs::path here = image_write_folder(), other = image_write_folder();
  const ImageVolume first = patterned<std::int16_t>(oblique_grid(4, 3, 2)),
                    second = patterned<std::int16_t>(oblique_grid(5, 5, 5));
  write_image(here / "a.mhd", first);
  fs::create_hard_link(here / "a.raw", other / "a.raw");  // what a reader that opened the old pair still sees
  fs::copy_file(here / "a.mhd", other / "a.mhd");
  write_image(here / "a.mhd", second);
  EXPECT_EQ(read_image(other / "a.mhd").volume.voxels, first.voxels);
  EXPECT_EQ(read_image(here / "a.mhd").volume.voxels, second.voxels);
  EXPECT_EQ(names_in(here), (std::set<std::string>{"a.mhd", "a-2.raw"}));
  write_image(here / "a.mhd", first);
  EXPECT_EQ(names_in(here), (std::set<std::string>{"a.mhd", "a.raw"}));
}

TEST(WriteImage, DoesNotDeleteVoxelsThatAreNotItsOwn) {
  const fs::path here = image_write_folder();
  write_bytes(here / "a.mhd", meta_header({{"ElementDataFile", "scan.raw"}}));
  write_bytes(here / "scan.raw", bytes_of(counted(24)));
  write_image(here / "a.mhd", patterned<std::int16_t>(oblique_grid(4, 3, 2)));
  EXPECT_EQ(names_in(here), (std::set<std::string>{"a.mhd", "a.raw", "scan.raw"}));
}

TEST(WriteImage, RefusesWhatItCannotWrite) {
  const fs::path here = image_write_folder();
  const ImageVolume image = patterned<std::int16_t>(oblique_grid(4, 3, 2));
  EXPECT_NE(refusal([&] { write_image(here / "a.png", image); }).find("extension"), std::string::npos);
  ImageVolume bad = image;
  bad.voxels.pop_back();
  EXPECT_NE(refusal([&] { write_image(here / "a.nrrd", bad); }).find("voxels"), std::string::npos);
  bad = image;
  bad.geometry.spacing[1] = 0.0;
  EXPECT_NE(refusal([&] { write_image(here / "a.nrrd", bad); }).find("spacing"), std::string::npos);
  EXPECT_THROW(write_image("/dev/null/a.nrrd", image), IoError);
  EXPECT_TRUE(names_in(here).empty());
}

/// Lets no file grow beyond a limit, as a full disk would.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) {
    signal_ = std::signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &old_);
    const rlimit limit{bytes, old_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &old_);
    std::signal(SIGXFSZ, signal_);
  }

 private:
  rlimit old_{};
  void (*signal_)(int);
};

TEST(WriteImage, WithoutRoomTheOldImageStays) {
  const fs::path here = image_write_folder();
  const ImageVolume old = patterned<std::int16_t>(oblique_grid(4, 3, 2)),
                    large = patterned<std::int16_t>(oblique_grid(64, 64, 64));
  for (const char* name : {"a.nrrd", "b.mhd", "c.mha"}) write_image(here / name, old);
  const auto before = names_in(here);
  for (const char* name : {"a.nrrd", "b.mhd", "c.mha"}) {
    {
      const FileSizeLimit limit(100000);
      EXPECT_THROW(write_image(here / name, large), ResourceError) << name;
    }
    EXPECT_EQ(read_image(here / name).volume.voxels, old.voxels) << name;
  }
  EXPECT_EQ(names_in(here), before);
}

TEST(WriteImage, InAReadOnlyFolderTheOldImageStays) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may write anywhere";
  const fs::path here = image_write_folder();
  const ImageVolume old = patterned<std::int16_t>(oblique_grid(4, 3, 2));
  write_image(here / "a.nrrd", old);
  fs::permissions(here, fs::perms::owner_read | fs::perms::owner_exec);
  EXPECT_THROW(write_image(here / "a.nrrd", patterned<std::int16_t>(oblique_grid(5, 5, 5))), IoError);
  fs::permissions(here, fs::perms::owner_all);
  EXPECT_EQ(read_image(here / "a.nrrd").volume.voxels, old.voxels);
}

}  // namespace
}  // namespace ostia::imaging
