#include "ostia/core/files.h"
#include "ostia/core/path_digest.h"
#include "ostia/imaging/dicom.h"

#include <map>
#include <set>

namespace ostia::imaging {
namespace fs = std::filesystem;

std::string series_digest(const DicomSeries& series, const core::TaskContext& task) {
  if (series.whole_files) return core::sha256_of_files(series.files, task);
  // The file alone would be the same for every phase in it.
  std::map<fs::path, std::set<std::int64_t>> frames;
  for (std::size_t i = 0; i < series.files.size(); ++i) frames[series.files[i]].insert(series.frames[i]);
  std::vector<fs::path> files;
  for (const auto& [file, numbers] : frames) files.push_back(file);
  std::vector<std::string> digests = core::sha256_of_each(files, task);
  for (std::size_t i = 0; i < files.size(); ++i) {
    std::string text = digests[i];
    for (const std::int64_t number : frames[files[i]]) text += " " + std::to_string(number);
    digests[i] = core::sha256(text);
  }
  return core::sha256_of_digests(std::move(digests));
}

}  // namespace ostia::imaging
