#include "ostia/pipeline/volume_preview.h"

#include "builtin_model.h"
#include "shared_data.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>

namespace ostia::pipeline {
namespace {

TEST(VolumePreview, WritesPlanesAndSlices) {
  const auto folder = testing::temporary_folder("preview") / "slices";
  PreviewOptions options;
  options.axial_slices = 3;
  const auto names = write_preview(builtin_case().image, folder, options);
  EXPECT_EQ(names,
            (std::vector<std::string>{"planes.png", "axial-001.png", "axial-002.png", "axial-003.png"}));
  for (const auto& name : names) EXPECT_GT(std::filesystem::file_size(folder / name), 5000u);
}

TEST(VolumePreview, RefusesPlacesOutside) {
  PreviewOptions options;
  options.position = geometry::Vec3(1e4, 0, 0);
  EXPECT_THROW(write_preview(builtin_case().image, testing::temporary_folder("preview"), options),
               InvalidInput);
  options = {};
  options.axial_slices = -1;
  EXPECT_THROW(write_preview(builtin_case().image, testing::temporary_folder("preview"), options),
               InvalidInput);
}

}  // namespace
}  // namespace ostia::pipeline
