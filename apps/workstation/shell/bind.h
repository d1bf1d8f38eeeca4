#pragma once
/// \file Widgets bound to properties in one line each.

#include "ostia/session/property.h"

#include <QAction>
#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QPointer>
#include <QSignalBlocker>
#include <memory>

namespace ostia::workstation {

/// Holds a subscription as long as the widget lives.
inline void keep_with(QObject* widget, session::Subscription subscription) {
  auto held = std::make_shared<session::Subscription>(std::move(subscription));
  QObject::connect(widget, &QObject::destroyed, [held] { held->drop(); });
}

inline void bind(QDoubleSpinBox* box, session::Property<double>& property) {
  if (const session::Range<double>* range = property.range()) {
    box->setRange(range->low, range->high);
    if (range->step > 0.0) box->setSingleStep(range->step);
  }
  const auto show = [box](const double& value) {
    const QSignalBlocker quiet(box);
    // Setting what is there already would write "12.0" over a "12" that is being typed.
    if (box->value() != value) box->setValue(value);
  };
  show(property.get());
  keep_with(box, property.observe(show));
  QObject::connect(box, QOverload<double>::of(&QDoubleSpinBox::valueChanged), box,
                   [&property](double value) { property.set(value); });
}

template <class Button>  // QCheckBox, QAction, QToolButton: anything checkable
void bind_checked(Button* button, session::Property<bool>& property) {
  button->setCheckable(true);
  const auto show = [button](const bool& value) {
    const QSignalBlocker quiet(button);
    button->setChecked(value);
  };
  show(property.get());
  keep_with(button, property.observe(show));
  QObject::connect(button, &Button::toggled, button, [&property](bool value) { property.set(value); });
}

/// An action that is checked while the property has this value.
template <class T>
void bind_value(QAction* action, session::Property<T>& property, T value) {
  const auto show = [action, value](const T& now) { action->setChecked(now == value); };
  show(property.get());
  keep_with(action, property.observe(show));
}

/// An action that switches the property between two values.
template <class T>
void bind_switch(QAction* action, session::Property<T>& property, T off, T on) {
  bind_value(action, property, on);
  QObject::connect(action, &QAction::triggered, action,
                   [&property, off, on](bool checked) { property.set(checked ? on : off); });
}

/// A combo box whose items' data are the values as int.
template <class Enum>
void bind(QComboBox* box, session::Property<Enum>& property) {
  const auto show = [box](const Enum& value) {
    const QSignalBlocker quiet(box);
    box->setCurrentIndex(box->findData(static_cast<int>(value)));
  };
  show(property.get());
  keep_with(box, property.observe(show));
  QObject::connect(box, QOverload<int>::of(&QComboBox::activated), box, [box, &property](int index) {
    property.set(static_cast<Enum>(box->itemData(index).toInt()));
  });
}

}  // namespace ostia::workstation
