#include "ostia/imaging/dicom_dataset.h"

#include "dicom_element.h"
#include "dicom_parser.h"
#include "dicom_syntax.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/core/text.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstring>

namespace ostia::imaging {
namespace fs = std::filesystem;
namespace {

/// Of Ostia's writer; drawn once at random as a UUID.
constexpr const char* implementation_uid = "2.25.204386196052518563977463528091842307761";

void put_number(std::string& to, std::uint64_t value, int count) {
  for (int i = 0; i < count; ++i) to.push_back(static_cast<char>(value >> (8 * i) & 0xff));
}

std::uint64_t little_number(const std::string& bytes, std::size_t at, std::size_t count) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < count; ++i)
    value |= static_cast<std::uint64_t>(static_cast<unsigned char>(bytes[at + i])) << (8 * i);
  return value;
}

std::string without_padding(std::string_view text) {
  while (!text.empty() && (text.back() == '\0' || text.back() == ' ')) text.remove_suffix(1);
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  return std::string(text);
}

bool padded_with_zero(std::string_view vr) {
  return vr == "UI" || vr == "OB" || vr == "UN";
}

/// Bytes of one number of a VR that has another order in a big-endian file; 1: none.
std::size_t swapped_bytes(std::string_view vr) {
  if (vr == "US" || vr == "SS" || vr == "OW" || vr == "AT") return 2;
  if (vr == "UL" || vr == "SL" || vr == "FL" || vr == "OF" || vr == "OL") return 4;
  if (vr == "FD" || vr == "OD" || vr == "SV" || vr == "UV" || vr == "OV") return 8;
  return 1;
}

void to_little_endian(std::string& value, std::string_view vr) {
  const std::size_t n = swapped_bytes(vr);
  if (n == 1) return;
  for (std::size_t i = 0; i + n <= value.size(); i += n)
    std::reverse(value.begin() + static_cast<std::ptrdiff_t>(i),
                 value.begin() + static_cast<std::ptrdiff_t>(i + n));
}

/// From bytes to a tree.
class TreeReader : public DicomHeadReader {
 public:
  TreeReader(DicomSource& source, const DicomObjectOptions& options)
      : DicomHeadReader(source), options_(options) {}

  std::uint64_t meta(std::uint64_t offset, DicomDataset& to) {
    while (offset + 8 <= source_.size() && tag_at(offset, false) >> 16 == 0x0002) {
      const DicomElementHead e = element(offset, {});
      if (e.length == dicom_undefined_length)
        throw DicomDamage{"the meta information holds an element of undefined length"};
      check_length(e, source_.size());
      count();
      to.set(e.tag, {vr_of(e), source_.bytes(e.value, e.length)});
      offset = e.value + e.length;
    }
    return offset;
  }

  /// Elements up to `end`, or to the delimiter of an item of undefined length; returns where it went to.
  std::uint64_t data_set(std::uint64_t offset, std::uint64_t end, bool delimited, DicomEncoding encoding,
                         std::size_t depth, DicomDataset& to) {
    while (offset < end) {
      const DicomElementHead e = element(offset, encoding);
      if (delimited && e.tag == dicom_item_end) return e.value;
      if (e.tag >> 16 == 0xFFFE)
        throw DicomDamage{"a stray " + tag_name(e.tag) + " at byte " + std::to_string(offset)};
      count();
      offset = one(e, end, encoding, depth, to);
    }
    if (delimited) throw DicomDamage{"an item does not end"};
    return offset;
  }

 private:
  static std::string vr_of(const DicomElementHead& e) {
    return e.vr[0] == 0 ? std::string() : std::string(e.vr, 2);
  }
  void count() {
    if (++elements_ > options_.most_elements)
      throw DicomDamage{"more than " + std::to_string(options_.most_elements) + " elements"};
  }

  std::uint64_t one(const DicomElementHead& e, std::uint64_t end, DicomEncoding encoding, std::size_t depth,
                    DicomDataset& to) {
    const bool undefined = e.length == dicom_undefined_length;
    if (!undefined) check_length(e, end);
    if (e.tag == dicom_pixel_data && depth == 0) return pixels(e, encoding, to);
    if (undefined && !(e.vr[0] == 0 || e.is("SQ") || e.is("UN")))
      throw DicomDamage{"element " + tag_name(e.tag) + " has an undefined length but is no sequence"};
    // An unknown VR hides a sequence in implicit VR little endian (PS3.5 6.2.2).
    const DicomEncoding inner = e.is("UN") ? DicomEncoding{false, false} : encoding;
    DicomElement element{"SQ", {}};
    if (undefined) {
      const std::uint64_t next = items(e, end, false, inner, depth, element);
      to.set(e.tag, std::move(element));
      return next;
    }
    const std::uint64_t after = e.value + e.length;
    if (e.is("SQ")) {
      items(e, after, true, inner, depth, element);
    } else if (!((e.vr[0] == 0 || e.is("UN")) && hidden_sequence(e, inner, depth, element))) {
      element = {vr_of(e), source_.bytes(e.value, e.length)};
      if (encoding.big_endian && !e.is("UN")) to_little_endian(element.value, element.vr);
    }
    to.set(e.tag, std::move(element));
    return after;
  }

  bool hidden_sequence(const DicomElementHead& e, DicomEncoding inner, std::size_t depth,
                       DicomElement& element) {
    if (e.length < 8 || tag_at(e.value, inner.big_endian) != dicom_item) return false;
    const std::size_t before = elements_;
    try {
      items(e, e.value + e.length, true, inner, depth, element);
      return true;
    } catch (const DicomDamage&) {
      if (elements_ > options_.most_elements) throw;
      elements_ = before;
      element.items.clear();
      return false;
    }
  }

  std::uint64_t items(const DicomElementHead& e, std::uint64_t end, bool defined, DicomEncoding encoding,
                      std::size_t depth, DicomElement& to) {
    if (depth >= options_.deepest)
      throw DicomDamage{"sequences nested deeper than " + std::to_string(options_.deepest)};
    std::uint64_t offset = e.value;
    while (!defined || offset < end) {
      const DicomElementHead head = element(offset, encoding);
      if (!defined && head.tag == dicom_sequence_end) return head.value;
      if (head.tag != dicom_item)
        throw DicomDamage{"sequence " + tag_name(e.tag) + " holds " + tag_name(head.tag) +
                          " where an item must be"};
      count();
      const bool open = head.length == dicom_undefined_length;
      if (!open) check_length(head, end);
      to.items.emplace_back();
      offset = data_set(head.value, open ? end : head.value + head.length, open, encoding, depth + 1,
                        to.items.back());
    }
    return offset;
  }

  std::uint64_t pixels(const DicomElementHead& e, DicomEncoding encoding, DicomDataset& to) {
    DicomElement element{vr_of(e).empty() ? "OW" : vr_of(e), {}};
    std::uint64_t after = e.value + e.length;
    std::uint64_t bytes = e.length;
    if (e.length == dicom_undefined_length) {
      element.encapsulated = true;
      std::uint64_t offset = e.value;
      for (;;) {
        const DicomElementHead head = this->element(offset, {true, false});
        if (head.tag == dicom_sequence_end) {
          bytes = offset - e.value;
          after = head.value;
          break;
        }
        if (head.tag != dicom_item || head.length == dicom_undefined_length)
          throw DicomDamage{"the compressed pixel data hold " + tag_name(head.tag) +
                            " where a fragment must be"};
        check_length(head, source_.size());
        count();
        offset = head.value + head.length;
      }
    }
    element.declared_bytes = bytes;
    if (options_.pixels) {
      element.value = source_.bytes(e.value, bytes);
      if (encoding.big_endian) to_little_endian(element.value, element.vr);
    } else {
      element.left_out = true;
    }
    to.set(e.tag, std::move(element));
    return after;
  }

  DicomObjectOptions options_;
  std::size_t elements_ = 0;
};

std::optional<DicomObject> object_in(DicomSource source, const DicomObjectOptions& options) {
  const std::optional<DicomStart> start = dicom_start(source);
  if (!start) return std::nullopt;
  DicomObject object;
  std::uint64_t offset = start->offset;
  DicomEncoding encoding = start->encoding;
  if (start->has_meta) {
    offset = TreeReader(source, options).meta(offset, object.meta);
    object.transfer_syntax = object.meta.text(0x00020010);
    encoding = {object.transfer_syntax != implicit_little_endian,
                object.transfer_syntax == explicit_big_endian};
  }
  if (object.transfer_syntax == deflated_little_endian) {
    source = DicomSource::memory(inflated(source, offset, most_inflated_dicom_bytes));
    offset = 0;
  }
  if (object.transfer_syntax.empty() || object.transfer_syntax == implicit_little_endian)
    encoding = detected_encoding(source, offset, encoding);
  if (object.transfer_syntax.empty())
    object.transfer_syntax = encoding.big_endian    ? explicit_big_endian
                             : encoding.explicit_vr ? explicit_little_endian
                                                    : implicit_little_endian;
  TreeReader(source, options).data_set(offset, source.size(), false, encoding, 0, object.data);
  if (!start->preamble && !start->has_meta && !object.data.has(0x00080016) && !object.data.has(0x0020000E))
    return std::nullopt;
  return object;
}

void encode(const DicomDataset& data, bool explicit_vr, std::string& to);

std::string encoded_items(const DicomElement& element, bool explicit_vr) {
  std::string bytes;
  for (const DicomDataset& item : element.items) {
    std::string inner;
    encode(item, explicit_vr, inner);
    put_number(bytes, 0xFFFE, 2);
    put_number(bytes, 0xE000, 2);
    put_number(bytes, inner.size(), 4);
    bytes += inner;
  }
  return bytes;
}

void encode_element(DicomTag tag, const DicomElement& element, bool explicit_vr, std::string& to) {
  const bool sequence = element.vr == "SQ";
  if (element.left_out)
    throw InvalidInput("DICOM: " + dicom_tag_text(tag) + " was not read and cannot be written");
  const std::string items = sequence ? encoded_items(element, explicit_vr) : std::string();
  const std::string& value = sequence ? items : element.value;
  if (value.size() >= dicom_undefined_length)
    throw InvalidInput("DICOM: " + dicom_tag_text(tag) + " has more than 4 GiB");
  put_number(to, tag >> 16, 2);
  put_number(to, tag & 0xffff, 2);
  const std::uint64_t length = element.encapsulated ? dicom_undefined_length : value.size();
  if (!explicit_vr) {
    put_number(to, length, 4);
  } else {
    if (element.vr.size() != 2)
      throw InvalidInput("DICOM: " + dicom_tag_text(tag) + " has no value representation");
    to += element.vr;
    if (dicom_long_length(element.vr.c_str())) {
      put_number(to, 0, 2);
      put_number(to, length, 4);
    } else {
      if (value.size() > 0xffff)
        throw InvalidInput("DICOM: " + dicom_tag_text(tag) + " has " + std::to_string(value.size()) +
                           " bytes; " + element.vr + " holds at most 65,535");
      put_number(to, length, 2);
    }
  }
  to += value;
  if (element.encapsulated) {
    put_number(to, 0xFFFE, 2);
    put_number(to, 0xE0DD, 2);
    put_number(to, 0, 4);
  }
}

void encode(const DicomDataset& data, bool explicit_vr, std::string& to) {
  for (const auto& [tag, element] : data.elements()) encode_element(tag, element, explicit_vr, to);
}

std::string part_10(const DicomDataset& data, const std::string& transfer_syntax, bool explicit_vr) {
  const std::string sop_class = data.text(0x00080016), sop_instance = data.text(0x00080018);
  if (sop_class.empty() || sop_instance.empty())
    throw InvalidInput("DICOM: an object without SOP class or instance cannot be written");
  DicomDataset meta;
  meta.set_bytes(0x00020001, "OB", std::string("\0\1", 2));
  meta.set_text(0x00020002, "UI", sop_class);
  meta.set_text(0x00020003, "UI", sop_instance);
  meta.set_text(0x00020010, "UI", transfer_syntax);
  meta.set_text(0x00020012, "UI", implementation_uid);
  const std::string rest = meta.encoded();
  DicomDataset length;
  length.set_u32(0x00020000, {static_cast<std::uint32_t>(rest.size())});
  std::string file = std::string(128, '\0') + "DICM" + length.encoded() + rest;
  encode(data, explicit_vr, file);
  return file;
}

}  // namespace

std::string dicom_tag_text(DicomTag tag) {
  return tag_name(tag);
}

const DicomElement* DicomDataset::find(DicomTag tag) const {
  const auto found = elements_.find(tag);
  return found == elements_.end() ? nullptr : &found->second;
}

DicomElement* DicomDataset::find(DicomTag tag) {
  const auto found = elements_.find(tag);
  return found == elements_.end() ? nullptr : &found->second;
}

std::string DicomDataset::text(DicomTag tag) const {
  const DicomElement* element = find(tag);
  return element ? without_padding(element->value) : std::string();
}

std::vector<std::string> DicomDataset::texts(DicomTag tag) const {
  std::vector<std::string> parts;
  const DicomElement* element = find(tag);
  if (!element || element->value.empty()) return parts;
  std::string_view rest = element->value;
  for (;;) {
    const std::size_t at = rest.find('\\');
    parts.push_back(without_padding(rest.substr(0, at)));
    if (at == std::string_view::npos) return parts;
    rest.remove_prefix(at + 1);
  }
}

std::optional<double> DicomDataset::decimal(DicomTag tag, std::size_t index) const {
  const std::vector<std::string> parts = texts(tag);
  return index < parts.size() ? parse_decimal(parts[index]) : std::nullopt;
}

std::vector<double> DicomDataset::decimals(DicomTag tag) const {
  std::vector<double> values;
  for (const std::string& part : texts(tag)) {
    const std::optional<double> value = parse_decimal(part);
    if (!value) return {};
    values.push_back(*value);
  }
  return values;
}

std::optional<std::int64_t> DicomDataset::integer(DicomTag tag) const {
  std::string value = text(tag);
  if (!value.empty() && value.front() == '+') value.erase(0, 1);
  std::int64_t number = 0;
  const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
  if (error != std::errc() || end != value.data() + value.size()) return std::nullopt;
  return number;
}

std::optional<std::uint16_t> DicomDataset::u16(DicomTag tag, std::size_t index) const {
  const DicomElement* element = find(tag);
  if (!element || element->value.size() < 2 * (index + 1)) return std::nullopt;
  return static_cast<std::uint16_t>(little_number(element->value, 2 * index, 2));
}

std::optional<std::uint32_t> DicomDataset::u32(DicomTag tag, std::size_t index) const {
  const DicomElement* element = find(tag);
  if (!element || element->value.size() < 4 * (index + 1)) return std::nullopt;
  return static_cast<std::uint32_t>(little_number(element->value, 4 * index, 4));
}

const std::vector<DicomDataset>& DicomDataset::items(DicomTag tag) const {
  static const std::vector<DicomDataset> none;
  const DicomElement* element = find(tag);
  return element ? element->items : none;
}

const DicomDataset* DicomDataset::item(DicomTag tag) const {
  const std::vector<DicomDataset>& all = items(tag);
  return all.empty() ? nullptr : &all.front();
}

void DicomDataset::set(DicomTag tag, DicomElement element) {
  elements_[tag] = std::move(element);
}

void DicomDataset::set_text(DicomTag tag, const char* vr, std::string value) {
  if (value.size() % 2 != 0) value.push_back(padded_with_zero(vr) ? '\0' : ' ');
  if (!dicom_long_length(vr) && value.size() > 0xffff)
    throw InvalidInput("DICOM: " + dicom_tag_text(tag) + " has " + std::to_string(value.size()) + " bytes; " +
                       vr + " holds at most 65,535");
  set(tag, {vr, std::move(value)});
}

void DicomDataset::set_u16(DicomTag tag, std::initializer_list<std::uint16_t> values) {
  DicomElement element{"US", {}};
  for (const std::uint16_t v : values) put_number(element.value, v, 2);
  set(tag, std::move(element));
}

void DicomDataset::set_u32(DicomTag tag, std::initializer_list<std::uint32_t> values) {
  DicomElement element{"UL", {}};
  for (const std::uint32_t v : values) put_number(element.value, v, 4);
  set(tag, std::move(element));
}

void DicomDataset::set_f64(DicomTag tag, double value) {
  DicomElement element{"FD", {}};
  put_number(element.value, std::bit_cast<std::uint64_t>(value), 8);
  set(tag, std::move(element));
}

void DicomDataset::set_decimals(DicomTag tag, std::initializer_list<double> values) {
  std::string text;
  for (const double v : values) text += (text.empty() ? "" : "\\") + dicom_decimal(v);
  set_text(tag, "DS", std::move(text));
}

void DicomDataset::set_tag(DicomTag tag, DicomTag value) {
  DicomElement element{"AT", {}};
  put_number(element.value, value >> 16, 2);
  put_number(element.value, value & 0xffff, 2);
  set(tag, std::move(element));
}

void DicomDataset::set_bytes(DicomTag tag, const char* vr, std::string value) {
  if (value.size() % 2 != 0) value.push_back('\0');
  set(tag, {vr, std::move(value)});
}

DicomDataset& DicomDataset::add_item(DicomTag tag) {
  DicomElement& element = elements_[tag];
  element.vr = "SQ";
  return element.items.emplace_back();
}

void DicomDataset::set_sequence(DicomTag tag) {
  elements_[tag].vr = "SQ";
}

std::string DicomDataset::encoded(bool explicit_vr) const {
  std::string bytes;
  encode(*this, explicit_vr, bytes);
  return bytes;
}

std::optional<DicomObject> read_dicom_object(const fs::path& path, const DicomObjectOptions& options) {
  try {
    return object_in(DicomSource::file(path), options);
  } catch (const DicomDamage& damage) {
    throw InvalidInput(path.string() + ": the DICOM file is damaged: " + damage.message);
  } catch (const InvalidInput& error) {
    throw InvalidInput(path.string() + ": " + error.what());
  }
}

DicomObject require_dicom_object(const fs::path& path, const DicomObjectOptions& options) {
  std::optional<DicomObject> object = read_dicom_object(path, options);
  if (!object) throw InvalidInput(path.string() + " is no DICOM file");
  return std::move(*object);
}

std::string dicom_sop_class(const fs::path& path) {
  DicomSource source = DicomSource::file(path);
  const std::optional<DicomStart> start = dicom_start(source);
  if (!start) return {};
  if (start->has_meta) {
    DicomDataset meta;
    try {
      TreeReader(source, {}).meta(start->offset, meta);
    } catch (const DicomDamage& damage) {
      throw InvalidInput(path.string() + ": the DICOM file is damaged: " + damage.message);
    }
    if (std::string found = meta.text(0x00020002); !found.empty()) return found;
  }
  const std::optional<DicomFile> file = parse_dicom(path);
  return file ? file->header.sop_class : std::string();
}

std::string dicom_file(const DicomDataset& data) {
  return part_10(data, explicit_little_endian, true);
}

std::string dicom_file(const DicomObject& object) {
  const bool rewritten =
      object.transfer_syntax == explicit_big_endian || object.transfer_syntax == deflated_little_endian;
  return part_10(object.data, rewritten ? explicit_little_endian : object.transfer_syntax,
                 object.transfer_syntax != implicit_little_endian);
}

std::string dicom_decimal(double value) {
  if (value == 0.0) return "0";
  for (int digits = 17; digits > 0; --digits) {
    std::string text = core::significant_text(value, digits);
    if (text.size() <= 16) return text;
  }
  throw InvalidInput("DICOM: the number " + std::to_string(value) + " does not fit a decimal string");
}

std::string dicom_uid(const std::string& text) {
  std::string hex = core::sha256(text).substr(0, 32);
  hex[12] = '8';
  hex[16] = "89ab"[static_cast<std::size_t>(std::stoi(hex.substr(16, 1), nullptr, 16)) % 4];
  std::string digits;  // most significant last
  for (const char c : hex) {
    int carry = c <= '9' ? c - '0' : c - 'a' + 10;
    for (char& d : digits) {
      carry += 16 * (d - '0');
      d = static_cast<char>('0' + carry % 10);
      carry /= 10;
    }
    for (; carry > 0; carry /= 10) digits.push_back(static_cast<char>('0' + carry % 10));
  }
  return "2.25." + std::string(digits.rbegin(), digits.rend());
}

}  // namespace ostia::imaging
