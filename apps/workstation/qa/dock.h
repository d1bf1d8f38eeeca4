#pragma once
/// \file QA mode: the case against the contours of somebody who knows, and sessions written down and done
/// again.

#include "shell/jobs.h"
#include "views/picture_widget.h"
#include "views/scene_widget.h"

#include "ostia/session/quality_check.h"
#include "ostia/view/hand_recording.h"
#include "ostia/view/truth_layer.h"

#include <QDockWidget>
#include <QElapsedTimer>
#include <QTimer>
#include <filesystem>
#include <memory>
#include <vector>

class QCheckBox;
class QComboBox;
class QLabel;
class QProgressBar;
class QPushButton;
class QTreeWidget;

namespace ostia::workstation {

/// The mode is on while the dock is open: then truth and figures are shown, and time is counted.
class QaDock final : public QDockWidget {
  Q_OBJECT
 public:
  /// `loud` says in a dialog what is refused.
  QaDock(session::Workbench& bench, std::vector<PictureWidget*> pictures, SceneWidget& scene, Jobs& jobs,
         Guard loud, QWidget* parent);
  ~QaDock() override;
  session::QualityCheck& check() { return check_; }
  void open_truth(const std::filesystem::path& path);
  void start_recording(const std::filesystem::path& path);
  void stop_recording();
  bool recording() const { return recorder_ != nullptr; }
  /// As fast as it was done, or as fast as it can be.
  void start_replay(const std::filesystem::path& path, bool full_speed);
  void cancel_replay();
  bool replaying() const { return replay_ != nullptr; }

 signals:
  void said(const QString& text);
  void refused(const QString& why);  ///< to be read and answered
  void replayed(bool same);          ///< all of a recording was done; whether the model is what it was then

 protected:
  bool eventFilter(QObject* object, QEvent* event) override;

 private:
  QWidget* truth_rows();
  QWidget* session_rows();
  void set_mode(bool on);
  void choose_truth();
  void show_truth();
  std::string patient() const;
  void follow_patient();
  void choose_recording();
  void choose_replay();
  void show_observers();
  void show_figures();
  void show_time();
  void show_session();
  void color_tree(const geometry::TriMesh& wall);
  void replay_some();
  void end_replay();
  session::Workbench& bench_;
  std::vector<PictureWidget*> pictures_;
  SceneWidget& scene_;
  Jobs& jobs_;
  Guard loud_;
  session::QualityCheck check_;
  std::string truth_of_;  // the patient whom the truth was opened for; empty where none was there
  std::vector<std::unique_ptr<view::TruthLayer>> layers_;
  std::unique_ptr<view::HandRecorder> recorder_;
  std::unique_ptr<view::HandReplay> replay_;
  bool full_speed_ = false, mode_ = false;
  QElapsedTimer replay_clock_;
  QTimer figures_soon_, time_, replay_tick_;
  QPushButton *open_ = nullptr, *next_ = nullptr, *run_ = nullptr, *record_ = nullptr, *again_ = nullptr,
              *cancel_ = nullptr;
  QComboBox *observer_ = nullptr, *speed_ = nullptr;
  QCheckBox *shown_ = nullptr, *colored_ = nullptr;
  QTreeWidget* list_ = nullptr;
  QLabel *vessel_ = nullptr, *whole_ = nullptr, *clock_ = nullptr;
  QProgressBar* progress_ = nullptr;
  std::vector<session::Subscription> own_;
};

}  // namespace ostia::workstation
