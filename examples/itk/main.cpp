// Reads an image with Ostia, whose checks and formats it gets, and smooths it by a filter of ITK: itk_median
// heart.nrrd smooth.nrrd
#include "ostia/imaging/image_file.h"
#include "ostia/itk.h"

#include <itkMedianImageFilter.h>

#include <cstdio>

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: itk_median IMAGE OUTPUT\n");
    return 2;
  }
  try {
    const auto volume =
        std::make_shared<const ostia::imaging::FloatVolume>(ostia::imaging::read_float_image(argv[1]).volume);
    using Image = itk::Image<float, 3>;
    const Image::ConstPointer image = ostia::itk_image(volume);
    auto median = itk::MedianImageFilter<Image, Image>::New();
    median->SetInput(image);
    median->Update();
    ostia::imaging::write_image(argv[2], *ostia::volume_of(*median->GetOutput()));
    std::printf("the same memory: %s\n", image->GetBufferPointer() == volume->voxels.data() ? "yes" : "no");
  } catch (const std::exception& error) {
    std::fprintf(stderr, "itk_median: %s\n", error.what());
    return 3;
  }
}
