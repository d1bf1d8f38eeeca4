#include "ostia/view/tree_scene.h"

#include "scene/tree_scene_impl.h"

#include "ostia/core/error.h"
#include "ostia/view/vessel_colors.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCommand.h>
#include <vtkLight.h>
#include <vtkMath.h>
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

std::string vessel_name_in(const geometry::VesselTree& tree, std::int32_t id) {
  for (const geometry::Vessel& vessel : tree.vessels)
    if (vessel.id == id) return vessel.name;
  return {};
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
  renderer->AddViewProp(other_actor.prop());
  front->AddViewProp(moving_actor.prop());
  renderer->AddViewProp(volume.prop());
  add_lights(*renderer);
  add_lights(*front);
  apply_look(*renderer, settings.look);
  apply_pose(*renderer, pose_from(ViewFrom::anterior, Vec3::Zero(), 60.0));
  front->SetLayer(1);
  front->SetPreserveDepthBuffer(1);
  front->SetActiveCamera(renderer->GetActiveCamera());
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
  front->RemoveAllViewProps();
}

void TreeScene::Impl::before_render() {
  const std::array<int, 2> size{renderer->GetSize()[0], renderer->GetSize()[1]};
  const CameraPose pose = pose_of(*renderer);
  if (guest && size[1] > 0) guest->seen_at(2.0 * pose.half_height_mm / size[1]);
  overlay.lay_out(pose, size[0], size[1], shown_settings());
  mark_actors.lay_out(pose, size[0], size[1], settings.pixel_ratio, overlay.taken());
  set_depths(pose);
  started = std::chrono::steady_clock::now();
}

/// Clipping planes around all that is shown, at whole steps: marks that move do not move the planes, and the
/// picture behind them stays.
void TreeScene::Impl::set_depths(const CameraPose& pose) {
  constexpr double step_mm = 100.0;
  double nearest = -step_mm, farthest = step_mm;
  for (vtkRenderer* layer : {static_cast<vtkRenderer*>(renderer), static_cast<vtkRenderer*>(front)}) {
    std::array<double, 6> box{};
    layer->ComputeVisiblePropBounds(box.data());
    if (!vtkMath::AreBoundsInitialized(box.data())) continue;
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 at(box[corner & 1 ? 1 : 0], box[corner & 2 ? 3 : 2], box[corner & 4 ? 5 : 4]);
      const double towards = (at - pose.target).dot(pose.towards);
      nearest = std::max(nearest, towards);
      farthest = std::max(farthest, -towards);
    }
  }
  const auto whole = [](double mm) { return step_mm * std::ceil(mm / step_mm + 1e-6); };
  renderer->GetActiveCamera()->SetClippingRange(camera_distance_mm - whole(std::max(nearest, 0.0)),
                                                camera_distance_mm + whole(farthest));
}

/// A coarse picture of the volume that took too long is the last one of this image and mode, unless it was
/// the first.
void TreeScene::Impl::after_render() {
  if (renderer->put_back()) return;
  volume_ms.reset();
  if (!volume.prop()->GetVisibility() || renderer->GetRenderWindow() == nullptr) return;
  constexpr double most_ms = 80.0;
  renderer->GetRenderWindow()->WaitForCompletion();
  const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - started;
  volume_ms = took.count();
  const bool first = ++volume_pictures == 1;
  if (volume.quality() != VolumeQuality::coarse || !interacting || first || took.count() <= most_ms) return;
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
  volume_pictures = 0;
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
  vessel_styles.clear();
  for (const auto& each : vessels) {
    const auto [style, is_new] = styles.try_emplace(each->vessel);
    if (is_new) style->second.color = vessel_color(vessel_name_in(model.tree, each->vessel), each->vessel);
    vessel_styles.push_back(&style->second);
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

OverlaySettings TreeScene::Impl::shown_settings() const {
  OverlaySettings shown = settings;
  if (guest) shown.color_bar = guest->bar();
  return shown;
}

void TreeScene::set_guest(std::shared_ptr<SceneGuest> guest) {
  Impl& scene = *impl_;
  if (scene.guest) {
    scene.renderer->RemoveViewProp(&scene.guest->prop());
  } else {
    scene.renderer->RemoveViewProp(scene.wall_actor.prop());
    scene.renderer->RemoveViewProp(scene.other_actor.prop());
    scene.front->RemoveViewProp(scene.moving_actor.prop());
  }
  scene.guest = std::move(guest);
  if (scene.guest) {
    scene.renderer->AddViewProp(&scene.guest->prop());
  } else {
    scene.renderer->AddViewProp(scene.wall_actor.prop());
    scene.renderer->AddViewProp(scene.other_actor.prop());
    scene.front->AddViewProp(scene.moving_actor.prop());
  }
  scene.renderer->Modified();  // as many props as before, but others
}

TreeScene::TreeScene() : impl_(std::make_unique<Impl>()) {}
TreeScene::~TreeScene() = default;

void TreeScene::attach(vtkRenderWindow& window) {
  detach();
  window.SetNumberOfLayers(2);
  window.AddRenderer(impl_->renderer);
  window.AddRenderer(impl_->front);
  impl_->window = &window;
}

void TreeScene::detach() {
  if (!impl_->window) return;
  impl_->window->RemoveRenderer(impl_->front);
  impl_->window->RemoveRenderer(impl_->renderer);
  impl_->window = nullptr;
}

void TreeScene::show_front(bool shown) {
  impl_->front->SetDraw(shown ? 1 : 0);
}

bool TreeScene::front_shown() const {
  return impl_->front->GetDraw() != 0;
}

bool TreeScene::kept_picture() const {
  return impl_->renderer->put_back();
}

}  // namespace ostia::view
