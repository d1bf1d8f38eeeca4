#pragma once
/// \file What the person opens: cases, images, series, the sample.

#include "ostia/core/beside.h"
#include "ostia/imaging/dicom.h"
#include "ostia/session/workbench.h"

#include <QObject>
#include <any>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace ostia::workstation {

class MainWindow;

/// Reads in the background and puts on the workbench what was read. What cannot be opened comes up as one
/// dialog, and what was open stays open.
class Opening final : public QObject {
  Q_OBJECT
 public:
  explicit Opening(MainWindow& window);
  void open(const std::filesystem::path& path);
  void open_sample();
  /// Asks for a file, or a folder of DICOM.
  void choose_file();
  void choose_folder();
  /// Another file with the same case, which is then the open one.
  void save_as();
  const std::filesystem::path& case_path() const { return case_path_; }
  /// A new case of the open image, in the folder of this machine's cases.
  void start_case(const lumen::LumenModel& model);
  void close_case();
  /// The case that was open when the program ended without closing it.
  void recover();
  /// Keeps with the case where the person looks.
  void remember_view();

 private:
  struct Loaded {
    session::OpenImage image;
    std::vector<std::string> warnings;
  };
  /// An image file of this machine that is being read.
  using ImageBeside = std::shared_ptr<core::Beside<Loaded>>;
  struct OpenedCase {
    std::shared_ptr<session::Session> session;
    ImageBeside image;  // the case's; null where it is open already or no such file is known
  };
  void open_case(const std::filesystem::path& path);
  void show_case(session::Session session, const std::filesystem::path& path,
                 const ImageBeside& image_beside = {});
  void open_image_of(const session::ImageReference& image, const ImageBeside& beside);
  void image_missing(const session::ImageReference& image);
  // images (opening_images.cpp)
  void open_image(const std::filesystem::path& path);
  void scan(const std::filesystem::path& path);
  void choose_series(const std::filesystem::path& path, const imaging::DicomFolder& folder);
  void load_series(const std::filesystem::path& path, const imaging::DicomSeries& series,
                   const imaging::DicomReadOptions& options);
  void show_first_slice(const imaging::DicomSeries& series);
  static Loaded read_file(const std::filesystem::path& path, const core::TaskContext& task);
  static ImageBeside read_beside(const std::optional<std::filesystem::path>& path);
  void load_file(const std::filesystem::path& path, const ImageBeside& beside = {});
  void show(const Loaded& loaded, const std::filesystem::path& path);
  void restore_view();
  std::filesystem::path state_folder() const;
  MainWindow& window_;
  std::filesystem::path case_path_;
};

}  // namespace ostia::workstation
