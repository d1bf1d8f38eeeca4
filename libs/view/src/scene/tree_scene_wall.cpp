// The wall in the scene: all of it, or that part of it apart which is being edited.
#include "scene/tree_scene_impl.h"

#include "ostia/core/error.h"

#include <vtkVolume.h>

#include <algorithm>
#include <map>
#include <string>
#include <utility>

namespace ostia::view {
namespace {

// About what an edit has changed, so that the next moves of the hand stay within.
constexpr double moving_margin_mm = 5.0;
// A cell whose corners stay may be divided otherwise where its neighbour changes.
constexpr double cell_margin_mm = 1.0;
// A wall's new radius tells whose the wall is no farther away.
constexpr double owner_margin_mm = 6.0;
constexpr double stretch_share = 0.7;  // of a stretch's colour
constexpr figure::Color other_wall_color{0.45, 0.72, 1.0};
constexpr double other_wall_opacity = 0.35;

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

geometry::Box3 grown(const geometry::Box3& box, double by_mm) {
  return {box.min() - Vec3::Constant(by_mm), box.max() + Vec3::Constant(by_mm)};
}

/// The same vessels on the same axes: walls alone may differ.
bool same_axes(const std::vector<std::shared_ptr<const lumen::VesselLumen>>& a,
               const std::vector<std::shared_ptr<const lumen::VesselLumen>>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& x, const auto& y) {
    return x->vessel == y->vessel && x->axis == y->axis && x->own_from_mm == y->own_from_mm;
  });
}

}  // namespace

void TreeScene::set_wall(std::shared_ptr<const geometry::TriMesh> wall, const lumen::LumenModel& model) {
  if (!wall) throw InvalidInput("there is no wall to be shown; clear_wall takes the former one away");
  check(*wall);
  Impl& scene = *impl_;
  std::shared_ptr<const geometry::TriMesh> former = std::exchange(scene.wall, std::move(wall));
  if (std::exchange(scene.moved, false)) former.reset();  // what is drawn is at another phase
  std::optional<WallChange> change;
  if (former && same_axes(scene.vessels, model.vessels)) change = change_between(*former, *scene.wall);
  // Of the same points it may still have other triangles.
  if (change && change->box.isEmpty() && former->triangles != scene.wall->triangles) change.reset();
  scene.take_places(model, former, change);
  if (scene.values.size() != scene.places.size()) clear_wall_values();
  if (!change || !scene.show_moved(*former, *change)) scene.show_wall();
}

void TreeScene::move_wall(std::shared_ptr<const geometry::TriMesh> moved,
                          const std::vector<std::shared_ptr<const geometry::AxisCurve>>& axes) {
  Impl& scene = *impl_;
  if (!moved || !scene.wall || moved->points.size() != scene.wall->points.size() ||
      axes.size() != scene.vessels.size())
    throw InvalidInput("the wall at another phase is not the one that is shown");
  if (!scene.moving_box.isEmpty()) scene.show_wall();
  scene.wall = std::move(moved);
  scene.moved = true;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    lumen::VesselLumen carried;  // without samples: nothing asks for them
    carried.vessel = scene.vessels[i]->vessel;
    carried.axis = axes[i];
    carried.own_from_mm = scene.vessels[i]->own_from_mm;
    scene.vessels[i] = std::make_shared<const lumen::VesselLumen>(std::move(carried));
  }
  scene.wall_actor.set_points(*scene.wall, smooth_normals(*scene.wall));
  scene.make_axes();
}

/// Whose each point is: kept for points that were there before and lie away from the change.
void TreeScene::Impl::take_places(const lumen::LumenModel& model,
                                  const std::shared_ptr<const geometry::TriMesh>& former,
                                  const std::optional<WallChange>& change) {
  follow_model(model);
  const std::vector<Vec3>& points = wall->points;
  std::vector<WallPlace> made(points.size());
  std::vector<std::size_t> asked;
  std::vector<Vec3> asked_points;
  const geometry::Box3 near =
      change && !change->box.isEmpty() ? grown(change->box, owner_margin_mm) : geometry::Box3{};
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool kept =
        former && change && (i < change->first || i >= change->last) && !near.contains(points[i]);
    if (kept) {
      const auto former_index = static_cast<std::ptrdiff_t>(i) - (i < change->first ? 0 : change->shift);
      made[i] = places[static_cast<std::size_t>(former_index)];
    } else {
      asked.push_back(i);
      asked_points.push_back(points[i]);
    }
  }
  const std::vector<WallPlace> answers = owner->at(asked_points);
  for (std::size_t k = 0; k < asked.size(); ++k) made[asked[k]] = answers[k];
  places = std::move(made);
  place_vessel.resize(places.size());
  std::map<std::int32_t, std::size_t> index;
  for (std::size_t i = 0; i < vessels.size(); ++i) index[vessels[i]->vessel] = i;
  std::optional<std::pair<std::int32_t, std::size_t>> last;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (!last || places[i].vessel != last->first) last = {places[i].vessel, index.at(places[i].vessel)};
    place_vessel[i] = last->second;
  }
}

bool TreeScene::Impl::visible(std::int32_t point) const {
  return vessel_styles[place_vessel[static_cast<std::size_t>(point)]]->visible;
}

/// A triangle is shown or not by its first corner.
bool TreeScene::Impl::shown(std::size_t triangle) const {
  return visible(wall->triangles[triangle][0]);
}

void TreeScene::Impl::show_wall() {
  moving_box.setEmpty();
  moving_actor.clear();
  if (!wall) return;
  wall_actor.set_points(*wall, smooth_normals(*wall));
  wall_actor.set_triangles(*wall, [&](std::size_t triangle) { return shown(triangle); });
  color_wall();
}

/// What lies behind a wall that lets light through, or before it in the CT, is mixed with it: then all is
/// drawn together. Values change everywhere.
bool TreeScene::Impl::moves_apart() const {
  return values.empty() && opacity == 1.0 && volume.prop()->GetVisibility() == 0;
}

/// While a place is edited the wall away from it stays as it was drawn; false where all is to be drawn.
bool TreeScene::Impl::show_moved(const geometry::TriMesh& former, const WallChange& change) {
  if (change.box.isEmpty()) return true;
  if (!moves_apart()) return false;
  const geometry::Box3 changed = grown(change.box, cell_margin_mm);
  if (moving_box.isEmpty()) {
    moving_box = grown(changed, moving_margin_mm);
    // The former wall is what is drawn; away from the box the new one is the same.
    const std::vector<char> moving = points_within(former, moving_box);
    wall_actor.keep_triangles([&](const geometry::Triangle& t) {
      return std::none_of(t.begin(), t.end(),
                          [&](std::int32_t corner) { return moving[static_cast<std::size_t>(corner)] != 0; });
    });
  } else if (!moving_box.contains(changed)) {
    moving_box = grown(changed, moving_margin_mm);
    const std::vector<char> moving = triangles_within(*wall, moving_box);
    wall_actor.set_points(*wall, smooth_normals(*wall));
    wall_actor.set_triangles(*wall,
                             [&](std::size_t triangle) { return !moving[triangle] && shown(triangle); });
    wall_actor.set_colors(places.size(), [&](std::size_t i) { return color_at(i); });
  }
  show_moving();
  return true;
}

void TreeScene::Impl::join_moving() {
  if (!moving_box.isEmpty() && !moves_apart()) show_wall();
}

void TreeScene::Impl::show_moving() {
  const WallPiece piece = piece_within(*wall, moving_box);
  moving_actor.set_points(piece.mesh, piece.normals);
  moving_actor.set_triangles(piece.mesh, [&](std::size_t triangle) {
    return visible(piece.points[static_cast<std::size_t>(piece.mesh.triangles[triangle][0])]);
  });
  moving_actor.set_colors(piece.points.size(),
                          [&](std::size_t i) { return color_at(static_cast<std::size_t>(piece.points[i])); });
}

figure::Color TreeScene::Impl::color_at(std::size_t point) const {
  const std::size_t of = place_vessel[point];
  const bool dark = settings.look == figure::Look::dark;
  const figure::Color dim = dark ? figure::Color{0.30, 0.32, 0.35} : figure::Color{0.80, 0.81, 0.83};
  figure::Color own = vessel_styles[of]->color;
  for (const ColoredStretch& one : stretches)
    if (one.vessel == places[point].vessel && places[point].s_mm >= one.from_mm &&
        places[point].s_mm <= one.to_mm)
      own = figure::mixed(own, one.color, stretch_share);
  const figure::Color color =
      values.empty() ? own
                     : scale_color(scale.colors, (values[point] - scale.low) / (scale.high - scale.low));
  return figure::mixed(color, dim, selected && *selected != vessels[of]->vessel ? 0.55 : 0.0);
}

void TreeScene::Impl::color_wall() {
  if (!wall) return;
  if (!moving_box.isEmpty()) return show_wall();  // the points have other numbers by now
  wall_actor.set_colors(places.size(), [&](std::size_t i) { return color_at(i); });
}

bool TreeScene::settle() {
  if (impl_->moving_box.isEmpty()) return false;
  impl_->show_wall();
  return true;
}

void TreeScene::clear_wall() {
  clear_wall_values();
  impl_->wall.reset();
  impl_->places.clear();
  impl_->place_vessel.clear();
  impl_->wall_actor.clear();
  impl_->moving_actor.clear();
  impl_->moving_box.setEmpty();
}

void TreeScene::set_other_wall(std::shared_ptr<const geometry::TriMesh> wall) {
  WallActor& actor = impl_->other_actor;
  if (!wall) return actor.clear();
  check(*wall);
  actor.set_points(*wall, smooth_normals(*wall));
  actor.set_triangles(*wall, [](std::size_t) { return true; });
  actor.set_colors(wall->points.size(), [](std::size_t) { return other_wall_color; });
  actor.set_opacity(other_wall_opacity);
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

void TreeScene::set_colored_stretches(std::vector<ColoredStretch> stretches) {
  if (impl_->stretches == stretches) return;
  impl_->stretches = std::move(stretches);
  if (impl_->wall && impl_->places.size() == impl_->wall->points.size()) impl_->color_wall();
}

VesselStyle TreeScene::vessel_style(std::int32_t vessel) const {
  impl_->vessel(vessel);
  return impl_->styles.at(vessel);
}

void TreeScene::set_vessel_style(std::int32_t vessel, const VesselStyle& style) {
  impl_->vessel(vessel);
  VesselStyle& kept = impl_->styles.at(vessel);
  if (kept == style) return;
  const bool other_triangles = kept.visible != style.visible;
  kept = style;
  if (other_triangles)
    impl_->show_wall();
  else
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
  impl_->opacity = opacity;
  impl_->wall_actor.set_opacity(opacity);
  impl_->join_moving();
}

void TreeScene::set_axes_shown(bool shown) {
  impl_->marks.axes_shown = shown;
  impl_->mark_actors.show_axes(impl_->marks);
}

}  // namespace ostia::view
