#include "commands/shortcuts.h"
#include "flow/cases.h"
#include "flow/results.h"
#include "help/help.h"
#include "measuring/reporting.h"
#include "meshing/export.h"
#include "opening/opening.h"
#include "phases/beating_case.h"
#include "shell/bind.h"
#include "shell/main_window.h"
#include "shell/tool_bar_fit.h"
#include "vessels/connect_menu.h"
#include "vessels/finder.h"
#include "vessels/outer_walls.h"

#include "ostia/core/error.h"

#include <QActionGroup>
#include <QCoreApplication>
#include <QHBoxLayout>
#include <QLabel>
#include <QMenu>
#include <QMenuBar>
#include <QToolBar>
#include <cmath>

namespace ostia::workstation {
namespace {

using session::Tool;

struct ToolEntry {
  Tool tool;
  const char* id;
  const char* text;
  const char* tip;
};

constexpr ToolEntry tools[] = {
    {Tool::browse, "tool.browse", QT_TRANSLATE_NOOP("tools", "Browse"),
     QT_TRANSLATE_NOOP("tools", "The cursor goes where you click. Shift and drag: turn the CPR.")},
    {Tool::drag, "tool.drag", QT_TRANSLATE_NOOP("tools", "Pull"),
     QT_TRANSLATE_NOOP("tools", "Take the contour and pull it. Shift and wheel: how far the pull reaches.")},
    {Tool::draw, "tool.draw", QT_TRANSLATE_NOOP("tools", "Draw"),
     QT_TRANSLATE_NOOP("tools", "Draw the wall anew, on a CPR or around the lumen on the cross-section.")},
    {Tool::brush, "tool.brush", QT_TRANSLATE_NOOP("tools", "Brush"),
     QT_TRANSLATE_NOOP("tools", "A ball that pushes the wall: outwards from within, inwards from without.")},
    {Tool::axis, "tool.axis", QT_TRANSLATE_NOOP("tools", "Centerline"),
     QT_TRANSLATE_NOOP("tools",
                       "Pull the centerline. Double click adds a control point, Delete takes one away.")},
    {Tool::add_vessel, "tool.add_vessel", QT_TRANSLATE_NOOP("tools", "Add vessel"),
     QT_TRANSLATE_NOOP("tools", "Click the distal end of a vessel; the way back to the tree is found.")},
    {Tool::distance, "tool.distance", QT_TRANSLATE_NOOP("tools", "Distance"),
     QT_TRANSLATE_NOOP("tools", "Drag from one place to the other.")},
    {Tool::angle, "tool.angle", QT_TRANSLATE_NOOP("tools", "Angle"),
     QT_TRANSLATE_NOOP("tools", "Click three places, the vertex second.")},
    {Tool::area, "tool.area", QT_TRANSLATE_NOOP("tools", "Area"),
     QT_TRANSLATE_NOOP("tools", "Draw around it.")},
    {Tool::diameter, "tool.diameter", QT_TRANSLATE_NOOP("tools", "Diameter"),
     QT_TRANSLATE_NOOP("tools", "Drag across the lumen.")},
    {Tool::stenosis, "tool.stenosis", QT_TRANSLATE_NOOP("tools", "Stenosis"),
     QT_TRANSLATE_NOOP("tools", "On a CPR, drag from the proximal to the distal place of reference.")},
    {Tool::volume, "tool.volume", QT_TRANSLATE_NOOP("tools", "Volume"),
     QT_TRANSLATE_NOOP("tools", "On a CPR, drag along the stretch of the vessel.")},
    {Tool::ring_hu, "tool.ring_hu", QT_TRANSLATE_NOOP("tools", "HU ring"),
     QT_TRANSLATE_NOOP("tools", "Click where CT numbers about the lumen are wanted.")},
};

}  // namespace

QAction* MainWindow::action(const QString& id, const QString& text, const std::function<void()>& run) {
  auto* made = new QAction(text, this);
  made->setObjectName(id);
  made->setShortcuts(ShortcutKeys::from(machine_.settings()).keys(id));
  if (run) connect(made, &QAction::triggered, this, [this, run] { guarded(run); });
  actions_[id] = made;
  return made;
}

void MainWindow::build_actions() {
  QMenu* file = menuBar()->addMenu(tr("&File"));
  file->addAction(
      action("file.open", tr("&Open a case or image\u2026"), [this] { opening_->choose_file(); }));
  file->addAction(
      action("file.open_folder", tr("Open a DICOM &folder\u2026"), [this] { opening_->choose_folder(); }));
  QMenu* recent = file->addMenu(tr("&Recent cases"));
  connect(recent, &QMenu::aboutToShow, this, [this, recent] { fill_recent(recent); });
  file->addAction(action("file.sample", tr("The &sample case"), [this] { opening_->open_sample(); }));
  file->addSeparator();
  file->addAction(action("file.save_as", tr("Save the case &as\u2026"), [this] { opening_->save_as(); }));
  file->addAction(action("file.close", tr("&Close the case"), [this] { opening_->close_case(); }));
  file->addSeparator();
  file->addAction(action("file.report", tr("&Report (PDF, HTML, tables)"),
                         [this] { reporting_->make_report(opening_->case_path()); }));
  file->addAction(action("file.pin", tr("&Pin this view to the report"), [this] { pin_view(); }));
  QMenu* exports = file->addMenu(tr("&Export"));
  exports->addAction(action("file.export_surface", tr("The &wall\u2026"),
                            [this] { meshing_export_->ask(ExportKind::surface, opening_->case_path()); }));
  exports->addAction(action("file.export_mesh", tr("A &mesh\u2026"),
                            [this] { meshing_export_->ask(ExportKind::mesh, opening_->case_path()); }));
  exports->addAction(action("file.flow_case", tr("A &flow case\u2026"),
                            [this] { flow_cases_->ask(opening_->case_path()); }));
  exports->addAction(action("file.export_centerlines", tr("The &centerlines\u2026"),
                            [this] { reporting_->export_centerlines(); }));
  file->addAction(
      action("file.open_mesh", tr("Open a &mesh\u2026"), [this] { meshing_export_->ask_for_mesh(); }));
  file->addAction(
      action("file.flow_results", tr("Open flow res&ults\u2026"), [this] { flow_results_->ask(); }));
  file->addAction(action("file.motion", tr("Open a mo&tion\u2026"), [this] { beating_->ask(); }));
  file->addSeparator();
  file->addAction(action("file.quit", tr("&Quit"), [this] { close(); }));

  QMenu* edit = menuBar()->addMenu(tr("&Edit"));
  edit->addAction(action("edit.undo", tr("&Undo"), [this] { bench_.undo(); }));
  edit->addAction(action("edit.redo", tr("&Redo"), [this] { bench_.redo(); }));

  QMenu* vessel = menuBar()->addMenu(tr("Ve&ssel"));
  vessel->addAction(
      action("vessel.find", tr("&Find the coronary arteries"), [this] { finder_->find_tree(); }));
  vessel->addAction(action("vessel.split", tr("&Split at the cursor"), [this] {
    bench_.edit(lumen::BranchSplit{bench_.vessel.get(), bench_.cursor_mm.get(), {}});
  }));
  vessel->addAction(action("vessel.merge", tr("&Join with parent vessel"), [this] { join_with_parent(); }));
  vessel->addAction(action("vessel.cut", tr("Cut in &two at the cursor"), [this] {
    bench_.edit(lumen::BranchCut{bench_.vessel.get(), bench_.cursor_mm.get(), {}});
  }));
  vessel->addAction(action("vessel.connect", tr("&Connect to the cursor\u2026"), [this] {
    connect_menu(bench_, guard_, this)->popup(mapToGlobal(rect().center()));
  }));

  QMenu* tool_menu = menuBar()->addMenu(tr("&Tools"));
  auto* group = new QActionGroup(this);
  for (const ToolEntry& entry : tools) {
    QAction* made = action(entry.id, QCoreApplication::translate("tools", entry.text), {});
    made->setProperty("tip", QCoreApplication::translate("tools", entry.tip));
    made->setCheckable(true);
    made->setChecked(entry.tool == bench_.tool.get());
    group->addAction(made);
    tool_menu->addAction(made);
    connect(made, &QAction::triggered, this, [this, tool = entry.tool, tip = QString(entry.tip)] {
      say(QCoreApplication::translate("tools", tip.toUtf8().constData()));
      bench_.tool.set(tool);  // who watches it may have something better to say
    });
    keep_with(made, bench_.tool.observe(
                        [made, tool = entry.tool](const Tool& now) { made->setChecked(now == tool); }));
    if (entry.tool == Tool::add_vessel) tool_menu->addSeparator();
  }
  tool_menu->addSeparator();
  tool_menu->addAction(action("view.play", tr("&Play the heartbeat"), [this] { beating_->toggle(); }));
  tool_menu->addAction(
      action("view.own_phase", tr("Back to the case's phase"), [this] { beating_->go_to_own(); }));

  build_tree_menu(tool_menu);

  QMenu* shown = menuBar()->addMenu(tr("&View"));
  shown->addAction(action("view.turn_left", tr("Turn the CPRs left"), [this] { turn(-5.0); }));
  shown->addAction(action("view.turn_right", tr("Turn the CPRs right"), [this] { turn(5.0); }));
  shown->addAction(action("view.proximal", tr("To proximal"), [this] { walk(-0.5); }));
  shown->addAction(action("view.distal", tr("To distal"), [this] { walk(0.5); }));
  shown->addAction(action("view.next_vessel", tr("Next vessel"), [this] { next_vessel(1); }));
  shown->addAction(action("view.previous_vessel", tr("Previous vessel"), [this] { next_vessel(-1); }));
  shown->addSeparator();
  const auto toggle = [&](const QString& id, const QString& text, auto& property, auto off, auto on) {
    QAction* made = action(id, text, {});
    made->setCheckable(true);
    using Value = decltype(off);
    keep_with(made, property.observe([made, on](const Value& now) { made->setChecked(now == on); }));
    connect(made, &QAction::triggered, this,
            [&property, off, on](bool checked) { property.set(checked ? on : off); });
    shown->addAction(made);
  };
  toggle("view.stretched", tr("Stretched CPR"), bench_.curved_mode, reformat::CurvedMode::straightened,
         reformat::CurvedMode::stretched);
  toggle("view.mip", tr("Slab: maximum"), bench_.slab, reformat::Slab::none, reformat::Slab::maximum);
  toggle("view.mean", tr("Slab: mean"), bench_.slab, reformat::Slab::none, reformat::Slab::mean);
  QAction* contours = action("view.contours", tr("Contours"), {});
  bind_checked(contours, bench_.contours_shown);
  shown->addAction(contours);
  QAction* outer = action("view.outer_wall", tr("Outer wall"), {});
  bind_checked(outer, outer_walls_->board().shown);
  shown->addAction(outer);
  shown->addAction(action("view.plaque", tr("Plaque"), {}));
  outer_walls_->set_plaque_command(actions_["view.plaque"]);
  shown->setToolTipsVisible(true);  // why a command cannot be used
  shown->addAction(action("view.fit", tr("Fit all views"), [this] {
    for (PictureWidget* picture : pictures_) picture->view().fit();
    scene_->go_to(scene_->scene().pose_fitted());
  }));
  shown->addSeparator();
  int number = 1;
  for (const session::WindowPreset& preset : session::window_presets())
    shown->addAction(action(QStringLiteral("window.%1").arg(number++),
                            tr("Window: %1").arg(QCoreApplication::translate("presets", preset.name.c_str())),
                            [this, preset] { bench_.grey.set(preset.window); }));
  shown->addSeparator();
  QMenu* camera = shown->addMenu(tr("Look at the tree from"));
  const auto from = [&](const QString& text, const std::function<view::CameraPose()>& pose) {
    camera->addAction(text, this, [this, pose] { guarded([&] { scene_->go_to(pose()); }); });
  };
  using view::ViewFrom;
  from(tr("the front"), [this] { return scene_->scene().pose_from_side(ViewFrom::anterior); });
  from(tr("the left"), [this] { return scene_->scene().pose_from_side(ViewFrom::left); });
  from(tr("the right"), [this] { return scene_->scene().pose_from_side(ViewFrom::right); });
  from(tr("above"), [this] { return scene_->scene().pose_from_side(ViewFrom::cranial); });
  for (const auto& [lao, cranial] :
       {std::pair(-30.0, 20.0), {-30.0, -20.0}, {40.0, 20.0}, {45.0, -25.0}, {0.0, 30.0}}) {
    const QString side = lao < 0   ? "RAO"
                         : lao > 0 ? "LAO"
                                   : "AP",
                  tilt = cranial < 0 ? tr("caudal") : tr("cranial");
    from(QStringLiteral("%1 %2\u00b0, %3 %4\u00b0")
             .arg(side)
             .arg(std::abs(lao))
             .arg(tilt)
             .arg(std::abs(cranial)),
         [this, lao = lao, cranial = cranial] {
           return scene_->scene().pose_from_carm({lao, cranial});
         });
  }
  from(tr("broadside of the vessel"), [this] { return scene_->scene().pose_of_vessel(bench_.vessel.get()); });
  shown->addSeparator();
  shown->addAction(action("view.theme", tr("Light or dark"), [this] {
    set_theme(current_theme() == Theme::dark ? Theme::light : Theme::dark);
  }));
  shown->addAction(build_qa());
  shown->addAction(meshing_export_->panel_action());

  connect(beating_, &BeatingCase::shown_changed, this, &MainWindow::refresh_actions);
  own_.push_back(bench_.case_changed.observe([this] { refresh_actions(); }));
  own_.push_back(bench_.image_changed.observe([this] { refresh_actions(); }));
  own_.push_back(bench_.steps_changed.observe([this] { refresh_actions(); }));
  own_.push_back(bench_.vessel.observe([this](const std::int32_t&) { refresh_actions(); }));
  refresh_actions();
  new Help(*this, {edit, tool_menu, shown});
}

void MainWindow::build_tool_bar() {
  QToolBar* bar = addToolBar(tr("Tools"));
  bar->setObjectName("tools");
  bar->setMovable(false);
  bar->addAction(actions_["edit.undo"]);
  bar->addAction(actions_["edit.redo"]);
  bar->addSeparator();
  for (const ToolEntry& entry : tools) {
    bar->addAction(actions_[entry.id]);
    if (entry.tool == Tool::browse || entry.tool == Tool::add_vessel) bar->addSeparator();
  }
  auto* options = addToolBar(tr("Options"));
  options->setObjectName("options");
  options->setMovable(false);
  const auto number = [&](const QString& text, const QString& tip, const QString& name,
                          session::Property<double>& property, int decimals) {
    auto* pair = new QWidget;  // where there is no room for the box its name goes with it
    auto* row = new QHBoxLayout(pair);
    row->setContentsMargins(0, 0, 0, 0);
    row->setSpacing(options->layout()->spacing());
    auto* label = new QLabel(" " + text + " ");
    auto* box = new QDoubleSpinBox;
    box->setObjectName(name);
    box->setAccessibleName(text);
    box->setToolTip(tip);
    box->setDecimals(decimals);
    box->setSuffix(tr(" mm"));
    box->setFocusPolicy(Qt::ClickFocus);
    label->setBuddy(box);
    bind(box, property);
    row->addWidget(label);
    row->addWidget(box);
    options->addWidget(pair);
  };
  number(tr("Reach"), tr("How far along the vessel a pull reaches"), "reach", bench_.reach_mm, 1);
  number(tr("Ball"), tr("Radius of the brush"), "ball", bench_.brush_mm, 1);
  number(tr("Slab"), tr("Thickness of the slab in 2D views, where one is shown"), "slab", bench_.slab_mm, 1);
  new ToolBarFit(this, bar, options);
}

void MainWindow::refresh_actions() {
  const bool has_case = bench_.has_case();
  std::optional<session::JournalEntry> undo, redo;
  if (has_case) {
    undo = bench_.session().file().next_undo();
    redo = bench_.session().file().next_redo();
  }
  actions_["edit.undo"]->setEnabled(undo.has_value());
  actions_["edit.redo"]->setEnabled(redo.has_value());
  for (const char* id : {"file.save_as", "file.close", "file.report", "file.pin", "file.export_surface",
                         "file.export_mesh", "file.export_centerlines", "file.motion"})
    actions_[id]->setEnabled(has_case);
  for (const char* id : {"view.play", "view.own_phase"}) actions_[id]->setEnabled(beating_->shown());
  actions_["vessel.find"]->setEnabled(!has_case && bench_.image().volume);
  actions_["vessel.split"]->setEnabled(has_case && bench_.axis());
  actions_["vessel.cut"]->setEnabled(has_case && bench_.axis());
  actions_["vessel.connect"]->setEnabled(has_case && bench_.axis() && bench_.model()->vessels.size() > 1);
  actions_["vessel.merge"]->setEnabled(has_case && bench_.axis() &&
                                       lumen::merge_parent(bench_.model()->tree, bench_.vessel.get()));
}

void MainWindow::join_with_parent() {
  const std::int32_t vessel = bench_.vessel.get();
  const double cursor = bench_.cursor_mm.get();
  const auto parent = lumen::merge_parent(bench_.model()->tree, vessel);
  bench_.edit(lumen::BranchMerge{vessel});
  bench_.vessel.set(*parent);  // the same place: its abscissas go on as they were
  bench_.cursor_mm.set(cursor);
}

void MainWindow::fill_recent(QMenu* menu) {
  menu->clear();
  for (const session::RecentCase& one : machine_.recent_cases()) {
    const QString path = QString::fromStdString(one.path.string());
    menu->addAction(path, this, [this, path] { open(path.toStdString()); });
  }
  if (menu->isEmpty()) menu->addAction(tr("none yet"))->setEnabled(false);
}

void MainWindow::pin_view() {
  auto* view = qobject_cast<PictureWidget*>(focusWidget());
  if (view)
    reporting_->pin(*view);
  else
    say(tr("Click into the CPR, section or slice to be pinned first."));
}

void MainWindow::turn(double degrees) {
  bench_.theta_deg.set(std::remainder(bench_.theta_deg.get() + degrees, 360.0));
}
void MainWindow::walk(double mm) {
  bench_.cursor_mm.set(bench_.cursor_mm.get() + mm);
}

void MainWindow::next_vessel(int by) {
  const lumen::LumenModel* model = bench_.model();
  if (!model) return;
  const auto& vessels = model->tree.vessels;
  const int count = static_cast<int>(vessels.size());
  for (int i = 0; i < count; ++i)
    if (vessels[static_cast<std::size_t>(i)].id == bench_.vessel.get()) {
      bench_.vessel.set(vessels[static_cast<std::size_t>((i + by + count) % count)].id);
      return;
    }
}

void MainWindow::set_theme(Theme theme) {
  apply_theme(theme);
  scene_->set_dark(theme == Theme::dark);
  guarded([&] { machine_.set_setting("theme", theme == Theme::dark ? "dark" : "light"); });
}

}  // namespace ostia::workstation
