#pragma once
/// \file What the person opens: cases, images, series, the sample.

#include "opening/view_memory.h"

#include "ostia/core/background_task.h"
#include "ostia/imaging/dicom.h"
#include "ostia/imaging/image_axes.h"
#include "ostia/imaging/series_preview.h"
#include "ostia/session/machine_state.h"
#include "ostia/session/open_mark.h"
#include "ostia/session/workbench.h"

#include <QObject>
#include <QString>
#include <any>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace ostia::workstation {

struct Desk;

/// Where the next case of this machine is made: `name` is an image's pseudonym.
std::filesystem::path unused_case_path(const std::filesystem::path& state_folder, const std::string& name);

/// Reads in the background and puts on the workbench what was read. What cannot be opened comes up as one
/// dialog, and what was open stays open.
class Opening final : public QObject {
  Q_OBJECT
 public:
  explicit Opening(Desk& desk);
  void open(const std::filesystem::path& path);
  void open_sample();
  /// Asks for a file, or a folder of DICOM.
  void choose_file();
  void choose_folder();
  /// The series of the folder that was looked through last, to choose another one.
  void choose_another_series();
  bool has_series() const;
  /// Another file with the same case, which is then the open one.
  void save_as();
  /// A new case of an image, in the folder of this machine's cases. A mask of coronary arteries that is
  /// opened becomes one by itself, of the image that is on the table.
  void start_case(const session::ImageReference& image,
                  const std::function<session::CaseFile(const std::filesystem::path&)>& make);
  void close_case();
  /// The case that was open when a program ended without closing it.
  void recover();
  /// Another series of the study that the image on the table is of: one of `folder`, found in `path`.
  void open_beside(const imaging::DicomSeries& series,
                   const std::shared_ptr<const imaging::DicomFolder>& folder,
                   const std::filesystem::path& path);
  /// What is on the table is one slice of an image that is still being read.
  bool reading() const;
  /// How the image on the table lies by its file; of a whole one alone.
  const imaging::Geometry& as_read() const { return shown_.as_read; }
  /// Gives the image on the table other axes (imaging::given_axes; empty: those of its file), which this
  /// machine remembers. A case that is open is closed: it was made of the image as it was.
  bool give_axes(const std::string& axes);
  /// A case of the image on the table, with the axes that it was made with: those the machine knows from here
  /// on.
  void open_with_axes(const std::filesystem::path& case_file, const std::string& axes);

 signals:
  /// A file that the person chose: of a case or an image, or of what others open.
  void file_chosen(const QString& path);
  /// A series of this folder is on the table, whole; it lies in `path`.
  void series_shown(const std::shared_ptr<const imaging::DicomFolder>& folder, const std::string& uid,
                    const std::filesystem::path& path);
  /// An image is on the table of which nobody knows what lies beside it.
  void image_alone();
  /// An image is on the table of which its files do not say how the patient lies, nor has a person said it.
  void axes_unknown();
  void leaving_case();  ///< it is still open, and about to be closed or copied
  /// A whole image is on the table, and no case of it.
  void image_without_case();
  /// A case without vessels: words on a calcium score of this image, which is being opened.
  void calcium_case_chosen(const QString& image_sha256, const QString& case_file);

 private:
  struct Loaded {
    session::OpenImage image;
    std::string name;        ///< for the window alone
    std::string series_uid;  ///< empty where it is no series
    std::vector<std::string> warnings;
    imaging::ShownIdentity whose{};  ///< of a series
    imaging::Geometry as_read{};     ///< before a person gave it other axes
    bool axes_guessed = false;       ///< its files do not say how the patient lies
  };
  /// What is known of a series before it has been read.
  struct FirstSight {
    std::string series_uid;
    QString name;
    std::optional<session::GreyWindow> window;
  };
  /// An image file of this machine that is being read.
  using ImageBeside = std::shared_ptr<core::BackgroundTask<Loaded>>;
  struct OpenedCase {
    std::shared_ptr<session::Session> session;
    ImageBeside image;  // the case's; null where it is open already or no such file is known
    std::optional<session::ImageReference> calcium_of{};  // it has no vessels: no session then
  };
  void open_case(const std::filesystem::path& path, const QString& then_say = {});
  void show_case(session::Session session, const std::filesystem::path& path,
                 const ImageBeside& image_beside = {});
  void show_calcium_case(const session::ImageReference& image, const std::filesystem::path& path);
  void open_image_of(const session::ImageReference& image, const ImageBeside& beside);
  /// `reason`: why what was chosen is not it.
  void image_missing(const session::ImageReference& image, const QString& reason = {});
  void keep_view();
  // images (opening_images.cpp)
  void open_image(const session::KnownImage& image);
  void scan(const session::KnownImage& image, bool ask = false);
  /// `ask`: which of its series, though one is known or alone.
  void choose_series(const session::KnownImage& image, const imaging::DicomFolder& folder, bool ask);
  void load_series(const std::shared_ptr<const imaging::DicomFolder>& folder,
                   const std::filesystem::path& path, const imaging::DicomSeries& series,
                   const imaging::DicomReadOptions& options);
  void show_first_slice(const imaging::DicomSeries& series);
  void take_first_sight();
  static Loaded read_file(const std::filesystem::path& path, const core::TaskContext& task);
  static ImageBeside read_beside(const std::optional<session::KnownImage>& image);
  void load_file(const std::filesystem::path& path, const ImageBeside& beside = {});
  void show(const Loaded& loaded, const std::filesystem::path& path);
  std::string wanted_axes(const session::ImageReference& image) const;
  void turn(const Loaded& loaded, const std::string& axes, const std::filesystem::path& path);
  // masks (masks.cpp)
  struct MaskCase {
    std::filesystem::path path;
    int vessels = 0;
    std::string first_warning;
  };
  static MaskCase case_of_mask(const std::filesystem::path& mask, const session::OpenImage& image,
                               const std::filesystem::path& state_folder, const core::TaskContext& task);
  void take_mask(const MaskCase& made);
  Desk& desk_;
  ViewMemory memory_;
  session::OpenMark mark_;
  std::optional<FirstSight> first_sight_;
  std::filesystem::path scanned_;  // for series; empty where another kind of image was opened since
  std::string series_uid_;         // of the image on the table
  Loaded shown_;                   // it, but for its voxels
  std::filesystem::path shown_path_;
  std::shared_ptr<const imaging::DicomFolder> folder_;  // of the series that was read last

 private slots:
  void drop_unread();
  void go_on();
};

}  // namespace ostia::workstation
