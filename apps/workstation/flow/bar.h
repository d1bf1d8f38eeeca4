#pragma once
/// \file What is chosen about a result on a surface, below the 3D picture.

#include "flow/arrays.h"

#include <QWidget>
#include <optional>
#include <utility>

class QCheckBox;
class QComboBox;
class QLabel;
class QLineEdit;
class QToolButton;

namespace ostia::workstation {

/// A list of arrays, the range of colours, and buttons that save the picture and take the result away.
class FlowBar final : public QWidget {
  Q_OBJECT
 public:
  explicit FlowBar(QWidget* parent = nullptr);
  /// The list anew; shows `first`, its range automatic.
  void set_arrays(const std::vector<FlowArray>& arrays, std::size_t first);
  std::size_t array() const;
  bool automatic() const;
  bool along() const;  ///< the profile shows what is along the vessel
  /// Shown in the fields while it is automatic.
  void set_range(const std::pair<double, double>& range);
  /// As typed; nothing where that is no range: then it is said below the fields.
  std::optional<std::pair<double, double>> range() const;

 signals:
  void array_changed();
  void range_changed();
  void along_toggled(bool on);
  void save_wanted();
  void hide_wanted();

 private:
  void check();
  QComboBox* arrays_;
  QCheckBox* automatic_;
  QLineEdit *low_, *high_;
  QLabel* trouble_;
  QToolButton* along_;
};

}  // namespace ostia::workstation
