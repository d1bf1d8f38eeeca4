#pragma once
/// \file Widgets by a name that is the same the next time.

#include <QString>

class QWidget;

namespace ostia::workstation {

/// The widget's own name, or "parent/Class:2": the third of its class below the nearest widget with a name.
QString walk_name(const QWidget& widget);
/// The visible widget of that name; null where there is none. Those of the dialog in front come first.
QWidget* walk_widget(const QString& name);

}  // namespace ostia::workstation
