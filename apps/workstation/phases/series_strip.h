#pragma once
/// \file A strip with a picture of each series and phase of the study that is open.

#include <QDockWidget>
#include <QImage>
#include <QListWidget>
#include <QString>
#include <vector>

class QDoubleSpinBox;
class QPushButton;
class QSlider;
class QToolButton;

namespace ostia::workstation {

/// One picture of the strip.
struct StripRow {
  QString title{};  ///< "45 %"
  QString note{};   ///< below it: "on the table, sharpest"
  QString tip{};
  bool whole = true;  ///< it can be read: others are there to be seen, and cannot be chosen
};

/// Pictures from left to right, above them a slider over the phases, a cine, and the sharpest phase. Arrow
/// keys and clicks choose; a double click, or Return, opens what is chosen in the place of what is on the
/// table. Knows nothing of images.
class SeriesStrip final : public QDockWidget {
  Q_OBJECT
 public:
  static constexpr int picture_px = 72;
  explicit SeriesStrip(QWidget* parent = nullptr);
  void set_rows(const std::vector<StripRow>& rows);
  void set_row(int row, const StripRow& shown);
  void set_picture(int row, const QImage& picture);
  void set_cine(const std::vector<int>& rows);  ///< what the slider goes over; below two it is off
  void set_current(int row);                    ///< what is shown; -1: none of them
  void set_playing(bool playing);
  /// What the button of the sharpest phase says; `can`: it can be pressed.
  void set_best(const QString& text, const QString& tip, bool can);
  /// Whether another than the one on the table is shown: then there is a way back, and it can be opened.
  void set_away(bool away);
  void offer_way_back();  ///< something was refused because of what is shown
  double pictures_a_second() const;
  int wanted_height() const;

 signals:
  void chosen(int row);
  void pressed(int row);  ///< by the mouse, the chosen one, too
  void open_wanted(int row);
  void play_wanted();
  void best_wanted();
  void back_wanted();

 protected:
  bool eventFilter(QObject* object, QEvent* event) override;

 private:
  QWidget* controls();
  QListWidget* list_;
  QToolButton* play_;
  QSlider* slider_;
  QDoubleSpinBox* speed_;
  QPushButton *best_, *open_, *back_;
  std::vector<int> cine_;
};

}  // namespace ostia::workstation
