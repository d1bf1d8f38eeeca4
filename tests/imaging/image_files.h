#pragma once
/// \file Image files, good and bad, that the tests build byte by byte.

#include "ostia/core/error.h"
#include "ostia/imaging/volume.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <vector>

namespace ostia::imaging::testing {
namespace fs = std::filesystem;

inline void write_bytes(const fs::path& path, const std::string& bytes) {
  std::ofstream out(path, std::ios::binary);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  ASSERT_TRUE(out.good()) << path;
}

inline std::string read_bytes(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return std::string(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
}

/// The values' bytes, little-endian or big-endian.
template <class T>
std::string bytes_of(const std::vector<T>& values, bool big = false) {
  std::string result(values.size() * sizeof(T), '\0');
  std::memcpy(result.data(), values.data(), result.size());
  if (big)
    for (std::size_t i = 0; i < values.size(); ++i)
      std::reverse(result.begin() + static_cast<std::ptrdiff_t>(i * sizeof(T)),
                   result.begin() + static_cast<std::ptrdiff_t>((i + 1) * sizeof(T)));
  return result;
}

/// As a gzip file (or a zlib stream).
inline std::string packed(const std::string& bytes, bool gzip = true, int level = 6) {
  z_stream z{};
  EXPECT_EQ(deflateInit2(&z, level, Z_DEFLATED, gzip ? 31 : 15, 8, Z_DEFAULT_STRATEGY), Z_OK);
  std::string result(deflateBound(&z, bytes.size()) + 64, '\0');
  z.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  z.avail_in = static_cast<uInt>(bytes.size());
  z.next_out = reinterpret_cast<Bytef*>(result.data());
  z.avail_out = static_cast<uInt>(result.size());
  EXPECT_EQ(deflate(&z, Z_FINISH), Z_STREAM_END);
  result.resize(z.total_out);
  deflateEnd(&z);
  return result;
}

/// 0, 1, 2, ... so that each voxel tells where it was stored.
template <class T = std::int16_t>
std::vector<T> counted(std::int64_t count) {
  std::vector<T> values(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<T>(i);
  return values;
}

using Fields = std::vector<std::pair<std::string, std::string>>;

/// `fields` with the values of `changes` put in (an empty value removes the field).
inline Fields changed(Fields fields, const std::map<std::string, std::string>& changes) {
  for (const auto& [name, value] : changes) {
    const auto found =
        std::find_if(fields.begin(), fields.end(), [&](const auto& field) { return field.first == name; });
    if (found != fields.end() && value.empty())
      fields.erase(found);
    else if (found != fields.end())
      found->second = value;
    else if (!value.empty())
      fields.insert(fields.end() - 1, {name, value});
  }
  return fields;
}

/// A NRRD header of 4 x 3 x 2 int16 voxels of 1 x 2 x 3 mm at (10, 20, 30).
inline std::string nrrd_header(const std::map<std::string, std::string>& changes = {}) {
  const Fields fields = changed({{"type", "short"},
                                 {"dimension", "3"},
                                 {"space", "left-posterior-superior"},
                                 {"sizes", "4 3 2"},
                                 {"space directions", "(1,0,0) (0,2,0) (0,0,3)"},
                                 {"endian", "little"},
                                 {"encoding", "raw"},
                                 {"space origin", "(10,20,30)"}},
                                changes);
  std::string text = "NRRD0004\n# a comment\n";
  for (const auto& [name, value] : fields) text += name + ": " + value + "\n";
  return text + "key:=value\n\n";
}

/// A MetaImage header of the same image, its data in image.raw.
inline std::string meta_header(const std::map<std::string, std::string>& changes = {}) {
  const Fields fields = changed({{"ObjectType", "Image"},
                                 {"NDims", "3"},
                                 {"BinaryData", "True"},
                                 {"BinaryDataByteOrderMSB", "False"},
                                 {"TransformMatrix", "1 0 0 0 1 0 0 0 1"},
                                 {"Offset", "10 20 30"},
                                 {"ElementSpacing", "1 2 3"},
                                 {"DimSize", "4 3 2"},
                                 {"ElementType", "MET_SHORT"},
                                 {"ElementDataFile", "image.raw"}},
                                changes);
  std::string text;
  for (const auto& [name, value] : fields) text += name + " = " + value + "\n";
  return text;
}

/// A NIfTI header of the same image (in LPS: axes and origin are turned to RAS by sform).
struct Nifti {
  int version = 1;
  bool big = false, pair = false;
  std::vector<std::int64_t> dim{3, 4, 3, 2, 1, 1, 1, 1};
  int datatype = 4, bitpix = 16;
  std::vector<double> pixdim{1, 1, 2, 3, 1, 1, 1, 1};
  double vox_offset = -1;  ///< -1: where the header ends
  double slope = 0, intercept = 0;
  int qform_code = 0, sform_code = 1, units = 2;
  std::vector<double> quatern{0, 0, 1}, qoffset{-10, -20, 30};
  std::vector<double> srow{-1, 0, 0, -10, 0, -2, 0, -20, 0, 0, 3, 30};

  std::string header() const {
    const bool one = version == 1;
    std::string h(one ? 352 : 544, '\0');
    const auto put = [&](std::size_t at, auto value) {
      char* to = h.data() + at;
      std::memcpy(to, &value, sizeof value);
      if (big) std::reverse(to, to + sizeof value);
    };
    const auto real = [&](std::size_t at1, std::size_t at2, double value, std::size_t i = 0) {
      if (one)
        put(at1 + 4 * i, static_cast<float>(value));
      else
        put(at2 + 8 * i, value);
    };
    const auto code = [&](std::size_t at1, std::size_t at2, int value) {
      if (one)
        put(at1, static_cast<std::int16_t>(value));
      else
        put(at2, static_cast<std::int32_t>(value));
    };
    put(0, static_cast<std::int32_t>(one ? 348 : 540));
    const std::string magic = one ? std::string(pair ? "ni1\0" : "n+1\0", 4)
                                  : std::string(pair ? "ni2\0\r\n\x1a\n" : "n+2\0\r\n\x1a\n", 8);
    h.replace(one ? 344 : 4, magic.size(), magic);
    for (std::size_t i = 0; i < 8; ++i) {
      if (one)
        put(40 + 2 * i, static_cast<std::int16_t>(dim[i]));
      else
        put(16 + 8 * i, dim[i]);
      real(76, 104, pixdim[i], i);
    }
    put(one ? 70 : 12, static_cast<std::int16_t>(datatype));
    put(one ? 72 : 14, static_cast<std::int16_t>(bitpix));
    const double offset = vox_offset >= 0 || pair ? std::max(vox_offset, 0.0) : static_cast<double>(h.size());
    if (one)
      put(108, static_cast<float>(offset));
    else
      put(168, static_cast<std::int64_t>(offset));
    real(112, 176, slope);
    real(116, 184, intercept);
    code(252, 344, qform_code);
    code(254, 348, sform_code);
    if (one)
      h[123] = static_cast<char>(units);
    else
      put(500, static_cast<std::int32_t>(units));
    for (std::size_t i = 0; i < 3; ++i) {
      real(256, 352, quatern[i], i);
      real(268, 376, qoffset[i], i);
    }
    for (std::size_t i = 0; i < 12; ++i) real(280, 400, srow[i], i);
    return h;
  }
  template <class T>
  std::string file(const std::vector<T>& voxels) const {
    return header() + bytes_of(voxels, big);
  }
};

/// What `work` says when it refuses; a failure when it does not, or with another class of error.
template <class Work>
std::string refusal(const Work& work) {
  try {
    work();
  } catch (const InvalidInput& error) {
    return error.what();
  } catch (const std::exception& error) {
    ADD_FAILURE() << "not an InvalidInput: " << error.what();
    return {};
  }
  ADD_FAILURE() << "was not refused";
  return {};
}

/// A grid that is neither axis-aligned nor isotropic.
inline Geometry oblique_grid(std::int64_t nx, std::int64_t ny, std::int64_t nz) {
  Geometry grid;
  grid.size = {nx, ny, nz};
  grid.spacing = Vec3(0.5, 0.7, 1.1);
  grid.origin = Vec3(-12.5, 40.25, 300.0);
  grid.direction =
      (Eigen::AngleAxisd(0.4, Vec3::UnitX()) * Eigen::AngleAxisd(-0.7, Vec3(1, 2, 3).normalized()))
          .toRotationMatrix();
  return grid;
}

/// Smooth and asymmetric integers, different in every voxel's neighbourhood.
template <class T>
Volume<T> patterned(const Geometry& grid) {
  Volume<T> volume{grid, std::vector<T>(static_cast<std::size_t>(grid.voxels()))};
  std::uint32_t state = 12345;
  for (T& v : volume.voxels) {
    state = state * 1664525U + 1013904223U;
    v = static_cast<T>(static_cast<double>(state >> 24) - (std::is_signed_v<T> ? 128.0 : 0.0));
  }
  return volume;
}

/// The value of voxel (i, j, k) where the file's voxels count 0, 1, 2, ... and the file is `size` large.
inline std::int16_t count_at(const std::array<std::int64_t, 3>& size, std::int64_t i, std::int64_t j,
                             std::int64_t k) {
  return static_cast<std::int16_t>(i + size[0] * (j + size[1] * k));
}

}  // namespace ostia::imaging::testing
