#pragma once
/// \file How a command looks in the palette: its text, below it its menus or why it cannot be used, its keys.

#include <QStyledItemDelegate>
#include <vector>

namespace ostia::workstation {

/// What a row of the model has.
enum PaletteRole {
  palette_text = Qt::DisplayRole,
  palette_below = Qt::UserRole,  ///< the second line
  palette_keys,                  ///< QStringList
  palette_marks,                 ///< QVariantList of the places of typed characters in the text
  palette_checked,               ///< of a command that is switched on
  palette_usable,                ///< now
};

class PaletteRows final : public QStyledItemDelegate {
 public:
  using QStyledItemDelegate::QStyledItemDelegate;
  void paint(QPainter* painter, const QStyleOptionViewItem& option, const QModelIndex& index) const override;
  QSize sizeHint(const QStyleOptionViewItem& option, const QModelIndex& index) const override;
};

}  // namespace ostia::workstation
