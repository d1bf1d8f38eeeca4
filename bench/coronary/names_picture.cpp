// A patient's tree as thin lines, with the names that a reader wrote down, from two usual angles.

#include "picture.h"
#include "written_names.h"

#include "ostia/coronary/mask_tree.h"
#include "ostia/figure/scene.h"
#include "ostia/imaging/image_file.h"

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace ostia;

constexpr double line_mm = 0.7;

void make(const std::string& mask, const std::string& table, const std::string& file) {
  const std::string patient = std::filesystem::path(mask).stem().string();
  const geometry::VesselTree tree = coronary::mask_tree(imaging::read_labels(mask).volume).vessels.tree;
  figure::Scene scene;
  for (const geometry::TreeSegment& segment : tree.segments)
    scene.tubes.push_back(figure::tube_of(segment.axis, line_mm, figure::colors::centerline));
  for (const testing::WrittenName& one : testing::written_names(table))
    if (one.patient == patient)
      scene.labels.push_back({one.place, one.other.empty() ? one.name : one.name + "/" + one.other});
  figure::RenderOptions render;
  render.width_px = 460;
  render.height_px = 400;
  render.look = figure::Look::light;
  std::vector<figure::Picture> views;
  for (const auto& [lao, cranial] : {std::pair{-30.0, -20.0}, std::pair{45.0, 25.0}})
    views.push_back(figure::scene_figure(scene, figure::cameras::angiographic(lao, cranial), render));
  figure::grid(views, {.look = figure::Look::light}).write(file, 1.0);
}

}  // namespace

int main(int argc, char** argv) {
  return bench::make_picture(argc, argv, "MASK TABLE.csv PICTURE.png", 3,
                             [](const std::vector<std::string>& a) { make(a[0], a[1], a[2]); });
}
