#include "ostia/core/kept_folder.h"

#include "made_parents.h"
#include "part_names.h"

#include "ostia/core/error.h"

#include <system_error>
#include <utility>

namespace ostia::core {
namespace fs = std::filesystem;
namespace {

constexpr const char* record_name = "record.json";
constexpr std::uint64_t largest_record = 64 << 20;

fs::path kept_beside(const fs::path& target) {
  const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
  return folder / (".kept-" + shortened(target.filename().string()));
}

void remove_dead_parts_below(const fs::path& folder) {
  remove_dead_parts(folder);
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_directory() && !entry.is_symlink()) remove_dead_parts(entry.path());
}

}  // namespace

KeptFolder::KeptFolder(fs::path target) : target_(std::move(target)) {
  if (!target_.has_filename() && target_.has_parent_path()) target_ = target_.parent_path();
  folder_ = kept_beside(target_);
  result_ = folder_ / "result";
  { const StagedFolder trial(target_); }  // what cannot be made is told as it is everywhere
  std::error_code error;
  parents_ = std::make_unique<const MadeParents>(folder_.parent_path().empty() ? "." : folder_.parent_path());
  fs::create_directory(folder_, error);
  if (!fs::is_directory(folder_)) throw IoError("cannot write " + target_.string() + ": " + error.message());
  lock_.emplace(folder_, target_, "wait until it ends, or end it");
  if (record().empty()) fs::remove_all(result_, error);  // nobody knows what is whole in it
  fs::create_directory(result_, error);
  if (!fs::is_directory(result_)) throw IoError("cannot write " + target_.string() + ": " + error.message());
  shown_.emplace(result_, target_);
  remove_dead_parts_below(result_);
}

KeptFolder::~KeptFolder() {
  if (committed_) return;
  std::error_code ignored;
  if (!fs::exists(folder_ / record_name, ignored)) fs::remove_all(folder_, ignored);
}

std::string KeptFolder::record() const {
  return fs::exists(folder_ / record_name) ? read_file(folder_ / record_name, largest_record) : std::string();
}

void KeptFolder::set_record(const std::string& text) {
  write_file(folder_ / record_name, text);
}

void KeptFolder::commit() {
  publish_folder(result_, target_);
  committed_ = true;
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

}  // namespace ostia::core
