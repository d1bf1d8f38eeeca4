#include "suite_pictures.h"

#include "ostia/evaluation/distance_picture.h"
#include "ostia/figure/plot.h"
#include "ostia/figure/scene.h"
#include "ostia/figure/slice_figure.h"
#include "ostia/geometry/mixed_mesh_sides.h"
#include "ostia/geometry/polyline.h"
#include "ostia/imaging/image_file.h"
#include "ostia/io/centerline_file.h"
#include "ostia/io/contour_file.h"
#include "ostia/io/surface_file.h"
#include "ostia/io/volume_mesh_file.h"
#include "ostia/reformat/plane.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ostia::evaluation {
namespace {

using figure::Color;
using geometry::TriMesh;
using geometry::Vec3;

const Color golden_color{0.90, 0.62, 0.00};  // Okabe-Ito orange
const Color result_color{0.34, 0.71, 0.91};  // Okabe-Ito sky blue

TriMesh mesh_of(const std::filesystem::path& path) {
  if (path.extension() == ".vtu") return geometry::boundary_triangles(io::read_volume_mesh(path));
  return io::read_surface(path).surface.mesh;
}

std::vector<CaptionedPicture> surface_pictures(const FilePair& pair, const core::TaskContext& task) {
  const TriMesh golden = mesh_of(pair.golden), result = mesh_of(pair.result);
  const std::vector<double> distances = signed_distances(golden, result, task);
  figure::PlotOptions how;
  how.title = "signed distance of the result from the golden surface";
  how.x_label = "mm, positive outside";
  how.y_label = "triangles";
  how.height_px = 260;
  const auto counts = figure::histogram(distances, 60);
  return {{distance_figure(result, distances, {}, task),
           pair.name + ": the result, coloured by its signed distance from the golden surface."},
          {figure::histogram_plot(counts, how), pair.name + ": distribution of the signed distance."}};
}

std::vector<CaptionedPicture> line_pictures(const FilePair& pair, const core::TaskContext& task) {
  figure::Scene scene;
  std::vector<Vec3> all;
  const auto add = [&](const std::filesystem::path& path, const Color& color, double radius,
                       const char* label) {
    bool first = true;
    const geometry::VesselTree tree = io::read_centerlines(path);
    for (const auto& segment : tree.segments) {
      scene.tubes.push_back(figure::tube_of(segment.axis, radius, color));
      if (first) scene.tubes.back().label = label;
      first = false;
      all.insert(all.end(), segment.axis.points.begin(), segment.axis.points.end());
    }
  };
  add(pair.golden, golden_color, 0.2, "golden");
  add(pair.result, result_color, 0.3, "result");
  return {{figure::scene_figure(scene, figure::cameras::broadside(all), {}, task),
           pair.name + ": axes of both runs; where only one colour is seen they agree."}};
}

std::vector<CaptionedPicture> contour_pictures(const FilePair& pair, const core::TaskContext& task) {
  figure::Scene scene;
  std::vector<Vec3> all;
  const auto add = [&](const std::filesystem::path& path, const Color& color, double radius,
                       const char* label) {
    bool first = true;
    for (const auto& section : io::read_contours(path).sections) {
      for (const auto& contour : section.contours) {
        std::vector<Vec3> closed = contour.points;
        closed.push_back(closed.front());
        all.insert(all.end(), closed.begin(), closed.end());
        scene.tubes.push_back({std::move(closed), {radius}, color, first ? label : ""});
        first = false;
      }
    }
  };
  add(pair.golden, golden_color, 0.05, "golden");
  add(pair.result, result_color, 0.08, "result");
  return {{figure::scene_figure(scene, figure::cameras::broadside(all), {}, task),
           pair.name + ": contours of both runs."}};
}

/// The place of the largest difference, world mm.
Vec3 farthest_place(const imaging::ImageVolume& a, const imaging::ImageVolume& b) {
  std::size_t worst = 0;
  int largest = -1;
  for (std::size_t i = 0; i < a.voxels.size(); ++i) {
    const int d = std::abs(static_cast<int>(a.voxels[i]) - b.voxels[i]);
    if (d > largest) {
      largest = d;
      worst = i;
    }
  }
  const auto at = static_cast<std::int64_t>(worst);
  const auto& size = a.geometry.size;
  return a.geometry.world(Vec3(static_cast<double>(at % size[0]), static_cast<double>(at / size[0] % size[1]),
                               static_cast<double>(at / (size[0] * size[1]))));
}

std::vector<CaptionedPicture> image_pictures(const FilePair& pair, const core::TaskContext& task) {
  const imaging::ImageVolume golden = imaging::read_image(pair.golden, task).volume;
  const imaging::ImageVolume result = imaging::read_image(pair.result, task).volume;
  if (!imaging::same_grid(golden.geometry, result.geometry)) return {};
  const Vec3 place = farthest_place(golden, result);
  imaging::ImageVolume difference = result;
  for (std::size_t i = 0; i < difference.voxels.size(); ++i)
    difference.voxels[i] = static_cast<std::int16_t>(
        std::clamp(static_cast<int>(result.voxels[i]) - golden.voxels[i], -32768, 32767));
  figure::SliceFigureOptions how;
  how.image_width_px = 300;
  const auto [least, most] = std::minmax_element(golden.voxels.begin(), golden.voxels.end());
  if (*most - *least <= 64) {  // labels
    how.level_hu = 0.5 * (*least + *most);
    how.window_hu = std::max(1, *most - *least);
  }
  figure::SliceFigureOptions plain = how;
  plain.level_hu = 0.0;
  plain.window_hu = std::max(2.0, 0.25 * how.window_hu);
  return {
      {figure::three_planes(golden, place, {}, {}, how), pair.name + ": golden, where the two differ most."},
      {figure::three_planes(result, place, {}, {}, how), pair.name + ": result, the same place."},
      {figure::three_planes(difference, place, {}, {}, plain),
       pair.name + ": result minus golden; mid-grey is no difference."}};
}

}  // namespace

std::vector<CaptionedPicture> pictures_of(const FilePair& pair, FileKind kind,
                                          const core::TaskContext& task) {
  switch (kind) {
    case FileKind::surface:
      return surface_pictures(pair, task);
    case FileKind::lines:
      return line_pictures(pair, task);
    case FileKind::contours:
      return contour_pictures(pair, task);
    case FileKind::mask:
    case FileKind::image:
      return image_pictures(pair, task);
    case FileKind::figures:
    case FileKind::points:
    case FileKind::other:
      break;
  }
  return {};
}

figure::Picture figure_plot(const std::string& key, const std::vector<const ComparedFile*>& files) {
  figure::Series golden{"golden", {}, {}, golden_color, figure::LineStyle::points, 5.0};
  figure::Series result{"result", {}, {}, result_color, figure::LineStyle::points, 3.0};
  figure::Series low{"tolerance", {}, {}, Color{0.6, 0.6, 0.6}, figure::LineStyle::solid, 1.5};
  double place = 1.0;
  for (const ComparedFile* file : files) {
    for (const FigurePair& f : file->figures) {
      if (f.key != key) continue;
      golden.x.push_back(place);
      golden.y.push_back(f.golden);
      result.x.push_back(place);
      result.y.push_back(f.result);
      for (const double y : {f.golden - f.allowed, f.golden + f.allowed, std::nan("")}) {
        low.x.push_back(place);
        low.y.push_back(y);
      }
    }
    place += 1.0;
  }
  figure::PlotOptions how;
  how.title = key;
  how.x_label = "file, in the order of the table";
  how.width_px = 460;
  how.height_px = 280;
  how.x_range = figure::Range{0.5, std::max(place - 0.5, 1.5)};
  return figure::line_plot({low, golden, result}, how);
}

}  // namespace ostia::evaluation
