#include "shell/layouts.h"

#include "shell/desk.h"
#include "shell/docks.h"
#include "shell/floating_views.h"
#include "shell/panel_layout.h"
#include "shell/screen_room.h"
#include "views/heart_memory.h"
#include "views/planes_dock.h"

#include "ostia/core/error.h"

#include <QMainWindow>
#include <QScreen>
#include <optional>

namespace ostia::workstation {
namespace {

constexpr const char* first_setting = "layouts.first";
constexpr const char* geometry_key = "geometry";
constexpr const char* centre_key = "layout.centre";
constexpr const char* tree_key = "layout.tree";
const QString own_prefix = QStringLiteral("own:");

}  // namespace

Layouts::Layouts(Desk& desk, QMainWindow& window, PanelLayout& panels, PlanesDock& planes, HeartVolume& heart)
    : desk_(desk),
      window_(window),
      panels_(panels),
      planes_(planes),
      heart_(heart),
      own_layouts_(desk.machine, "layouts.own") {
  // A window without anything in it would be a riddle.
  connect(&planes, &QDockWidget::topLevelChanged, this, &Layouts::keep_something);
  connect(&planes, &QDockWidget::visibilityChanged, this, &Layouts::keep_something);
}

void Layouts::centre(bool shown) {
  window_.centralWidget()->setVisible(shown);
}

void Layouts::keep_something() {
  if (window_.centralWidget()->isHidden() && (planes_.isHidden() || planes_.isFloating())) centre(true);
}

void Layouts::show_reading() {
  panels_.floating().bring_all_back();
  centre(true);
  panels_.show_tree(true);
  planes_.hide();
  shown_ = QStringLiteral("reading");
}

void Layouts::show_planes() {
  panels_.floating().bring_all_back();
  planes_.setFloating(false);
  planes_.show();
  centre(false);
  shown_ = QStringLiteral("planes");
}

void Layouts::show_flat() {
  panels_.floating().bring_all_back();
  centre(true);
  panels_.show_tree(false);
  planes_.hide();
  shown_ = QStringLiteral("flat");
}

void Layouts::show_own(const QString& name) {
  const Values values = own_layouts_.values(name);
  if (values.empty()) return;
  // Of a mesh or a motion the docks are there while there is one, whatever a layout says.
  std::map<QDockWidget*, bool> others;
  for (QDockWidget* dock : window_.findChildren<QDockWidget*>())
    if (dock != &planes_ && dock->objectName() != "qa") others[dock] = !dock->isHidden();
  arrange(values);
  for (const auto& [dock, shown] : others) dock->setVisible(shown);
  shown_ = own_prefix + name;
}

void Layouts::save(const QString& name) {
  const QString clean = name.simplified();
  if (clean.isEmpty()) throw InvalidInput("a layout needs a name");
  own_layouts_.set(clean, now());
  shown_ = own_prefix + clean;
}

void Layouts::forget(const QString& name) {
  own_layouts_.remove(name);
  if (first() == own_prefix + name) set_first({});
}

void Layouts::set_first(const QString& which) {
  desk_.machine.set_setting(first_setting, which.toStdString());
}

QString Layouts::first() const {
  return QString::fromStdString(desk_.machine.setting(first_setting).value_or(""));
}

Layouts::Values Layouts::now() const {
  Values values = panels_.layout_settings();
  values[geometry_key] = window_.saveGeometry().toBase64().toStdString();
  values.merge(dock_settings(window_));
  values.merge(look_settings(heart_));
  values[centre_key] = window_.centralWidget()->isHidden() ? "off" : "on";
  values[tree_key] = panels_.tree_shown() ? "on" : "off";
  return values;
}

void Layouts::arrange(const Values& values) {
  const auto value = [&](const char* key) -> std::optional<std::string> {
    const auto found = values.find(key);
    return found == values.end() ? std::nullopt : std::optional(found->second);
  };
  window_.restoreGeometry(
      QByteArray::fromBase64(QByteArray::fromStdString(value(geometry_key).value_or(""))));
  window_.resize(window_.size().boundedTo(window_.screen()->availableSize()));
  restore_docks(window_, value("docks"), value("docks.opened"));
  panels_.restore_layout(values);
  panels_.show_tree(value(tree_key).value_or("on") != "off");
  panels_.floating().restore(value("views.floating").value_or(""));
  bring_back_docks(window_);
  centre(value(centre_key).value_or("on") != "off");
  keep_something();
  restore_look(heart_, values);
}

void Layouts::show(const QString& which) {
  if (which == "reading") show_reading();
  if (which == "planes") show_planes();
  if (which == "flat") show_flat();
  if (which.startsWith(own_prefix)) show_own(which.mid(own_prefix.size()));
}

void Layouts::begin() {
  show(first());
}

}  // namespace ostia::workstation
