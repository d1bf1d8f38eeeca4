#include "phases/profile.h"

#include "shell/desk.h"

#include <QAbstractItemView>
#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QVBoxLayout>

namespace ostia::workstation {
namespace {

constexpr int rest_ms = 300;

}  // namespace

PhaseProfile::PhaseProfile(Desk& desk, session::PhaseClock& clock, Source beating)
    : QDockWidget(tr("Lumen over the cycle"), &desk.window),
      desk_(desk),
      beating_(std::move(beating)),
      map_(new PhaseMap(desk.bench, clock)) {
  setObjectName("phase_profile");
  auto* value = new QComboBox;
  value->setObjectName("phase_value");
  value->setAccessibleName(tr("What the colours are"));
  value->view()->setAccessibleName(value->accessibleName());
  value->addItem(tr("Diameter"), static_cast<int>(PhaseMapValue::diameter));
  value->addItem(tr("Area"), static_cast<int>(PhaseMapValue::area));
  value->addItem(tr("Change of the diameter"), static_cast<int>(PhaseMapValue::change));
  connect(value, QOverload<int>::of(&QComboBox::activated), map_, [this, value](int index) {
    map_->set_value(static_cast<PhaseMapValue>(value->itemData(index).toInt()));
  });
  auto* inside = new QWidget;
  auto* column = new QVBoxLayout(inside);
  column->setContentsMargins(2, 2, 2, 2);
  auto* row = new QHBoxLayout;
  row->addWidget(value);
  row->addStretch(1);
  column->addLayout(row);
  column->addWidget(map_, 1);
  setWidget(inside);
  connect(this, &QDockWidget::visibilityChanged, this, [this](bool visible) {
    if (visible && !map_->profile()) rest_.start();
  });
  rest_.setSingleShot(true);
  rest_.setInterval(rest_ms);
  connect(&rest_, &QTimer::timeout, this, &PhaseProfile::measure);
  session::Workbench& bench = desk.bench;
  own_.push_back(bench.vessel.observe([this](const std::int32_t&) { refresh(); }));
  own_.push_back(bench.model_changed.observe([this](const session::ModelEvent&) { refresh(); }));
}

void PhaseProfile::refresh() {
  desk_.jobs.cancel("phase_profile");
  map_->set_profile(std::nullopt, 0.0);
  if (isVisible()) rest_.start();
}

void PhaseProfile::measure() {
  const session::Workbench& bench = desk_.bench;
  if (!isVisible() || !bench.has_case() || !bench.axis()) return;
  const auto beating = beating_();
  if (!beating) return;
  desk_.jobs.run(
      "phase_profile", tr("Lumen over the cycle"),
      [beating,
       work = session::ring_work(bench.session(), bench.vessel.get())](const core::TaskContext& task) {
        return std::any(session::beating_profile(session::lumen_rings(work, task), *beating));
      },
      [this, beating](const std::any& made) {
        if (beating_() != beating) return;  // another motion by now
        map_->set_profile(std::any_cast<const session::BeatingProfile&>(made),
                          beating->motion().template_phase);
      },
      [this](const QString& message) { desk_.messages.say(message); });
}

}  // namespace ostia::workstation
