#include "mesh/classic_netcdf.h"

#include "surface_formats.h"

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace ostia::io {
namespace fs = std::filesystem;
namespace {

constexpr std::uint64_t largest_header = 16ULL << 20, largest_count = 1ULL << 40;

std::string begin_of(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::string begin(static_cast<std::size_t>(std::min<std::uint64_t>(fs::file_size(path), largest_header)),
                    '\0');
  in.read(begin.data(), static_cast<std::streamsize>(begin.size()));
  begin.resize(static_cast<std::size_t>(std::max<std::streamsize>(0, in.gcount())));
  return begin;
}

/// The header, number by number, big-endian.
class ClassicHeader {
 public:
  ClassicHeader(const fs::path& path, const std::string& bytes) : path_(path), bytes_(bytes) {
    kind_ = bytes[3];
    at_ = 4;
  }

  /// Bytes that the file must have.
  std::uint64_t least_size() {
    const std::uint64_t records = counted();
    read_dimensions();
    skip_attributes();
    read_variables();
    std::uint64_t record = 0, size = at_;
    for (const Variable& one : variables_)
      if (one.of_records) record += one.padded;
    for (const Variable& one : variables_) {
      if (!one.of_records) size = std::max(size, one.begin + one.bytes);
      // A file of records that is still being written counts them as unknown.
      if (one.of_records && records > 0 && records < unknown_records)
        size = std::max(size, one.begin + (records - 1) * record + one.bytes);
    }
    return size;
  }

 private:
  static constexpr std::uint64_t unknown_records = 0xffffffffULL;
  struct Variable {
    std::uint64_t begin = 0, bytes = 0, padded = 0;
    bool of_records = false;
  };

  [[noreturn]] void cut() const { refuse(path_, "it is cut short within its header; copy it again"); }
  std::uint64_t number(std::size_t bytes) {
    if (at_ + bytes > bytes_.size()) cut();
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < bytes; ++i)
      value = value << 8U | static_cast<unsigned char>(bytes_[static_cast<std::size_t>(at_++)]);
    return value;
  }
  std::uint64_t counted() { return number(kind_ == 5 ? 8 : 4); }
  /// Of what fits into a file; no sum of a few of these is past 64 bits.
  std::uint64_t bounded() {
    const std::uint64_t value = counted();
    if (value > largest_count) refuse(path_, "its header counts " + std::to_string(value) + " of something");
    return value;
  }
  void skip(std::uint64_t bytes) {
    at_ += (bytes + 3) / 4 * 4;
    if (at_ > bytes_.size()) cut();
  }
  void skip_name() { skip(bounded()); }
  /// How many are in the list that begins here.
  std::uint64_t list() {
    number(4);
    return bounded();
  }
  std::uint64_t bytes_of(std::uint64_t type) const {
    constexpr std::uint64_t sizes[] = {1, 1, 2, 4, 4, 8, 1, 2, 4, 8, 8};  // NC_BYTE is 1
    if (type < 1 || type > std::size(sizes)) refuse(path_, "its header names type " + std::to_string(type));
    return sizes[type - 1];
  }

  void read_dimensions() {
    for (std::uint64_t n = list(); n > 0; --n) {
      skip_name();
      lengths_.push_back(bounded());
    }
  }
  void skip_attributes() {
    for (std::uint64_t n = list(); n > 0; --n) {
      skip_name();
      const std::uint64_t one = bytes_of(number(4));
      skip(one * bounded());
    }
  }
  void read_variables() {
    for (std::uint64_t n = list(); n > 0; --n) {
      skip_name();
      Variable made;
      std::uint64_t values = 1;
      const std::uint64_t dimensions = bounded();
      for (std::uint64_t d = 0; d < dimensions; ++d) {
        const std::uint64_t id = bounded();
        if (id >= lengths_.size()) refuse(path_, "its header names a dimension that is not there");
        const std::uint64_t length = lengths_[static_cast<std::size_t>(id)];
        if (d == 0 && length == 0)
          made.of_records = true;
        else if (__builtin_mul_overflow(values, length, &values) || values > largest_count)
          refuse(path_, "its header has a variable of too many values");
      }
      skip_attributes();
      made.bytes = values * bytes_of(number(4));
      made.padded = (made.bytes + 3) / 4 * 4;
      counted();  // the size as it is padded; of large variables it is not right
      made.begin = number(kind_ == 1 ? 4 : 8);
      if (made.begin > largest_count) refuse(path_, "its header has a variable beyond any file's end");
      variables_.push_back(made);
    }
  }

  const fs::path& path_;
  const std::string& bytes_;
  char kind_ = 0;
  std::uint64_t at_ = 0;
  std::vector<std::uint64_t> lengths_;
  std::vector<Variable> variables_;
};

}  // namespace

void require_whole_netcdf(const fs::path& path) {
  const std::string begin = begin_of(path);
  if (begin.size() < 4 || begin.compare(0, 3, "CDF") != 0 ||
      (begin[3] != 1 && begin[3] != 2 && begin[3] != 5))
    return;
  const std::uint64_t needed = ClassicHeader(path, begin).least_size(), there = fs::file_size(path);
  if (there < needed)
    refuse(path, "it is cut short: it has " + std::to_string(there) + " of " + std::to_string(needed) +
                     " bytes; copy it again");
}

}  // namespace ostia::io
