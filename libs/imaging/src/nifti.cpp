#include "image_data.h"
#include "image_source.h"

#include "ostia/core/text.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

// The format: nifti1.h and nifti2.h of the NIfTI Data Format Working Group, nifti.nimh.nih.gov.

namespace ostia::imaging {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t size_1 = 348, size_2 = 540;

template <class T>
T number_at(const std::string& head, std::size_t at, bool swap) {
  char bytes[sizeof(T)];
  std::memcpy(bytes, head.data() + at, sizeof(T));
  if (swap) std::reverse(bytes, bytes + sizeof(T));
  T value;
  std::memcpy(&value, bytes, sizeof(T));
  return value;
}

struct Kind {
  int version = 0;  ///< 0: not NIfTI
  bool swap = false, pair = false;
};

Kind kind_of(const std::string& head) {
  for (const bool swap : {false, true}) {
    if (head.size() < 4) break;
    const auto length = number_at<std::int32_t>(head, 0, swap);
    if (length == size_1 && head.size() >= size_1) {
      const std::string magic = head.substr(344, 4);
      if (magic == std::string("n+1\0", 4)) return {1, swap, false};
      if (magic == std::string("ni1\0", 4)) return {1, swap, true};
    }
    if (length == size_2 && head.size() >= size_2) {
      const std::string magic = head.substr(4, 8);
      if (magic == std::string("n+2\0\r\n\x1a\n", 8)) return {2, swap, false};
      if (magic == std::string("ni2\0\r\n\x1a\n", 8)) return {2, swap, true};
    }
  }
  return {};
}

/// The fields of either version that matter, in their widest types.
struct NiftiHeader {
  std::int64_t dim[8];
  double pixdim[8], vox_offset, slope, intercept, quatern[3], qoffset[3], srow[3][4];
  int datatype, bitpix, qform_code, sform_code, xyzt_units;
};

NiftiHeader parsed(const std::string& head, const Kind& kind) {
  NiftiHeader h{};
  const bool one = kind.version == 1, swap = kind.swap;
  const auto real = [&](std::size_t at1, std::size_t at2, std::size_t index = 0) {
    return one ? static_cast<double>(number_at<float>(head, at1 + 4 * index, swap))
               : number_at<double>(head, at2 + 8 * index, swap);
  };
  const auto code = [&](std::size_t at1, std::size_t at2) {
    return one ? static_cast<int>(number_at<std::int16_t>(head, at1, swap))
               : static_cast<int>(number_at<std::int32_t>(head, at2, swap));
  };
  for (std::size_t i = 0; i < 8; ++i) {
    h.dim[i] = one ? number_at<std::int16_t>(head, 40 + 2 * i, swap)
                   : number_at<std::int64_t>(head, 16 + 8 * i, swap);
    h.pixdim[i] = real(76, 104, i);
  }
  h.vox_offset = one ? static_cast<double>(number_at<float>(head, 108, swap))
                     : static_cast<double>(number_at<std::int64_t>(head, 168, swap));
  h.slope = real(112, 176);
  h.intercept = real(116, 184);
  h.datatype = number_at<std::int16_t>(head, one ? 70 : 12, swap);
  h.bitpix = number_at<std::int16_t>(head, one ? 72 : 14, swap);
  h.qform_code = code(252, 344);
  h.sform_code = code(254, 348);
  h.xyzt_units = one ? static_cast<int>(static_cast<unsigned char>(head[123])) : code(0, 500);
  for (std::size_t i = 0; i < 3; ++i) {
    h.quatern[i] = real(256, 352, i);
    h.qoffset[i] = real(268, 376, i);
    for (std::size_t j = 0; j < 4; ++j) h.srow[i][j] = real(280 + 16 * i, 400 + 32 * i, j);
  }
  return h;
}

PixelType pixel_type(const fs::path& path, const NiftiHeader& h) {
  struct Code {
    int datatype;
    PixelType type;
  };
  constexpr Code codes[] = {{2, PixelType::uint8},    {4, PixelType::int16},    {8, PixelType::int32},
                            {16, PixelType::float32}, {64, PixelType::float64}, {256, PixelType::int8},
                            {512, PixelType::uint16}, {768, PixelType::uint32}, {1024, PixelType::int64},
                            {1280, PixelType::uint64}};
  for (const Code& c : codes) {
    if (c.datatype != h.datatype) continue;
    if (h.bitpix != 8 * bytes_of(c.type))
      refuse(path, "bitpix",
             std::to_string(h.bitpix) + " bits do not go with datatype " + std::to_string(h.datatype));
    return c.type;
  }
  refuse(path, "datatype", "code " + std::to_string(h.datatype) + " is not a scalar type that can be read");
}

void set_sizes(const fs::path& path, const NiftiHeader& h, ImageSource& source) {
  if (h.dim[0] < 3 || h.dim[0] > 7)
    refuse(path, "dim[0]", std::to_string(h.dim[0]) + " dimensions; 3 are read");
  for (std::int64_t i = 4; i <= h.dim[0]; ++i)
    if (h.dim[i] != 1)
      refuse(path, "dim[" + std::to_string(i) + "]",
             std::to_string(h.dim[i]) + " where 1 is needed; one scalar volume is read");
  for (std::size_t i = 0; i < 3; ++i) source.size[i] = h.dim[i + 1];
  check_sizes(path, "dim", source.size);
}

double unit_mm(const fs::path& path, const NiftiHeader& h, std::vector<std::string>& warnings) {
  const int unit = h.xyzt_units & 7;
  if (unit == 2) return 1.0;
  if (unit == 1) return 1000.0;
  if (unit == 3) return 1e-3;
  if (unit != 0) refuse(path, "xyzt_units", "code " + std::to_string(unit) + " is no unit of length");
  warnings.push_back("xyzt_units gives no unit of length: millimetres are taken");
  return 1.0;
}

struct Affine {
  Mat3 step;
  Vec3 origin;
};

Affine by_sform(const NiftiHeader& h) {
  Affine a;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) a.step(i, j) = h.srow[i][j];
    a.origin[i] = h.srow[i][3];
  }
  return a;
}

Affine by_qform(const fs::path& path, const NiftiHeader& h) {
  Vec3 v(h.quatern[0], h.quatern[1], h.quatern[2]);
  const double length = v.squaredNorm();
  if (!(length <= 1.01))
    refuse(path, "quatern_b, _c, _d",
           "no unit quaternion: the sum of squares is " + core::shortest_text(length));
  double a = 1.0 - length;
  if (a < 1e-7) {
    v /= std::sqrt(length);
    a = 0.0;
  }
  a = std::sqrt(a);
  const double b = v[0], c = v[1], d = v[2];
  Affine result;
  result.step << a * a + b * b - c * c - d * d, 2.0 * (b * c - a * d), 2.0 * (b * d + a * c),  //
      2.0 * (b * c + a * d), a * a + c * c - b * b - d * d, 2.0 * (c * d - a * b),             //
      2.0 * (b * d - a * c), 2.0 * (c * d + a * b), a * a + d * d - b * b - c * c;
  if (h.pixdim[0] < 0.0) result.step.col(2) *= -1.0;  // qfac
  result.step = result.step * Vec3(h.pixdim[1], h.pixdim[2], h.pixdim[3]).asDiagonal();
  result.origin = Vec3(h.qoffset[0], h.qoffset[1], h.qoffset[2]);
  return result;
}

void set_axes(const fs::path& path, const NiftiHeader& h, ImageSource& source) {
  for (int i = 1; i <= 3; ++i) check_spacing(path, "pixdim[" + std::to_string(i) + "]", h.pixdim[i]);
  Affine ras;
  if (h.sform_code > 0) {
    source.axes_field = "srow_x, _y, _z (sform)";
    ras = by_sform(h);
    if (h.qform_code > 0) {
      const Affine other = by_qform(path, h);
      const Vec3 far(static_cast<double>(source.size[0]), static_cast<double>(source.size[1]),
                     static_cast<double>(source.size[2]));
      const double apart = std::max((ras.origin - other.origin).norm(),
                                    ((ras.step - other.step) * far + ras.origin - other.origin).norm());
      if (!(apart <= 0.5 * std::min({h.pixdim[1], h.pixdim[2], h.pixdim[3]})))
        source.warnings.push_back("sform and qform disagree about where the image lies: sform is used");
    }
  } else if (h.qform_code > 0) {
    source.axes_field = "quatern_b, _c, _d (qform)";
    ras = by_qform(path, h);
  } else {
    source.axes_field = "pixdim";
    ras.step = Vec3(h.pixdim[1], h.pixdim[2], h.pixdim[3]).asDiagonal();
    ras.origin.setZero();
    source.warnings.push_back(
        "neither sform nor qform is set: orientation and origin are unknown, right-anterior-superior axes "
        "are taken");
  }
  const double mm = unit_mm(path, h, source.warnings);
  const Vec3 to_lps(-mm, -mm, mm);
  source.step = to_lps.asDiagonal() * ras.step;
  source.origin = to_lps.cwiseProduct(ras.origin);
}

void set_data(const fs::path& path, const NiftiHeader& h, const Kind& kind, Encoding encoding,
              ImageSource& source) {
  source.big_endian = kind.swap != (std::endian::native == std::endian::big);
  const double least = kind.pair ? 0.0 : kind.version == 1 ? 352.0 : 544.0;
  if (!(h.vox_offset >= least) || h.vox_offset > 9e15 || h.vox_offset != std::floor(h.vox_offset))
    refuse(path, "vox_offset",
           core::shortest_text(h.vox_offset) + " is not a whole number of at least " +
               core::shortest_text(least) + " bytes");
  source.skip = static_cast<std::uint64_t>(h.vox_offset);
  if (!kind.pair) {
    source.data_path = path;
    source.encoding = encoding;
    return;
  }
  if (encoding != Encoding::raw)
    refuse(path, "magic", "compressed .hdr and .img pairs are not read; gunzip them first");
  fs::path image = path.filename();
  source.data_path = data_file(path, "magic (a pair)", image.replace_extension(".img").string());
}

}  // namespace

bool is_nifti(const std::string& head) {
  return kind_of(head).version != 0;
}

ImageSource parse_nifti(const fs::path& path, const std::string& head, Encoding encoding) {
  const Kind kind = kind_of(head);
  const NiftiHeader h = parsed(head, kind);
  ImageSource source;
  source.format = kind.version == 1 ? "NIfTI-1" : "NIfTI-2";
  source.header_path = path;
  source.pixel_type = pixel_type(path, h);
  set_sizes(path, h, source);
  set_axes(path, h, source);
  if (h.slope != 0.0) {  // 0: the values are not scaled
    if (!std::isfinite(h.slope) || !std::isfinite(h.intercept)) {
      source.warnings.push_back(
          "scl_slope or scl_inter is not a number: the values are taken as they are stored");
    } else {
      source.slope = h.slope;
      source.intercept = h.intercept;
    }
  }
  set_data(path, h, kind, encoding, source);
  return source;
}

}  // namespace ostia::imaging
