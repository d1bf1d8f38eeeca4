#include "ostia/view/tree_scene.h"

#include "tree_scene_impl.h"

#include "ostia/core/error.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCommand.h>
#include <vtkLight.h>
#include <vtkRenderWindow.h>
#include <vtkVolume.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

namespace ostia::view {
namespace {

/// From the target to the camera; with parallel rays it changes nothing but what the clipping planes allow.
constexpr double camera_distance_mm = 1000.0;

void check(const geometry::TriMesh& wall) {
  const auto count = static_cast<std::int32_t>(wall.points.size());
  for (std::size_t i = 0; i < wall.triangles.size(); ++i)
    for (const std::int32_t corner : wall.triangles[i])
      if (corner < 0 || corner >= count)
        throw InvalidInput("triangle " + std::to_string(i) + " of the wall to be shown has a corner " +
                           std::to_string(corner) + ", there are " + std::to_string(count) + " points");
  for (std::size_t i = 0; i < wall.points.size(); ++i)
    if (!wall.points[i].allFinite())
      throw InvalidInput("point " + std::to_string(i) + " of the wall to be shown is not finite");
}

figure::Color background(figure::Look look) {
  return look == figure::Look::dark ? figure::Color{0.075, 0.085, 0.10} : figure::Color{0.97, 0.975, 0.98};
}

}  // namespace

CameraPose pose_of(vtkRenderer& renderer) {
  vtkCamera* camera = renderer.GetActiveCamera();
  CameraPose pose;
  camera->GetFocalPoint(pose.target.data());
  pose.towards = (Vec3(camera->GetPosition()) - pose.target).normalized();
  const Vec3 up(camera->GetViewUp());
  pose.up = (up - up.dot(pose.towards) * pose.towards).normalized();
  pose.half_height_mm = camera->GetParallelScale();
  return pose;
}

void apply_pose(vtkRenderer& renderer, const CameraPose& pose) {
  vtkCamera* camera = renderer.GetActiveCamera();
  camera->ParallelProjectionOn();
  camera->SetFocalPoint(pose.target.data());
  const Vec3 position = pose.target + camera_distance_mm * pose.towards;
  camera->SetPosition(position.data());
  camera->SetViewUp(pose.up.data());
  camera->SetParallelScale(pose.half_height_mm);
}

void add_lights(vtkRenderer& renderer) {
  renderer.AutomaticLightCreationOff();
  const auto add = [&](double x, double y, double z, double intensity) {
    vtkNew<vtkLight> light;
    light->SetLightTypeToCameraLight();
    light->SetPosition(x, y, z);
    light->SetFocalPoint(0.0, 0.0, 0.0);
    light->SetIntensity(intensity);
    renderer.AddLight(light);
  };
  add(-0.4, 0.6, 1.0, 0.85);
  add(0.8, -0.3, 0.7, 0.3);
}

void apply_look(vtkRenderer& renderer, figure::Look look) {
  const figure::Color color = background(look);
  renderer.SetBackground(color.r, color.g, color.b);
}

TreeScene::Impl::Impl() {
  renderer->AddViewProp(wall_actor.prop());
  renderer->AddViewProp(volume.prop());
  add_lights(*renderer);
  apply_look(*renderer, settings.look);
  apply_pose(*renderer, pose_from(ViewFrom::anterior, Vec3::Zero(), 60.0));
  const auto observe = [this](vtkCallbackCommand* command, unsigned long event, auto callback) {
    command->SetClientData(this);
    command->SetCallback(callback);
    renderer->AddObserver(event, command);
  };
  observe(before, vtkCommand::StartEvent,
          [](vtkObject*, unsigned long, void* self, void*) { static_cast<Impl*>(self)->before_render(); });
  observe(after, vtkCommand::EndEvent,
          [](vtkObject*, unsigned long, void* self, void*) { static_cast<Impl*>(self)->after_render(); });
}

TreeScene::Impl::~Impl() {
  renderer->RemoveObserver(before);
  renderer->RemoveObserver(after);
  renderer->RemoveAllViewProps();
}

void TreeScene::Impl::before_render() {
  const int* size = renderer->GetSize();
  const CameraPose pose = pose_of(*renderer);
  overlay.lay_out(pose, size[0], size[1], settings);
  mark_actors.lay_out(pose, size[0], size[1], settings.pixel_ratio);
  renderer->ResetCameraClippingRange();
  started = std::chrono::steady_clock::now();
}

/// A coarse picture of the volume that took too long is the last one of this image and mode.
void TreeScene::Impl::after_render() {
  volume_ms.reset();
  if (!volume.prop()->GetVisibility() || renderer->GetRenderWindow() == nullptr) return;
  constexpr double most_ms = 80.0;
  renderer->GetRenderWindow()->WaitForCompletion();
  const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - started;
  volume_ms = took.count();
  if (volume.quality() != VolumeQuality::coarse || !interacting || took.count() <= most_ms) return;
  coarse_is_slow = true;
  apply_quality();
}

void TreeScene::Impl::apply_quality() {
  if (!interacting)
    volume.set_quality(still_quality);
  else
    volume.set_quality(coarse_is_slow ? VolumeQuality::hidden : VolumeQuality::coarse);
}

void TreeScene::Impl::start_coarse() {
  coarse_is_slow = false;
  still_quality = VolumeQuality::coarse;
  volume_ms.reset();
  apply_quality();
}

const lumen::VesselLumen& TreeScene::Impl::vessel(std::int32_t id) const {
  for (const auto& each : vessels)
    if (each->vessel == id) return *each;
  throw InvalidInput("the 3D scene has no vessel " + std::to_string(id));
}

void TreeScene::Impl::follow_model(const lumen::LumenModel& model) {
  auto made = std::make_unique<const WallOwner>(model, owner.get());
  const bool same = vessels == model.vessels;
  owner = std::move(made);
  vessels = model.vessels;
  for (const auto& each : vessels) {
    const auto [style, is_new] = styles.try_emplace(each->vessel);
    if (is_new)
      style->second.color = figure::palette(styles_made++ % 7);  // the eighth is the grey of "unknown"
  }
  if (!same) make_axes();
}

void TreeScene::Impl::make_axes() {
  constexpr double step_mm = 0.5;
  marks.axes.clear();
  for (const auto& each : vessels) {
    const VesselStyle& style = styles.at(each->vessel);
    if (!style.visible) continue;
    SceneLine line;
    line.color = figure::mixed(style.color, figure::theme(settings.look).foreground, 0.4);
    for (const Vec3& point : each->axis->sampled(step_mm).points) line.points.push_back(point);
    const double from = each->own_from_mm / std::max(each->axis->length(), 1e-9);
    const auto first = static_cast<std::ptrdiff_t>(from * static_cast<double>(line.points.size() - 1));
    line.points.erase(line.points.begin(), line.points.begin() + first);
    marks.axes.push_back(std::move(line));
  }
  mark_actors.show_axes(marks);
}

bool TreeScene::Impl::visible(std::int32_t point) const {
  return styles.at(places[static_cast<std::size_t>(point)].vessel).visible;
}

void TreeScene::Impl::show_triangles() {
  if (!wall) return;
  std::vector<char> shown(vessels.size());
  for (std::size_t i = 0; i < vessels.size(); ++i) shown[i] = styles.at(vessels[i]->vessel).visible;
  wall_actor.set_triangles(
      *wall, [&](std::int32_t point) { return shown[place_vessel[static_cast<std::size_t>(point)]] != 0; });
}

void TreeScene::Impl::color_wall() {
  if (!wall) return;
  const figure::Color dim =
      settings.look == figure::Look::dark ? figure::Color{0.30, 0.32, 0.35} : figure::Color{0.80, 0.81, 0.83};
  std::vector<figure::Color> colors;
  std::vector<double> dimmed;
  for (const auto& each : vessels) {
    colors.push_back(styles.at(each->vessel).color);
    dimmed.push_back(selected && *selected != each->vessel ? 0.55 : 0.0);
  }
  const bool by_value = !values.empty();
  wall_actor.set_colors(places.size(), [&](std::size_t i) {
    const std::size_t of = place_vessel[i];
    const figure::Color color =
        by_value ? scale_color(scale.colors, (values[i] - scale.low) / (scale.high - scale.low)) : colors[of];
    return figure::mixed(color, dim, dimmed[of]);
  });
}

TreeScene::TreeScene() : impl_(std::make_unique<Impl>()) {}
TreeScene::~TreeScene() = default;

vtkRenderer* TreeScene::renderer() const {
  return impl_->renderer;
}

void TreeScene::set_wall(std::shared_ptr<const geometry::TriMesh> wall, const lumen::LumenModel& model) {
  if (!wall) throw InvalidInput("there is no wall to be shown; clear_wall takes the former one away");
  check(*wall);
  impl_->follow_model(model);
  impl_->places = impl_->owner->at(wall->points);
  impl_->place_vessel.resize(impl_->places.size());
  std::map<std::int32_t, std::size_t> index;
  for (std::size_t i = 0; i < impl_->vessels.size(); ++i) index[impl_->vessels[i]->vessel] = i;
  std::int32_t last = -1;
  std::size_t last_index = 0;
  for (std::size_t i = 0; i < impl_->places.size(); ++i) {
    if (impl_->places[i].vessel != last || i == 0) {
      last = impl_->places[i].vessel;
      last_index = index.at(last);
    }
    impl_->place_vessel[i] = last_index;
  }
  impl_->wall = std::move(wall);
  if (impl_->values.size() != impl_->places.size()) clear_wall_values();
  impl_->wall_actor.set_points(*impl_->wall);
  impl_->show_triangles();
  impl_->color_wall();
}

void TreeScene::clear_wall() {
  clear_wall_values();
  impl_->wall.reset();
  impl_->places.clear();
  impl_->place_vessel.clear();
  impl_->wall_actor.clear();
}

std::span<const WallPlace> TreeScene::wall_places() const {
  return impl_->places;
}

void TreeScene::set_wall_values(std::vector<double> values, const ValueScale& scale) {
  validate(scale);
  if (values.size() != impl_->places.size() || values.empty())
    throw InvalidInput(std::to_string(values.size()) + " values were given for a wall of " +
                       std::to_string(impl_->places.size()) + " points; one a point is needed");
  impl_->values = std::move(values);
  impl_->scale = scale;
  impl_->settings.color_bar = scale;
  impl_->color_wall();
}

void TreeScene::clear_wall_values() {
  impl_->settings.color_bar.reset();
  if (impl_->values.empty()) return;
  impl_->values.clear();
  if (impl_->wall && impl_->places.size() == impl_->wall->points.size()) impl_->color_wall();
}

VesselStyle TreeScene::vessel_style(std::int32_t vessel) const {
  impl_->vessel(vessel);
  return impl_->styles.at(vessel);
}

void TreeScene::set_vessel_style(std::int32_t vessel, const VesselStyle& style) {
  impl_->vessel(vessel);
  VesselStyle& kept = impl_->styles.at(vessel);
  const bool other_triangles = kept.visible != style.visible;
  kept = style;
  if (other_triangles) impl_->show_triangles();
  impl_->color_wall();
  impl_->make_axes();
}

void TreeScene::select_vessel(std::optional<std::int32_t> vessel) {
  if (vessel) impl_->vessel(*vessel);
  if (impl_->selected == vessel) return;
  impl_->selected = vessel;
  impl_->color_wall();
}

void TreeScene::set_opacity(double opacity) {
  if (!(opacity >= 0.05 && opacity <= 1.0))
    throw InvalidInput("the wall's opacity is " + std::to_string(opacity) +
                       ", it has to be between 0.05 and 1");
  impl_->wall_actor.set_opacity(opacity);
}

void TreeScene::set_axes_shown(bool shown) {
  impl_->marks.axes_shown = shown;
  impl_->mark_actors.show_axes(impl_->marks);
}

}  // namespace ostia::view
