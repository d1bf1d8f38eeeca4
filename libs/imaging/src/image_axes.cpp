#include "ostia/imaging/image_axes.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ostia::imaging {
namespace {

constexpr std::array<const char*, 3> axis_letters{"LR", "PA", "SI"};  // rising, falling; LPS

/// The patient's axis and the sign that a letter stands for.
struct AxisOfLetter {
  Eigen::Index axis = -1;
  double sign = 1.0;
};
AxisOfLetter axis_of_letter(char letter) {
  for (Eigen::Index axis = 0; axis < 3; ++axis)
    for (const int side : {0, 1})
      if (axis_letters[static_cast<std::size_t>(axis)][side] == letter) return {axis, side == 0 ? 1.0 : -1.0};
  return {};
}

/// Unit vectors: the columns are what i, j and k rise towards.
Mat3 matrix_of_axes(const std::string& axes) {
  validate_axes(axes);
  Mat3 result = Mat3::Zero();
  for (Eigen::Index column = 0; column < 3; ++column) {
    const AxisOfLetter towards = axis_of_letter(axes[static_cast<std::size_t>(column)]);
    result(towards.axis, column) = towards.sign;
  }
  return result;
}

Vec3 middle_index(const Geometry& grid) {
  return 0.5 * Vec3(static_cast<double>(grid.size[0] - 1), static_cast<double>(grid.size[1] - 1),
                    static_cast<double>(grid.size[2] - 1));
}

}  // namespace

std::string axes_of(const Geometry& grid) {
  std::string axes(3, ' ');
  std::array<bool, 3> image_taken{}, patient_taken{};
  for (int turn = 0; turn < 3; ++turn) {  // the pair that is nearest to each other first
    Eigen::Index image = 0, patient = 0;
    double most = -1.0;
    for (Eigen::Index i = 0; i < 3; ++i)
      for (Eigen::Index p = 0; p < 3; ++p) {
        const double along = std::abs(grid.direction(p, i));
        if (image_taken[static_cast<std::size_t>(i)] || patient_taken[static_cast<std::size_t>(p)] ||
            along <= most)
          continue;
        most = along;
        image = i;
        patient = p;
      }
    image_taken[static_cast<std::size_t>(image)] = patient_taken[static_cast<std::size_t>(patient)] = true;
    axes[static_cast<std::size_t>(image)] =
        axis_letters[static_cast<std::size_t>(patient)][grid.direction(patient, image) < 0.0 ? 1 : 0];
  }
  return axes;
}

void validate_axes(const std::string& axes) {
  std::array<bool, 3> taken{};
  bool good = axes.size() == 3;
  for (const char letter : axes) {
    const Eigen::Index axis = axis_of_letter(letter).axis;
    if (axis < 0 || taken[static_cast<std::size_t>(axis)]) {
      good = false;
      break;
    }
    taken[static_cast<std::size_t>(axis)] = true;
  }
  if (!good)
    throw InvalidInput(
        "an image's axes are three letters, one each of L or R, P or A, S or I, such as LPS, "
        "not \"" +
        axes.substr(0, 20) + "\"");
}

bool mirrored(const std::string& a, const std::string& b) {
  return matrix_of_axes(a).determinant() * matrix_of_axes(b).determinant() < 0.0;
}

AxesGiven given_axes(const Geometry& as_read, const std::string& axes) {
  AxesGiven result{as_read, false};
  if (axes.empty()) return result;
  const std::string own = axes_of(as_read);
  validate_axes(axes);
  if (axes == own) return result;
  Geometry& grid = result.grid;
  grid.direction = matrix_of_axes(axes) * matrix_of_axes(own).transpose() * as_read.direction;
  result.slices_reversed = grid.direction.determinant() < 0.0;
  if (result.slices_reversed) grid.direction.col(2) *= -1.0;
  const Vec3 middle = middle_index(as_read);
  grid.origin = as_read.world(middle) - grid.direction * grid.spacing.cwiseProduct(middle);
  return result;
}

template <class T>
Volume<T> laid(const Volume<T>& image, const AxesGiven& from, const AxesGiven& to) {
  Volume<T> result{to.grid, image.voxels};
  if (from.slices_reversed == to.slices_reversed) return result;
  const auto slice = static_cast<std::ptrdiff_t>(image.geometry.size[0] * image.geometry.size[1]);
  auto first = result.voxels.begin(), last = result.voxels.end();
  for (; slice > 0 && last - first >= 2 * slice; first += slice, last -= slice)
    std::swap_ranges(first, first + slice, last - slice);
  return result;
}

template ImageVolume laid(const ImageVolume&, const AxesGiven&, const AxesGiven&);
template MaskVolume laid(const MaskVolume&, const AxesGiven&, const AxesGiven&);

ImageVolume with_axes(const ImageVolume& image, const std::string& axes) {
  return laid(image, {image.geometry, false}, given_axes(image.geometry, axes));
}

}  // namespace ostia::imaging
