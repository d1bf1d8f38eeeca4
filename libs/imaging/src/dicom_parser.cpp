#include "dicom_parser.h"

#include "dicom_attributes.h"
#include "dicom_syntax.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <cstring>

namespace ostia::imaging {
namespace {

constexpr std::uint32_t kUndefined = 0xFFFFFFFFu;
constexpr std::uint32_t kItem = 0xFFFEE000u, kItemEnd = 0xFFFEE00Du, kSequenceEnd = 0xFFFEE0DDu;
constexpr std::uint32_t kPixelData = 0x7FE00010u;
constexpr std::uint32_t kSharedGroups = 0x52009229u, kFrameGroups = 0x52009230u, kModalityLut = 0x00283000u;
constexpr std::size_t kMaxDepth = 64;
constexpr std::size_t kMaxElements = 5'000'000;
constexpr std::size_t kMaxValue = 64 * 1024;
constexpr std::size_t kMaxFragments = 1'000'000;
constexpr std::size_t kMaxDescribedFrames = 100'000;
constexpr std::uint64_t kMaxInflated = 2ULL << 30;

struct Syntax {
  bool explicit_vr = true;
  bool big_endian = false;
};

struct Element {
  std::uint32_t tag = 0;
  char vr[2] = {0, 0};  ///< zero where it is implicit
  std::uint32_t length = 0;
  std::uint64_t value = 0;  ///< offset
  bool is(const char* text) const { return vr[0] == text[0] && vr[1] == text[1]; }
};

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

bool upper_case(char c) {
  return c >= 'A' && c <= 'Z';
}

bool has_long_length(const char* vr) {
  static constexpr char kLong[][3] = {"OB", "OD", "OF", "OL", "OV", "OW", "SQ",
                                      "SV", "UC", "UN", "UR", "UT", "UV"};
  return std::any_of(std::begin(kLong), std::end(kLong),
                     [&](const char* v) { return v[0] == vr[0] && v[1] == vr[1]; });
}

class Parser {
 public:
  explicit Parser(DicomSource& source, DicomTexts* texts = nullptr) : source_(source), texts_(texts) {}

  DicomAttributes attributes;

  std::uint32_t u16(std::uint64_t offset, bool big) {
    unsigned char b[2];
    need(offset, b, 2);
    return big ? static_cast<std::uint32_t>(b[0]) << 8 | b[1] : static_cast<std::uint32_t>(b[1]) << 8 | b[0];
  }
  std::uint32_t u32(std::uint64_t offset, bool big) {
    const std::uint32_t first = u16(offset, big), second = u16(offset + 2, big);
    return big ? first << 16 | second : second << 16 | first;
  }
  std::uint32_t tag_at(std::uint64_t offset, bool big) {
    return u16(offset, big) << 16 | u16(offset + 2, big);
  }

  /// Reads the header of the element at `offset`; its value is not touched.
  Element element(std::uint64_t offset, Syntax syntax) {
    Element e;
    e.tag = tag_at(offset, syntax.big_endian);
    e.value = offset + 8;
    if (e.tag >> 16 == 0xFFFE || !syntax.explicit_vr) {
      e.length = u32(offset + 4, syntax.big_endian);
      return e;
    }
    char vr[2];
    need(offset + 4, vr, 2);
    if (!upper_case(vr[0]) || !upper_case(vr[1])) {
      // Some writers slip elements without a VR into an explicit data set.
      e.length = u32(offset + 4, syntax.big_endian);
      return e;
    }
    e.vr[0] = vr[0];
    e.vr[1] = vr[1];
    if (has_long_length(vr)) {
      e.length = u32(offset + 8, syntax.big_endian);
      e.value = offset + 12;
    } else {
      e.length = u16(offset + 6, syntax.big_endian);
    }
    return e;
  }

  /// The file meta information from `offset`; returns where the data set begins.
  std::uint64_t meta(std::uint64_t offset, std::string& transfer_syntax) {
    while (offset + 8 <= source_.size() && tag_at(offset, false) >> 16 == 0x0002) {
      const Element e = element(offset, {});
      if (e.length == kUndefined)
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
  void need(std::uint64_t offset, void* to, std::size_t count) {
    if (source_.read(offset, to, count)) return;
    throw DicomDamage{"the file ends at byte " + std::to_string(source_.size()) +
                      " in the middle of an element"};
  }
  void count_element() {
    if (++elements_ > kMaxElements)
      throw DicomDamage{"more than " + std::to_string(kMaxElements) + " elements"};
  }
  void check_length(const Element& e, std::uint64_t end) const {
    if (e.length <= end && e.value <= end - e.length) return;
    const std::uint64_t left = end > e.value ? end - e.value : 0;
    throw DicomDamage{"element " + tag_name(e.tag) + " is said to have " + std::to_string(e.length) +
                      " bytes, but " + std::to_string(left) + " are left"};
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

  DicomSource& source_;
  DicomTexts* texts_;  // wanted besides, or null
  std::vector<Level> levels_;
  std::size_t elements_ = 0;
  bool done_ = false;
};

std::uint64_t Parser::in_sequence(std::uint64_t offset) {
  Level& level = levels_.back();
  const Element e = element(offset, level.syntax);
  if (e.tag == kSequenceEnd) {
    if (level.defined) throw DicomDamage{"a sequence of defined length holds a sequence delimiter"};
    levels_.pop_back();
    return e.value;
  }
  if (e.tag != kItem)
    throw DicomDamage{"sequence " + tag_name(level.tag) + " holds " + tag_name(e.tag) +
                      " where an item must be"};
  Level item = level;
  item.sequence = false;
  item.defined = e.length != kUndefined;
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
  level.defined = e.length != kUndefined;
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
  if (e.tag == kItemEnd && !at_top && !level.defined) {
    levels_.pop_back();
    return e.value;
  }
  if (e.tag >> 16 == 0xFFFE)
    throw DicomDamage{"a stray " + tag_name(e.tag) + " at byte " + std::to_string(offset)};
  if (at_top && e.tag == kPixelData) {
    pixels(e);
    done_ = true;
    return e.value;
  }
  if (at_top && e.tag == kModalityLut && e.length != 0) attributes.header.has_modality_lut = true;
  const bool groups = at_top && (e.tag == kSharedGroups || e.tag == kFrameGroups);
  const bool macro = level.frame != kNoFrame && (level.tag == kSharedGroups || level.tag == kFrameGroups);
  if (e.length == kUndefined) {
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
  if (e.length == kUndefined) {
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
    if (e.tag == kSequenceEnd) return;
    if (e.tag != kItem || e.length == kUndefined) {
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

/// How the data set is really encoded: some files say one thing and do the other.
Syntax detected(DicomSource& source, std::uint64_t offset, Syntax declared) {
  char b[8];
  if (!source.read(offset, b, sizeof b)) return declared;
  const bool vr = upper_case(b[4]) && upper_case(b[5]);
  return {vr, declared.big_endian};
}

/// Without a preamble: a first element of group 0002 or 0008 that makes sense.
bool looks_like_data_set(DicomSource& source, Syntax& syntax) {
  unsigned char b[8];
  if (!source.read(0, b, sizeof b)) return false;
  const bool little = (b[0] == 0x02 || b[0] == 0x08) && b[1] == 0x00;
  const bool big = b[0] == 0x00 && b[1] == 0x08;
  if (!little && !big) return false;
  syntax.big_endian = big;
  syntax.explicit_vr = upper_case(static_cast<char>(b[4])) && upper_case(static_cast<char>(b[5]));
  if (syntax.explicit_vr) return true;
  const std::uint32_t length =
      big ? static_cast<std::uint32_t>(b[6]) << 8 | b[7] : static_cast<std::uint32_t>(b[5]) << 8 | b[4];
  const bool high_zero = big ? (b[4] == 0 && b[5] == 0) : (b[6] == 0 && b[7] == 0);
  return high_zero && length <= 1024 && length <= source.size();
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
      source = DicomSource::memory(inflated(source, offset, kMaxInflated));
      offset = 0;
    }
    if (declared.empty() || declared == implicit_little_endian) syntax = detected(source, offset, syntax);
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
  char magic[4] = {0, 0, 0, 0};
  Syntax syntax;
  std::uint64_t start = 0;
  bool preamble = false;
  if (source.read(128, magic, 4) && std::memcmp(magic, "DICM", 4) == 0) {
    start = 132;
    preamble = true;
  } else if (!looks_like_data_set(source, syntax)) {
    return std::nullopt;
  }
  char group[2] = {0, 0};
  const bool has_meta = source.read(start, group, 2) && group[0] == 2 && group[1] == 0;
  if (preamble && !has_meta && source.read(start, group, 2)) {
    char b[6] = {0, 0, 0, 0, 0, 0};
    source.read(start, b, sizeof b);
    syntax.big_endian = b[0] == 0 && b[1] != 0;
    syntax.explicit_vr = upper_case(b[4]) && upper_case(b[5]);
  }
  DicomFile file{std::move(source), {}};
  parse(file.source, start, syntax, has_meta, file.header, texts);
  // Without the magic word it takes an attribute that every DICOM object has to believe in it.
  if (!preamble && file.header.sop_class.empty() && file.header.series_uid.empty() && !has_meta)
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
