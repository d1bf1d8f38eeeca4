#include "intake.h"

#include "uid.h"

#include "ostia/core/write_back.h"
#include "ostia/imaging/dicom_texts.h"

#include <algorithm>
#include <utility>

namespace ostia::pacs {
namespace {

constexpr std::uint32_t kSopInstance = 0x00080018, kStudy = 0x0020000D, kSeries = 0x0020000E,
                        kPatient = 0x00100020;

}  // namespace

Intake::Intake(std::filesystem::path folder, SeriesWanted wanted, std::string patient_id, std::size_t images,
               core::TaskContext task)
    : folder_(std::move(folder)),
      wanted_(std::move(wanted)),
      images_(images),
      task_(std::move(task)),
      patient_id_(std::move(patient_id)),
      patient_known_(!patient_id_.empty()) {}

void Intake::expect(std::set<std::string> images, std::set<std::string> classes) {
  const std::lock_guard lock(mutex_);
  expected_ = std::move(images);
  classes_ = std::move(classes);
}

std::filesystem::path Intake::next_part() {
  const std::lock_guard lock(mutex_);
  return folder_ / (".part" + std::to_string(++parts_));
}

std::string Intake::fault_of(const std::string& sop, const std::string& study, const std::string& series,
                             const std::string& patient) {
  if (!is_uid(sop)) return "sent an object without a SOP instance UID";
  if (study != wanted_.study_uid) return "sent an object of another study";
  if (series != wanted_.series_uid) return "sent an object of another series";
  const std::string id = patient.substr(std::min(patient.find_first_not_of(' '), patient.size()));
  if (!std::exchange(patient_known_, true)) patient_id_ = id;
  if (id != patient_id_) return "sent an object of another patient";
  return {};
}

Intake::Taken Intake::take(const std::filesystem::path& part) {
  imaging::DicomTexts texts{{kSopInstance, {}}, {kStudy, {}}, {kSeries, {}}, {kPatient, {}}};
  const bool dicom = imaging::read_dicom_texts(part, texts);
  const std::lock_guard lock(mutex_);
  const std::string& sop = texts[kSopInstance];
  const std::string wrong = dicom ? fault_of(sop, texts[kStudy], texts[kSeries], texts[kPatient])
                                  : "sent something that is no DICOM object";
  std::error_code ignored;
  if (!wrong.empty()) {
    if (fault_.empty()) fault_ = wrong;
    std::filesystem::remove(part, ignored);
    return Taken::refused;
  }
  if (files_.count(sop) > 0) {
    ++duplicates_;
    std::filesystem::remove(part, ignored);
    return Taken::duplicate;
  }
  const std::filesystem::path target = folder_ / (sop + ".dcm");
  std::error_code error;
  std::filesystem::rename(part, target, error);
  if (error) throw IoError("cannot keep a received object: " + error.message());
  files_.emplace(sop, target);
  core::begin_writing_back(target);  // beside what comes next, so that the sync at the end finds little left
  show_progress();
  return Taken::yes;
}

void Intake::show_progress() const {
  const std::size_t all = has_list() ? expected_.size() : images_;
  if (all == 0) return;
  task_.set_progress(static_cast<double>(std::min(files_.size(), all)) / static_cast<double>(all));
  task_.set_stage("receiving " + std::to_string(files_.size()) + " of " + std::to_string(all));
}

void Intake::note_disk_fault(const std::string& fault) {
  const std::lock_guard lock(mutex_);
  if (disk_fault_.empty()) disk_fault_ = fault;
}

std::string Intake::fault() const {
  const std::lock_guard lock(mutex_);
  return fault_;
}

std::string Intake::disk_fault() const {
  const std::lock_guard lock(mutex_);
  return disk_fault_;
}

void Intake::throw_if_faulty() const {
  const std::lock_guard lock(mutex_);
  if (!fault_.empty()) throw InvalidInput(fault_ + "; nothing of it is kept");
  if (!disk_fault_.empty()) throw ResourceError(disk_fault_);
}

bool Intake::complete() const {
  if (has_list()) return missing().empty();
  return images_ > 0 && received() == images_;
}

std::size_t Intake::announced() const {
  return has_list() ? expected_.size() : images_;
}

std::vector<std::string> Intake::missing() const {
  const std::lock_guard lock(mutex_);
  std::vector<std::string> all;
  for (const std::string& sop : expected_)
    if (files_.count(sop) == 0) all.push_back(sop);
  return all;
}

std::size_t Intake::received() const {
  const std::lock_guard lock(mutex_);
  return files_.size();
}

std::size_t Intake::duplicates() const {
  const std::lock_guard lock(mutex_);
  return duplicates_;
}

std::size_t Intake::unlisted() const {
  const std::lock_guard lock(mutex_);
  if (!has_list()) return 0;
  return static_cast<std::size_t>(std::count_if(
      files_.begin(), files_.end(), [&](const auto& one) { return expected_.count(one.first) == 0; }));
}

std::vector<std::filesystem::path> Intake::files() const {
  const std::lock_guard lock(mutex_);
  std::vector<std::filesystem::path> all;
  for (const auto& [sop, file] : files_) all.push_back(file);
  return all;
}

}  // namespace ostia::pacs
