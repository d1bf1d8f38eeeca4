#pragma once
/// \file The series of the study that is open: which are beside the image on the table, which is shown.

#include "ostia/imaging/dicom.h"
#include "ostia/session/phase_choice.h"
#include "ostia/session/series_stack.h"
#include "ostia/session/signal.h"
#include "ostia/session/workbench.h"

#include <QElapsedTimer>
#include <QObject>
#include <QTimer>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

class QMainWindow;

namespace ostia::workstation {

class BeatingCase;
struct Desk;
class SeriesStrip;
struct StripRow;

/// Shows phases and reconstructions of a study one after the other in all views, along the same axes or, with
/// a motion, along those that it carries. Everything is read in the background and held within a bound
/// (session::StackImages); series of other patients and studies are never among them.
class StudySeries final : public QObject {
  Q_OBJECT
 public:
  /// Its dock is put into `window`, hidden until there is more than one image.
  StudySeries(Desk& desk, QMainWindow& window, BeatingCase& beating);
  ~StudySeries() override;
  /// The image on the table is the series `uid` of this folder, which lies in `path`.
  void take(const std::shared_ptr<const imaging::DicomFolder>& folder, const std::string& uid,
            const std::filesystem::path& path = {});
  void take_alone();  ///< the image on the table is a file: one of the phases, or another
  void clear();       ///< nothing is known beside the image on the table
  void put_away();    ///< hides the dock until there is something to show
  void ask_beside();  ///< for more images: phases in files, or series of the same study
  void open_folder(const std::filesystem::path& folder);
  bool any() const { return stack_.readable() > 1; }
  bool has_cine() const { return cine_.size() > 1; }
  bool playing() const { return playing_; }
  int shown() const { return shown_; }  ///< number in the stack; -1: the image on the table, not among them
  const session::SeriesStack& stack() const { return stack_; }
  const std::optional<session::PhaseChoice>& choice() const { return choice_; }
  SeriesStrip& strip() { return *strip_; }
  void show_or_hide();                 ///< the strip; remembered
  void go_to(int n);                   ///< shows it when it is read
  void go_to_own();                    ///< the image on the table
  void toggle_cine();                  ///< plays the phases, or pauses
  void find_best();                    ///< measures which phase is the sharpest
  void set_budget(std::size_t bytes);  ///< of the images in memory

 signals:
  /// To be put on the table; `folder` is all that is known beside it, `path` where it was found itself.
  void series_wanted(const imaging::DicomSeries& series,
                     const std::shared_ptr<const imaging::DicomFolder>& folder,
                     const std::filesystem::path& path);
  void file_wanted(const QString& path);
  void changed();

 private:
  void start(session::SeriesStack stack);
  void on_jobs();
  void chosen(int n);
  void open(int n);
  void read(int n);
  void put(int n, const session::StackImages::Image& image);
  session::StackImages::Image image_of(int n) const;  // that is there: whole or coarser
  std::filesystem::path folder_of(const imaging::DicomSeries& series) const;
  session::OtherImage described(int n, const session::StackImages::Image& image) const;
  void fail(int n, const QString& why);
  // cine (study_cine.cpp)
  void next_frame();
  void load_frames();
  void stop();
  void give_images();
  void follow_motion();
  // best phase (best_phase.cpp)
  void best_pressed();
  void take_choice(const session::PhaseChoice& choice);
  void tell_best();
  QString how_measured() const;
  // rows (best_phase.cpp)
  StripRow row_of(int n) const;
  void refresh_rows();
  void next_picture(int from);
  QString name_of(int n) const;
  int own() const { return stack_.own ? static_cast<int>(*stack_.own) : -1; }
  const session::StackEntry& entry(int n) const { return stack_.entries[static_cast<std::size_t>(n)]; }

  Desk& desk_;
  QMainWindow& window_;
  BeatingCase& beating_;
  SeriesStrip* strip_;
  std::shared_ptr<const imaging::DicomFolder> folder_;
  std::string uid_;  // of the series on the table
  /// Where each series was found, by its first file: a study may lie in several folders.
  std::map<std::filesystem::path, std::filesystem::path> found_in_;
  session::SeriesStack stack_;
  std::vector<int> cine_;
  session::StackImages images_;
  std::size_t budget_ = session::StackImages::usual_budget();
  std::vector<QString> faults_;  // of those that could not be read
  std::optional<session::PhaseChoice> choice_;
  int shown_ = -1, wanted_ = -1;
  bool playing_ = false, loading_ = false, best_pending_ = false, bound_told_ = false;
  QTimer frame_;
  QElapsedTimer since_frame_;
  std::vector<session::Subscription> own_;
};

}  // namespace ostia::workstation
