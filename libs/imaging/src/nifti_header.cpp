#include "nifti_header.h"

#include <Eigen/Geometry>

#include <array>
#include <cstring>

// The format: nifti1.h of the NIfTI Data Format Working Group, nifti.nimh.nih.gov.

namespace ostia::imaging {
namespace {

constexpr std::size_t header_bytes = 352;  // with the four that say that no extension follows

template <class T>
void put(std::string& head, std::size_t at, T value) {
  std::memcpy(head.data() + at, &value, sizeof value);
}

}  // namespace

std::string nifti_header(const Geometry& grid, NiftiType type) {
  // Right-anterior-superior is a half turn of left-posterior-superior about the head's axis, and so no
  // reflection: voxels stay in their order.
  const Mat3 to_ras = Vec3(-1.0, -1.0, 1.0).asDiagonal();
  const Mat3 axes = to_ras * grid.direction;
  const Vec3 origin = to_ras * grid.origin;
  std::string head(header_bytes, '\0');
  put<std::int32_t>(head, 0, 348);
  put<std::int16_t>(head, 40, 3);
  put<float>(head, 76, 1.0F);  // qfac
  for (std::size_t d = 0; d < 7; ++d) {
    put<std::int16_t>(head, 42 + 2 * d, d < 3 ? static_cast<std::int16_t>(grid.size[d]) : std::int16_t{1});
    put<float>(head, 80 + 4 * d,
               d < 3 ? static_cast<float>(grid.spacing[static_cast<Eigen::Index>(d)]) : 1.0F);
  }
  put<std::int16_t>(head, 70, type.code);
  put<std::int16_t>(head, 72, type.bits);
  put<float>(head, 108, static_cast<float>(header_bytes));
  put<float>(head, 112, 1.0F);  // slope
  head[123] = 2;                // millimetres
  put<std::int16_t>(head, 252, 1);
  put<std::int16_t>(head, 254, 1);
  Eigen::Quaterniond turn(axes);
  if (turn.w() < 0.0) turn.coeffs() *= -1.0;
  const std::array<double, 3> imaginary{turn.x(), turn.y(), turn.z()};
  for (std::size_t d = 0; d < 3; ++d) {
    const auto row = static_cast<Eigen::Index>(d);
    put<float>(head, 256 + 4 * d, static_cast<float>(imaginary[d]));
    put<float>(head, 268 + 4 * d, static_cast<float>(origin[row]));
    for (std::size_t c = 0; c < 3; ++c) {
      const auto column = static_cast<Eigen::Index>(c);
      put<float>(head, 280 + 16 * d + 4 * c, static_cast<float>(axes(row, column) * grid.spacing[column]));
    }
    put<float>(head, 280 + 16 * d + 12, static_cast<float>(origin[row]));
  }
  std::memcpy(head.data() + 344, "n+1", 4);
  return head;
}

}  // namespace ostia::imaging
