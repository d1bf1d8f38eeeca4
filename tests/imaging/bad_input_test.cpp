#include "image_files.h"
#include "shared_data.h"

#include "ostia/imaging/image_file.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <clocale>
#include <cstdlib>

// One test a row of the project's table of bad input: each builds the bad file itself and looks for the
// file's and the field's name in the refusal.
namespace ostia::imaging {
namespace {
using namespace testing;

struct BadInput : ::testing::Test {
  fs::path here = ostia::testing::temporary_folder("bad");
  std::vector<std::int16_t> voxels = counted(24);

  static long peak_kilobytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss;
  }
  /// Refused by header and by reader alike, the message holding `parts`.
  void expect_refused(const std::string& name, const std::vector<std::string>& parts,
                      bool by_header_too = true) {
    std::vector<std::string> messages{
        refusal([&] { read_image(here / name); }), refusal([&] { read_mask(here / name); }),
        refusal([&] { read_float_image(here / name); }), refusal([&] { looks_like_mask(here / name); })};
    if (by_header_too) messages.push_back(refusal([&] { read_image_header(here / name); }));
    for (const std::string& message : messages)
      for (const std::string& part : parts)
        EXPECT_NE(message.find(part), std::string::npos) << "'" << part << "' in: " << message;
  }
  /// Voxels of few values without a pattern: a mask for all that their number says, so that every reader
  /// reads to the end.
  static std::vector<std::int16_t> few(std::int64_t count) {
    std::vector<std::int16_t> values(static_cast<std::size_t>(count));
    std::uint32_t state = 1;
    for (std::int16_t& v : values)
      v = static_cast<std::int16_t>((state = state * 1664525U + 1013904223U) >> 29);
    return values;
  }
  void put(const std::string& name, const std::string& bytes) { write_bytes(here / name, bytes); }
};

TEST_F(BadInput, EmptyFile) {
  for (const char* name : {"a.nrrd", "a.mhd", "a.mha", "a.nii", "a.nii.gz"}) {
    put(name, "");
    expect_refused(name, {name, "size", "empty"});
  }
}

TEST_F(BadInput, MhdWhoseRawFileIsShort) {
  put("a.mhd", meta_header());
  put("image.raw", bytes_of(voxels).substr(0, 47));
  expect_refused("a.mhd", {"image.raw", "voxels", "cut short", "48 bytes", "47"});
}

TEST_F(BadInput, MhdWhoseRawFileIsEmpty) {
  put("a.mhd", meta_header());
  put("image.raw", "");
  expect_refused("a.mhd", {"image.raw", "voxels", "empty"});
}

TEST_F(BadInput, NiftiCutShort) {
  const std::string good = Nifti{}.file(voxels);
  for (const std::size_t length : {std::size_t{3}, std::size_t{200}, std::size_t{347}}) {
    put("a.nii", good.substr(0, length));
    expect_refused("a.nii", {"a.nii", "format", "cut short"});
  }
  put("a.nii", good.substr(0, 352));
  expect_refused("a.nii", {"a.nii", "data offset"});
  put("a.nii", good.substr(0, good.size() - 1));
  expect_refused("a.nii", {"a.nii", "voxels", "cut short"});
}

TEST_F(BadInput, PackedNiftiCutShort) {
  Nifti nifti;
  nifti.dim = {3, 20, 20, 20, 1, 1, 1, 1};
  const std::string good = packed(nifti.file(few(8000)));
  for (const std::size_t length : {good.size() - 1, good.size() - 9, good.size() / 2}) {
    put("a.nii.gz", good.substr(0, length));
    expect_refused("a.nii.gz", {"a.nii.gz", "cut short"}, false);
  }
  put("a.nii.gz", packed(nifti.file(few(7999))));  // whole gzip, one voxel missing within
  expect_refused("a.nii.gz", {"a.nii.gz", "voxels", "cut short", "15998 are there"}, false);
}

TEST_F(BadInput, NrrdWhoseGzipIsCutOrWrong) {
  const std::string header = nrrd_header({{"encoding", "gzip"}}), data = packed(bytes_of(few(24)));
  put("a.nrrd", header + data.substr(0, data.size() - 3));
  expect_refused("a.nrrd", {"a.nrrd", "compressed data", "cut short"}, false);
  std::string wrong = data;
  wrong[wrong.size() - 8] = static_cast<char>(wrong[wrong.size() - 8] ^ 1);
  put("a.nrrd", header + wrong);
  expect_refused("a.nrrd", {"a.nrrd", "compressed data", "damaged", "wrong check sum"}, false);
  put("a.nrrd", header + "this is no gzip stream at all, only text that goes on and on");
  expect_refused("a.nrrd", {"a.nrrd", "compressed data", "damaged"}, false);
}

TEST_F(BadInput, HugeHeaderOfLittleDataAllocatesNothing) {
  const long before = peak_kilobytes();
  const std::string kilobyte(1024, 'x'),
      size = "1290 1290 1290";  // within the limit on voxels: 4.3 GB of int16
  put("a.mhd", meta_header({{"DimSize", size}}));
  put("image.raw", kilobyte);
  expect_refused("a.mhd", {"image.raw", "voxels", "cut short", "1290 x 1290 x 1290"});
  put("a.nrrd", nrrd_header({{"sizes", size}}) + kilobyte);
  expect_refused("a.nrrd", {"a.nrrd", "voxels", "cut short"});
  put("b.nrrd", nrrd_header({{"sizes", size}, {"encoding", "gzip"}}) + packed(kilobyte));
  expect_refused("b.nrrd", {"b.nrrd", "voxels", "cut short"});
  put("c.nrrd", nrrd_header({{"sizes", size}, {"encoding", "ascii"}}) + kilobyte);
  expect_refused("c.nrrd", {"c.nrrd", "voxels", "cut short"});
  Nifti nifti;
  nifti.dim = {3, 1290, 1290, 1290, 1, 1, 1, 1};
  put("a.nii", nifti.header() + kilobyte);
  expect_refused("a.nii", {"a.nii", "voxels", "cut short"});
  put("a.nii.gz", packed(nifti.header() + kilobyte));
  expect_refused("a.nii.gz", {"a.nii.gz", "voxels", "cut short"});
  put("d.mhd", meta_header({{"DimSize", "2000 2000 2000"}}));
  expect_refused("d.mhd", {"d.mhd", "DimSize", "at most"});
  EXPECT_LT(peak_kilobytes() - before, 100000);
}

TEST_F(BadInput, ProductOfDimensionsOverflows) {
  put("image.raw", bytes_of(voxels));
  for (const char* size : {"4294967296 4294967296 1", "3037000500 3037000500 3", "9223372036854775807 2 2",
                           "65536 65536 65536"}) {
    put("a.mhd", meta_header({{"DimSize", size}}));
    expect_refused("a.mhd", {"a.mhd", "DimSize"});
    put("a.nrrd", nrrd_header({{"sizes", size}}) + bytes_of(voxels));
    expect_refused("a.nrrd", {"a.nrrd", "sizes"});
  }
  put("a.nrrd", nrrd_header({{"sizes", "99999999999999999999 1 1"}}) + bytes_of(voxels));
  expect_refused("a.nrrd", {"a.nrrd", "sizes", "99999999999999999999"});
  Nifti nifti;
  nifti.version = 2;
  nifti.dim = {3, std::int64_t{1} << 32, std::int64_t{1} << 32, 2, 1, 1, 1, 1};
  put("a.nii", nifti.file(voxels));
  expect_refused("a.nii", {"a.nii", "dim"});
}

TEST_F(BadInput, DimensionZeroOrNegative) {
  put("image.raw", bytes_of(voxels));
  for (const std::int64_t n : {std::int64_t{0}, std::int64_t{-3}}) {
    const std::string size = "4 " + std::to_string(n) + " 2";
    put("a.mhd", meta_header({{"DimSize", size}}));
    expect_refused("a.mhd", {"a.mhd", "DimSize", "a size of " + std::to_string(n)});
    put("a.nrrd", nrrd_header({{"sizes", size}}) + bytes_of(voxels));
    expect_refused("a.nrrd", {"a.nrrd", "sizes", "a size of " + std::to_string(n)});
    Nifti nifti;
    nifti.dim[2] = n;
    put("a.nii", nifti.file(voxels));
    expect_refused("a.nii", {"a.nii", "dim", "a size of " + std::to_string(n)});
  }
}

TEST_F(BadInput, SpacingNanZeroOrNegative) {
  put("image.raw", bytes_of(voxels));
  for (const char* bad : {"nan", "0", "-1", "inf"}) {
    put("a.mhd", meta_header({{"ElementSpacing", std::string("1 ") + bad + " 1"}}));
    expect_refused("a.mhd", {"a.mhd", "ElementSpacing", bad});
    put("a.nrrd", nrrd_header({{"space directions", ""}, {"spacings", std::string("1 ") + bad + " 1"}}) +
                      bytes_of(voxels));
    expect_refused("a.nrrd", {"a.nrrd", "spacings", bad});
    Nifti nifti;
    nifti.pixdim[2] = std::strtod(bad, nullptr);
    put("a.nii", nifti.file(voxels));
    expect_refused("a.nii", {"a.nii", "pixdim[2]", bad});
  }
  put("a.nrrd", nrrd_header({{"space directions", "(1,0,0) (0,0,0) (0,0,1)"}}) + bytes_of(voxels));
  expect_refused("a.nrrd", {"a.nrrd", "space directions", "axis 1"});
}

TEST_F(BadInput, DataOffsetBeyondTheFile) {
  put("a.mhd", meta_header({{"HeaderSize", "1000"}}));
  put("image.raw", bytes_of(voxels));
  expect_refused("a.mhd", {"image.raw", "data offset", "byte 1000"});
  put("a.nrrd", nrrd_header({{"byte skip", "1000"}}) + bytes_of(voxels));
  expect_refused("a.nrrd", {"a.nrrd", "data offset"});
  put("b.nrrd", nrrd_header({{"line skip", "1000"}}) + bytes_of(voxels));
  expect_refused("b.nrrd", {"b.nrrd", "line skip"});
  Nifti nifti;
  nifti.vox_offset = 1e6;
  put("a.nii", nifti.file(voxels));
  expect_refused("a.nii", {"a.nii", "data offset", "byte 1000000"});
  put("a.nii.gz", packed(nifti.file(voxels)));
  expect_refused("a.nii.gz", {"a.nii.gz"});
  for (const double offset : {-5.0, 352.5, std::nan("")}) {
    nifti.vox_offset = offset;
    std::string bytes = nifti.file(voxels);
    const float value = static_cast<float>(offset);
    std::memcpy(bytes.data() + 108, &value, 4);
    put("a.nii", bytes);
    expect_refused("a.nii", {"a.nii", "vox_offset"});
  }
}

TEST_F(BadInput, DataFileOutsideTheFolder) {
  const fs::path outside = ostia::testing::temporary_folder("outside");
  write_bytes(outside / "secret.raw", bytes_of(voxels));
  fs::create_symlink(outside / "secret.raw", here / "link.raw");
  fs::create_directory_symlink(outside, here / "folder");
  fs::create_symlink("/dev/zero", here / "zero.raw");
  ASSERT_EQ(::mkfifo((here / "pipe.raw").c_str(), 0600), 0);
  fs::create_directory(here / "directory.raw");
  const std::string up = "../" + outside.filename().string() + "/secret.raw";
  for (const std::string& name :
       {(outside / "secret.raw").string(), up, std::string("link.raw"), std::string("folder/secret.raw"),
        std::string("/dev/zero"), std::string("zero.raw"), std::string("pipe.raw"),
        std::string("directory.raw")}) {
    put("a.mhd", meta_header({{"ElementDataFile", name}}));
    expect_refused("a.mhd", {"a.mhd: ElementDataFile: ", name});
    put("a.nhdr", nrrd_header({{"data file", name}}));
    expect_refused("a.nhdr", {"a.nhdr: data file: ", name});
  }
  Nifti nifti;
  nifti.pair = true;
  put("pair.hdr", nifti.header());
  fs::create_symlink(outside / "secret.raw", here / "pair.img");
  expect_refused("pair.hdr", {"pair.hdr", "pair.img", "link"});
}

TEST_F(BadInput, LinksWithinTheFolderAreFine) {
  put("real.raw", bytes_of(voxels));
  fs::create_symlink("real.raw", here / "image.raw");
  put("a.mhd", meta_header());
  EXPECT_EQ(read_image(here / "a.mhd").volume.voxels, voxels);
}

TEST_F(BadInput, SingularAxes) {
  put("image.raw", bytes_of(voxels));
  put("a.nrrd", nrrd_header({{"space directions", "(1,0,0) (0,2,0) (1,2,0)"}}) + bytes_of(voxels));
  expect_refused("a.nrrd", {"a.nrrd", "space directions", "singular"});
  put("a.mhd", meta_header({{"TransformMatrix", "1 0 0 0 1 0 0 1 0"}}));
  expect_refused("a.mhd", {"a.mhd", "TransformMatrix", "singular"});
  Nifti nifti;
  nifti.srow = {1, 0, 0, 0, 0, 2, 2, 0, 0, 0, 0, 0};
  put("a.nii", nifti.file(voxels));
  expect_refused("a.nii", {"a.nii", "sform", "singular"});
}

TEST_F(BadInput, LeftHandedAxesAreConvertedAndSaid) {
  Nifti nifti;
  nifti.srow = {1, 0, 0, -10, 0, -2, 0, -20, 0, 0, 3, 30};  // i runs to the patient's right in RAS
  put("a.nii", nifti.file(voxels));
  const auto image = read_image(here / "a.nii");
  ASSERT_EQ(image.header.warnings.size(), 1U);
  EXPECT_EQ(image.header.warnings[0], "left-handed axes: k reversed");
  const Vec3 at =
      image.volume.geometry.index({10 - 2, 20 + 2 * 1, 30 + 3 * 0});  // voxel (2, 1, 0) of the file
  EXPECT_LT((at - Vec3(2, 1, 1)).norm(), 1e-6);
  EXPECT_EQ(image.volume(2, 1, 1), count_at({4, 3, 2}, 2, 1, 0));
}

TEST_F(BadInput, ShearedAxesAreResampledAndSaid) {
  put("a.nrrd", nrrd_header({{"sizes", "20 20 10"}, {"space directions", "(1,0,0) (0,1,0) (0.3,0,1)"}}) +
                    bytes_of(counted(4000)));
  const auto image = read_image(here / "a.nrrd");
  ASSERT_EQ(image.header.warnings.size(), 1U);
  EXPECT_NE(image.header.warnings[0].find("resampled"), std::string::npos);
  // Voxel (5, 7, 6) of the file lies at 10 + 5 + 0.3 * 6 along x; its neighbours along x count on by one.
  const Vec3 at = image.volume.geometry.index(Vec3(10 + 5 + 1.8, 20 + 7, 30 + 6));
  EXPECT_NEAR(at[1], 7, 1e-9);
  EXPECT_NEAR(at[2], 6, 1e-9);
  const std::int64_t i = std::lround(at[0]);
  EXPECT_NEAR(image.volume(i, 7, 6), count_at({20, 20, 10}, 5, 7, 6) + (static_cast<double>(i) - at[0]),
              0.51);
}

TEST_F(BadInput, ObliqueOrientationPutsALandmarkWhereItIs) {
  // A bright voxel at a point known beforehand, in an image whose axes are turned about all three axes,
  // written in every format by hand from one matrix.
  const Geometry grid = oblique_grid(20, 16, 12);
  std::vector<std::int16_t> data(static_cast<std::size_t>(grid.voxels()), -100);
  data[static_cast<std::size_t>(grid.offset(13, 5, 8))] = 900;
  const Vec3 landmark = grid.origin + grid.direction * Vec3(13 * 0.5, 5 * 0.7, 8 * 1.1);
  const Mat3 step = grid.direction * grid.spacing.asDiagonal();
  const auto text = [](const char* format, const Vec3& v) {
    char out[120];
    std::snprintf(out, sizeof out, format, v[0], v[1], v[2]);
    return std::string(out);
  };
  const char *list = "(%.17g,%.17g,%.17g) ", *plain = "%.17g %.17g %.17g ";
  put("lps.nrrd", nrrd_header({{"sizes", "20 16 12"},
                               {"space directions",
                                text(list, step.col(0)) + text(list, step.col(1)) + text(list, step.col(2))},
                               {"space origin", text(list, grid.origin)}}) +
                      bytes_of(data));
  const Vec3 ras(-1, -1, 1);
  const Mat3 ras_step = ras.asDiagonal() * step;
  put("ras.nrrd",
      nrrd_header({{"space", "right-anterior-superior"},
                   {"sizes", "20 16 12"},
                   {"space directions",
                    text(list, ras_step.col(0)) + text(list, ras_step.col(1)) + text(list, ras_step.col(2))},
                   {"space origin", text(list, ras.cwiseProduct(grid.origin))}}) +
          bytes_of(data));
  put("a.mha", meta_header({{"DimSize", "20 16 12"},
                            {"TransformMatrix", text(plain, grid.direction.col(0)) +
                                                    text(plain, grid.direction.col(1)) +
                                                    text(plain, grid.direction.col(2))},
                            {"Offset", text(plain, grid.origin)},
                            {"ElementSpacing", text(plain, grid.spacing)},
                            {"ElementDataFile", "LOCAL"}}) +
                   bytes_of(data));
  Nifti nifti;
  nifti.dim = {3, 20, 16, 12, 1, 1, 1, 1};
  nifti.pixdim = {1, 0.5, 0.7, 1.1, 1, 1, 1, 1};
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column)
      nifti.srow[static_cast<std::size_t>(4 * row + column)] = ras_step(row, column);
    nifti.srow[static_cast<std::size_t>(4 * row + 3)] = ras[row] * grid.origin[row];
  }
  put("s.nii", nifti.file(data));
  const Eigen::Quaterniond turn(Mat3(ras.asDiagonal() * grid.direction));
  const double sign = turn.w() < 0 ? -1.0 : 1.0;
  nifti.sform_code = 0;
  nifti.qform_code = 1;
  nifti.quatern = {sign * turn.x(), sign * turn.y(), sign * turn.z()};
  nifti.qoffset = {-grid.origin[0], -grid.origin[1], grid.origin[2]};
  put("q.nii", nifti.file(data));
  for (const char* name : {"lps.nrrd", "ras.nrrd", "a.mha", "s.nii", "q.nii"}) {
    const ImageVolume image = read_image(here / name).volume;
    const auto brightest = std::max_element(image.voxels.begin(), image.voxels.end()) - image.voxels.begin();
    const std::int64_t i = brightest % 20, j = brightest / 20 % 16, k = brightest / 320;
    const Vec3 found =
        image.geometry.world(Vec3(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)));
    EXPECT_LT((found - landmark).norm(), 1e-4) << name;
  }
}

/// The voxels and then 256 MB of zeros, packed bit by bit so that this program never holds them.
std::string bomb_behind(const std::string& bytes) {
  z_stream z{};
  EXPECT_EQ(deflateInit2(&z, 1, Z_DEFLATED, 31, 8, Z_DEFAULT_STRATEGY), Z_OK);
  std::string result, zeros(std::size_t{1} << 20, '\0'), room(std::size_t{1} << 20, '\0');
  const auto add = [&](const std::string& part, int flush) {
    z.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(part.data()));
    z.avail_in = static_cast<uInt>(part.size());
    z.next_out = reinterpret_cast<Bytef*>(room.data());
    z.avail_out = static_cast<uInt>(room.size());
    deflate(&z, flush);
    result.append(room, 0, room.size() - z.avail_out);
  };
  add(bytes, Z_NO_FLUSH);
  for (int i = 0; i < 256; ++i) add(zeros, i == 255 ? Z_FINISH : Z_NO_FLUSH);
  deflateEnd(&z);
  return result;
}

TEST_F(BadInput, ABombStopsAtTheHeadersSize) {
  // Read as if the rest were not there, and said so.
  const std::string bomb = bomb_behind(bytes_of(voxels));
  ASSERT_LT(bomb.size(), 2000000U);
  put("a.nrrd", nrrd_header({{"encoding", "gzip"}}) + bomb);
  const long before = peak_kilobytes();
  const auto image = read_image(here / "a.nrrd");
  EXPECT_LT(peak_kilobytes() - before, 20000);
  EXPECT_EQ(image.volume.voxels, voxels);
  ASSERT_EQ(image.header.warnings.size(), 1U);
  EXPECT_NE(image.header.warnings[0].find("more data than the header announces"), std::string::npos);
}

/// Makes the German locale in a folder of its own and sets it for the process; nothing where that is not
/// possible.
class GermanLocale {
 public:
  GermanLocale() {
    const char* was = std::setlocale(LC_ALL, nullptr);
    old_ = was ? was : "C";
    const fs::path folder = ostia::testing::temporary_folder("locale");
    const std::string make =
        "localedef -i de_DE -f UTF-8 '" + (folder / "de_DE.UTF-8").string() + "' > /dev/null 2>&1";
    if (!std::setlocale(LC_ALL, "de_DE.UTF-8") && std::system(make.c_str()) == 0) {
      ::setenv("LOCPATH", folder.c_str(), 1);
      std::setlocale(LC_ALL, "de_DE.UTF-8");
    }
    set_ = std::string(std::localeconv()->decimal_point) == ",";
    if (set_) std::locale::global(std::locale("de_DE.UTF-8"));
  }
  ~GermanLocale() {
    std::locale::global(std::locale::classic());
    std::setlocale(LC_ALL, old_.c_str());
    ::unsetenv("LOCPATH");
  }
  bool set() const { return set_; }

 private:
  std::string old_;
  bool set_ = false;
};

TEST_F(BadInput, GermanLocaleChangesNothing) {
  ImageVolume image = patterned<std::int16_t>(oblique_grid(12, 11, 10));
  for (const char* name : {"c.nrrd", "c.mha"}) write_image(here / name, image);
  std::string text = "1.5 -2.25 1234567.5 0.125";
  const std::string small = nrrd_header({{"sizes", "4 1 1"},
                                         {"type", "float"},
                                         {"encoding", "ascii"},
                                         {"space directions", "(1.5,0,0) (0,2.5,0) (0,0,3.5)"}}) +
                            text;
  put("text.nrrd", small);
  const GermanLocale german;
  if (!german.set()) GTEST_SKIP() << "no German locale, and none can be made here";
  for (const char* name : {"c.nrrd", "c.mha"}) {
    EXPECT_TRUE(same_grid(read_image(here / name).volume.geometry, image.geometry, 1e-9)) << name;
    write_image(here / (std::string("de-") + name), image);
    EXPECT_EQ(read_bytes(here / name), read_bytes(here / (std::string("de-") + name))) << name;
  }
  const FloatVolume floats = read_float_image(here / "text.nrrd").volume;
  EXPECT_EQ(floats.geometry.spacing, Vec3(1.5, 2.5, 3.5));
  EXPECT_EQ(floats.voxels, (std::vector<float>{1.5F, -2.25F, 1234567.5F, 0.125F}));
}

TEST_F(BadInput, SpacesUmlautsAndLongPaths) {
  const ImageVolume image = patterned<std::int16_t>(oblique_grid(4, 3, 2));
  const std::string long_name(100, 'n');
  const fs::path folder =
      here / "Herz \xC3\xBC \xE5\xBF\x83 (a b)" / std::string(100, 'x') / std::string(100, 'y');
  fs::create_directories(folder);
  ASSERT_GT((folder / (long_name + ".nrrd")).string().size(), 250U);
  for (const std::string& stem : {long_name, std::string(250, 'z'), std::string("\xC3\xA4 b")})
    for (const char* extension : {".nrrd", ".mha", ".mhd"}) {
      const fs::path path = folder / (stem + extension);
      write_image(path, image);
      EXPECT_EQ(read_image(path).volume.voxels, image.voxels) << path;
    }
}

}  // namespace
}  // namespace ostia::imaging
