#pragma once
/// \file A workbench with a straight tube of known size and its image.

#include "vessel_trees.h"

#include "ostia/lumen/start_surface.h"
#include "ostia/session/workbench.h"

#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>

namespace ostia::view::testing {

inline constexpr double tube_radius_mm = 1.5, tube_length_mm = 30.0;
inline constexpr std::int16_t tube_hu = 400, fat_hu = -80;

/// CT numbers of the tube along z, soft at its edge over a voxel.
inline session::OpenImage tube_image() {
  auto volume = std::make_shared<imaging::ImageVolume>();
  volume->geometry.size = {60, 60, 90};
  volume->geometry.spacing = {0.4, 0.4, 0.4};
  volume->geometry.origin = {-11.8, -11.8, -2.0};
  volume->voxels.resize(static_cast<std::size_t>(volume->geometry.voxels()));
  for (std::int64_t k = 0; k < 90; ++k)
    for (std::int64_t j = 0; j < 60; ++j)
      for (std::int64_t i = 0; i < 60; ++i) {
        const geometry::Vec3 at =
            volume->geometry.world({static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)});
        const double inside = std::clamp(0.5 - (std::hypot(at.x(), at.y()) - tube_radius_mm) / 0.4, 0.0, 1.0);
        (*volume)(i, j, k) = static_cast<std::int16_t>(std::lround(fat_hu + inside * (tube_hu - fat_hu)));
      }
  return {volume, {std::string(64, 'a'), "image-test"}};
}

/// A round outline of another size across the axis: an edit that narrows or widens the lumen there.
inline lumen::SectionContour outline_of(const session::Workbench& bench, double s_mm, double radius_mm) {
  lumen::SectionContour contour;
  contour.vessel = bench.vessel.get();
  contour.s_mm = s_mm;
  for (int i = 0; i < 24; ++i)
    contour.points.push_back(bench.axis()->place(s_mm, 2.0 * M_PI * i / 24.0, radius_mm));
  return contour;
}

/// The case of the straight tube, or of another tree, in a folder of its own that goes with it.
class TubeCase {
 public:
  explicit TubeCase(const geometry::VesselTree& tree = lumen::testing::straight_vessel(tube_length_mm,
                                                                                       tube_radius_mm)) {
    std::string name = (std::filesystem::temp_directory_path() / "ostia-view-XXXXXX").string();
    if (!::mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
    folder = name;
    bench.set_image(tube_image());
    bench.set_session(session::Session(session::CaseFile::create(
        folder / "case.ostia", lumen::model_of_tubes(tree), bench.image().reference)));
  }
  ~TubeCase() {
    bench.close_case();
    std::error_code ignored;
    std::filesystem::remove_all(folder, ignored);
  }
  std::filesystem::path folder;
  session::Workbench bench;
};

}  // namespace ostia::view::testing
