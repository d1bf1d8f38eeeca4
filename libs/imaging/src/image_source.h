#pragma once
/// \file What the header of an image file says, before its voxels are put in order. Private to the room.

#include "ostia/core/private_folder.h"
#include "ostia/imaging/image_file.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ostia::imaging {

enum class Encoding { raw, deflate, text };  ///< deflate: gzip or zlib

/// One scalar image in a file: where its voxels are, what they mean, and where they lie in LPS and mm.
struct ImageSource {
  std::string format;
  std::filesystem::path header_path, data_path;
  Encoding encoding = Encoding::raw;
  std::uint64_t offset = 0;  ///< bytes of the data file before the stream
  std::uint64_t skip = 0;    ///< bytes of the decoded stream before the first voxel
  bool big_endian = false;
  PixelType pixel_type = PixelType::int16;
  std::array<std::int64_t, 3> size{0, 0, 0};
  Mat3 step =
      Mat3::Identity();  ///< columns: from one voxel to the next along i, j, k; any lengths and angles
  Vec3 origin = Vec3::Zero();
  std::string axes_field;  ///< the header's name for `step`, for messages
  double slope = 1.0, intercept = 0.0;
  std::vector<std::string> warnings;
  std::shared_ptr<const core::PrivateFolder> kept{};  ///< that holds the data file, where the worker made it

  std::int64_t voxels() const { return size[0] * size[1] * size[2]; }
  std::uint64_t bytes() const;
};
int bytes_of(PixelType type);

/// The most voxels an image may have.
constexpr std::int64_t max_voxels = std::int64_t{1} << 31;
/// The longest text header that is read.
constexpr std::size_t max_header_bytes = std::size_t{1} << 20;

/// Finds the format by content, reads and checks the header and that the data can be there in full.
ImageSource read_source(const std::filesystem::path& path);

ImageSource parse_nrrd(const std::filesystem::path& path, const std::string& head);
ImageSource parse_meta_image(const std::filesystem::path& path, const std::string& head);
bool is_nifti(const std::string& head);
/// `head`: at least the header's bytes, decompressed; `encoding`: how the file itself is packed.
ImageSource parse_nifti(const std::filesystem::path& path, const std::string& head, Encoding encoding);

/// Throws InvalidInput "FILE: FIELD: WHAT".
[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& field,
                         const std::string& what);

/// Numbers as every file format writes them, whatever the locale: the whole text is one number, or nothing.
std::optional<double> to_double(std::string_view text);
std::optional<std::int64_t> to_integer(std::string_view text);

std::string_view trimmed(std::string_view text);
std::string lower_case(std::string_view text);
std::vector<std::string_view> words(std::string_view text);

/// The "name: value" lines of a header by lower-case name.
class HeaderFields {
 public:
  explicit HeaderFields(std::filesystem::path file) : file_(std::move(file)) {}
  void add(std::string_view name, std::string_view value);  ///< refuses a second value
  const std::string* find(const std::string& name) const;
  /// The value under the first of `names` that is there.
  const std::string* find_any(std::initializer_list<const char*> names) const;
  const std::string& require(const std::string& name) const;
  std::int64_t integer(const std::string& name) const;
  /// The numbers of a field that must be there; "nan" counts as a number. Exactly `count` of them where
  /// `count` > 0.
  std::vector<double> numbers(const std::string& name, std::size_t count) const;
  std::vector<std::int64_t> integers(const std::string& name, std::size_t count) const;
  bool flag(const std::string& name, bool otherwise) const;

 private:
  std::filesystem::path file_;
  std::map<std::string, std::string> values_;
};

/// Throws unless each size is positive and their product within `max_voxels`.
void check_sizes(const std::filesystem::path& file, const std::string& field,
                 const std::array<std::int64_t, 3>& size);
/// Throws unless finite and positive.
void check_spacing(const std::filesystem::path& file, const std::string& field, double spacing);
/// The data file that a header names: a regular file in the header's folder or below it, links resolved.
/// Throws otherwise.
std::filesystem::path data_file(const std::filesystem::path& header, const std::string& field,
                                const std::string& name);
/// Throws IoError unless it is a regular file that can be read.
std::uint64_t regular_file_size(const std::filesystem::path& file);

}  // namespace ostia::imaging
