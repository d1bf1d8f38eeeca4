#include "views/heart_volume.h"

#include "shell/desk.h"
#include "views/scene_widget.h"

#include "ostia/imaging/reduced_volume.h"
#include "ostia/view/volume_box.h"
#include "ostia/view/volume_light.h"

#include <any>
#include <utility>

namespace ostia::workstation {
namespace {

constexpr double artery_step_mm = 0.5;
constexpr std::size_t most_cuts = 200;  // a hand that cuts more begins anew
constexpr int rest_ms = 350;            // longer than a cine shows a picture

/// About the arteries: what heart_region keeps at most.
imaging::ReducedVolumeOptions region_about(const std::vector<coronary::ArteryPlace>& arteries) {
  imaging::ReducedVolumeOptions options;
  if (arteries.empty()) return options;
  const coronary::HeartRegionOptions region;
  const double beyond_mm = region.about_tree + region.blood;
  options.box.emplace();
  for (const coronary::ArteryPlace& each : arteries) {
    options.box->extend(each.place - geometry::Vec3::Constant(beyond_mm));
    options.box->extend(each.place + geometry::Vec3::Constant(beyond_mm));
  }
  return options;
}

}  // namespace

struct HeartVolume::Prepared {
  Ground ground;
  SharedImage shown;
  std::shared_ptr<const std::vector<float>> light;  // null: not wished
  std::vector<std::int64_t> histogram;
};

HeartVolume::Prepared HeartVolume::prepare(const Wish& wish, Ground ground, const core::TaskContext& task) {
  Prepared made{std::move(ground), {}, {}, {}};
  if (!made.ground.reduced) {
    const auto options = wish.alone ? region_about(wish.arteries) : imaging::ReducedVolumeOptions{};
    made.ground.reduced = std::make_shared<const imaging::ImageVolume>(
        imaging::reduced_volume(*wish.image, options, task.sub(0.0, 0.3)));
    if (wish.alone)
      made.ground.heart = std::make_shared<const imaging::MaskVolume>(
          coronary::heart_region(*made.ground.reduced, wish.arteries, {}, task.sub(0.3, 0.9)));
  }
  made.shown = made.ground.reduced;
  if (made.ground.heart || !wish.cuts.empty()) {
    const imaging::ImageVolume& reduced = *made.ground.reduced;
    imaging::MaskVolume mask{reduced.geometry, {}};
    if (made.ground.heart)
      mask = *made.ground.heart;
    else
      mask.voxels.assign(reduced.voxels.size(), 1);
    for (const view::VolumeCut& cut : wish.cuts) view::cut_away(mask, cut, task);
    made.shown = std::make_shared<const imaging::ImageVolume>(view::with_mask(reduced, mask));
  }
  if (wish.lit)
    made.light = std::make_shared<const std::vector<float>>(view::ambient_light(*made.shown, task));
  made.histogram = view::histogram(*made.shown, histogram_low_hu, histogram_high_hu, histogram_bins);
  return made;
}

HeartVolume::HeartVolume(Desk& desk, SceneWidget& scene, std::function<bool()> is_being_read)
    : QObject(&desk.window), desk_(desk), scene_(scene), is_being_read_(std::move(is_being_read)) {
  connect(&scene, &SceneWidget::volume_wanted, this, &HeartVolume::refresh);
  const auto look_changed = [this] {
    scene_.scene().set_volume_look(look());
    scene_.request_render();
  };
  look_changed();
  const auto show_tree = [this] {
    const bool alone_there = scene_.volume_mode() == view::VolumeMode::off;
    scene_.scene().set_wall_shown(tree_over_it.get() || alone_there);
    scene_.request_render();
  };
  connect(&scene, &SceneWidget::volume_mode_changed, this, show_tree);
  own_.push_back(tree_over_it.observe([show_tree](const bool&) { show_tree(); }));
  own_.push_back(preset.observe([look_changed](const auto&) { look_changed(); }));
  own_.push_back(shift_hu.observe([look_changed](const auto&) { look_changed(); }));
  own_.push_back(stretch.observe([look_changed](const auto&) { look_changed(); }));
  own_.push_back(crop.observe([this](const view::VolumeCrop& now) {
    scene_.scene().set_volume_crop(now);
    scene_.request_render();
  }));
  own_.push_back(box_shown.observe([this](const bool& shown) {
    if (shown) show();
  }));
  own_.push_back(alone.observe([this](const bool&) { forget_ground(); }));
  own_.push_back(desk.bench.image_changed.observe([this] {
    follow_image();
    make_stale();  // the scene has let go of it
    refresh();
  }));
  resting_.setSingleShot(true);
  resting_.setInterval(rest_ms);
  connect(&resting_, &QTimer::timeout, this, &HeartVolume::follow_shown);
  own_.push_back(desk.bench.other_image_changed.observe([this] { resting_.start(); }));
  own_.push_back(desk.bench.phase_changed.observe([this] { resting_.start(); }));
  own_.push_back(desk.bench.case_changed.observe([this] {
    if (alone.get()) forget_ground();
  }));
  own_.push_back(desk.bench.model_changed.observe([this](const session::ModelEvent& event) {
    if (event.tree_changed && alone.get()) forget_ground();
  }));
}

void HeartVolume::reset_look() {
  shift_hu.set(0.0);
  stretch.set(1.0);
}

void HeartVolume::show() {
  if (scene_.volume_mode() == view::VolumeMode::off)
    scene_.set_volume_mode(view::VolumeMode::rendering);
  else
    refresh();
}

void HeartVolume::cut(const view::VolumeCut& cut) {
  if (cuts_.size() >= most_cuts) return;
  cuts_.push_back(cut);
  make_stale();
  show();
  emit cuts_changed();
}

bool HeartVolume::undo_cut() {
  if (cuts_.empty()) return false;
  cuts_.pop_back();
  make_stale();
  refresh();
  emit cuts_changed();
  return true;
}

void HeartVolume::reset_cuts() {
  set_cuts({});
}

void HeartVolume::set_cuts(std::vector<view::VolumeCut> cuts) {
  if (cuts.empty() && cuts_.empty()) return;
  if (cuts.size() > most_cuts) cuts.resize(most_cuts);
  cuts_ = std::move(cuts);
  make_stale();
  refresh();
  emit cuts_changed();
}

void HeartVolume::follow_image() {
  if (desk_.bench.image().volume == image_) return;
  resting_.stop();
  image_ = desk_.bench.image().volume;
  source_ = desk_.bench.shown_image();
  crop_grid_ = image_ ? image_->geometry : imaging::Geometry();
  ground_ = {};
  cuts_.clear();
  shown_.reset();
  histogram_.clear();
  make_stale();
  crop.set({});
  emit cuts_changed();
  emit shown_changed();
}

/// What was shown last stays until the new one is there.
void HeartVolume::follow_shown() {
  if (desk_.bench.shown_image() == source_) return;
  source_ = desk_.bench.shown_image();
  forget_ground();
}

void HeartVolume::make_stale() {
  stale_ = true;
  ++wish_;
}

void HeartVolume::forget_ground() {
  ground_ = {};
  make_stale();
  refresh();
}

std::vector<coronary::ArteryPlace> HeartVolume::arteries() const {
  std::vector<coronary::ArteryPlace> places;
  const lumen::LumenModel* model = desk_.bench.model();
  if (!model || !source_) return places;
  for (const auto& vessel : model->vessels) {
    const auto axis = desk_.bench.axis(vessel->vessel);  // at the phase that is shown
    for (double s = 0.0; axis && s < axis->length() + artery_step_mm; s += artery_step_mm)
      if (const geometry::Vec3 place = axis->point(s); source_->geometry.contains(place))
        places.push_back({place, axis->radius(s)});
  }
  return places;
}

void HeartVolume::refresh() {
  follow_image();
  if (!stale_ || !source_ || scene_.volume_mode() == view::VolumeMode::off || is_being_read_()) return;
  const Wish wish{source_, arteries(), alone.get(), !scene_.scene().draws_in_software(), cuts_};
  desk_.jobs.run(
      "volume", SceneWidget::tr("Preparing the heart"),
      [wish, ground = ground_](const core::TaskContext& task) {
        return std::any(std::make_shared<const Prepared>(prepare(wish, ground, task)));
      },
      [this, number = wish_](const std::any& result) {
        if (number != wish_) return;  // another heart by now, or less of it
        const auto made = std::any_cast<std::shared_ptr<const Prepared>>(result);
        ground_ = made->ground;
        shown_ = made->shown;
        histogram_ = made->histogram;
        stale_ = false;
        scene_.scene().set_volume(shown_);
        const view::VolumeCrop box = view::carried(crop.get(), crop_grid_, shown_->geometry);
        crop_grid_ = shown_->geometry;
        crop.set(box);
        scene_.scene().set_volume_light(made->light);
        scene_.request_render();
        emit shown_changed();
      },
      [this](const QString& message) { desk_.messages.say(message); });
}

}  // namespace ostia::workstation
