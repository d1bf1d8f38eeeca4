#include "dicom_syntax.h"

#include "dicom_writer.h"

#include "ostia/core/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ostia::imaging {
namespace {

using testing::CtSlice;
using ::testing::HasSubstr;

std::string fault_of(const std::function<void(CtSlice&)>& change) {
  CtSlice slice;
  change(slice);
  const auto file = parse_dicom(DicomSource::memory(slice.file()));
  EXPECT_TRUE(file.has_value());
  return file ? pixel_fault(file->header) : "not parsed";
}

TEST(PixelFault, NothingIsWrongWithAPlainSlice) {
  EXPECT_EQ(fault_of([](CtSlice&) {}), "");
  EXPECT_EQ(fault_of([](CtSlice& s) { s.photometric = "MONOCHROME1"; }), "");
}

TEST(PixelFault, TooShort) {
  EXPECT_THAT(fault_of([](CtSlice& s) { s.pixels = std::string(38, 'x'); }),
              HasSubstr("40 bytes, 38 are there"));
  EXPECT_THAT(fault_of([](CtSlice& s) { s.frames = "2"; }), HasSubstr("80 bytes, 40 are there"));
}

TEST(PixelFault, LargestSizeWithoutData) {
  const auto largest = [](CtSlice& s) { s.rows = s.columns = 65535; };
  EXPECT_THAT(fault_of([&](CtSlice& s) {
                s.pixels = "x ";
                largest(s);
              }),
              HasSubstr("8589672450 bytes"));
  EXPECT_THAT(fault_of([&](CtSlice& s) {
                s.has_pixels = false;
                largest(s);
              }),
              HasSubstr("no pixel data"));
  EXPECT_THAT(fault_of([&](CtSlice& s) {
                s.transfer_syntax = "1.2.840.10008.1.2.4.90";
                s.streams = {"\xFF\x4F\xFF\x51 tiny"};
                largest(s);
              }),
              HasSubstr("bytes of compressed pixel data cannot be 65535 rows"));
}

TEST(PixelFault, ColourAndOddDepthsAreRefused) {
  EXPECT_THAT(fault_of([](CtSlice& s) { s.photometric = "RGB"; }), HasSubstr("colour"));
  EXPECT_THAT(fault_of([](CtSlice& s) { s.samples = 3; }), HasSubstr("colour"));
  EXPECT_THAT(fault_of([](CtSlice& s) { s.photometric = "PALETTE COLOR"; }), HasSubstr("colour"));
  EXPECT_THAT(fault_of([](CtSlice& s) { s.bits_stored = 20; }), HasSubstr("contradict"));
  EXPECT_THAT(fault_of([](CtSlice& s) { s.high_bit = 3; }), HasSubstr("contradict"));
  EXPECT_THAT(fault_of([](CtSlice& s) {
                s.bits_allocated = 64;
                s.bits_stored = 64;
              }),
              HasSubstr("64 bits a pixel"));
  EXPECT_THAT(fault_of([](CtSlice& s) { s.rows = 0; }), HasSubstr("0 rows"));
}

TEST(PixelFault, TransferSyntaxMustBeKnownAndFitTheData) {
  EXPECT_THAT(fault_of([](CtSlice& s) { s.transfer_syntax = "1.2.840.10008.1.2.4.100"; }),
              HasSubstr("cannot be read"));
  EXPECT_THAT(fault_of([](CtSlice& s) { s.transfer_syntax = "1.2.840.10008.1.2.5"; }),
              HasSubstr("contradicts"));
  EXPECT_THAT(fault_of([](CtSlice& s) { s.streams = {"abcd"}; }), HasSubstr("contradicts"));
}

DicomFile with_streams(const std::vector<std::string>& streams, const char* frames) {
  CtSlice slice;
  slice.transfer_syntax = "1.2.840.10008.1.2.4.70";
  slice.streams = streams;
  slice.frames = frames;
  return *parse_dicom(DicomSource::memory(slice.file()));
}

TEST(FrameStream, PutsFragmentsTogether) {
  DicomFile one = with_streams({"ab", "cd"}, "1");
  EXPECT_EQ(frame_stream(one, 0), "abcd");
  DicomFile each = with_streams({"ab", "cd"}, "2");
  EXPECT_EQ(frame_stream(each, 1), "cd");
  DicomFile marked = with_streams({"\xFF\xD8\xFF-", "12", "\xFF\xD8\xFF+", "34"}, "2");
  EXPECT_EQ(frame_stream(marked, 0), "\xFF\xD8\xFF-12");
  EXPECT_EQ(frame_stream(marked, 1), "\xFF\xD8\xFF+34");
  DicomFile unclear = with_streams({"ab", "cd", "ef"}, "2");
  EXPECT_THROW(frame_stream(unclear, 0), InvalidInput);
}

TEST(FrameStream, OffsetTableTellsFramesApart) {
  DicomFile file = with_streams({"ab", "cd", "ef"}, "2");
  file.header.offset_table = {0, 20};  // two fragments of two bytes with their tags of eight
  EXPECT_EQ(frame_stream(file, 0), "abcd");
  EXPECT_EQ(frame_stream(file, 1), "ef");
}

}  // namespace
}  // namespace ostia::imaging
