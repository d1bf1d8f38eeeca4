#include "qa/walk_widgets.h"

#include <QApplication>
#include <QWidget>

namespace ostia::workstation {
namespace {

/// Qt's own parts have names that begin so; they are not unique.
bool is_named(const QWidget& widget) {
  return !widget.objectName().isEmpty() && !widget.objectName().startsWith("qt_");
}

QList<QWidget*> of_class(const QWidget& root, const QString& name) {
  QList<QWidget*> found;
  for (QWidget* one : root.findChildren<QWidget*>())
    if (one->metaObject()->className() == name && !is_named(*one)) found << one;
  return found;
}

QWidget* below(QWidget& root, const QString& name) {
  const QStringList parts = name.split('/');
  QList<QWidget*> named = root.findChildren<QWidget*>(parts[0]);
  if (root.objectName() == parts[0]) named.prepend(&root);
  for (QWidget* at : named) {
    if (!at->isVisible()) continue;
    if (parts.size() == 1) return at;
    const QString cls = parts[1].section(':', 0, 0);
    QWidget* const found = of_class(*at, cls).value(parts[1].section(':', 1).toInt());
    if (found && found->isVisible()) return found;
  }
  return nullptr;
}

}  // namespace

QString walk_name(const QWidget& widget) {
  const QWidget* root = &widget;
  while (!is_named(*root) && root->parentWidget()) root = root->parentWidget();
  if (root == &widget) return is_named(widget) ? widget.objectName() : QString();
  const QString cls = widget.metaObject()->className();
  return QStringLiteral("%1/%2:%3")
      .arg(root->objectName(), cls)
      .arg(of_class(*root, cls).indexOf(const_cast<QWidget*>(&widget)));
}

QWidget* walk_widget(const QString& name) {
  QList<QWidget*> roots = QApplication::topLevelWidgets();
  for (QWidget* front : {QApplication::activeModalWidget(), QApplication::activePopupWidget()})
    if (front) roots.prepend(front);
  for (QWidget* root : roots)
    if (root->isVisible())
      if (QWidget* found = below(*root, name)) return found;
  return nullptr;
}

}  // namespace ostia::workstation
