#pragma once
/// \file Small DICOM files made up for tests.

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace ostia::testing {

enum class Encoding { implicit_little, explicit_little, explicit_big };

/// Elements in the order of their tags, written one after the other.
class DicomWriter {
 public:
  explicit DicomWriter(Encoding encoding = Encoding::explicit_little) : encoding_(encoding) {}

  void text(std::uint32_t tag, const char* vr, std::string value) {
    if (value.size() % 2 != 0) value.push_back(std::string(vr) == "UI" ? '\0' : ' ');
    element(tag, vr, value);
  }
  void u16(std::uint32_t tag, unsigned value) { element(tag, "US", bytes(value, 2)); }
  void f64(std::uint32_t tag, double value) {
    std::uint64_t bits = 0;
    static_assert(sizeof bits == sizeof value);
    std::copy_n(reinterpret_cast<const char*>(&value), 8, reinterpret_cast<char*>(&bits));
    element(tag, "FD", bytes(bits, 8));
  }
  /// An element with a length of one's own: the value need not be as long as it says.
  void element(std::uint32_t tag, const char* vr, const std::string& value, std::int64_t length = -1) {
    const std::uint64_t said = length < 0 ? value.size() : static_cast<std::uint64_t>(length);
    put_tag(tag);
    if (encoding_ == Encoding::implicit_little) {
      out_ += bytes(said, 4);
    } else {
      out_ += vr;
      const std::string name = vr;
      const bool wide = name == "OB" || name == "OW" || name == "SQ" || name == "UN" || name == "UT";
      if (wide) out_ += std::string(2, '\0');
      out_ += bytes(said, wide ? 4 : 2);
    }
    out_ += value;
  }
  /// A sequence of items, each written by one function.
  void sequence(std::uint32_t tag, const std::vector<std::function<void(DicomWriter&)>>& items,
                bool defined = false) {
    std::string content;
    for (const auto& item : items) {
      DicomWriter inner(encoding_);
      item(inner);
      DicomWriter head(encoding_);
      head.put_tag(0xFFFEE000u);
      content += head.out_ + bytes(defined ? inner.out_.size() : 0xFFFFFFFFu, 4) + inner.out_;
      if (!defined) content += delimiter(0xFFFEE00Du);
    }
    if (!defined) content += delimiter(0xFFFEE0DDu);
    element(tag, "SQ", content, defined ? -1 : 0xFFFFFFFFll);
  }
  /// Compressed pixel data, one fragment each.
  void fragments(const std::vector<std::string>& streams) {
    std::string content = item({});
    for (const std::string& stream : streams) content += item(stream);
    element(0x7FE00010u, "OB", content + delimiter(0xFFFEE0DDu), 0xFFFFFFFFll);
  }
  void raw(const std::string& more) { out_ += more; }
  const std::string& data_set() const { return out_; }

  std::string bytes(std::uint64_t value, int count) const {
    std::string result;
    for (int i = 0; i < count; ++i) {
      const int shift = 8 * (encoding_ == Encoding::explicit_big ? count - 1 - i : i);
      result.push_back(static_cast<char>(value >> shift & 0xFF));
    }
    return result;
  }

 private:
  void put_tag(std::uint32_t tag) { out_ += bytes(tag >> 16, 2) + bytes(tag & 0xFFFF, 2); }
  std::string delimiter(std::uint32_t tag) const {
    return bytes(tag >> 16, 2) + bytes(tag & 0xFFFF, 2) + std::string(4, '\0');
  }
  std::string item(const std::string& content) const {
    return bytes(0xFFFE, 2) + bytes(0xE000, 2) + bytes(content.size() + content.size() % 2, 4) + content +
           std::string(content.size() % 2, '\0');
  }
  Encoding encoding_;
  std::string out_;
};

/// A whole file: preamble, meta information, data set.
inline std::string part10(const std::string& transfer_syntax, const std::string& data_set) {
  DicomWriter meta;
  meta.text(0x00020010u, "UI", transfer_syntax);
  DicomWriter group;
  group.element(0x00020000u, "UL", group.bytes(meta.data_set().size(), 4));
  return std::string(128, '\0') + "DICM" + group.data_set() + meta.data_set() + data_set;
}

inline void write_bytes(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

/// One CT slice. An attribute whose text is empty is left out. Value at (i, j): `value(i, j)`.
struct CtSlice {
  Encoding encoding = Encoding::explicit_little;
  std::string transfer_syntax = "1.2.840.10008.1.2.1";
  std::string sop_instance = "1.2.3.4.1", series = "1.2.3", modality = "CT",
              image_type = "ORIGINAL\\PRIMARY\\AXIAL";
  std::string position = "0\\0\\0", orientation = "1\\0\\0\\0\\1\\0", pixel_spacing = "0.5\\0.5",
              thickness = "9";
  std::string slope = "1", intercept = "-1024", instance = "1", photometric = "MONOCHROME2";
  std::string patient_name = "DOE^JANE", patient_id, study, study_date, description, character_set,
              window_centre, window_width;
  std::string tube_kv, kernel;
  std::string acquisition, trigger_time, temporal_position, content_time, cardiac_percent, frames;
  unsigned rows = 4, columns = 5, samples = 1, bits_allocated = 16, bits_stored = 12, high_bit = 11,
           is_signed = 0;
  std::function<int(int, int)> value = [](int i, int j) { return 1024 + 10 * i + j; };
  std::vector<std::string> streams;  ///< compressed pixel data instead
  std::string pixels;                ///< raw pixel data instead
  bool has_pixels = true;

  std::string raw_pixels() const {
    if (!pixels.empty()) return pixels;
    std::string result;
    DicomWriter w(encoding);
    for (unsigned j = 0; j < rows; ++j) {
      for (unsigned i = 0; i < columns; ++i) {
        result += w.bytes(static_cast<std::uint64_t>(
                              static_cast<std::int64_t>(value(static_cast<int>(i), static_cast<int>(j)))),
                          static_cast<int>(bits_allocated / 8));
      }
    }
    return result;
  }

  std::string data_set() const {
    DicomWriter w(encoding);
    const auto put = [&](std::uint32_t tag, const char* vr, const std::string& text) {
      if (!text.empty()) w.text(tag, vr, text);
    };
    put(0x00080005u, "CS", character_set);
    put(0x00080008u, "CS", image_type);
    put(0x00080016u, "UI", "1.2.840.10008.5.1.4.1.1.2");
    put(0x00080018u, "UI", sop_instance);
    put(0x00080020u, "DA", study_date);
    put(0x00080033u, "TM", content_time);
    put(0x00080060u, "CS", modality);
    put(0x0008103Eu, "LO", description);
    put(0x00100010u, "PN", patient_name);
    put(0x00100020u, "LO", patient_id);
    put(0x00180050u, "DS", thickness);
    put(0x00180060u, "DS", tube_kv);
    put(0x00181060u, "DS", trigger_time);
    put(0x00181210u, "SH", kernel);
    put(0x0020000Du, "UI", study);
    put(0x0020000Eu, "UI", series);
    put(0x00200012u, "IS", acquisition);
    put(0x00200013u, "IS", instance);
    put(0x00200032u, "DS", position);
    put(0x00200037u, "DS", orientation);
    put(0x00200100u, "IS", temporal_position);
    w.u16(0x00280002u, samples);
    put(0x00280004u, "CS", photometric);
    put(0x00280008u, "IS", frames);
    w.u16(0x00280010u, rows);
    w.u16(0x00280011u, columns);
    put(0x00280030u, "DS", pixel_spacing);
    w.u16(0x00280100u, bits_allocated);
    w.u16(0x00280101u, bits_stored);
    w.u16(0x00280102u, high_bit);
    w.u16(0x00280103u, is_signed);
    put(0x00281050u, "DS", window_centre);
    put(0x00281051u, "DS", window_width);
    put(0x00281052u, "DS", intercept);
    put(0x00281053u, "DS", slope);
    if (!streams.empty()) {
      w.fragments(streams);
    } else if (has_pixels) {
      w.element(0x7FE00010u, "OW", raw_pixels());
    }
    return w.data_set();
  }
  std::string file() const { return part10(transfer_syntax, data_set()); }
  void write(const std::filesystem::path& path) const { write_bytes(path, file()); }
};

/// A series of `count` slices along z; `change` may alter each.
inline void write_series(
    const std::filesystem::path& folder, int count, double spacing_mm,
    const std::function<void(CtSlice&, int)>& change = [](CtSlice&, int) {}) {
  for (int k = 0; k < count; ++k) {
    CtSlice slice;
    slice.sop_instance = "1.2.3.4." + std::to_string(k);
    slice.instance = std::to_string(k + 1);
    slice.position = "-10\\-20\\" + std::to_string(100.0 + spacing_mm * k);
    slice.value = [k](int i, int j) { return 1024 + 100 * k + 10 * j + i; };
    change(slice, k);
    slice.write(folder / ("slice" + std::to_string(k) + ".dcm"));
  }
}

struct EnhancedFrame {
  std::string position;
  double cardiac_percent = -1.0;  ///< negative: left out
};

/// An enhanced CT image of frames of 2 x 2 pixels, the i-th of frame f stored as 100 f + i; slope 2,
/// intercept -10.
inline std::string enhanced_ct(const std::vector<EnhancedFrame>& frames) {
  using Item = std::function<void(DicomWriter&)>;
  DicomWriter w;
  w.text(0x00080016u, "UI", "1.2.840.10008.5.1.4.1.1.2.1");
  w.text(0x00080060u, "CS", "CT");
  w.text(0x0020000Eu, "UI", "1.2.3");
  w.u16(0x00280002u, 1);
  w.text(0x00280004u, "CS", "MONOCHROME2");
  w.text(0x00280008u, "IS", std::to_string(frames.size()));
  for (const auto& [tag, value] : {std::pair{0x00280010u, 2u},
                                   {0x00280011u, 2u},
                                   {0x00280100u, 16u},
                                   {0x00280101u, 16u},
                                   {0x00280102u, 15u},
                                   {0x00280103u, 1u}}) {
    w.u16(tag, value);
  }
  const Item shared = [](DicomWriter& item) {
    item.sequence(0x00209116u, {Item([](auto& m) { m.text(0x00200037u, "DS", "1\\0\\0\\0\\1\\0"); })});
    item.sequence(0x00289110u, {Item([](auto& m) { m.text(0x00280030u, "DS", "0.5\\0.5"); })});
    item.sequence(0x00289145u, {Item([](auto& m) {
                    m.text(0x00281052u, "DS", "-10");
                    m.text(0x00281053u, "DS", "2");
                  })});
  };
  std::vector<Item> own;
  std::string pixels;
  for (std::size_t f = 0; f < frames.size(); ++f) {
    own.push_back([&frame = frames[f]](DicomWriter& item) {
      if (frame.cardiac_percent >= 0.0)
        item.sequence(0x00189118u, {Item([&](auto& m) { m.f64(0x00209241u, frame.cardiac_percent); })});
      item.sequence(0x00209113u, {Item([&](auto& m) { m.text(0x00200032u, "DS", frame.position); })});
    });
    for (std::size_t i = 0; i < 4; ++i) pixels += w.bytes(100 * f + i, 2);
  }
  w.sequence(0x52009229u, {shared});
  w.sequence(0x52009230u, own);
  w.element(0x7FE00010u, "OW", pixels);
  return part10("1.2.840.10008.1.2.1", w.data_set());
}

}  // namespace ostia::testing
