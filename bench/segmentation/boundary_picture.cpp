// The picture of docs/methods/lumen-boundary.md: the found boundary and the true one over both straightened
// reformations and four cross-sections of an annotated section of a phantom's data set.
//   boundary_picture DATASET_FOLDER VESSEL_FOLDER SECTION OUTPUT.png

#include "boundary_views.h"
#include "picture.h"

namespace {

using namespace ostia;

void make(const std::filesystem::path& dataset, const std::string& vessel, const std::string& section,
          const std::filesystem::path& out) {
  const imaging::ImageVolume image = bench::image_of(dataset);
  const auto axis = bench::axis_of(dataset, vessel);
  const std::vector<bench::Ring> truth = bench::truth_of(dataset / "contours.json", section, *axis);
  const double first = truth.front().s_mm, last = truth.back().s_mm;
  const segmentation::LumenBoundary found = segmentation::lumen_boundary(
      image, *axis, std::max(0.0, first - 15.0), std::min(axis->length(), last + 15.0));
  const std::vector<bench::DrawnRings> drawn{
      {truth, figure::colors::cut, 1.4, "truth"},
      {bench::rings_of(found, truth), figure::colors::contour, 1.4, "found"}};
  std::vector<figure::Picture> panels = bench::both_along(image, axis, first, last, drawn), sections;
  for (const double share : {0.1, 0.38, 0.48, 0.61})
    sections.push_back(bench::across(image, *axis, drawn, static_cast<std::size_t>(share * truth.size())));
  figure::GridOptions pairs;
  pairs.columns = 2;
  panels.push_back(figure::grid(sections, pairs));
  figure::GridOptions grid;
  grid.columns = 3;
  grid.letters = true;
  grid.title = "Boundary found in the image, and the truth";
  figure::grid(panels, grid).write_png(out);
}

}  // namespace

int main(int argc, char** argv) {
  return ostia::bench::make_picture(
      argc, argv, "DATASET_FOLDER VESSEL_FOLDER SECTION OUTPUT.png", 4,
      [](const std::vector<std::string>& given) { make(given[0], given[1], given[2], given[3]); });
}
