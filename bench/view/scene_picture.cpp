// Pictures of the 3D scene: a tree with its marks, values on its wall, the heart behind it.

#include "picture.h"
#include "scene_case.h"

#include "ostia/figure/picture.h"
#include "ostia/imaging/reduced_volume.h"
#include "ostia/reformat/plane_image.h"
#include "ostia/view/tree_scene.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>

namespace {

using namespace ostia;

view::ScenePlanePicture section(const imaging::ImageVolume& image, const reformat::Plane& plane) {
  view::ScenePlanePicture made{plane, {}};
  for (const float hu : reformat::slice(image, plane).values)
    made.gray.push_back(
        std::isnan(hu) ? std::uint8_t{0}
                       : static_cast<std::uint8_t>(std::clamp(255.0 * (hu + 150.0) / 800.0, 0.0, 255.0)));
  return made;
}

void make(const std::filesystem::path& folder) {
  const bench::SceneCase of = bench::scene_case(0.3, phantom::Preset::small);
  const phantom::Scan scan = phantom::scan_case(of.plan);
  geometry::Box3 heart;
  for (const auto& point : of.wall->points) heart.extend(point);
  heart = {heart.min() - view::Vec3::Constant(18.0), heart.max() + view::Vec3::Constant(18.0)};

  view::TreeScene scene;
  const auto save = [&](const std::string& name, std::optional<figure::Look> look = {}) {
    figure::picture_of(scene.snapshot(1000, 800, look)).write_png(folder / (name + ".png"));
  };
  scene.set_wall(of.wall, *of.model);
  scene.set_pose(scene.pose_from_side(view::ViewFrom::anterior));
  save("tree");
  save("tree-light", figure::Look::light);

  const lumen::VesselLumen& first = *of.model->vessels.front();
  const geometry::AxisCurve& axis = *first.axis;
  const double s = 0.4 * axis.length();
  scene.select_vessel(first.vessel);
  scene.set_cursor(view::SceneCursor{axis.point(s), axis.frame(s), 4.0, 0.4, true});
  const auto on_wall = [&](double at_mm) { return axis.place(at_mm, 0.0, axis.radius(at_mm)); };
  scene.set_measurements({{1, {on_wall(s + 10.0), on_wall(s + 22.0)}, false, "12.0 mm", true},
                          {2,
                           {on_wall(s - 20.0), on_wall(s - 8.0), on_wall(s - 14.0) + view::Vec3(6, 0, 0)},
                           true,
                           "31.2 mm\xc2\xb2",
                           false}});
  scene.set_plane(view::ScenePlane::cross_section,
                  section(scan.image, reformat::cross_section_plane(axis, s, 20.0, 0.25)));
  scene.set_pose(view::zoomed(scene.pose_of_vessel(first.vessel), 1.6, axis.point(s)));
  save("marks");
  save("marks-light", figure::Look::light);
  scene.set_plane(view::ScenePlane::axial,
                  section(scan.image, reformat::axial_plane(scan.image.geometry, axis.point(s))));
  scene.set_pose(scene.pose_from_carm({40.0, 25.0}));
  save("axial");
  scene.set_plane(view::ScenePlane::axial, {});
  scene.set_plane(view::ScenePlane::cross_section, {});
  scene.set_cursor({});
  scene.set_measurements({});
  scene.select_vessel({});

  std::vector<double> diameters;
  for (const view::WallPlace& place : scene.wall_places()) diameters.push_back(2.0 * place.radius_mm);
  scene.set_wall_values(diameters, {"diameter, mm", 1.0, 4.5, view::ColorScale::sequential});
  scene.set_pose(scene.pose_from_side(view::ViewFrom::left));
  save("diameter");
  scene.clear_wall_values();
  scene.set_opacity(0.35);
  scene.set_axes_shown(true);
  scene.set_pose(scene.pose_from_carm({-30.0, -20.0}));
  save("axes");
  scene.set_opacity(1.0);
  scene.set_axes_shown(false);

  imaging::ReducedVolumeOptions options;
  options.box = heart;
  scene.set_volume(
      std::make_shared<const imaging::ImageVolume>(imaging::reduced_volume(scan.image, options)));
  scene.set_pose(scene.pose_from_side(view::ViewFrom::anterior));
  scene.set_volume_mode(view::VolumeMode::rendering);
  save("volume");
  save("volume-light", figure::Look::light);
  scene.set_pose(scene.pose_from_carm({45.0, 20.0}));
  save("volume-lao");
  scene.set_volume_mode(view::VolumeMode::mip);
  save("mip");
}

}  // namespace

int main(int argc, char** argv) {
  return ostia::bench::make_picture(argc, argv, "FOLDER", 1,
                                    [](const std::vector<std::string>& given) { make(given[0]); });
}
