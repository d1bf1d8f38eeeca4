#include "dicom_decode.h"

#include "dicom_writer.h"
#include "shared_data.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/imaging/dicom.h"

#include <gtest/gtest.h>

#include <cstring>

namespace ostia::imaging {
namespace {

using testing::CtSlice;
using testing::Encoding;

std::vector<std::int32_t> decoded(const CtSlice& slice, std::int64_t frame = 0) {
  auto file = parse_dicom(DicomSource::memory(slice.file()));
  if (!file) throw InvalidInput("not parsed");
  return decode_frame(*file, frame);
}

TEST(DecodeFrame, NativeInEveryByteOrder) {
  for (const auto& [encoding, syntax] : {std::pair{Encoding::explicit_little, "1.2.840.10008.1.2.1"},
                                         std::pair{Encoding::implicit_little, "1.2.840.10008.1.2"},
                                         std::pair{Encoding::explicit_big, "1.2.840.10008.1.2.2"}}) {
    CtSlice slice;
    slice.encoding = encoding;
    slice.transfer_syntax = syntax;
    slice.value = [](int i, int j) { return 300 * j + i; };
    const auto voxels = decoded(slice);
    ASSERT_EQ(voxels.size(), 20u);
    EXPECT_EQ(voxels[0], 0);
    EXPECT_EQ(voxels[4], 4);
    EXPECT_EQ(voxels[5 * 3 + 2], 902);
  }
}

TEST(DecodeFrame, SignIsExtendedFromTheBitsStoredAndOverlaysAreMasked) {
  CtSlice slice;
  slice.is_signed = 1;
  // Twelve bits are stored; the upper four hold overlay planes.
  slice.value = [](int i, int) { return i == 0 ? 0xF800 : i == 1 ? 0x7FFF : i == 2 ? 0xA7FF : 5; };
  const auto voxels = decoded(slice);
  EXPECT_EQ(voxels[0], -2048);
  EXPECT_EQ(voxels[1], -1);
  EXPECT_EQ(voxels[2], 2047);
  EXPECT_EQ(voxels[3], 5);
  slice.is_signed = 0;
  EXPECT_EQ(decoded(slice)[0], 2048);
  EXPECT_EQ(decoded(slice)[1], 4095);
}

TEST(DecodeFrame, HighBitMovesTheValue) {
  CtSlice slice;
  slice.high_bit = 15;
  slice.value = [](int i, int) { return (100 + i) << 4 | 9; };
  EXPECT_EQ(decoded(slice)[3], 103);
}

TEST(DecodeFrame, OneAndFourBytesAPixel) {
  CtSlice slice;
  slice.bits_allocated = 8;
  slice.bits_stored = 8;
  slice.high_bit = 7;
  slice.value = [](int i, int j) { return 50 * j + i + 40; };
  EXPECT_EQ(decoded(slice)[19], 194);
  slice.bits_allocated = 32;
  slice.bits_stored = 32;
  slice.high_bit = 31;
  slice.is_signed = 1;
  slice.value = [](int i, int) { return -100'000 * i; };
  EXPECT_EQ(decoded(slice)[4], -400'000);
}

TEST(DecodeFrame, EachFrameOfSeveral) {
  CtSlice slice;
  slice.frames = "2";
  slice.pixels = CtSlice().raw_pixels();
  slice.value = [](int i, int) { return i; };
  CtSlice second;
  second.value = [](int i, int) { return 7 + i; };
  slice.pixels += second.raw_pixels();
  EXPECT_EQ(decoded(slice, 0)[0], 1024);
  EXPECT_EQ(decoded(slice, 1)[4], 11);
  EXPECT_THROW(decoded(slice, 2), InvalidInput);
}

TEST(DecodeFrame, RefusesWhatTheHeaderShowsToBeWrong) {
  CtSlice slice;
  slice.pixels = std::string(38, 'x');
  EXPECT_THROW(decoded(slice), InvalidInput);
  slice = CtSlice();
  slice.pixel_spacing = "0,5\\0,5";
  EXPECT_THROW(decoded(slice), InvalidInput);
}

std::string rle_frame(const std::vector<std::string>& segments) {
  std::string head, body;
  const auto word = [](std::size_t v) {
    std::string w;
    for (int i = 0; i < 4; ++i) w.push_back(static_cast<char>(v >> (8 * i) & 0xFF));
    return w;
  };
  head = word(segments.size());
  for (const std::string& segment : segments) {
    head += word(64 + body.size());
    body += segment;
  }
  head.resize(64, '\0');
  return head + body;
}

TEST(DecodeRle, RunsAndLiterals) {
  // High bytes: 6 times 1. Low bytes: 3 literals, a no-op, 3 times 9.
  const std::string frame =
      rle_frame({std::string("\xFB\x01", 2), std::string("\x02\x05\x06\x07\x80\xFE\x09", 7)});
  EXPECT_EQ(decode_rle(frame, 6, 2), std::string("\x05\x01\x06\x01\x07\x01\x09\x01\x09\x01\x09\x01", 12));
}

TEST(DecodeRle, DamageIsRefused) {
  const std::string good =
      rle_frame({std::string("\xFB\x01", 2), std::string("\x05\x05\x06\x07\x08\x09\x0A", 7)});
  EXPECT_EQ(decode_rle(good, 6, 2).size(), 12u);
  EXPECT_THROW(decode_rle(good.substr(0, good.size() - 2), 6, 2), InvalidInput);  // literals cut short
  EXPECT_THROW(decode_rle(good, 7, 2), InvalidInput);                             // too few pixels
  EXPECT_THROW(decode_rle(good, 5, 2), InvalidInput);                             // a run past the end
  EXPECT_THROW(decode_rle(good, 6, 1), InvalidInput);                             // other number of segments
  EXPECT_THROW(decode_rle(good.substr(0, 60), 6, 2), InvalidInput);
  std::string outside = good;
  outside[8] = '\xFF';  // the second segment begins beyond the frame
  EXPECT_THROW(decode_rle(outside, 6, 2), InvalidInput);
}

TEST(DecodeFrame, RleSlice) {
  CtSlice slice;
  slice.transfer_syntax = "1.2.840.10008.1.2.5";
  slice.rows = 2;
  slice.columns = 3;
  slice.streams = {rle_frame({std::string("\xFB\x01", 2), std::string("\x05\x05\x06\x07\x08\x09\x0A", 7)})};
  const auto voxels = decoded(slice);
  EXPECT_EQ(voxels.front(), 0x105);
  EXPECT_EQ(voxels.back(), 0x10A);
}

TEST(DecodeFrame, DeflatedSliceNeedsItsBytes) {
  CtSlice slice;
  slice.transfer_syntax = "1.2.840.10008.1.2.1.99";  // says deflated and is not
  EXPECT_THROW(decoded(slice), InvalidInput);
}

TEST(StreamInfo, HeadersOfCodestreams) {
  const std::string jpeg(
      "\xFF\xD8\xFF\xE0\x00\x04xx\xFF\xC3\x00\x0B\x0C\x01\x02\x03\x04\x01\x01\x11\x00\xFF\xD9\x00", 24);
  const StreamInfo a = jpeg_info(jpeg);
  EXPECT_EQ(a.rows, 0x0102u);
  EXPECT_EQ(a.columns, 0x0304u);
  EXPECT_EQ(a.precision, 12);
  EXPECT_EQ(a.components, 1);
  EXPECT_TRUE(a.whole);
  EXPECT_FALSE(jpeg_info(jpeg.substr(0, 20)).whole);
  for (std::size_t n = 0; n < jpeg.size(); ++n) (void)jpeg_info(jpeg.substr(0, n));  // reads nothing beyond

  std::string j2k("\xFF\x4F\xFF\x51\x00\x29\x00\x00", 8);
  j2k += std::string("\x00\x00\x02\x01\x00\x00\x01\x80\x00\x00\x00\x01\x00\x00\x00\x00", 16) +
         std::string(16, '\0');
  j2k += std::string("\x00\x01\x8F\x01\x01", 5) + "....\xFF\xD9";
  const StreamInfo b = jpeg_2000_info(j2k);
  EXPECT_EQ(b.columns, 0x200u);
  EXPECT_EQ(b.rows, 0x180u);
  EXPECT_EQ(b.precision, 16);
  EXPECT_TRUE(b.is_signed);
  EXPECT_TRUE(b.whole);
  for (std::size_t n = 0; n < j2k.size(); ++n) (void)jpeg_2000_info(j2k.substr(0, n));
}

TEST(DecodeList, ComesBackWhateverThePaths) {
  const auto path = testing::temporary_folder("list") / "list";
  write_decode_list(path, {{"/a b/\xC3\xBC\nnew line", 0}, {"c", 12}});
  const auto items = read_decode_list(path);
  ASSERT_EQ(items.size(), 2u);
  EXPECT_EQ(items[0].path, "/a b/\xC3\xBC\nnew line");
  EXPECT_EQ(items[1].frame, 12);
  testing::write_bytes(path, "something else");
  EXPECT_THROW(read_decode_list(path), InvalidInput);
}

TEST(DecodeDicomFiles, WritesTheSmallestTypeThatHoldsTheValues) {
  const auto folder = testing::temporary_folder("decode");
  CtSlice narrow, wide;
  wide.bits_stored = 16;
  wide.high_bit = 15;
  wide.value = [](int, int) { return 60'000; };
  narrow.write(folder / "a.dcm");
  wide.write(folder / "b.dcm");
  write_decode_list(folder / "list", {{folder / "a.dcm", 0}, {folder / "b.dcm", 0}});
  ASSERT_EQ(decode_dicom_files(folder / "list", folder / "out"), 0);
  const std::string out = core::read_file(folder / "out");
  ASSERT_EQ(out.size(), 12u + 40u + 12u + 80u);
  SliceRecord record;
  std::memcpy(&record, out.data() + 52, sizeof record);
  EXPECT_EQ(record.voxel_bytes, 4u);
  EXPECT_EQ(record.columns, 5u);
  std::int32_t value = 0;
  std::memcpy(&value, out.data() + 64, sizeof value);
  EXPECT_EQ(value, 60'000);
}

TEST(DecodeDicomFiles, ExitCodeSaysWhatWentWrong) {
  const auto folder = testing::temporary_folder("decode");
  testing::write_bytes(folder / "a.dcm", "not DICOM");
  write_decode_list(folder / "list", {{folder / "a.dcm", 0}});
  EXPECT_EQ(decode_dicom_files(folder / "list", folder / "out"), 3);
  EXPECT_EQ(decode_dicom_files(folder / "absent", folder / "out"), 3);
}

}  // namespace
}  // namespace ostia::imaging
