// The picture of docs/methods/outer-wall.md: outer wall and lumen as found and as they are, over both
// straightened reformations and four cross-sections of an annotated section of a phantom's data set.
//   outer_wall_picture DATASET_FOLDER VESSEL_FOLDER SECTION OUTPUT.png

#include "boundary_views.h"
#include "picture.h"

#include "ostia/segmentation/outer_wall.h"

namespace {

using namespace ostia;

constexpr figure::Color outer_color{0.94, 0.89, 0.26}, outer_truth{0.35, 0.70, 0.90};  // Okabe-Ito

void make(const std::filesystem::path& dataset, const std::string& vessel, const std::string& section,
          const std::filesystem::path& out) {
  const imaging::ImageVolume image = bench::image_of(dataset);
  const auto axis = bench::axis_of(dataset, vessel);
  const std::vector<bench::Ring> truth = bench::truth_of(dataset / "contours.json", section, *axis, "wall");
  const double first = truth.front().s_mm, last = truth.back().s_mm;
  const segmentation::LumenBoundary lumen = segmentation::lumen_boundary(
      image, *axis, std::max(0.0, first - 15.0), std::min(axis->length(), last + 15.0));
  const segmentation::OuterWall found = segmentation::outer_wall(image, *axis, lumen);
  const std::vector<bench::DrawnRings> drawn{
      {truth, outer_truth, 1.2, "outer wall, truth"},
      {bench::rings_of(found.surface, truth), outer_color, 1.2, "outer wall, found"},
      {bench::rings_of(lumen, truth), figure::colors::contour, 1.2, "lumen, found"}};
  std::vector<figure::Picture> panels = bench::both_along(image, axis, first, last, drawn), sections;
  for (const double share : {0.1, 0.38, 0.48, 0.61})
    sections.push_back(
        bench::across(image, *axis, drawn, static_cast<std::size_t>(share * truth.size()), 7.0));
  figure::GridOptions pairs;
  pairs.columns = 2;
  panels.push_back(figure::grid(sections, pairs));
  figure::GridOptions grid;
  grid.columns = 3;
  grid.letters = true;
  grid.title = "Outer wall found in the image, and the truth";
  figure::grid(panels, grid).write_png(out);
}

}  // namespace

int main(int argc, char** argv) {
  return ostia::bench::make_picture(
      argc, argv, "DATASET_FOLDER VESSEL_FOLDER SECTION OUTPUT.png", 4,
      [](const std::vector<std::string>& given) { make(given[0], given[1], given[2], given[3]); });
}
