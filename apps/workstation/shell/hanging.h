#pragma once
/// \file Which panes stand where, by the room that the window has.

#include <QByteArray>
#include <QObject>

class QSize;
class QSplitter;
class QTabWidget;
class QWidget;

namespace ostia::workstation {

class Panel;

/// No larger than the window that a dialog belongs to, and than its screen.
void resize_within(QWidget& dialog, const QSize& wanted);

/// Four columns side by side where there is room for them: lists, CPRs, sections, tree. In a narrower window
/// the tree is a tab beside the lists; where that is too much still (another panel is docked), the lists go
/// until there is room again. Follows the columns' width; rests while one panel is shown alone.
class Hanging final : public QObject {
  Q_OBJECT
 public:
  /// `columns` holds in this order `side`, CPRs, sections and `tree`; `tabs` is within `side`.
  Hanging(QSplitter* columns, QTabWidget* tabs, Panel* tree);
  bool narrow() const { return narrow_; }
  /// Whether the tree has a place at all, as a column or a tab.
  void keep_tree(bool kept);
  bool tree_kept() const { return tree_kept_; }
  /// True: somebody takes the tree out, and the columns close up; false: it comes back.
  void lend_tree(bool away);
  void rest(bool resting);   ///< one panel is shown alone, or no longer
  QByteArray sizes() const;  ///< of the four columns, as QSplitter::saveState has them

 signals:
  void narrow_changed(bool narrow);

 protected:
  bool eventFilter(QObject* object, QEvent* event) override;

 private:
  void fit();
  void set_narrow(bool narrow);
  void share_room();
  int needed(int first, int last) const;
  QSplitter* columns_;
  QTabWidget* tabs_;
  Panel* tree_;
  QByteArray wide_sizes_;
  bool narrow_ = false, resting_ = false, tree_kept_ = true, tree_away_ = false;
};

}  // namespace ostia::workstation
