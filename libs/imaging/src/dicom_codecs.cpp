#include "dicom_decode.h"
#include "dicom_syntax.h"

#include "ostia/core/error.h"

#include <gdcmFragment.h>
#include <gdcmImage.h>
#include <gdcmSequenceOfFragments.h>
#include <gdcmTrace.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstdio>

namespace ostia::imaging {
namespace {

/// The codecs tell of damage on stderr alone, and go on with made-up pixels. What they say is caught here.
class CaughtStandardError {
 public:
  CaughtStandardError() {
    std::fflush(stderr);
    file_ = ::memfd_create("codec", MFD_CLOEXEC);
    saved_ = ::dup(STDERR_FILENO);
    if (file_ >= 0 && saved_ >= 0) ::dup2(file_, STDERR_FILENO);
  }
  ~CaughtStandardError() {
    release();
    if (saved_ >= 0) ::close(saved_);
    if (file_ >= 0) ::close(file_);
  }
  CaughtStandardError(const CaughtStandardError&) = delete;
  CaughtStandardError& operator=(const CaughtStandardError&) = delete;

  void release() {
    std::fflush(stderr);
    if (saved_ >= 0) ::dup2(saved_, STDERR_FILENO);
  }
  std::string text() const {
    std::string result(64 * 1024, '\0');
    const ssize_t count = file_ < 0 ? 0 : ::pread(file_, result.data(), result.size(), 0);
    result.resize(count > 0 ? static_cast<std::size_t>(count) : 0);
    return result;
  }

 private:
  int file_ = -1, saved_ = -1;
};

gdcm::PixelFormat pixel_format(const StreamInfo& info) {
  const unsigned short allocated = info.precision <= 8 ? 8 : 16;
  const auto precision = static_cast<unsigned short>(info.precision);
  return gdcm::PixelFormat(1, allocated, precision, static_cast<unsigned short>(precision - 1),
                           info.is_signed ? 1 : 0);
}

}  // namespace

std::string decode_stream(const DicomHeader& header, const StreamInfo& info, const std::string& stream) {
  gdcm::Trace::WarningOff();
  gdcm::Fragment fragment;
  fragment.SetByteValue(stream.data(), gdcm::VL(static_cast<std::uint32_t>(stream.size())));
  gdcm::SmartPointer<gdcm::SequenceOfFragments> fragments = new gdcm::SequenceOfFragments;
  fragments->AddFragment(fragment);
  gdcm::DataElement pixels(gdcm::Tag(0x7fe0, 0x0010));
  pixels.SetVR(gdcm::VR::OB);
  pixels.SetValue(*fragments);

  gdcm::Image image;
  image.SetNumberOfDimensions(2);
  image.SetDimension(0, info.columns);
  image.SetDimension(1, info.rows);
  image.SetPixelFormat(pixel_format(info));
  image.SetPhotometricInterpretation(gdcm::PhotometricInterpretation::MONOCHROME2);
  image.SetTransferSyntax(gdcm::TransferSyntax::GetTSType(header.transfer_syntax.c_str()));
  image.SetDataElement(pixels);

  const std::size_t expected =
      static_cast<std::size_t>(info.columns) * info.rows * (info.precision <= 8 ? 1 : 2);
  if (image.GetBufferLength() != expected) throw InvalidInput("the codec does not take the compressed image");
  std::string result(expected, '\0');
  CaughtStandardError caught;
  const bool decoded = image.GetBuffer(result.data());
  caught.release();
  const std::string said = caught.text();
  for (const char* complaint : {"Corrupt JPEG", "Premature end", "bad Huffman code"}) {
    if (said.find(complaint) != std::string::npos) {
      throw InvalidInput(transfer_syntax_name(header.transfer_syntax) + " data are damaged");
    }
  }
  if (!decoded) throw InvalidInput(transfer_syntax_name(header.transfer_syntax) + " data cannot be decoded");
  return result;
}

}  // namespace ostia::imaging
