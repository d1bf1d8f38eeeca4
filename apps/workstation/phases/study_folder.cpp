// More images of the heart that is on the table, from a folder that the person chooses.
#include "phases/study_series.h"
#include "shell/desk.h"
#include "shell/file_dialogs.h"

#include "ostia/core/log.h"

#include <QMainWindow>
#include <algorithm>

namespace ostia::workstation {
namespace {

/// What a folder that the person chose holds.
struct FolderBeside {
  imaging::DicomFolder series;
  std::vector<session::PhaseSource> files;
};

FolderBeside look_into(const std::filesystem::path& folder, const core::TaskContext& task) {
  FolderBeside found;
  found.series = imaging::scan_dicom(folder, task.sub(0.0, 0.5));
  if (found.series.series.empty()) found.files = session::find_phase_images(folder, task.sub(0.5, 1.0));
  return found;
}

}  // namespace

void StudySeries::take_alone() {
  std::vector<session::PhaseSource> files;
  for (const session::StackEntry& one : stack_.entries)
    if (!one.source.series) files.push_back(one.source);
  const auto known = desk_.machine.find_image(desk_.bench.image().reference.sha256);
  if (known && !files.empty()) {
    session::SeriesStack stack = session::stack_of_files(files, known->path);
    if (stack.own) return start(std::move(stack));
  }
  clear();
}

void StudySeries::ask_beside() {
  const QString chosen = ask_folder(&window_, tr("Folder with phases or series of this study"));
  if (!chosen.isEmpty()) open_folder(chosen.toStdString());
}

void StudySeries::open_folder(const std::filesystem::path& folder) {
  core::redact_in_logs(folder.string(), "the phases");  // it may name the patient
  desk_.jobs.run(
      "series_folder", tr("Looking for the phases"),
      [folder](const core::TaskContext& task) { return std::any(look_into(folder, task)); },
      [this, folder](const std::any& result) {
        const auto& found = std::any_cast<const FolderBeside&>(result);
        const session::OpenImage& image = desk_.bench.image();
        if (!image.volume) return;
        if (!found.files.empty()) {
          const auto known = desk_.machine.find_image(image.reference.sha256);
          folder_.reset();
          uid_.clear();
          start(session::stack_of_files(found.files, known ? known->path : std::filesystem::path()));
          return;
        }
        auto both = std::make_shared<imaging::DicomFolder>(folder_ ? *folder_ : imaging::DicomFolder());
        for (const imaging::DicomSeries& one : found.series.series) {
          const bool there = std::any_of(both->series.begin(), both->series.end(),
                                         [&](const auto& other) { return other.files == one.files; });
          if (there) continue;
          both->series.push_back(one);
          if (!one.files.empty()) found_in_[one.files.front()] = folder;
        }
        const std::size_t before = stack_.entries.size();
        if (folder_) take(both, uid_);
        if (!folder_ || stack_.entries.size() == before)
          desk_.messages.complain(
              tr("No series there is known to be of the patient and the study that the image on the table is "
                 "of. "
                 "Two patients are never shown together: open the series by itself."));
      },
      [this](const QString& message) {
        desk_.messages.complain(message, tr("The images of the phases cannot be opened"));
      });
}

}  // namespace ostia::workstation
