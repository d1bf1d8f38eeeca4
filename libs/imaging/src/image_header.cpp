#include "foreign_source.h"
#include "image_data.h"
#include "image_source.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>

namespace ostia::imaging {
namespace fs = std::filesystem;
namespace {

bool is_space(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\v' || c == '\f';
}

template <class T>
std::optional<T> parsed(std::string_view text) {
  if (!text.empty() && text.front() == '+') {
    text.remove_prefix(1);
    if (!text.empty() && text.front() == '-') return std::nullopt;
  }
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

}  // namespace

std::uint64_t ImageSource::bytes() const {
  return static_cast<std::uint64_t>(voxels()) * bytes_of(pixel_type);
}

int bytes_of(PixelType type) {
  switch (type) {
    case PixelType::int8:
    case PixelType::uint8:
      return 1;
    case PixelType::int16:
    case PixelType::uint16:
      return 2;
    case PixelType::int32:
    case PixelType::uint32:
    case PixelType::float32:
      return 4;
    default:
      return 8;
  }
}

void refuse(const fs::path& file, const std::string& field, const std::string& what) {
  throw InvalidInput(file.string() + ": " + field + ": " + what);
}

std::optional<double> to_double(std::string_view text) {
  return parsed<double>(text);
}
std::optional<std::int64_t> to_integer(std::string_view text) {
  return parsed<std::int64_t>(text);
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
  return text;
}

std::string lower_case(std::string_view text) {
  std::string result(text);
  for (char& c : result)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return result;
}

std::vector<std::string_view> words(std::string_view text) {
  std::vector<std::string_view> result;
  std::size_t at = 0;
  while (at < text.size()) {
    while (at < text.size() && is_space(text[at])) ++at;
    const std::size_t start = at;
    while (at < text.size() && !is_space(text[at])) ++at;
    if (at > start) result.push_back(text.substr(start, at - start));
  }
  return result;
}

void HeaderFields::add(std::string_view name, std::string_view value) {
  if (!values_.emplace(lower_case(name), std::string(value)).second)
    refuse(file_, std::string(name), "given twice; leave one");
}

const std::string* HeaderFields::find(const std::string& name) const {
  const auto found = values_.find(lower_case(name));
  return found == values_.end() ? nullptr : &found->second;
}

const std::string* HeaderFields::find_any(std::initializer_list<const char*> names) const {
  for (const char* name : names)
    if (const std::string* value = find(name)) return value;
  return nullptr;
}

const std::string& HeaderFields::require(const std::string& name) const {
  const std::string* value = find(name);
  if (!value) refuse(file_, name, "missing from the header");
  return *value;
}

std::int64_t HeaderFields::integer(const std::string& name) const {
  return integers(name, 1)[0];
}

std::vector<double> HeaderFields::numbers(const std::string& name, std::size_t count) const {
  std::vector<double> result;
  const std::string& text = require(name);
  for (const std::string_view word : words(text)) {
    const auto value = to_double(word);
    if (!value) refuse(file_, name, "'" + std::string(word) + "' is not a number");
    result.push_back(*value);
  }
  if (count > 0 && result.size() != count)
    refuse(file_, name, "has " + std::to_string(result.size()) + " numbers, needs " + std::to_string(count));
  return result;
}

std::vector<std::int64_t> HeaderFields::integers(const std::string& name, std::size_t count) const {
  std::vector<std::int64_t> result;
  const std::string& text = require(name);
  for (const std::string_view word : words(text)) {
    const auto value = to_integer(word);
    if (!value) refuse(file_, name, "'" + std::string(word) + "' is not a whole number (of at most 64 bits)");
    result.push_back(*value);
  }
  if (count > 0 && result.size() != count)
    refuse(file_, name, "has " + std::to_string(result.size()) + " numbers, needs " + std::to_string(count));
  return result;
}

bool HeaderFields::flag(const std::string& name, bool otherwise) const {
  const std::string* value = find(name);
  if (!value) return otherwise;
  const std::string text = lower_case(*value);
  if (text == "true" || text == "t" || text == "1") return true;
  if (text == "false" || text == "f" || text == "0") return false;
  refuse(file_, name, "'" + *value + "' is neither True nor False");
}

void check_sizes(const fs::path& file, const std::string& field, const std::array<std::int64_t, 3>& size) {
  std::int64_t voxels = 1;
  bool overflow = false;
  for (const std::int64_t n : size) {
    if (n <= 0) refuse(file, field, "a size of " + std::to_string(n) + " voxels; each must be 1 or more");
    overflow = overflow || __builtin_mul_overflow(voxels, n, &voxels);
  }
  if (overflow || voxels > max_voxels)
    refuse(file, field,
           std::to_string(size[0]) + " x " + std::to_string(size[1]) + " x " + std::to_string(size[2]) +
               " voxels; at most " + std::to_string(max_voxels) + " are read");
}

void check_spacing(const fs::path& file, const std::string& field, double spacing) {
  if (!(spacing > 0.0) || !std::isfinite(spacing))
    refuse(file, field, "a spacing of " + core::shortest_text(spacing) + "; it must be finite and above 0");
}

std::uint64_t regular_file_size(const fs::path& file) {
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (!fs::exists(status)) throw IoError(file.string() + ": there is no such file, or it cannot be reached");
  if (!fs::is_regular_file(status)) throw IoError(file.string() + ": is not a regular file");
  const std::uintmax_t size = fs::file_size(file, error);
  if (error) throw IoError(file.string() + ": cannot be read (" + error.message() + ")");
  return size;
}

fs::path data_file(const fs::path& header, const std::string& field, const std::string& name) {
  const fs::path given(name);
  const std::string rule = "; the data file must lie in the header's own folder";
  if (name.empty()) refuse(header, field, "names no file");
  if (given.is_absolute()) refuse(header, field, "'" + name + "' is an absolute path" + rule);
  if (std::find(given.begin(), given.end(), "..") != given.end())
    refuse(header, field, "'" + name + "' leads up" + rule);
  const fs::path folder = header.has_parent_path() ? header.parent_path() : fs::path(".");
  const fs::path path = folder / given;
  std::error_code error;
  if (!fs::exists(path, error)) refuse(header, field, "there is no file '" + name + "' beside the header");
  const fs::path real_folder = fs::canonical(folder, error), real = fs::canonical(path, error);
  if (error) throw IoError(path.string() + ": cannot be read (" + error.message() + ")");
  const auto parting = std::mismatch(real_folder.begin(), real_folder.end(), real.begin(), real.end());
  if (parting.first != real_folder.end())
    refuse(header, field, "'" + name + "' is a link that leads out" + rule);
  if (!fs::is_regular_file(real, error)) refuse(header, field, "'" + name + "' is not a regular file");
  return path;
}

ImageSource read_source(const fs::path& given) {
  fs::path path = given;
  if (lower_case(given.extension().string()) == ".img")
    path.replace_extension(".hdr");  // the pair's header says more
  if (regular_file_size(path) == 0) throw InvalidInput(path.string() + ": size: the file is empty");
  bool compressed = false;
  const std::string head = file_head(path, max_header_bytes, compressed);
  ImageSource source;
  if (is_nifti(head)) {
    source = parse_nifti(path, head, compressed ? Encoding::deflate : Encoding::raw);
  } else if (!compressed && head.rfind("NRRD", 0) == 0) {
    source = parse_nrrd(path, head);
  } else if (!compressed && (lower_case(head).find("elementdatafile") != std::string::npos ||
                             lower_case(path.extension().string()) == ".mhd" ||
                             lower_case(path.extension().string()) == ".mha")) {
    source = parse_meta_image(path, head);
  } else if (const std::string foreign = foreign_format_of(path, head); !foreign.empty()) {
    source = read_foreign_source(path, foreign);
  } else if (!compressed && head.size() > 132 && head.compare(128, 4, "DICM") == 0) {
    throw InvalidInput(path.string() + ": format: a DICOM file; give the folder of its series");
  } else {
    throw InvalidInput(
        path.string() +
        ": format: neither NRRD, MetaImage (MHD, MHA) nor NIfTI, nor GIPL, TIFF, VTK image, Analyze or HDF5 "
        "image, or its header is cut short");
  }
  check_data_size(source);
  return source;
}

}  // namespace ostia::imaging
