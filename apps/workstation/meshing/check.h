#pragma once
/// \file Will it mesh? The page of the mesh's dialog that lists what would fail.

#include "ostia/meshing/mesh_forecast.h"

#include <QWidget>
#include <optional>

class QLabel;
class QListWidget;
class QPushButton;

namespace ostia::workstation {

/// As a person reads it.
QString heading_of(meshing::TroubleKind kind);
/// Whether a change of the dialog's fields is the way out.
bool is_of_settings(meshing::OfferedRepair repair);

/// A list of places; what is chosen is told below it, with a button where the fields can be changed.
class MeshingCheck final : public QWidget {
  Q_OBJECT
 public:
  explicit MeshingCheck(QWidget* parent = nullptr);
  void show_running();
  void show_forecast(const meshing::MeshForecast& forecast);
  void show_failure(const QString& message);  ///< it did not come as far as looking
  void show_nothing();                        ///< as before the first check
  /// What is shown belongs to other settings by now.
  void set_stale();
  bool running() const { return running_; }
  void set_possible(bool possible);  ///< the fields are as they should be

 signals:
  void wanted();
  void given_up();
  void chosen(int place);  ///< by the mouse or the keys; again when it is activated
  void repair_wanted(const ostia::meshing::ForecastPlace& place);

 protected:
  bool eventFilter(QObject* object, QEvent* event) override;

 private:
  void show_place(int row);
  void refresh();
  meshing::MeshForecast forecast_;
  QString state_;
  bool running_ = false, possible_ = true, stale_ = false;
  bool answered_ = false, changed_ = false;  // a check has ended; the settings, since it began
  QPushButton *check_ = nullptr, *repair_ = nullptr;
  QLabel *summary_ = nullptr, *detail_ = nullptr;
  QListWidget* list_ = nullptr;
};

}  // namespace ostia::workstation
