// Volumes as images of ITK (ostia/itk.h), and back.

#include "ostia/itk.h"

#include <gtest/gtest.h>
#include <itkMedianImageFilter.h>

#include <cmath>

namespace ostia {
namespace {

using imaging::FloatVolume;

std::shared_ptr<FloatVolume> turned_volume() {
  auto volume = std::make_shared<FloatVolume>();
  volume->geometry.size = {4, 5, 6};
  volume->geometry.spacing = {0.4, 0.5, 0.7};
  volume->geometry.origin = {-12.5, 30.25, 700.125};
  const double c = std::cos(0.3), s = std::sin(0.3);
  volume->geometry.direction << c, -s, 0, s, c, 0, 0, 0, 1;
  for (int n = 0; n < 120; ++n) volume->voxels.push_back(static_cast<float>(n % 7));
  return volume;
}

TEST(ItkImage, IsTheVolumesOwnMemoryAtTheSamePlaces) {
  const auto volume = turned_volume();
  const auto image = itk_image(volume);
  EXPECT_EQ(image->GetBufferPointer(), volume->voxels.data());
  for (const auto& [i, j, k] : {std::array<int, 3>{0, 0, 0}, {3, 0, 0}, {0, 4, 0}, {1, 2, 5}}) {
    itk::Image<float, 3>::IndexType index{{i, j, k}};
    itk::Image<float, 3>::PointType point;
    image->TransformIndexToPhysicalPoint(index, point);
    const imaging::Vec3 truth = volume->geometry.world(imaging::Vec3(i, j, k));
    for (unsigned a = 0; a < 3; ++a) EXPECT_NEAR(point[a], truth[a], 1e-12);
    EXPECT_EQ(image->GetPixel(index), (*volume)(i, j, k));
  }
  image->SetPixel({{1, 1, 1}}, 99.0F);
  EXPECT_EQ((*volume)(1, 1, 1), 99.0F);
}

TEST(ItkImage, ComesBackAsTheVeryVolume) {
  const auto volume = turned_volume();
  const auto image = itk_image(volume);
  EXPECT_EQ(volume_of(*image).get(), volume.get());
  image->SetSpacing(itk::Vector<double, 3>(2.0));
  const auto other = volume_of(*image);
  EXPECT_NE(other.get(), volume.get()) << "another grid is another volume";
  EXPECT_EQ(other->geometry.spacing, imaging::Vec3(2, 2, 2));
}

TEST(ItkImage, KeepsTheVolumeAlive) {
  std::weak_ptr<FloatVolume> watched;
  itk::Image<float, 3>::Pointer image;
  {
    const auto volume = turned_volume();
    watched = volume;
    image = itk_image(volume);
  }
  EXPECT_FALSE(watched.expired());
  EXPECT_EQ(image->GetPixel({{1, 0, 0}}), 1.0F);
  image = nullptr;
  EXPECT_TRUE(watched.expired());
}

TEST(ItkImage, OfAFilterIsAVolumeOnTheExactGrid) {
  const auto volume = turned_volume();
  auto median = itk::MedianImageFilter<itk::Image<float, 3>, itk::Image<float, 3>>::New();
  median->SetInput(itk_image(std::shared_ptr<const FloatVolume>(volume)));
  median->Update();
  const auto result = volume_of(*median->GetOutput());
  EXPECT_EQ(result->geometry.size, volume->geometry.size);
  EXPECT_EQ(result->geometry.spacing, volume->geometry.spacing);
  EXPECT_EQ(result->geometry.origin, volume->geometry.origin);
  EXPECT_EQ(result->geometry.direction, volume->geometry.direction);
}

TEST(ItkImage, OfAPartBeginsWhereThePartDoes) {
  auto image = itk::Image<float, 3>::New();
  image->SetRegions(itk::Image<float, 3>::RegionType({{2, 3, 4}}, {{5, 5, 5}}));
  image->SetSpacing(itk::Vector<double, 3>(0.5));
  image->Allocate(true);
  EXPECT_EQ(volume_of(*image)->geometry.origin, imaging::Vec3(1.0, 1.5, 2.0));
}

TEST(ItkImage, RefusesAMirroredOne) {
  auto image = itk::Image<float, 3>::New();
  image->SetRegions(itk::Image<float, 3>::SizeType{{2, 2, 2}});
  itk::Image<float, 3>::DirectionType mirror;
  mirror.SetIdentity();
  mirror[2][2] = -1.0;
  image->SetDirection(mirror);
  image->Allocate(true);
  EXPECT_THROW(volume_of(*image), InvalidInput);
}

}  // namespace
}  // namespace ostia
