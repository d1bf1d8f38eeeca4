#include "dicom_decode.h"
#include "dicom_writer.h"

#include "ostia/core/error.h"

#include <gdcmImage.h>
#include <gdcmImageChangeTransferSyntax.h>
#include <gdcmSequenceOfFragments.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace ostia::imaging {
namespace {

using testing::CtSlice;

constexpr int kColumns = 64, kRows = 48;

/// A smooth picture with some noise; twelve bits.
int picture(int i, int j) {
  return 1200 + static_cast<int>(800.0 * std::sin(0.2 * i) * std::cos(0.15 * j)) + (i * 7 + j * 13) % 5;
}

/// A slice compressed by GDCM. `is_signed` is what the stream says.
CtSlice compressed(const char* syntax, bool is_signed, const std::function<int(int, int)>& value = picture) {
  CtSlice slice;
  slice.rows = kRows;
  slice.columns = kColumns;
  slice.bits_stored = 16;
  slice.high_bit = 15;
  slice.value = value;
  slice.is_signed = is_signed ? 1 : 0;

  gdcm::SmartPointer<gdcm::Image> image = new gdcm::Image;
  image->SetNumberOfDimensions(2);
  image->SetDimension(0, kColumns);
  image->SetDimension(1, kRows);
  image->SetPixelFormat(gdcm::PixelFormat(1, 16, 16, 15, is_signed ? 1 : 0));
  image->SetPhotometricInterpretation(gdcm::PhotometricInterpretation::MONOCHROME2);
  image->SetTransferSyntax(gdcm::TransferSyntax::ExplicitVRLittleEndian);
  gdcm::DataElement pixels(gdcm::Tag(0x7fe0, 0x0010));
  const std::string raw = slice.raw_pixels();
  pixels.SetByteValue(raw.data(), gdcm::VL(static_cast<std::uint32_t>(raw.size())));
  image->SetDataElement(pixels);
  gdcm::ImageChangeTransferSyntax change;
  change.SetTransferSyntax(gdcm::TransferSyntax::GetTSType(syntax));
  change.SetInput(*image);
  EXPECT_TRUE(change.Change());
  const gdcm::SequenceOfFragments* fragments = change.GetOutput().GetDataElement().GetSequenceOfFragments();
  std::string stream;
  for (unsigned n = 0; fragments && n < fragments->GetNumberOfFragments(); ++n) {
    const gdcm::ByteValue* bytes = fragments->GetFragment(n).GetByteValue();
    stream.append(bytes->GetPointer(), bytes->GetLength());
  }
  slice.transfer_syntax = syntax;
  slice.streams = {stream};
  return slice;
}

std::vector<std::int32_t> decoded_codec(const CtSlice& slice) {
  auto file = parse_dicom(DicomSource::memory(slice.file()));
  if (!file) throw InvalidInput("not parsed");
  return decode_frame(*file, 0);
}

std::int32_t worst_difference(const std::vector<std::int32_t>& voxels,
                              const std::function<int(int, int)>& value) {
  std::int32_t largest = 0;
  for (int j = 0; j < kRows; ++j) {
    for (int i = 0; i < kColumns; ++i) {
      largest = std::max(largest, std::abs(voxels[static_cast<std::size_t>(i + kColumns * j)] - value(i, j)));
    }
  }
  return largest;
}

constexpr const char* kLossless[] = {"1.2.840.10008.1.2.4.57", "1.2.840.10008.1.2.4.70",
                                     "1.2.840.10008.1.2.4.80", "1.2.840.10008.1.2.4.90",
                                     "1.2.840.10008.1.2.5"};

TEST(DicomCodecs, LosslessOnesGiveEveryValueBack) {
  for (const char* syntax : kLossless)
    EXPECT_EQ(worst_difference(decoded_codec(compressed(syntax, false)), picture), 0) << syntax;
}

TEST(DicomCodecs, NegativeValuesToo) {
  const auto value = [](int i, int j) { return picture(i, j) - 1500; };
  for (const char* syntax : kLossless)
    EXPECT_EQ(worst_difference(decoded_codec(compressed(syntax, true, value)), value), 0) << syntax;
}

TEST(DicomCodecs, TheHeaderDecidesOnTheSignWhereJpeg2000SaysOtherwise) {
  const auto value = [](int i, int j) { return picture(i, j) - 1500; };
  // The stream holds two's complement as unsigned words; the header says they are signed.
  CtSlice slice = compressed("1.2.840.10008.1.2.4.90", false, value);
  slice.is_signed = 1;
  EXPECT_EQ(worst_difference(decoded_codec(slice), value), 0);
}

TEST(DicomCodecs, StreamsCutShortAreRefused) {
  for (const char* syntax : kLossless) {
    CtSlice slice = compressed(syntax, false);
    const std::string whole = slice.streams.front();
    for (const double part : {0.02, 0.3, 0.7, 0.98}) {
      slice.streams = {whole.substr(
          0, static_cast<std::size_t>(part * static_cast<double>(whole.size())) & ~std::size_t{1})};
      EXPECT_THROW(decoded_codec(slice), InvalidInput) << syntax << " at " << part;
    }
  }
}

TEST(DicomCodecs, NoiseInsideAStreamIsRefused) {
  // A picture of noise: streams long enough that a stretch of other noise breaks a rule of the format.
  const auto noise = [](int i, int j) {
    return static_cast<int>((i * 7919u + j * 104729u) * 2654435761u >> 20);
  };
  for (const char* syntax : {"1.2.840.10008.1.2.4.70", "1.2.840.10008.1.2.4.80", "1.2.840.10008.1.2.4.90"}) {
    CtSlice slice = compressed(syntax, false, noise);
    const std::string whole = slice.streams.front();
    ASSERT_GT(whole.size(), 3000u) << syntax;
    std::mt19937 random(5);
    for (const bool lost : {false, true}) {
      std::string& stream = slice.streams.front();
      stream = whole;
      for (std::size_t i = stream.size() / 4; i < stream.size() - 100; ++i) {
        stream[i] = lost ? '\0' : static_cast<char>(random());
      }
      EXPECT_THROW(decoded_codec(slice), InvalidInput) << syntax << (lost ? ", a block lost" : ", noise");
    }
  }
}

TEST(DicomCodecs, StreamsOfAnotherSizeAreRefused) {
  for (const char* syntax : kLossless) {
    CtSlice slice = compressed(syntax, false);
    slice.rows = kRows * 2;
    EXPECT_THROW(decoded_codec(slice), InvalidInput) << syntax;
  }
}

}  // namespace
}  // namespace ostia::imaging
