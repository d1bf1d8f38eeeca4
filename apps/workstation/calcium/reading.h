#pragma once
/// \file The calcium score of a scan without contrast agent: scored in the background, shown on slices,
/// corrected by a person, taken into the report.

#include "ostia/imaging/dicom.h"
#include "ostia/session/calcium_board.h"
#include "ostia/view/calcium_layer.h"

#include <QObject>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace ostia::workstation {

struct Desk;
class Opening;
class PictureWidget;

/// Scores what is shown when it is asked to, in a job "calcium". The result stays while other images are
/// shown, so that it can be taken into the report of the angiogram. Goes before the views that it draws on.
class Calcium final : public QObject {
  Q_OBJECT
 public:
  /// The series that is shown beside the image on the table; nothing where the image itself is.
  using ShownSeries = std::function<std::optional<imaging::DicomSeries>()>;
  Calcium(Desk& desk, Opening& opening, const std::vector<PictureWidget*>& pictures, ShownSeries series);
  session::CalciumBoard& board() { return board_; }
  /// Scores the image that is shown; one that was scored already only where `again`.
  void score(bool again = false);
  bool scoring() const;
  /// Its words are in this case, which was opened: it is scored once its image is on the table.
  void expect(const std::string& image_sha256, const std::filesystem::path& case_file);
  bool expects_shown() const;  ///< the image on the table
  /// mg of hydroxyapatite in 1 cm3 for each HU; nothing: no mass. Scores again.
  void set_calibration(std::optional<double> calibration);

  void say(analysis::CalciumPlace place);  ///< of the chosen lesion
  void choose(int number);                 ///< and all slices go to it
  /// Words on lesions are steps of their own: Undo and Redo are theirs while no other case is open, or while
  /// the keyboard is on their page.
  bool can_take_back() const;
  bool can_do_again() const;
  void take_back() { board_.undo(); }
  void do_again() { board_.redo(); }
  void set_page(QWidget* page) { page_ = page; }
  /// Why the score cannot be taken into the report of the case that is open; empty where it can.
  QString why_not_into_report() const;
  void into_report();
  void save();  ///< asks for a folder: tables and pictures

 private:
  void take(const session::CalciumReading& reading);
  void follow_place();
  bool has_the_steps() const;
  Desk& desk_;
  session::CalciumBoard board_;
  ShownSeries shown_series_;
  std::vector<std::unique_ptr<view::CalciumLayer>> layers_;
  std::optional<double> calibration_;
  std::string expected_image_;
  std::filesystem::path expected_case_;
  QWidget* page_ = nullptr;
  bool choosing_ = false;
  std::vector<session::Subscription> own_;
};

}  // namespace ostia::workstation
