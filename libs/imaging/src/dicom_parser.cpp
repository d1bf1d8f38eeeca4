#include "dicom_parser.h"

#include "dicom_attributes.h"
#include "dicom_element.h"
#include "dicom_syntax.h"

#include "ostia/core/error.h"

#include <algorithm>

namespace ostia::imaging {
namespace {

constexpr std::uint32_t kSharedGroups = 0x52009229u, kFrameGroups = 0x52009230u, kModalityLut = 0x00283000u;
constexpr std::size_t kMaxDepth = 64;
constexpr std::size_t kMaxElements = 5'000'000;
constexpr std::size_t kMaxValue = 64 * 1024;
constexpr std::size_t kMaxFragments = 1'000'000;
constexpr std::size_t kMaxDescribedFrames = 100'000;

using Syntax = DicomEncoding;
using Element = DicomElementHead;

/// Where the functional groups met inside a sequence or an item belong.
constexpr std::int64_t kNoFrame = -1, kAllFrames = -2;

struct Level {
  std::uint64_t end = 0;  ///< where a defined length ends; that of the level above otherwise
  bool defined = true;
  bool sequence = false;  ///< a sequence holds items, an item holds elements
  std::uint32_t tag = 0;  ///< of the sequence (for an item: the one that it is in)
  std::int64_t frame = kNoFrame;
  Syntax syntax;
};

class Parser : public DicomHeadReader {
 public:
  explicit Parser(DicomSource& source, DicomTexts* texts = nullptr)
      : DicomHeadReader(source), texts_(texts) {}

  DicomAttributes attributes;

  /// The file meta information from `offset`; returns where the data set begins.
  std::uint64_t meta(std::uint64_t offset, std::string& transfer_syntax) {
    while (offset + 8 <= source_.size() && tag_at(offset, false) >> 16 == 0x0002) {
      const Element e = element(offset, {});
      if (e.length == dicom_undefined_length)
        throw DicomDamage{"the meta information holds an element of undefined length"};
      check_length(e, source_.size());
      if (e.tag == 0x00020010u) transfer_syntax = text(e);
      offset = e.value + e.length;
      count_element();
    }
    return offset;
  }

  void data_set(std::uint64_t offset, Syntax syntax);

 private:
  void count_element() {
    if (++elements_ > kMaxElements)
      throw DicomDamage{"more than " + std::to_string(kMaxElements) + " elements"};
  }
  std::string text(const Element& e) {
    std::string value = source_.bytes(e.value, std::min<std::size_t>(e.length, kMaxValue));
    while (!value.empty() && (value.back() == '\0' || value.back() == ' ')) value.pop_back();
    return value;
  }
  void push(Level level) {
    if (levels_.size() >= kMaxDepth) {
      throw DicomDamage{"sequences nested deeper than " + std::to_string(kMaxDepth)};
    }
    levels_.push_back(level);
  }
  /// Each returns the offset to go on from.
  std::uint64_t in_sequence(std::uint64_t offset);
  std::uint64_t in_data_set(std::uint64_t offset);
  std::uint64_t enter(const Element& e, std::int64_t frame);
  void value(const Element& e);
  void pixels(const Element& e);
  void fragments(std::uint64_t offset);

  DicomTexts* texts_;  // wanted besides, or null
  std::vector<Level> levels_;
  std::size_t elements_ = 0;
  bool done_ = false;
};

std::uint64_t Parser::in_sequence(std::uint64_t offset) {
  Level& level = levels_.back();
  const Element e = element(offset, level.syntax);
  if (e.tag == dicom_sequence_end) {
    if (level.defined) throw DicomDamage{"a sequence of defined length holds a sequence delimiter"};
    levels_.pop_back();
    return e.value;
  }
  if (e.tag != dicom_item)
    throw DicomDamage{"sequence " + tag_name(level.tag) + " holds " + tag_name(e.tag) +
                      " where an item must be"};
  Level item = level;
  item.sequence = false;
  item.defined = e.length != dicom_undefined_length;
  if (item.defined) {
    check_length(e, level.end);
    item.end = e.value + e.length;
  }
  if (level.tag == kSharedGroups) item.frame = kAllFrames;
  if (level.tag == kFrameGroups) {
    if (attributes.per_frame.size() >= kMaxDescribedFrames) {
      throw DicomDamage{"more than " + std::to_string(kMaxDescribedFrames) + " frames are described"};
    }
    item.frame = static_cast<std::int64_t>(attributes.per_frame.size());
    attributes.per_frame.emplace_back();
  }
  push(item);
  return e.value;
}

std::uint64_t Parser::enter(const Element& e, std::int64_t frame) {
  Level level = levels_.back();
  level.sequence = true;
  level.tag = e.tag;
  level.frame = frame;
  level.defined = e.length != dicom_undefined_length;
  if (level.defined) level.end = e.value + e.length;
  // An unknown VR hides a sequence in implicit VR little endian (PS3.5 6.2.2).
  if (e.is("UN")) level.syntax = {false, false};
  push(level);
  return e.value;
}

void Parser::value(const Element& e) {
  const Level& level = levels_.back();
  const bool at_top = levels_.size() == 1;
  if (at_top && texts_ != nullptr) {
    if (const auto found = texts_->find(e.tag); found != texts_->end()) found->second = text(e);
  }
  const bool for_frame =
      !at_top && level.frame != kNoFrame && DicomAttributes::wanted_in_macro(level.tag, e.tag);
  if (!(at_top ? DicomAttributes::wanted(e.tag) : for_frame)) return;
  if (e.length > kMaxValue) {
    throw DicomDamage{"element " + tag_name(e.tag) + " has " + std::to_string(e.length) + " bytes"};
  }
  const std::string bytes = source_.bytes(e.value, e.length);
  const bool big = level.syntax.big_endian && !e.is("UN");
  if (at_top) {
    attributes.set(e.tag, bytes, big);
  } else {
    DicomFrame& frame = level.frame == kAllFrames
                            ? attributes.shared
                            : attributes.per_frame[static_cast<std::size_t>(level.frame)];
    DicomAttributes::set_frame(frame, e.tag, bytes, big);
  }
}

std::uint64_t Parser::in_data_set(std::uint64_t offset) {
  const Level level = levels_.back();
  const Element e = element(offset, level.syntax);
  const bool at_top = levels_.size() == 1;
  if (e.tag == dicom_item_end && !at_top && !level.defined) {
    levels_.pop_back();
    return e.value;
  }
  if (e.tag >> 16 == 0xFFFE)
    throw DicomDamage{"a stray " + tag_name(e.tag) + " at byte " + std::to_string(offset)};
  if (at_top && e.tag == dicom_pixel_data) {
    pixels(e);
    done_ = true;
    return e.value;
  }
  if (at_top && e.tag == kModalityLut && e.length != 0) attributes.header.has_modality_lut = true;
  const bool groups = at_top && (e.tag == kSharedGroups || e.tag == kFrameGroups);
  const bool macro = level.frame != kNoFrame && (level.tag == kSharedGroups || level.tag == kFrameGroups);
  if (e.length == dicom_undefined_length) {
    if (e.vr[0] != 0 && !e.is("SQ") && !e.is("UN")) {
      throw DicomDamage{"element " + tag_name(e.tag) + " has an undefined length but is no sequence"};
    }
    return enter(e, macro ? level.frame : kNoFrame);
  }
  check_length(e, level.end);
  if (groups || (macro && e.length > 0)) return enter(e, macro ? level.frame : kNoFrame);
  value(e);
  return e.value + e.length;
}

void Parser::pixels(const Element& e) {
  DicomHeader& header = attributes.header;
  header.has_pixels = true;
  header.pixel_offset = e.value;
  header.big_endian = levels_.back().syntax.big_endian;
  if (e.length == dicom_undefined_length) {
    header.encapsulated = true;
    fragments(e.value);
    return;
  }
  header.pixel_length = e.length;
  header.pixel_available =
      std::min<std::uint64_t>(e.length, source_.size() - std::min(source_.size(), e.value));
}

void Parser::fragments(std::uint64_t offset) {
  DicomHeader& header = attributes.header;
  for (bool first = true;; first = false) {
    const Element e = element(offset, {});
    if (e.tag == dicom_sequence_end) return;
    if (e.tag != dicom_item || e.length == dicom_undefined_length) {
      throw DicomDamage{"the compressed pixel data hold " + tag_name(e.tag) + " where a fragment must be"};
    }
    check_length(e, source_.size());
    if (first) {
      const std::string table = source_.bytes(e.value, std::min<std::size_t>(e.length, 4 * kMaxFragments));
      for (std::size_t i = 0; i + 4 <= table.size(); i += 4)
        header.offset_table.push_back(u32(e.value + i, false));
    } else {
      if (header.fragments.size() >= kMaxFragments) throw DicomDamage{"too many fragments of pixel data"};
      header.fragments.push_back({e.value, e.length});
    }
    offset = e.value + e.length;
  }
}

void Parser::data_set(std::uint64_t offset, Syntax syntax) {
  Level top;
  top.end = source_.size();
  top.syntax = syntax;
  levels_.assign(1, top);
  while (!done_) {
    const Level& level = levels_.back();
    if (level.defined && offset >= level.end) {
      levels_.pop_back();
      if (levels_.empty()) return;
      continue;
    }
    count_element();
    offset = level.sequence ? in_sequence(offset) : in_data_set(offset);
  }
}

void parse(DicomSource& source, std::uint64_t start, Syntax syntax, bool has_meta, DicomHeader& header,
           DicomTexts* texts) {
  Parser head(source);
  DicomAttributes attributes;
  std::string damage;
  std::string declared;
  try {
    std::uint64_t offset = start;
    if (has_meta) {
      offset = head.meta(start, declared);
      syntax = {declared != implicit_little_endian, declared == explicit_big_endian};
    }
    if (declared == deflated_little_endian) {
      source = DicomSource::memory(inflated(source, offset, most_inflated_dicom_bytes));
      offset = 0;
    }
    if (declared.empty() || declared == implicit_little_endian)
      syntax = detected_encoding(source, offset, syntax);
    Parser body(source, texts);
    try {
      body.data_set(offset, syntax);
    } catch (const DicomDamage& found) {
      damage = found.message;
    }
    attributes = std::move(body.attributes);
    if (attributes.header.has_pixels && !attributes.header.encapsulated &&
        static_cast<std::uint64_t>(attributes.header.frame_count) > attributes.header.pixel_available) {
      attributes.header.frame_count = 1;
      if (damage.empty()) damage = "more frames than bytes of pixel data";
    }
    attributes.finish();
  } catch (const DicomDamage& found) {
    if (damage.empty()) damage = found.message;
  } catch (const InvalidInput& found) {
    if (damage.empty()) damage = found.what();
  }
  header = std::move(attributes.header);
  header.damage = damage;
  header.transfer_syntax = !declared.empty()    ? declared
                           : syntax.big_endian  ? explicit_big_endian
                           : syntax.explicit_vr ? explicit_little_endian
                                                : implicit_little_endian;
}

std::optional<DicomFile> parsed(DicomSource source, DicomTexts* texts) {
  const std::optional<DicomStart> start = dicom_start(source);
  if (!start) return std::nullopt;
  DicomFile file{std::move(source), {}};
  parse(file.source, start->offset, start->encoding, start->has_meta, file.header, texts);
  // Without the magic word it takes an attribute that every DICOM object has to believe in it.
  if (!start->preamble && file.header.sop_class.empty() && file.header.series_uid.empty() && !start->has_meta)
    return std::nullopt;
  return file;
}

}  // namespace

std::optional<DicomFile> parse_dicom(DicomSource source) {
  return parsed(std::move(source), nullptr);
}

std::optional<DicomFile> parse_dicom(const std::filesystem::path& path) {
  auto file = parse_dicom(DicomSource::file(path));
  if (file) file->header.path = path;
  return file;
}

bool read_dicom_texts(const std::filesystem::path& path, DicomTexts& wanted) {
  return parsed(DicomSource::file(path), &wanted).has_value();
}

}  // namespace ostia::imaging
