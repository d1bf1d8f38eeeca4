#pragma once
/// \file A new HDF5 file with arrays.

#include "ostia/geometry/vec.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace ostia::io {

/// Keeps HDF5 from printing its errors while it lives: what went wrong is in our own message.
class QuietHdf5 {
 public:
  QuietHdf5();
  ~QuietHdf5();
  QuietHdf5(const QuietHdf5&) = delete;
  QuietHdf5& operator=(const QuietHdf5&) = delete;

 private:
  int (*printer_)(std::int64_t, void*) = nullptr;  ///< of before
  void* printer_data_ = nullptr;
};

/// Throws IoError when HDF5 cannot write. Arrays of more than one row are compressed.
class Hdf5File {
 public:
  explicit Hdf5File(std::filesystem::path path);
  ~Hdf5File();
  Hdf5File(const Hdf5File&) = delete;
  Hdf5File& operator=(const Hdf5File&) = delete;
  void make_group(const std::string& name);
  /// Rows of `columns` numbers; one column is an array of one dimension.
  void write(const std::string& name, const std::vector<std::int32_t>& values, std::size_t columns);
  void write(const std::string& name, const std::vector<geometry::Vec3>& points);
  void close();

 private:
  void write(const std::string& name, std::int64_t type, const void* values, std::size_t rows,
             std::size_t columns);
  void require(bool good) const;
  QuietHdf5 quiet_;
  std::filesystem::path path_;
  std::int64_t file_ = -1;
};

}  // namespace ostia::io
