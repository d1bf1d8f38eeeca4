#include "ostia/imaging/dicom_dataset.h"

#include "dicom_writer.h"
#include "shared_data.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ostia::imaging {
namespace {

using ::testing::HasSubstr;

std::filesystem::path dataset_file(const std::string& bytes) {
  static const std::filesystem::path folder = ostia::testing::temporary_folder("dataset");
  const std::filesystem::path file = folder / "object.dcm";
  core::write_file(file, bytes);
  return file;
}

DicomDataset small_dataset() {
  DicomDataset d;
  d.set_text(0x00080016, "UI", "1.2.840.10008.5.1.4.1.1.7");
  d.set_text(0x00080018, "UI", "1.2.3");
  d.set_text(0x00100010, "PN", "DOE^JANE");
  d.set_u16(0x00280010, {3});
  d.set_decimals(0x00280030, {0.5, 0.25});
  DicomDataset& item = d.add_item(0x00081140);
  item.set_text(0x00081155, "UI", "1.2.3.4");
  item.add_item(0x0040A170).set_text(0x00080104, "LO", "deep");
  d.add_item(0x00081140).set_text(0x00081155, "UI", "1.2.3.5");
  d.set_bytes(0x7FE00010, "OB", std::string("\1\2\3", 3));
  return d;
}

void expect_small(const DicomDataset& d) {
  EXPECT_EQ(d.text(0x00100010), "DOE^JANE");
  EXPECT_EQ(*d.u16(0x00280010), 3);
  EXPECT_EQ(d.decimals(0x00280030), (std::vector<double>{0.5, 0.25}));
  ASSERT_EQ(d.items(0x00081140).size(), 2U);
  EXPECT_EQ(d.items(0x00081140)[1].text(0x00081155), "1.2.3.5");
  EXPECT_EQ(d.item(0x00081140)->item(0x0040A170)->text(0x00080104), "deep");
  EXPECT_EQ(d.find(0x7FE00010)->value, std::string("\1\2\3\0", 4));
}

TEST(DicomDatasetTree, ComesBackFromItsFile) {
  const DicomObject read = require_dicom_object(dataset_file(dicom_file(small_dataset())));
  expect_small(read.data);
  EXPECT_EQ(read.meta.text(0x00020010), "1.2.840.10008.1.2.1");
  EXPECT_EQ(dicom_file(read), dicom_file(small_dataset()));
}

TEST(DicomDatasetTree, ImplicitVrIsReadTooWithItsSequences) {
  const std::string bytes = small_dataset().encoded(false);
  const DicomObject read = require_dicom_object(dataset_file(std::string(128, '\0') + "DICM" + bytes));
  expect_small(read.data);
}

TEST(DicomDatasetTree, SequencesOfUndefinedLengthAndBigEndianAreRead) {
  for (const auto encoding :
       {ostia::testing::Encoding::explicit_little, ostia::testing::Encoding::explicit_big}) {
    ostia::testing::DicomWriter w(encoding);
    w.text(0x00080016, "UI", "1.2");
    w.text(0x00080018, "UI", "1.2.3");
    w.sequence(0x00081140, {[](ostia::testing::DicomWriter& item) { item.u16(0x00280010, 515); }});
    const std::string syntax =
        encoding == ostia::testing::Encoding::explicit_big ? "1.2.840.10008.1.2.2" : "1.2.840.10008.1.2.1";
    const DicomObject read = require_dicom_object(dataset_file(ostia::testing::part10(syntax, w.data_set())));
    ASSERT_NE(read.data.item(0x00081140), nullptr);
    EXPECT_EQ(*read.data.item(0x00081140)->u16(0x00280010), 515);
  }
}

TEST(DicomDatasetTree, EveryCutIsRefused) {
  const std::string whole = dicom_file(small_dataset());
  for (std::size_t length = 133; length < whole.size(); ++length) {
    const auto file = dataset_file(whole.substr(0, length));
    try {
      const auto read = read_dicom_object(file);
      // A cut between two elements is a shorter object.
      ASSERT_TRUE(read);
      EXPECT_FALSE(read->data.has(0x7FE00010));
    } catch (const InvalidInput& error) {
      EXPECT_THAT(error.what(), HasSubstr("damaged"));
    }
  }
}

TEST(DicomDatasetTree, DepthAndNumberAreBounded) {
  DicomDataset deep;
  for (int i = 0; i < 40; ++i) {
    DicomDataset outer;
    outer.add_item(0x00081140) = deep;
    deep = outer;
  }
  deep.set_text(0x00080016, "UI", "1.2");
  deep.set_text(0x00080018, "UI", "1.2.3");
  const auto message = [](const std::string& bytes, const DicomObjectOptions& options) {
    try {
      read_dicom_object(dataset_file(bytes), options);
    } catch (const InvalidInput& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(message(dicom_file(deep), {}), HasSubstr("nested deeper than 32"));
  EXPECT_EQ(message(dicom_file(deep), {.deepest = 64}), "");
  EXPECT_THAT(message(dicom_file(small_dataset()), {.most_elements = 5}), HasSubstr("more than 5 elements"));
}

TEST(DicomDatasetTree, PixelsAreLeftOutWhereNobodyAsksForThem) {
  const DicomObject read = require_dicom_object(dataset_file(dicom_file(small_dataset())), {.pixels = false});
  EXPECT_TRUE(read.data.find(0x7FE00010)->left_out);
  EXPECT_EQ(read.data.find(0x7FE00010)->declared_bytes, 4U);
  EXPECT_THROW(dicom_file(read), InvalidInput);  // nothing is written without its pixels
}

TEST(DicomDatasetTree, CompressedPixelsComeBackByteForByte) {
  DicomDataset d = small_dataset();
  std::string fragments("\xfe\xff\x00\xe0\x00\x00\x00\x00\xfe\xff\x00\xe0\x04\x00\x00\x00RLE!", 20);
  d.set(0x7FE00010, {"OB", fragments, {}, true});
  const DicomObject read = require_dicom_object(dataset_file(dicom_file(d)));
  EXPECT_TRUE(read.data.find(0x7FE00010)->encapsulated);
  EXPECT_EQ(read.data.find(0x7FE00010)->value, fragments);
}

TEST(DicomDatasetTree, NoValueIsTakenForWhatItIsNot) {
  DicomDataset d;
  EXPECT_EQ(d.text(0x00100010), "");
  EXPECT_FALSE(d.u16(0x00280010));
  EXPECT_TRUE(d.items(0x00081140).empty());
  d.set_text(0x00280030, "DS", "0,5\\1");
  EXPECT_TRUE(d.decimals(0x00280030).empty());
  EXPECT_FALSE(d.decimal(0x00280030));
  EXPECT_DOUBLE_EQ(*d.decimal(0x00280030, 1), 1.0);
  d.set_text(0x00280008, "IS", "3x");
  EXPECT_FALSE(d.integer(0x00280008));
  d.set_bytes(0x00280010, "US", "");
  EXPECT_FALSE(d.u16(0x00280010));
  EXPECT_THROW(d.set_text(0x00100010, "PN", std::string(70'000, 'a')), InvalidInput);
}

TEST(DicomDatasetTree, TheSopClassIsReadFromTheBeginning) {
  EXPECT_EQ(dicom_sop_class(dataset_file(dicom_file(small_dataset()).substr(0, 320))),
            "1.2.840.10008.5.1.4.1.1.7");
  EXPECT_EQ(dicom_sop_class(dataset_file("no DICOM")), "");
}

}  // namespace
}  // namespace ostia::imaging
