#pragma once
/// \file Ostia's volumes as images of the Insight Toolkit (ITK 5), and back, without a copy.
///
/// For programs that use both. No room of Ostia includes it; it is installed as a component of its own,
/// `itk`, and its user links ITK and Ostia::imaging. Both libraries have their places in LPS and mm, so that
/// nothing is turned: size, spacing, origin and direction are the same numbers.

#include "ostia/core/error.h"
#include "ostia/imaging/volume.h"

#include <itkImage.h>
#include <itkImportImageContainer.h>

#include <memory>
#include <utility>
#include <vector>

namespace ostia {

/// Voxels of a volume that ITK works on; they live as long as somebody holds either.
template <class T>
class ItkVoxels : public itk::ImportImageContainer<itk::SizeValueType, T> {
 public:
  using Self = ItkVoxels;
  using Superclass = itk::ImportImageContainer<itk::SizeValueType, T>;
  using Pointer = itk::SmartPointer<Self>;
  using Shared = std::shared_ptr<const imaging::Volume<T>>;

  static Pointer New(Shared volume) {
    Pointer made = new Self(std::move(volume));
    made->UnRegister();  // it is counted from the first on
    return made;
  }
  const Shared& volume() const { return volume_; }
  /// False once ITK has put other memory in its place.
  bool whole() const {
    return const_cast<Self*>(this)->GetImportPointer() == volume_->voxels.data() &&
           this->Size() == volume_->voxels.size();
  }

 private:
  explicit ItkVoxels(Shared volume) : volume_(std::move(volume)) {
    this->SetImportPointer(const_cast<T*>(volume_->voxels.data()),
                           static_cast<itk::SizeValueType>(volume_->voxels.size()), false);
  }
  Shared volume_;
};

namespace detail {

template <class T>
typename itk::Image<T, 3>::Pointer itk_image_of(std::shared_ptr<const imaging::Volume<T>> volume) {
  const imaging::Geometry& grid = volume->geometry;
  auto image = itk::Image<T, 3>::New();
  typename itk::Image<T, 3>::SizeType size;
  typename itk::Image<T, 3>::SpacingType spacing;
  typename itk::Image<T, 3>::PointType origin;
  typename itk::Image<T, 3>::DirectionType direction;
  for (unsigned a = 0; a < 3; ++a) {
    size[a] = static_cast<itk::SizeValueType>(grid.size[a]);
    spacing[a] = grid.spacing[a];
    origin[a] = grid.origin[a];
    for (unsigned b = 0; b < 3; ++b) direction[a][b] = grid.direction(a, b);
  }
  image->SetRegions(size);
  image->SetSpacing(spacing);
  image->SetOrigin(origin);
  image->SetDirection(direction);
  image->SetPixelContainer(ItkVoxels<T>::New(std::move(volume)));
  return image;
}

/// Of the buffered part, whose first voxel need not have the index 0.
template <class T>
imaging::Geometry grid_of(const itk::Image<T, 3>& image) {
  imaging::Geometry grid;
  const auto& region = image.GetBufferedRegion();
  typename itk::Image<T, 3>::PointType first;
  image.TransformIndexToPhysicalPoint(region.GetIndex(), first);
  const bool at_zero = region.GetIndex() == typename itk::Image<T, 3>::IndexType{{0, 0, 0}};
  for (unsigned a = 0; a < 3; ++a) {
    grid.size[a] = static_cast<std::int64_t>(region.GetSize(a));
    grid.spacing[a] = image.GetSpacing()[a];
    grid.origin[a] = at_zero ? image.GetOrigin()[a] : first[a];
    for (unsigned b = 0; b < 3; ++b) grid.direction(a, b) = image.GetDirection()[a][b];
  }
  const geometry::Mat3 product = grid.direction.transpose() * grid.direction;
  if ((product - geometry::Mat3::Identity()).cwiseAbs().maxCoeff() > 1e-6 ||
      grid.direction.determinant() < 0.0)
    throw InvalidInput(
        "an image of ITK whose axes are not right-handed and orthonormal has no place in a Volume; "
        "turn it by itk::OrientImageFilter or resample it");
  return grid;
}

}  // namespace detail

/// The volume as an image of ITK: the same memory, which the image keeps alive. Filters that work in place
/// change the volume.
template <class T>
typename itk::Image<T, 3>::Pointer itk_image(std::shared_ptr<imaging::Volume<T>> volume) {
  return detail::itk_image_of<T>(std::move(volume));
}
/// The same of what nobody may change: give it to filters that do not work in place (InPlaceOff).
template <class T>
typename itk::Image<T, 3>::ConstPointer itk_image(std::shared_ptr<const imaging::Volume<T>> volume) {
  return typename itk::Image<T, 3>::ConstPointer(detail::itk_image_of<T>(std::move(volume)));
}

/// The image as a volume: the very one where its voxels are those of an `itk_image` on the same grid, a copy
/// where ITK owns them (a Volume's memory is a std::vector's). The buffered part of it. Throws InvalidInput
/// for axes that are not right-handed and orthonormal.
template <class T>
std::shared_ptr<const imaging::Volume<T>> volume_of(const itk::Image<T, 3>& image) {
  imaging::Geometry grid = detail::grid_of(image);
  const auto* own = dynamic_cast<const ItkVoxels<T>*>(image.GetPixelContainer());
  if (own != nullptr && own->whole()) {
    const imaging::Geometry& is = own->volume()->geometry;
    if (is.size == grid.size && is.spacing == grid.spacing && is.origin == grid.origin &&
        is.direction == grid.direction)
      return own->volume();
  }
  const T* first = image.GetBufferPointer();
  return std::make_shared<const imaging::Volume<T>>(
      imaging::Volume<T>{grid, std::vector<T>(first, first + grid.voxels())});
}

}  // namespace ostia
