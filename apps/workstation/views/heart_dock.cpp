#include "views/heart_dock.h"

#include "commands/table.h"
#include "shell/bind.h"
#include "views/heart_volume.h"
#include "views/transfer_plot.h"

#include <QComboBox>
#include <QFormLayout>
#include <QGridLayout>
#include <QLabel>
#include <QPushButton>
#include <QScrollArea>
#include <QSlider>
#include <QToolButton>
#include <QVBoxLayout>
#include <cmath>
#include <utility>

namespace ostia::workstation {
namespace {

constexpr int stretch_steps = 100, crop_steps = 200;

QSlider* slider(const QString& name, const QString& title, int low, int high) {
  auto* made = new QSlider(Qt::Horizontal);
  made->setObjectName(name);
  made->setAccessibleName(title);
  made->setRange(low, high);
  made->setPageStep(std::max(1, (high - low) / 20));
  return made;
}

void show_value(QSlider* slider, int value) {
  const QSignalBlocker quiet(slider);
  slider->setValue(value);
}

}  // namespace

HeartDock::HeartDock(HeartVolume& heart, QWidget* parent)
    : QDockWidget(tr("Heart in 3D"), parent), heart_(heart) {
  setObjectName("heart");
  auto* whole = new QWidget;
  auto* rows = new QVBoxLayout(whole);
  buttons_ = new QWidget;
  auto* buttons = new QVBoxLayout(buttons_);
  buttons->setContentsMargins(0, 0, 0, 0);
  rows->addWidget(look_part());
  rows->addWidget(buttons_);
  rows->addWidget(box_part());
  rows->addStretch(1);
  auto* scrolled = new QScrollArea;
  scrolled->setFocusPolicy(Qt::NoFocus);  // what is in it takes the keyboard
  scrolled->setWidgetResizable(true);
  scrolled->setFrameShape(QFrame::NoFrame);
  scrolled->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  scrolled->setWidget(whole);
  scrolled->setMinimumWidth(whole->minimumSizeHint().width() + 20);
  setWidget(scrolled);
}

QWidget* HeartDock::look_part() {
  auto* part = new QWidget;
  auto* form = new QFormLayout(part);
  form->setContentsMargins(0, 0, 0, 0);
  auto* preset = new QComboBox;
  preset->setObjectName("heart_look");
  preset->setAccessibleName(tr("Look"));
  using view::VolumePreset;
  for (const auto& [text, value] : {std::pair(tr("Coronary arteries"), VolumePreset::coronary),
                                    {tr("Contrast alone"), VolumePreset::vessels},
                                    {tr("Soft tissue"), VolumePreset::soft_tissue},
                                    {tr("Bone"), VolumePreset::bone}})
    preset->addItem(text, static_cast<int>(value));
  bind(preset, heart_.preset);
  connect(preset, QOverload<int>::of(&QComboBox::activated), &heart_, &HeartVolume::show);
  form->addRow(tr("Look"), preset);
  form->addRow(new TransferPlot(heart_));
  const session::Range<double>& shifts = *heart_.shift_hu.range();
  auto* shift =
      slider("heart_shift", tr("Shift"), static_cast<int>(shifts.low), static_cast<int>(shifts.high));
  shift->setToolTip(tr("To the right: only what is denser is seen"));
  connect(shift, &QSlider::valueChanged, &heart_, [this](int hu) { heart_.shift_hu.set(hu); });
  const auto show_shift = [shift](double hu) { show_value(shift, static_cast<int>(std::lround(hu))); };
  show_shift(heart_.shift_hu.get());
  keep_with(shift, heart_.shift_hu.observe(show_shift));
  form->addRow(tr("Shift"), shift);
  auto* soft = slider("heart_stretch", tr("Softness"), -stretch_steps, stretch_steps);
  soft->setToolTip(tr("To the left: hard edges. To the right: soft ones"));
  const double most = std::log(heart_.stretch.range()->high);
  connect(soft, &QSlider::valueChanged, &heart_,
          [this, most](int step) { heart_.stretch.set(std::exp(most * step / stretch_steps)); });
  const auto show_soft = [soft, most](double stretch) {
    show_value(soft, static_cast<int>(std::lround(stretch_steps * std::log(stretch) / most)));
  };
  show_soft(heart_.stretch.get());
  keep_with(soft, heart_.stretch.observe(show_soft));
  form->addRow(tr("Softness"), soft);
  return part;
}

QWidget* HeartDock::box_part() {
  auto* part = new QWidget;
  auto* grid = new QGridLayout(part);
  grid->setContentsMargins(0, 0, 0, 0);
  grid->addWidget(new QLabel(tr("Box")), 0, 0, 1, 3);
  const std::array titles{tr("Right to left"), tr("Front to back"), tr("Feet to head")};
  for (std::size_t a = 0; a < 3; ++a) {
    const int row = static_cast<int>(a) + 1;
    from_[a] = slider(QStringLiteral("heart_from_%1").arg(row), tr("%1: from").arg(titles[a]), 0, crop_steps);
    to_[a] = slider(QStringLiteral("heart_to_%1").arg(row), tr("%1: to").arg(titles[a]), 0, crop_steps);
    grid->addWidget(new QLabel(titles[a]), row, 0);
    grid->addWidget(from_[a], row, 1);
    grid->addWidget(to_[a], row, 2);
    for (QSlider* one : {from_[a], to_[a]})
      connect(one, &QSlider::valueChanged, this, &HeartDock::crop_changed);
  }
  auto* all = new QPushButton(tr("No box"));
  all->setObjectName("heart_no_box");
  connect(all, &QPushButton::clicked, &heart_, [this] { heart_.crop.set({}); });
  grid->addWidget(all, 4, 1, 1, 2);
  show_crop();
  keep_with(this, heart_.crop.observe([this](const view::VolumeCrop&) { show_crop(); }));
  return part;
}

/// What is pulled pushes the other side before it: one step is left at least.
void HeartDock::crop_changed() {
  view::VolumeCrop crop;
  for (std::size_t a = 0; a < 3; ++a) {
    int from = from_[a]->value(), to = to_[a]->value();
    if (from >= to) {
      const bool from_moved = sender() == from_[a];
      from = std::min(from_moved ? from : to - 1, crop_steps - 1);
      from = std::max(from, 0);
      to = std::max(from_moved ? from + 1 : to, from + 1);
    }
    crop.low[a] = static_cast<double>(from) / crop_steps;
    crop.high[a] = static_cast<double>(to) / crop_steps;
  }
  heart_.crop.set(crop);
}

void HeartDock::show_crop() {
  const view::VolumeCrop& crop = heart_.crop.get();
  for (std::size_t a = 0; a < 3; ++a) {
    show_value(from_[a], static_cast<int>(std::lround(crop_steps * crop.low[a])));
    show_value(to_[a], static_cast<int>(std::lround(crop_steps * crop.high[a])));
  }
}

void HeartDock::add_buttons(const CommandTable& commands) {
  const auto add_switch = [&](const char* id, session::Property<bool>& property) {
    auto* box = new QCheckBox(commands.action(id).text());
    box->setObjectName(QString("switch.") + id);
    box->setToolTip(commands.action(id).toolTip());
    bind_checked(box, property);
    buttons_->layout()->addWidget(box);
  };
  add_switch("heart.alone", heart_.alone);
  add_switch("heart.tree", heart_.tree_over_it);
  add_switch("heart.box", heart_.box_shown);
  for (const char* id : {"heart.cut_inside", "heart.cut_outside", "heart.undo_cut", "heart.all_back"})
    buttons_->layout()->addWidget(command_button(commands, id));
}

}  // namespace ostia::workstation
