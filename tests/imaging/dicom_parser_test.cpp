#include "dicom_parser.h"

#include "dicom_writer.h"

#include <gtest/gtest.h>

#include <random>

namespace ostia::imaging {
namespace {

using testing::CtSlice;
using testing::DicomWriter;
using testing::Encoding;

DicomHeader header_of(const std::string& bytes) {
  auto file = parse_dicom(DicomSource::memory(bytes));
  EXPECT_TRUE(file.has_value());
  return file ? file->header : DicomHeader{};
}

void expect_slice(const DicomHeader& h) {
  EXPECT_EQ(h.damage, "");
  EXPECT_EQ(h.modality, "CT");
  EXPECT_EQ(h.series_uid, "1.2.3");
  EXPECT_EQ(h.rows, 4);
  EXPECT_EQ(h.columns, 5);
  EXPECT_EQ(h.bits_allocated, 16);
  EXPECT_EQ(h.bits_stored, 12);
  EXPECT_EQ(h.high_bit, 11);
  ASSERT_EQ(h.frames.size(), 1u);
  ASSERT_TRUE(h.frames[0].position && h.frames[0].orientation && h.frames[0].pixel_spacing);
  EXPECT_EQ(*h.frames[0].position, geometry::Vec3(1.5, -2, 30));
  EXPECT_EQ((*h.frames[0].orientation)[4], 1.0);
  EXPECT_EQ((*h.frames[0].pixel_spacing)[0], 0.5);
  EXPECT_EQ(h.frames[0].intercept, -1024.0);
  EXPECT_TRUE(h.has_pixels);
  EXPECT_FALSE(h.encapsulated);
  EXPECT_EQ(h.pixel_length, 40u);
  EXPECT_EQ(h.pixel_available, 40u);
}

CtSlice slice_in(Encoding encoding, const char* syntax) {
  CtSlice slice;
  slice.encoding = encoding;
  slice.transfer_syntax = syntax;
  slice.position = "1.5\\-2\\30";
  return slice;
}

TEST(DicomParser, ExplicitLittleEndian) {
  expect_slice(header_of(slice_in(Encoding::explicit_little, "1.2.840.10008.1.2.1").file()));
}
TEST(DicomParser, ImplicitLittleEndian) {
  expect_slice(header_of(slice_in(Encoding::implicit_little, "1.2.840.10008.1.2").file()));
}
TEST(DicomParser, ExplicitBigEndian) {
  const DicomHeader h = header_of(slice_in(Encoding::explicit_big, "1.2.840.10008.1.2.2").file());
  expect_slice(h);
  EXPECT_TRUE(h.big_endian);
}

TEST(DicomParser, WithoutPreambleAndMeta) {
  for (const auto& [encoding, syntax] : {std::pair{Encoding::explicit_little, "1.2.840.10008.1.2.1"},
                                         std::pair{Encoding::implicit_little, "1.2.840.10008.1.2"},
                                         std::pair{Encoding::explicit_big, "1.2.840.10008.1.2.2"}}) {
    const CtSlice slice = slice_in(encoding, syntax);
    const DicomHeader bare = header_of(slice.data_set());
    expect_slice(bare);
    EXPECT_EQ(bare.transfer_syntax, syntax);
    expect_slice(header_of(slice.file().substr(132)));
    expect_slice(header_of(std::string(128, '\0') + "DICM" + slice.data_set()));
  }
}

TEST(DicomParser, ImplicitThatIsReallyExplicit) {
  expect_slice(header_of(slice_in(Encoding::explicit_little, "1.2.840.10008.1.2").file()));
}

TEST(DicomParser, WhatIsNotDicomIsToldApart) {
  EXPECT_FALSE(parse_dicom(DicomSource::memory("")));
  EXPECT_FALSE(parse_dicom(DicomSource::memory("DICM")));
  EXPECT_FALSE(parse_dicom(DicomSource::memory(std::string(5000, '\0'))));
  EXPECT_FALSE(parse_dicom(DicomSource::memory("NRRD0004\ntype: short\n")));
  std::mt19937 random(1);
  std::string noise(4096, '\0');
  for (char& c : noise) c = static_cast<char>(random());
  EXPECT_FALSE(parse_dicom(DicomSource::memory(noise)));
}

TEST(DicomParser, TheMagicWordAloneIsDamage) {
  const DicomHeader h = header_of(std::string(128, '\0') + "DICM" + std::string("\x08\x00\x10", 3));
  EXPECT_NE(h.damage, "");
  EXPECT_FALSE(h.is_image());
}

TEST(DicomParser, SequencesAreWalkedWhateverTheirForm) {
  for (const bool defined : {false, true}) {
    for (const Encoding encoding :
         {Encoding::explicit_little, Encoding::implicit_little, Encoding::explicit_big}) {
      DicomWriter w(encoding);
      w.text(0x00080016u, "UI", "1.2");
      // Attributes inside a sequence that is no functional group are another image's.
      w.sequence(0x00082112u, {[&](DicomWriter& item) {
                   item.u16(0x00280010u, 77);
                   item.sequence(0x00409999u,
                                 {[](DicomWriter&) {}, [](DicomWriter& x) { x.u16(0x00280011u, 7); }},
                                 defined);
                 }},
                 defined);
      w.u16(0x00280010u, 4);
      const DicomHeader h = header_of(w.data_set());
      EXPECT_EQ(h.damage, "");
      EXPECT_EQ(h.rows, 4);
      EXPECT_EQ(h.columns, 0);
    }
  }
}

TEST(DicomParser, FunctionalGroupsOfEnhancedImages) {
  DicomWriter w;
  w.text(0x00080016u, "UI", "1.2.840.10008.5.1.4.1.1.2.1");
  w.text(0x00280008u, "IS", "2");
  w.u16(0x00280010u, 1);
  w.u16(0x00280011u, 1);
  const auto shared = [](DicomWriter& item) {
    item.sequence(0x00289110u, {[](DicomWriter& m) { m.text(0x00280030u, "DS", "0.4\\0.3"); }}, true);
    item.sequence(0x00289145u, {[](DicomWriter& m) {
                    m.text(0x00281052u, "DS", "-1000");
                    m.text(0x00281053u, "DS", "2");
                  }});
    item.sequence(0x00209116u, {[](DicomWriter& m) { m.text(0x00200037u, "DS", "0\\1\\0\\0\\0\\-1"); }},
                  true);
  };
  const auto frame = [](const char* position, double percent) {
    return [position, percent](DicomWriter& item) {
      item.sequence(0x00189118u, {[percent](DicomWriter& m) { m.f64(0x00209241u, percent); }});
      // The position of a source image must not be taken for the frame's own.
      item.sequence(0x00089124u, {[](DicomWriter& m) { m.text(0x00200032u, "DS", "9\\9\\9"); }});
      item.sequence(0x00209113u, {[position](DicomWriter& m) { m.text(0x00200032u, "DS", position); }}, true);
    };
  };
  w.sequence(0x52009229u, {shared});
  w.sequence(0x52009230u, {frame("1\\2\\3", 40.0), frame("1\\2\\4", 75.0)}, true);
  w.element(0x7FE00010u, "OW", "abcd");
  const DicomHeader h = header_of(w.data_set());
  EXPECT_EQ(h.damage, "");
  ASSERT_EQ(h.frames.size(), 2u);
  EXPECT_EQ(*h.frames[0].position, geometry::Vec3(1, 2, 3));
  EXPECT_EQ(*h.frames[1].position, geometry::Vec3(1, 2, 4));
  EXPECT_EQ(h.frames[0].cardiac_percent, 40.0);
  EXPECT_EQ(h.frames[1].cardiac_percent, 75.0);
  for (const DicomFrame& f : h.frames) {
    EXPECT_EQ((*f.pixel_spacing)[1], 0.3);
    EXPECT_EQ((*f.orientation)[5], -1.0);
    EXPECT_EQ(f.slope, 2.0);
    EXPECT_EQ(f.intercept, -1000.0);
  }
}

TEST(DicomParser, PixelDataCutShortAreCounted) {
  std::string bytes = CtSlice().file();
  bytes.resize(bytes.size() - 7);
  const DicomHeader h = header_of(bytes);
  EXPECT_EQ(h.pixel_length, 40u);
  EXPECT_EQ(h.pixel_available, 33u);
}

TEST(DicomParser, ElementOfFourGigabytesIsRefused) {
  for (const Encoding encoding : {Encoding::explicit_little, Encoding::implicit_little}) {
    DicomWriter w(encoding);
    w.text(0x00080016u, "UI", "1.2.840.10008.5.1.4.1.1.2");
    w.element(0x00091010u, "OB", "short", 0xFFFFFFFEll);
    w.u16(0x00280010u, 4);
    const DicomHeader h = header_of(w.data_set());
    EXPECT_NE(h.damage.find("(0009,1010) is said to have 4294967294 bytes"), std::string::npos) << h.damage;
  }
}

TEST(DicomParser, DeepSequencesAreRefused) {
  DicomWriter w;
  w.text(0x00080016u, "UI", "1.2.840.10008.5.1.4.1.1.2");
  std::string deep;
  for (int i = 0; i < 200'000; ++i) {
    DicomWriter level;
    level.element(0x00082112u, "SQ", "", 0xFFFFFFFFll);
    deep += level.data_set() + std::string("\xFE\xFF\x00\xE0\xFF\xFF\xFF\xFF", 8);
  }
  w.raw(deep);
  const DicomHeader h = header_of(w.data_set());
  EXPECT_NE(h.damage.find("nested deeper than 64"), std::string::npos) << h.damage;
}

TEST(DicomParser, CommaInSpacingIsDamage) {
  CtSlice slice;
  slice.pixel_spacing = "0,5\\0,5";
  EXPECT_NE(header_of(slice.file()).damage.find("PixelSpacing"), std::string::npos);
}

TEST(DicomParser, FragmentsAndOffsetTable) {
  CtSlice slice;
  slice.transfer_syntax = "1.2.840.10008.1.2.5";
  slice.streams = {"first!", "second", "odd"};
  const std::string bytes = slice.file();
  const DicomHeader h = header_of(bytes);
  EXPECT_EQ(h.damage, "");
  EXPECT_TRUE(h.encapsulated);
  ASSERT_EQ(h.fragments.size(), 3u);
  EXPECT_EQ(bytes.substr(h.fragments[1].offset, h.fragments[1].length), "second");
  EXPECT_NE(header_of(bytes.substr(0, bytes.size() - 10)).damage, "");
}

TEST(DicomParser, MoreFramesThanBytesAreRefusedBeforeTheyAreHeld) {
  CtSlice slice;
  slice.frames = "90000";
  const DicomHeader h = header_of(slice.file());
  EXPECT_NE(h.damage, "");
  EXPECT_LE(h.frames.size(), 1u);
}

TEST(DicomParser, NothingOfThePatientIsKept) {
  const DicomHeader h = header_of(CtSlice().file());
  for (const std::string& text :
       {h.description, h.image_type, h.modality, h.series_uid, h.sop_class, h.damage}) {
    EXPECT_EQ(text.find("DOE"), std::string::npos);
  }
}

TEST(DicomParser, MutatedFilesNeverCrash) {
  DicomWriter w;
  w.text(0x00280008u, "IS", "1");
  w.sequence(0x52009229u, {[](DicomWriter& item) {
               item.sequence(0x00289110u, {[](DicomWriter& m) { m.text(0x00280030u, "DS", "0.4\\0.3"); }},
                             true);
             }});
  CtSlice packed;
  packed.transfer_syntax = "1.2.840.10008.1.2.5";
  packed.streams = {"first!", "second"};
  const std::string seeds[] = {CtSlice().file(),
                               slice_in(Encoding::implicit_little, "1.2.840.10008.1.2").file(),
                               slice_in(Encoding::explicit_big, "1.2.840.10008.1.2.2").file(), packed.file(),
                               testing::part10("1.2.840.10008.1.2.1", w.data_set())};
  std::mt19937 random(20240607);
  std::size_t parsed = 0, damaged = 0;
  for (int round = 0; round < 3000; ++round) {
    std::string bytes = seeds[static_cast<std::size_t>(round) % std::size(seeds)];
    const int changes = 1 + static_cast<int>(random() % 8);
    for (int c = 0; c < changes; ++c) {
      // The preamble is of no account: change what follows it.
      const std::size_t at = 132 + random() % (bytes.size() - 132);
      bytes[at] = static_cast<char>(random() % 4 == 0 ? 0xFF : random() % 256);
    }
    if (random() % 4 == 0) bytes.resize(132 + random() % (bytes.size() - 132));
    const auto file = parse_dicom(DicomSource::memory(bytes));
    ASSERT_TRUE(file.has_value());
    ++parsed;
    damaged += file->header.damage.empty() ? 0 : 1;
    if (file->header.damage.empty()) {
      EXPECT_EQ(file->header.frames.size(), static_cast<std::size_t>(file->header.frame_count));
    }
  }
  EXPECT_EQ(parsed, 3000u);
  EXPECT_GT(damaged, 100u);  // the changes do reach the parser
}

}  // namespace
}  // namespace ostia::imaging
