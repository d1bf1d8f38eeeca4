#include "shell/panel_layout.h"

#include "measuring/lesion_list.h"
#include "measuring/list.h"
#include "shell/desk.h"
#include "shell/floating_views.h"
#include "shell/hanging.h"
#include "shell/panel.h"
#include "shell/step_list.h"
#include "shell/theme.h"
#include "vessels/doubts.h"
#include "vessels/list.h"
#include "views/paint_queue.h"
#include "views/scene_widget.h"

#include "ostia/view/curved_view.h"
#include "ostia/view/plane_view.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QSplitter>
#include <QTabWidget>

namespace ostia::workstation {
namespace {

using view::CurvedView;
using view::SectionView;
using view::SliceKind;
using view::SliceView;

constexpr double strip_step_mm = 1.0;
constexpr int strip_px = 56;  // of a neighbour at least

/// The names of what stands in a splitter, in its order.
std::string parts_of(const QSplitter& splitter) {
  QStringList names;
  for (int i = 0; i < splitter.count(); ++i) names << splitter.widget(i)->objectName();
  return names.join(' ').toStdString();
}

}  // namespace

PanelLayout::PanelLayout(Desk& desk) : QObject(&desk.window), desk_(desk) {
  guard_ = [&desk](const std::function<void()>& act) { desk.messages.guarded(act); };
  auto* columns = new QSplitter(Qt::Horizontal);
  columns->setObjectName("columns");
  tree_ = tree_panel();  // first: the list of vessels asks it for colours
  columns->addWidget(side_column());
  columns->addWidget(curved_column());
  columns->addWidget(section_column());
  columns->addWidget(tree_);
  columns->setSizes({300, 560, 330, 380});
  columns->setStretchFactor(0, 0);
  for (int i = 1; i < 4; ++i) columns->setStretchFactor(i, 1);
  hanging_ = new Hanging(columns, columns->findChild<QTabWidget*>("lists"), tree_);
  connect(hanging_, &Hanging::narrow_changed, this, &PanelLayout::narrow_changed);
  rows_ = new QSplitter(Qt::Vertical);
  rows_->setObjectName("rows");
  rows_->addWidget(columns);
  rows_->addWidget(bottom_row());
  rows_->setSizes({760, 170});
  rows_->setStretchFactor(0, 1);
  rows_->setStretchFactor(1, 0);
  splitters_.push_back(columns);
  splitters_.push_back(rows_);
  for (const QSplitter* one : splitters_) parts_[one] = parts_of(*one);
  let_views_float();
}

void PanelLayout::let_views_float() {
  floating_ = new FloatingViews(desk_.window);
  const auto add = [this](FloatingView view) {
    view.leave = [this, leave = view.leave] {
      if (alone_) maximise(alone_);
      leave();
    };
    floating_->add(std::move(view));
  };
  for (Panel* one : rows_->findChildren<Panel*>()) {
    connect(one, &Panel::own_window_wanted, this,
            [this, name = one->objectName()] { floating_->set_floating(name, !floating_->floats(name)); });
    if (one == tree_)
      add({tree_, one->accessibleName(), [this] { hanging_->lend_tree(true); },
           [this] { hanging_->lend_tree(false); }});
    else
      add(in_splitter(*one, one->accessibleName()));
  }
  add(in_splitter(*rows_->findChild<QTabWidget*>("lists"), tr("Measurements and steps")));
  connect(floating_, &FloatingViews::changed, this, &PanelLayout::fold);
}

/// Columns of views that are elsewhere close up, and open again.
void PanelLayout::fold() {
  show_alone(rows_, alone_);
  if (!alone_) hanging_->keep_tree(hanging_->tree_kept());
}

QWidget& PanelLayout::whole() {
  return *rows_;
}

void PanelLayout::add_beside_tree(QWidget* control) {
  tree_->add_control(control);
}

QSplitter* PanelLayout::splitter(Qt::Orientation orientation, const QString& name) {
  auto* made = new QSplitter(orientation);
  made->setObjectName(name);
  splitters_.push_back(made);
  return made;
}

Panel* PanelLayout::panel(const QString& title, const QString& name, QWidget* content) {
  auto* made = new Panel(title, content);
  made->setObjectName(name + "_panel");
  connect(made, &Panel::maximise_wanted, this, [this, made] { maximise(made); });
  return made;
}

Panel* PanelLayout::picture_panel(const QString& title, const QString& name,
                                  std::unique_ptr<view::PictureView> shown) {
  auto* picture = new PictureWidget(std::move(shown), name, guard_);
  picture->setAccessibleName(title);
  pictures_.push_back(picture);
  picture->show_identity(desk_.identity);
  connect(picture, &PictureWidget::hovered, this, &PanelLayout::hovered);
  own_.push_back(
      picture->pointer().end_chosen.observe([this](const geometry::Vec3& end) { emit end_chosen(end); }));
  return panel(title, name, picture);
}

QWidget* PanelLayout::curved_column() {
  curved_ = splitter(Qt::Horizontal, "curved");
  const auto frame = std::make_shared<view::CurvedFrame>();
  curved_->addWidget(picture_panel(
      tr("CPR"), "cpr1", std::make_unique<CurvedView>(desk_.bench, CurvedView::Which::first, frame)));
  curved_->addWidget(
      picture_panel(tr("CPR + 90\u00b0"), "cpr2",
                    std::make_unique<CurvedView>(desk_.bench, CurvedView::Which::second, frame)));
  pictures_[pictures_.size() - 2]->set_twin(pictures_.back());
  pictures_.back()->set_twin(pictures_[pictures_.size() - 2]);
  PaintQueue::instance().set_prepare(&PictureWidget::prepare);
  curved_->setSizes({280, 280});
  for (int i = 0; i < 2; ++i) curved_->setStretchFactor(i, 1);
  return curved_;
}

QWidget* PanelLayout::neighbours() {
  auto* strip = new QWidget;
  auto* row = new QHBoxLayout(strip);
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(1);
  for (const int step : {-2, -1, 1, 2}) {
    auto* picture = new PictureWidget(std::make_unique<SectionView>(desk_.bench, step * strip_step_mm, 12.0),
                                      QStringLiteral("strip%1").arg(step), guard_);
    picture->setAccessibleName(tr("Cross-section, %1 mm on").arg(step * strip_step_mm));
    picture->setMinimumSize(strip_px, strip_px);
    pictures_.push_back(picture);
    row->addWidget(picture);
  }
  return strip;
}

Panel* PanelLayout::slice_panel() {
  auto* slice = new SliceView(desk_.bench, SliceKind::axial);
  Panel* slices = picture_panel(tr("Slice"), "slice", std::unique_ptr<view::PictureView>(slice));
  auto* kind = new QComboBox;
  kind->setObjectName("slice_kind");
  for (const auto& [name, value] : {std::pair(tr("Axial"), SliceKind::axial),
                                    {tr("Coronal"), SliceKind::coronal},
                                    {tr("Sagittal"), SliceKind::sagittal},
                                    {tr("Oblique"), SliceKind::oblique}})
    kind->addItem(name, static_cast<int>(value));
  kind->setToolTip(tr("Oblique: Shift and drag turns it"));
  kind->setAccessibleName(tr("Orientation of the slice"));
  connect(kind, QOverload<int>::of(&QComboBox::activated), this, [slice, kind](int index) {
    slice->set_kind(static_cast<SliceKind>(kind->itemData(index).toInt()));
  });
  slices->add_control(kind);
  return slices;
}

QWidget* PanelLayout::section_column() {
  QSplitter* column = splitter(Qt::Vertical, "sections");
  column->addWidget(
      picture_panel(tr("Cross-section"), "section", std::make_unique<SectionView>(desk_.bench, 0.0)));
  column->addWidget(panel(tr("Neighbours, every %1 mm").arg(strip_step_mm), "neighbours", neighbours()));
  column->addWidget(slice_panel());
  column->setSizes({360, 130, 360});
  return column;
}

Panel* PanelLayout::tree_panel() {
  scene_ = new SceneWidget(desk_.bench, guard_);
  scene_->set_dark(current_theme() == Theme::dark);
  scene_->show_identity(desk_.identity);
  return panel(tr("Coronary tree"), "tree", scene_);
}

QWidget* PanelLayout::side_column() {
  QSplitter* column = splitter(Qt::Vertical, "side");
  const auto color_of = [this](std::int32_t vessel) { return scene_->color_of(vessel); };
  auto* list = vessels_ = new VesselList(desk_.bench, color_of, guard_);
  connect(scene_, &SceneWidget::styles_changed, list, &VesselList::refresh);
  column->addWidget(panel(tr("Vessels"), "vessels", list));
  auto* tabs = new QTabWidget;
  tabs->setObjectName("lists");
  tabs->setDocumentMode(true);
  tabs->addTab((new MeasurementList(desk_.bench, guard_))->with_filter(), tr("Measurements"));
  tabs->addTab((new StepList(desk_.bench, guard_))->with_filter(), tr("Steps"));
  doubts_ = new DoubtList(desk_.bench);
  tabs->setTabVisible(tabs->addTab(doubts_, tr("Doubts")), false);
  connect(doubts_, &DoubtList::known, tabs, [tabs, list = doubts_](bool probabilities) {
    tabs->setTabVisible(tabs->indexOf(list), probabilities);
  });
  column->addWidget(tabs);
  column->setSizes({420, 320});
  // Names and numbers of vessels.
  list->setMinimumWidth(38 * desk_.window.fontMetrics().averageCharWidth());
  return column;
}

/// The profile, and the table of what is found along it.
QWidget* PanelLayout::bottom_row() {
  QSplitter* row = splitter(Qt::Horizontal, "bottom");
  profile_ = new ProfileWidget(desk_.bench, guard_);
  lesions_ = new LesionList(desk_.bench, guard_);
  row->addWidget(panel(tr("Lumen profile"), "profile", profile_));
  Panel* table = panel(tr("Lesions"), "lesions", lesions_);
  table->add_control(lesions_->controls());
  row->addWidget(table);
  row->setSizes({860, 740});
  for (int i = 0; i < 2; ++i) row->setStretchFactor(i, 1);
  return row;
}

void PanelLayout::maximise(Panel* panel) {
  if (QWidget* own = panel->window(); floating_->floats(panel->objectName()))
    return own->isMaximized() ? own->showNormal() : own->showMaximized();
  alone_ = alone_ == panel ? nullptr : panel;
  if (alone_) hanging_->rest(true);
  show_alone(rows_, alone_);
  if (!alone_) hanging_->keep_tree(hanging_->tree_kept());  // all was shown again
  if (!alone_) hanging_->rest(false);
}

std::map<std::string, std::string> PanelLayout::layout_settings() {
  if (alone_) maximise(alone_);
  std::map<std::string, std::string> settings{{"views.floating", floating_->places()}};
  for (const QSplitter* one : splitters_) {
    const std::string name = one->objectName().toStdString();
    settings["splitter." + name] = one->saveState().toBase64().toStdString();
    settings["panels." + name] = parts_.at(one);
  }
  settings["splitter.columns"] = hanging_->sizes().toBase64().toStdString();
  return settings;
}

void PanelLayout::restore_layout(const std::map<std::string, std::string>& settings) {
  floating_->bring_all_back();
  for (QSplitter* one : splitters_) {
    const std::string name = one->objectName().toStdString();
    // Sizes are kept in the order of the panels: those of others fit none of these.
    const auto panels = settings.find("panels." + name);
    if (panels != settings.end() && panels->second != parts_.at(one)) continue;
    const auto kept = settings.find("splitter." + name);
    one->restoreState(kept != settings.end() ? QByteArray::fromBase64(QByteArray::fromStdString(kept->second))
                                             : QByteArray());
  }
}

void PanelLayout::show_tree(bool shown) {
  if (alone_) maximise(alone_);
  hanging_->keep_tree(shown);
}

bool PanelLayout::tree_shown() const {
  return hanging_->tree_kept();
}

}  // namespace ostia::workstation
