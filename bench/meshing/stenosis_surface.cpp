// A stenosed tube along z as an STL file, open at both ends, for docs/methods/flow-refinement.md.

#include "picture.h"

#include "ostia/geometry/analytic_shapes.h"
#include "ostia/io/surface_file.h"

#include <string>

namespace {

using namespace ostia;

constexpr double length_mm = 30.0, radius_mm = 1.5, centre_mm = 8.0, stenosis_mm = 6.0;
constexpr int around = 96;
constexpr double step_mm = 0.05;

void make(const std::string& file, double severity) {
  const auto shape = geometry::stenosed_tube(length_mm, radius_mm, severity, centre_mm, stenosis_mm);
  io::write_surface(file, geometry::structured_surface(shape.tubes[0], around, step_mm));
}

}  // namespace

int main(int argc, char** argv) {
  return bench::make_picture(
      argc, argv, "SURFACE.stl SEVERITY", 2,
      [](const std::vector<std::string>& words) { make(words[0], std::stod(words[1])); });
}
