#include "flow/results.h"

#include "flow/bar.h"
#include "shell/desk.h"
#include "shell/file_dialogs.h"
#include "shell/panel.h"
#include "views/scene_widget.h"

namespace ostia::workstation {
namespace {

constexpr int picture_scale = 2;  // pixels of a saved picture over those of the screen

}  // namespace

FlowResults::FlowResults(Desk& desk, SceneWidget& view, ProfileWidget& profile)
    : QObject(&desk.window), desk_(desk), view_(view), profile_(profile), bar_(new FlowBar) {
  bar_->hide();
  view.add_below(bar_);
  connect(bar_, &FlowBar::array_changed, this, &FlowResults::show_array);
  connect(bar_, &FlowBar::range_changed, this, &FlowResults::color);
  connect(bar_, &FlowBar::hide_wanted, this, &FlowResults::hide);
  connect(bar_, &FlowBar::save_wanted, this, &FlowResults::save_picture);
  connect(&view, &SceneWidget::pointed, this, &FlowResults::tell);
  connect(&view, &SceneWidget::left, this, [this] {
    if (scene_) emit pointed({});
  });
  connect(&view, &SceneWidget::guest_changed, this, [this](const view::SceneGuest* guest) {
    if (guest == scene_.get()) return;
    scene_.reset();
    result_ = {};
    bar_->hide();
    show_along();
  });
  follow_vessels();
  own_.push_back(desk.bench.case_changed.observe([this] {
    desk_.jobs.cancel("flow_results");  // what is still being read is of the former case
    hide();
  }));
}

void FlowResults::ask() {
  const QString chosen = ask_open_file(&desk_.window, tr("Open flow results"),
                                       tr("Surfaces with values (*.vtp *.vtk);;All files (*)"));
  if (!chosen.isEmpty()) open({chosen.toStdString()});
}

void FlowResults::open(const std::vector<std::filesystem::path>& files) {
  desk_.jobs.run(
      "flow_results", tr("Flow results"),
      [files](const core::TaskContext&) { return std::any(read_flow_surface(files)); },
      [this](const std::any& read) { show(std::any_cast<const FlowSurface&>(read)); },
      [this](const QString& message) {
        desk_.messages.complain(message, tr("The results could not be opened"));
      });
}

void FlowResults::show(FlowSurface result) {
  auto scene = std::make_shared<view::SurfaceFieldScene>(result.surface);
  result_ = std::move(result);
  scene_ = scene;
  bar_->set_arrays(result_.arrays, first_shown(result_.arrays));
  show_array();
  bar_->show();
  reveal(view_);
  view_.show_guest(scene);
  show_along();
}

void FlowResults::hide() {
  if (scene_) view_.show_guest(nullptr);
}

void FlowResults::show_array() {
  if (!scene_) return;
  color();
}

void FlowResults::color() {
  if (!scene_) return;
  const FlowArray& array = result_.arrays[bar_->array()];
  auto range = bar_->range();
  if (bar_->automatic()) {
    range = view::rounded_range(view::automatic_range(array.values));
    bar_->set_range(*range);
  }
  if (!range) return;  // what is typed is not finished
  scene_->set_values(
      array.values, array.at,
      {title_with_unit(array).toStdString(), range->first, range->second, view::ColorScale::sequential});
  view_.request_render();
}

void FlowResults::tell(const geometry::Vec2& display) {
  if (!scene_) return;
  const auto value = scene_->value_at(view_.scene().ray(display));
  const FlowArray& array = result_.arrays[bar_->array()];
  emit pointed(value ? title_of_array(array) + " " + value_text(*value, array) : QString());
}

void FlowResults::save_picture() {
  const QString chosen = ask_save_file(&desk_.window, tr("Save the picture"), tr("Pictures (*.png)"));
  if (chosen.isEmpty() || !scene_) return;
  desk_.messages.guarded(
      [&] {
        view_.save_picture(chosen.toStdString(), picture_scale);
        desk_.messages.say(tr("The picture is in %1.").arg(chosen));
      },
      true);
}

}  // namespace ostia::workstation
