#include "ostia/imaging/worker_reads.h"

#include "dicom_decode.h"

namespace ostia::imaging {

std::vector<std::filesystem::path> reads_of_decoding(const std::filesystem::path& list_file) {
  std::vector<std::filesystem::path> files;
  for (const DecodeItem& item : read_decode_list(list_file))
    if (files.empty() || files.back() != item.path) files.push_back(item.path);  // frames of one file
  return files;
}

std::vector<std::filesystem::path> reads_of_foreign_image(const std::filesystem::path& in) {
  std::vector<std::filesystem::path> files{in};
  for (const char* ending : {".hdr", ".img", ".HDR", ".IMG"}) {
    files.push_back(in);
    files.back().replace_extension(ending);
  }
  return files;
}

}  // namespace ostia::imaging
