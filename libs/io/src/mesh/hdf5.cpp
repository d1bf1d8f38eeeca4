#include "mesh/hdf5.h"

#include "mesh/text.h"

#include <hdf5.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <utility>

namespace ostia::io {

QuietHdf5::QuietHdf5() {
  H5Eget_auto2(H5E_DEFAULT, &printer_, &printer_data_);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

QuietHdf5::~QuietHdf5() {
  H5Eset_auto2(H5E_DEFAULT, printer_, printer_data_);
}

Hdf5File::Hdf5File(std::filesystem::path path) : path_(std::move(path)) {
  errno = 0;
  file_ = H5Fcreate(path_.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  require(file_ >= 0);
}

Hdf5File::~Hdf5File() {
  if (file_ >= 0) H5Fclose(file_);
}

void Hdf5File::require(bool good) const {
  if (!good) throw_cannot_write(path_, errno ? errno : EIO);
}

void Hdf5File::make_group(const std::string& name) {
  const hid_t group = H5Gcreate2(file_, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  require(group >= 0);
  H5Gclose(group);
}

void Hdf5File::write(const std::string& name, std::int64_t type, const void* values, std::size_t rows,
                     std::size_t columns) {
  const std::array<hsize_t, 2> size = {rows, columns};
  const int rank = columns == 1 ? 1 : 2;
  const hid_t space = H5Screate_simple(rank, size.data(), nullptr);
  const hid_t layout = H5Pcreate(H5P_DATASET_CREATE);
  const std::array<hsize_t, 2> chunk = {std::min<hsize_t>(rows, 1 << 16), columns};
  H5Pset_chunk(layout, rank, chunk.data());
  H5Pset_deflate(layout, 4);
  errno = 0;
  const hid_t set = H5Dcreate2(file_, name.c_str(), type, space, H5P_DEFAULT, layout, H5P_DEFAULT);
  const bool good = set >= 0 && H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) >= 0;
  const bool closed = set < 0 || H5Dclose(set) >= 0;
  H5Pclose(layout);
  H5Sclose(space);
  require(good && closed);
}

void Hdf5File::write(const std::string& name, const std::vector<std::int32_t>& values, std::size_t columns) {
  write(name, H5T_NATIVE_INT32, values.data(), values.size() / columns, columns);
}

void Hdf5File::write(const std::string& name, const std::vector<geometry::Vec3>& points) {
  static_assert(sizeof(geometry::Vec3) == 3 * sizeof(double));
  write(name, H5T_NATIVE_DOUBLE, points.data(), points.size(), 3);
}

void Hdf5File::close() {
  errno = 0;
  const bool flushed = H5Fflush(file_, H5F_SCOPE_GLOBAL) >= 0;
  require(H5Fclose(std::exchange(file_, -1)) >= 0 && flushed);
}

}  // namespace ostia::io
