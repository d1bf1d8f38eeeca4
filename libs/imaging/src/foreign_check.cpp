#include "foreign_check.h"

#include "image_source.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <optional>
#include <vector>

namespace ostia::imaging {
namespace fs = std::filesystem;
namespace {

[[noreturn]] void refuse_cut(std::uint64_t has, std::uint64_t needs, const std::string& what) {
  throw InvalidInput("it is cut short: " + std::to_string(has) + " of " + std::to_string(needs) + " " + what);
}

void require_bytes(const fs::path& path, std::uint64_t before, std::uint64_t bytes) {
  const std::uint64_t size = regular_file_size(path);
  if (size < before + bytes)
    refuse_cut(size > before ? size - before : 0, bytes, "bytes of voxels are there");
}

/// GIPL's header has 256 bytes.
void check_gipl(const fs::path& path, std::uint64_t bytes) {
  std::ifstream in(path, std::ios::binary);
  std::array<unsigned char, 2> start{};
  in.read(reinterpret_cast<char*>(start.data()), start.size());
  if (start[0] == 0x1f && start[1] == 0x8b) throw InvalidInput("it is packed by gzip; unpack it first");
  require_bytes(path, 256, bytes);
}

void check_analyze(const fs::path& path, std::uint64_t bytes) {
  for (const char* end : {".img", ".IMG"}) {
    fs::path data = path;
    data.replace_extension(end);
    if (fs::exists(data)) return require_bytes(data, 0, bytes);
  }
  throw InvalidInput("its data file, of the same name with .img, is not there");
}

/// Where the values of a legacy VTK file begin: behind the line of the lookup table, or of the scalars where
/// there is none.
void check_vtk(const fs::path& path, std::uint64_t voxels, std::uint64_t bytes) {
  std::ifstream in(path, std::ios::binary);
  std::string line;
  bool text = false;
  std::streampos values = -1;
  for (int n = 0; n < 64 && line.size() < 4096 && std::getline(in, line); ++n) {
    const std::string word = lower_case(trimmed(line));
    if (word == "ascii") text = true;
    if (word.rfind("lookup_table", 0) == 0) {
      values = in.tellg();
      break;
    }
    if (word.rfind("scalars", 0) == 0) values = in.tellg();
  }
  if (values < 0) throw InvalidInput("it has no scalars");
  if (!text) return require_bytes(path, static_cast<std::uint64_t>(values), bytes);
  in.clear();
  in.seekg(values);
  std::uint64_t found = 0;
  while (found < voxels && in >> line) ++found;
  if (found < voxels) refuse_cut(found, voxels, "values are there");
}

/// The pages of a TIFF file, whose strips or tiles must lie within it.
class TiffPages {
 public:
  explicit TiffPages(const fs::path& path) : in_(path, std::ios::binary), size_(regular_file_size(path)) {
    std::array<char, 4> start{};
    in_.read(start.data(), start.size());
    big_endian_ = start[0] == 'M';
    large_ = start[big_endian_ ? 3 : 2] == 43;  // offsets of 64 bits
  }

  void check() {
    std::uint64_t page = number(large_ ? 8 : 4, large_ ? 8 : 4);
    for (int n = 0; page != 0; ++n) {
      if (n >= 65536) throw InvalidInput("its pages have no end");
      page = check_page(page);
    }
  }

 private:
  struct Entry {
    std::uint64_t type = 0, count = 0, at = 0;  ///< where its values are
  };

  std::uint64_t number(std::uint64_t at, int bytes) {
    std::array<unsigned char, 8> raw{};
    if (at > size_ || size_ - at < static_cast<std::uint64_t>(bytes))
      refuse_cut(size_, at + 8, "bytes are there");
    in_.clear();
    in_.seekg(static_cast<std::streamoff>(at));
    in_.read(reinterpret_cast<char*>(raw.data()), bytes);
    std::uint64_t value = 0;
    for (int i = 0; i < bytes; ++i)
      value = value << 8 | raw[static_cast<std::size_t>(big_endian_ ? i : bytes - 1 - i)];
    return value;
  }

  static int width(std::uint64_t type) { return type == 3 ? 2 : type == 4 ? 4 : type == 16 ? 8 : 0; }

  std::vector<std::uint64_t> values(const Entry& entry) {
    const int bytes = width(entry.type);
    if (bytes == 0 || entry.count > (1U << 22)) throw InvalidInput("a list of its strips is damaged");
    std::vector<std::uint64_t> list;
    for (std::uint64_t i = 0; i < entry.count; ++i)
      list.push_back(number(entry.at + i * static_cast<std::uint64_t>(bytes), bytes));
    return list;
  }

  /// Where the next one is.
  std::uint64_t check_page(std::uint64_t page) {
    const int head = large_ ? 8 : 2, entry_bytes = large_ ? 20 : 12, inside = large_ ? 8 : 4;
    const std::uint64_t entries = number(page, head);
    if (entries > 4096) throw InvalidInput("the directory of a page is damaged");
    std::optional<Entry> offsets, counts;
    for (std::uint64_t e = 0; e < entries; ++e) {
      const std::uint64_t at =
          page + static_cast<std::uint64_t>(head) + e * static_cast<std::uint64_t>(entry_bytes);
      const std::uint64_t tag = number(at, 2);
      if (tag != 273 && tag != 279 && tag != 324 && tag != 325) continue;
      Entry entry{number(at + 2, 2), number(at + 4, inside), at + 4 + static_cast<std::uint64_t>(inside)};
      if (entry.count * static_cast<std::uint64_t>(width(entry.type)) > static_cast<std::uint64_t>(inside))
        entry.at = number(entry.at, inside);
      (tag == 273 || tag == 324 ? offsets : counts) = entry;
    }
    if (!offsets || !counts) throw InvalidInput("a page has no strips");
    check_strips(values(*offsets), values(*counts));
    return number(page + static_cast<std::uint64_t>(head) + entries * static_cast<std::uint64_t>(entry_bytes),
                  inside);
  }

  void check_strips(const std::vector<std::uint64_t>& offsets,
                    const std::vector<std::uint64_t>& counts) const {
    if (offsets.size() != counts.size()) throw InvalidInput("a page's strips have no lengths");
    for (std::size_t i = 0; i < offsets.size(); ++i)
      if (offsets[i] > size_ || counts[i] > size_ - offsets[i])
        refuse_cut(size_, offsets[i] + counts[i], "bytes are there");
  }

  std::ifstream in_;
  std::uint64_t size_;
  bool big_endian_ = false, large_ = false;
};

}  // namespace

void require_complete(const fs::path& path, const std::string& format, std::uint64_t voxels,
                      std::uint64_t bytes) {
  if (format == "GIPL") return check_gipl(path, bytes);
  if (format == "Analyze") return check_analyze(path, bytes);
  if (format == "VTK image") return check_vtk(path, voxels, bytes);
  if (format == "TIFF") return TiffPages(path).check();
}  // HDF5 checks by itself

}  // namespace ostia::imaging
