#include "dicom_attributes.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <functional>

namespace ostia::imaging {
namespace {

constexpr std::int64_t kMaxFrames = 100'000;

constexpr std::uint32_t kImageType = dicom_tag(0x0008, 0x0008), kSopClass = dicom_tag(0x0008, 0x0016),
                        kSopInstance = dicom_tag(0x0008, 0x0018),
                        kAcquisitionTime = dicom_tag(0x0008, 0x0032),
                        kContentTime = dicom_tag(0x0008, 0x0033), kModality = dicom_tag(0x0008, 0x0060),
                        kSeriesDescription = dicom_tag(0x0008, 0x103E),
                        kTriggerTime = dicom_tag(0x0018, 0x1060), kGantryTilt = dicom_tag(0x0018, 0x1120),
                        kNameOfPatient = dicom_tag(0x0010, 0x0010), kIdOfPatient = dicom_tag(0x0010, 0x0020),
                        kStudyUid = dicom_tag(0x0020, 0x000D), kSeriesUid = dicom_tag(0x0020, 0x000E),
                        kAcquisitionNumber = dicom_tag(0x0020, 0x0012),
                        kInstanceNumber = dicom_tag(0x0020, 0x0013), kPosition = dicom_tag(0x0020, 0x0032),
                        kOrientation = dicom_tag(0x0020, 0x0037),
                        kTemporalPosition = dicom_tag(0x0020, 0x0100),
                        kTemporalIndex = dicom_tag(0x0020, 0x9128), kTriggerDelay = dicom_tag(0x0020, 0x9153),
                        kCardiacPercent = dicom_tag(0x0020, 0x9241), kSamples = dicom_tag(0x0028, 0x0002),
                        kPhotometric = dicom_tag(0x0028, 0x0004), kFrames = dicom_tag(0x0028, 0x0008),
                        kRows = dicom_tag(0x0028, 0x0010), kColumns = dicom_tag(0x0028, 0x0011),
                        kPixelSpacing = dicom_tag(0x0028, 0x0030), kBitsAllocated = dicom_tag(0x0028, 0x0100),
                        kBitsStored = dicom_tag(0x0028, 0x0101), kHighBit = dicom_tag(0x0028, 0x0102),
                        kPixelRepresentation = dicom_tag(0x0028, 0x0103),
                        kWindowCentre = dicom_tag(0x0028, 0x1050), kWindowWidth = dicom_tag(0x0028, 0x1051),
                        kIntercept = dicom_tag(0x0028, 0x1052), kSlope = dicom_tag(0x0028, 0x1053);

constexpr std::uint32_t kDataSet[] = {kImageType,      kSopClass,     kSopInstance,         kAcquisitionTime,
                                      kContentTime,    kModality,     kSeriesDescription,   kTriggerTime,
                                      kGantryTilt,     kSeriesUid,    kAcquisitionNumber,   kInstanceNumber,
                                      kPosition,       kOrientation,  kTemporalPosition,    kTriggerDelay,
                                      kCardiacPercent, kSamples,      kPhotometric,         kFrames,
                                      kRows,           kColumns,      kPixelSpacing,        kBitsAllocated,
                                      kBitsStored,     kHighBit,      kPixelRepresentation, kIntercept,
                                      kSlope,          kWindowCentre, kWindowWidth,         kNameOfPatient,
                                      kIdOfPatient,    kStudyUid};

std::string_view trimmed_value(std::string_view text) {
  const auto blank = [](char c) { return c == ' ' || c == '\0' || c == '\t' || c == '\r' || c == '\n'; };
  while (!text.empty() && blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && blank(text.back())) text.remove_suffix(1);
  return text;
}

/// Text without control characters: it is shown on terminals.
std::string plain(std::string_view text) {
  std::string result(trimmed_value(text).substr(0, 256));
  for (char& c : result) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) c = ' ';
  }
  return result;
}

/// A number in the place of a text that may name a person; 0 for none. Ends of empty components of a name
/// do not count.
std::uint64_t unnamed(std::string_view text) {
  text = trimmed_value(text);
  while (!text.empty() && (text.back() == '^' || text.back() == '=' || text.back() == ' '))
    text.remove_suffix(1);
  return text.empty() ? 0 : std::max<std::uint64_t>(1, std::hash<std::string_view>()(text));
}

/// `count` numbers separated by backslashes. Nothing for an empty value.
template <std::size_t count>
std::optional<std::array<double, count>> decimals(std::uint32_t tag, const char* name,
                                                  std::string_view text) {
  text = trimmed_value(text);
  if (text.empty()) return std::nullopt;
  const auto wrong = [&]() -> DicomDamage {
    return {std::string(name) + " " + tag_name(tag) + " is '" + plain(text) + "', not " +
            std::to_string(count) + (count == 1 ? " number" : " numbers")};
  };
  std::array<double, count> values{};
  std::size_t index = 0;
  while (true) {
    const std::size_t end = text.find('\\');
    const auto value = parse_decimal(text.substr(0, end));
    if (!value || index == count) throw wrong();
    values[index++] = *value;
    if (end == std::string_view::npos) break;
    text.remove_prefix(end + 1);
  }
  if (index != count) throw wrong();
  return values;
}

std::optional<double> decimal(std::uint32_t tag, const char* name, std::string_view text) {
  const auto value = decimals<1>(tag, name, text);
  if (!value) return std::nullopt;
  return (*value)[0];
}

/// A binary unsigned short; 0 for an empty value.
int unsigned_short(std::string_view value, bool big_endian) {
  if (value.size() < 2) return 0;
  const int a = static_cast<unsigned char>(value[0]), b = static_cast<unsigned char>(value[1]);
  return big_endian ? a << 8 | b : b << 8 | a;
}

std::optional<double> unsigned_long(std::string_view value, bool big_endian) {
  if (value.size() < 4) return std::nullopt;
  double result = 0.0;
  for (int i = 0; i < 4; ++i) {
    result =
        result * 256.0 + static_cast<unsigned char>(value[static_cast<std::size_t>(big_endian ? i : 3 - i)]);
  }
  return result;
}

std::optional<double> float_double(std::string_view value, bool big_endian) {
  if (value.size() < 8) return std::nullopt;
  std::uint64_t bits = 0;
  for (int i = 0; i < 8; ++i) {
    bits = bits << 8 | static_cast<unsigned char>(value[static_cast<std::size_t>(big_endian ? i : 7 - i)]);
  }
  double result = 0.0;
  static_assert(sizeof result == sizeof bits);
  std::copy_n(reinterpret_cast<const char*>(&bits), sizeof bits, reinterpret_cast<char*>(&result));
  if (!std::isfinite(result)) return std::nullopt;
  return result;
}

/// Seconds of "HHMMSS.FFFFFF"; only differences matter.
std::optional<double> time_seconds(std::string_view text) {
  const auto value = parse_decimal(text);
  if (!value || *value < 0.0) return std::nullopt;
  const double hours = std::floor(*value / 10000.0), minutes = std::floor(std::fmod(*value, 10000.0) / 100.0);
  return hours * 3600.0 + minutes * 60.0 + std::fmod(*value, 100.0);
}

template <class T>
void assign(std::optional<T>& to, const std::optional<T>& value) {
  if (value) to = value;
}

}  // namespace

std::optional<double> parse_decimal(std::string_view text) {
  text = trimmed_value(text);
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::string tag_name(std::uint32_t tag) {
  char text[16];
  std::snprintf(text, sizeof text, "(%04x,%04x)", tag >> 16, tag & 0xFFFFu);
  return text;
}

void DicomFrame::complete(const DicomFrame& other) {
  if (!position) position = other.position;
  if (!orientation) orientation = other.orientation;
  if (!pixel_spacing) pixel_spacing = other.pixel_spacing;
  if (!slope) slope = other.slope;
  if (!intercept) intercept = other.intercept;
  if (!window_centre) window_centre = other.window_centre;
  if (!window_width) window_width = other.window_width;
  if (!temporal_position) temporal_position = other.temporal_position;
  if (!trigger_time_ms) trigger_time_ms = other.trigger_time_ms;
  if (!cardiac_percent) cardiac_percent = other.cardiac_percent;
}

bool DicomAttributes::wanted(std::uint32_t tag) {
  return std::find(std::begin(kDataSet), std::end(kDataSet), tag) != std::end(kDataSet);
}

bool DicomAttributes::wanted_in_macro(std::uint32_t macro, std::uint32_t tag) {
  switch (macro) {
    case dicom_tag(0x0020, 0x9113):
      return tag == kPosition;
    case dicom_tag(0x0020, 0x9116):
      return tag == kOrientation;
    case dicom_tag(0x0028, 0x9110):
      return tag == kPixelSpacing;
    case dicom_tag(0x0028, 0x9145):
      return tag == kIntercept || tag == kSlope;
    case dicom_tag(0x0028, 0x9132):
      return tag == kWindowCentre || tag == kWindowWidth;
    case dicom_tag(0x0020, 0x9111):
      return tag == kTemporalIndex;
    case dicom_tag(0x0018, 0x9118):
      return tag == kTriggerDelay || tag == kCardiacPercent;
    default:
      return false;
  }
}

bool DicomAttributes::set_frame(DicomFrame& frame, std::uint32_t tag, std::string_view value,
                                bool big_endian) {
  switch (tag) {
    case kPosition:
      if (const auto p = decimals<3>(tag, "ImagePositionPatient", value)) {
        frame.position = geometry::Vec3((*p)[0], (*p)[1], (*p)[2]);
      }
      return true;
    case kOrientation:
      assign(frame.orientation, decimals<6>(tag, "ImageOrientationPatient", value));
      return true;
    case kPixelSpacing:
      assign(frame.pixel_spacing, decimals<2>(tag, "PixelSpacing", value));
      return true;
    case kSlope:
      assign(frame.slope, decimal(tag, "RescaleSlope", value));
      return true;
    case kIntercept:
      assign(frame.intercept, decimal(tag, "RescaleIntercept", value));
      return true;
    case kWindowCentre:  // only a way to show it: a wrong one does not damage the image
      assign(frame.window_centre, parse_decimal(value.substr(0, value.find('\\'))));
      return true;
    case kWindowWidth:
      assign(frame.window_width, parse_decimal(value.substr(0, value.find('\\'))));
      return true;
    case kTemporalPosition:
      assign(frame.temporal_position, parse_decimal(value));
      return true;
    case kTemporalIndex:
      assign(frame.temporal_position, unsigned_long(value, big_endian));
      return true;
    case kTriggerTime:
      assign(frame.trigger_time_ms, parse_decimal(value));
      return true;
    case kTriggerDelay:
      assign(frame.trigger_time_ms, float_double(value, big_endian));
      return true;
    case kCardiacPercent:
      assign(frame.cardiac_percent, float_double(value, big_endian));
      return true;
    default:
      return false;
  }
}

void DicomAttributes::set(std::uint32_t tag, std::string_view value, bool big_endian) {
  if (set_frame(shared, tag, value, big_endian)) return;
  switch (tag) {
    case kImageType:
      header.image_type = plain(value);
      break;
    case kSopClass:
      header.sop_class = plain(value);
      break;
    case kSopInstance:
      header.sop_instance = plain(value);
      break;
    case kSeriesUid:
      header.series_uid = plain(value);
      break;
    case kNameOfPatient:
      header.whose.patient_name = unnamed(value);
      break;
    case kIdOfPatient:
      header.whose.patient_id = unnamed(value);
      break;
    case kStudyUid:
      header.whose.study = unnamed(value);
      break;
    case kModality:
      header.modality = plain(value);
      break;
    case kSeriesDescription:
      header.description = plain(value);
      break;
    case kPhotometric:
      header.photometric = plain(value);
      break;
    case kAcquisitionTime:
      header.acquisition_time = time_seconds(value);
      break;
    case kContentTime:
      header.content_time = time_seconds(value);
      break;
    case kGantryTilt:
      header.gantry_tilt_deg = parse_decimal(value);
      break;
    case kAcquisitionNumber:
      header.acquisition_number = parse_decimal(value);
      break;
    case kInstanceNumber:
      header.instance_number = parse_decimal(value);
      break;
    case kFrames: {
      const double frames = decimal(tag, "NumberOfFrames", value).value_or(1.0);
      if (!(frames >= 1.0 && frames <= static_cast<double>(kMaxFrames)) || frames != std::floor(frames)) {
        throw DicomDamage{"NumberOfFrames is " + plain(value) + "; from 1 to " + std::to_string(kMaxFrames) +
                          " can be read"};
      }
      header.frame_count = static_cast<std::int64_t>(frames);
      break;
    }
    case kSamples:
      header.samples = unsigned_short(value, big_endian);
      break;
    case kRows:
      header.rows = unsigned_short(value, big_endian);
      break;
    case kColumns:
      header.columns = unsigned_short(value, big_endian);
      break;
    case kBitsAllocated:
      header.bits_allocated = unsigned_short(value, big_endian);
      break;
    case kBitsStored:
      header.bits_stored = unsigned_short(value, big_endian);
      break;
    case kHighBit:
      header.high_bit = unsigned_short(value, big_endian);
      break;
    case kPixelRepresentation:
      header.is_signed = unsigned_short(value, big_endian) == 1;
      break;
    default:
      break;
  }
}

void DicomAttributes::finish() {
  if (header.bits_stored == 0) header.bits_stored = header.bits_allocated;
  if (header.high_bit < 0) header.high_bit = header.bits_stored - 1;
  if (!per_frame.empty() && per_frame.size() != static_cast<std::size_t>(header.frame_count)) {
    throw DicomDamage{"NumberOfFrames is " + std::to_string(header.frame_count) + ", but " +
                      std::to_string(per_frame.size()) + " frames are described"};
  }
  header.frames = std::move(per_frame);
  header.frames.resize(static_cast<std::size_t>(header.frame_count));
  for (DicomFrame& frame : header.frames) frame.complete(shared);
}

}  // namespace ostia::imaging
