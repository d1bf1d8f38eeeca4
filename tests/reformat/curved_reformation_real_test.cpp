// The axes of a real coronary tree.

#include "shared_data.h"

#include "ostia/reformat/curved_reformation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>

namespace ostia::reformat {
namespace {

/// The lines of a legacy VTK file with ASCII points and cells.
std::vector<geometry::Centerline> lines_of(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::string word;
  std::size_t count = 0, total = 0;
  while (file >> word && word != "POINTS") continue;
  file >> count >> word;
  std::vector<geometry::Vec3> points(count);
  for (geometry::Vec3& p : points) file >> p.x() >> p.y() >> p.z();
  while (file >> word && word != "CELLS") continue;
  file >> count >> total;
  std::vector<geometry::Centerline> lines(count);
  for (geometry::Centerline& line : lines) {
    std::size_t length = 0, index = 0;
    file >> length;
    for (std::size_t i = 0; i < length && file >> index; ++i) line.points.push_back(points.at(index));
  }
  return lines;
}

TEST(CurvedReformationOfRealAxes, RoundTripsAreExact) {
  OSTIA_REQUIRE_SHARED(path, "coronary/xra-phantom/centerlines.vtk");
  const std::vector<geometry::Centerline> lines = lines_of(path);
  ASSERT_EQ(lines.size(), 11U);
  double worst_px_mm = 0.0, worst_mm = 0.0;
  for (const geometry::Centerline& line : lines) {
    const auto axis = std::make_shared<const geometry::AxisCurve>(line);
    CurvedOptions options;
    for (const CurvedMode mode : {CurvedMode::straightened, CurvedMode::stretched}) {
      options.mode = mode;
      for (options.theta_deg = 0.0; options.theta_deg < 360.0; options.theta_deg += 70.0) {
        const CurvedReformation view(axis, options);
        const double last = view.row_at_abscissa(axis->length());
        for (double y = 0.2; y < last; y += 9.7) {
          for (double x = 256.0 - 16.0; x <= 256.0 + 16.0; x += 4.0) {  // within 4 mm
            const geometry::Vec3 place = view.world({x, y});
            const auto near = view.project(place, view.abscissa_at_row(y));
            const auto any = view.project(place);
            ASSERT_TRUE(near && any);
            worst_px_mm = std::max(worst_px_mm, (near->picture_px - Vec2(x, y)).norm() * options.pixel_mm);
            worst_mm = std::max(worst_mm, (view.world(any->picture_px) - place).norm());
          }
        }
      }
    }
  }
  EXPECT_LT(worst_px_mm, 0.01);
  EXPECT_LT(worst_mm, 1e-6);
}

}  // namespace
}  // namespace ostia::reformat
