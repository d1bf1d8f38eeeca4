#pragma once
/// \file DICOM data sets of any kind as trees of elements: read within bounds, changed, written.

#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ostia::imaging {

/// Tags as 0xGGGGEEEE: 0x00100020 is (0010,0020).
using DicomTag = std::uint32_t;
std::string dicom_tag_text(DicomTag tag);  ///< "(0010,0020)"

class DicomDataset;

struct DicomElement {
  std::string vr;     ///< "PN"; empty where the file does not say (implicit VR)
  std::string value;  ///< bytes as in a little-endian file, padded to an even length
  /// Of a sequence (`vr` "SQ").
  std::vector<DicomDataset> items = {};
  /// Pixel data in fragments: `value` has the items, without the delimiter that ends them.
  bool encapsulated = false;
  /// The value was left out by DicomObjectOptions::pixels; `declared_bytes` says how long it is.
  bool left_out = false;
  std::uint64_t declared_bytes = 0;
};

/// Elements by rising tag. Texts are bytes in the data set's own character set. Values are read by what the
/// caller knows of a tag; one that is missing, empty or no such thing is nothing.
class DicomDataset {
 public:
  const std::map<DicomTag, DicomElement>& elements() const { return elements_; }
  bool has(DicomTag tag) const { return elements_.count(tag) != 0; }
  const DicomElement* find(DicomTag tag) const;  ///< null: not there
  DicomElement* find(DicomTag tag);

  std::string text(DicomTag tag) const;  ///< without padding and spaces at its ends; "" where there is none
  std::vector<std::string> texts(DicomTag tag) const;                        ///< parted at backslashes
  std::optional<double> decimal(DicomTag tag, std::size_t index = 0) const;  ///< of a DS or IS
  std::vector<double> decimals(DicomTag tag) const;         ///< of a DS; empty where one of them is no number
  std::optional<std::int64_t> integer(DicomTag tag) const;  ///< of an IS
  std::optional<std::uint16_t> u16(DicomTag tag, std::size_t index = 0) const;
  std::optional<std::uint32_t> u32(DicomTag tag, std::size_t index = 0) const;
  const std::vector<DicomDataset>& items(DicomTag tag) const;  ///< of a sequence; none where there is none
  const DicomDataset* item(DicomTag tag) const;                ///< the first; null: none

  void set(DicomTag tag, DicomElement element);
  /// Pads the value. Throws InvalidInput for one that is too long for its VR.
  void set_text(DicomTag tag, const char* vr, std::string value);
  void set_u16(DicomTag tag, std::initializer_list<std::uint16_t> values);
  void set_u32(DicomTag tag, std::initializer_list<std::uint32_t> values);
  void set_f64(DicomTag tag, double value);
  void set_decimals(DicomTag tag, std::initializer_list<double> values);  ///< DS, by dicom_decimal
  void set_tag(DicomTag tag, DicomTag value);                             ///< AT
  void set_bytes(DicomTag tag, const char* vr, std::string value);        ///< OB, OW
  DicomDataset& add_item(DicomTag tag);  ///< good until the next one is added to the same sequence
  void set_sequence(DicomTag tag);       ///< empty, where it is not there
  void erase(DicomTag tag) { elements_.erase(tag); }

  /// Little endian; sequences of undefined length are written with defined ones. Throws InvalidInput for an
  /// element without a VR where it is to be explicit.
  std::string encoded(bool explicit_vr = true) const;

 private:
  std::map<DicomTag, DicomElement> elements_;
};

struct DicomObjectOptions {
  bool pixels = true;  ///< false: (7FE0,0010) of the object itself is left out
  std::size_t most_elements = 2'000'000;
  std::size_t deepest = 32;  ///< sequences within one another
};

struct DicomObject {
  DicomDataset meta;  ///< group 0002
  DicomDataset data;
  std::string transfer_syntax;  ///< of the file; values are little-endian here whatever it is
};

/// A file's whole content by our own bounded parser: implicit and explicit VR, both byte orders, deflated.
/// Nothing when it is not DICOM. What a file of implicit VR does not say is guessed: a value that begins as
/// an item and holds together as items is a sequence. Throws InvalidInput naming the file for what is damaged
/// (cut short, too deep, too many elements), IoError where it cannot be read.
std::optional<DicomObject> read_dicom_object(const std::filesystem::path& path,
                                             const DicomObjectOptions& options = {});

/// The same, where something else is wrong input: "FILE is no DICOM file".
DicomObject require_dicom_object(const std::filesystem::path& path, const DicomObjectOptions& options = {});

/// What kind of object a file is (SOPClassUID), read from its beginning; empty when it is not DICOM. Throws
/// IoError, InvalidInput for damage.
std::string dicom_sop_class(const std::filesystem::path& path);

/// A part 10 file of explicit VR little endian; SOP class and instance are the data set's own. Throws
/// InvalidInput where these are missing.
std::string dicom_file(const DicomDataset& data);
/// The same of an object that was read: in its own encoding and transfer syntax but for byte order and
/// deflation, which become explicit VR little endian.
std::string dicom_file(const DicomObject& object);

/// 2.25.N of the first 128 bits of a text's SHA-256, marked as a UUID of a scheme of one's own (RFC 9562,
/// version 8): the same text, the same UID.
std::string dicom_uid(const std::string& text);
/// A decimal string: the most precise that 16 characters hold.
std::string dicom_decimal(double value);

}  // namespace ostia::imaging
