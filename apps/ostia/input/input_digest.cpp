#include "input/input_digest.h"

#include "ostia/core/files.h"

#include <algorithm>
#include <string_view>
#include <vector>

namespace ostia::app {
namespace fs = std::filesystem;
namespace {

/// Whether `file` may hold what `header`, in the same folder, describes.
bool is_data_of(const fs::path& header, const fs::path& file) {
  const std::string name = file.filename().string(), stem = header.stem().string() + ".";
  const auto ends_with_any = [&](std::initializer_list<std::string_view> ends) {
    return std::ranges::any_of(ends, [&](std::string_view end) { return name.ends_with(end); });
  };
  if (header.extension() == ".xdmf") return ends_with_any({".h5", ".xdmf"});
  if (header.extension() != ".mhd" && header.extension() != ".nhdr") return false;
  return name.starts_with(stem) && ends_with_any({".raw", ".zraw", ".gz", ".bz2"});
}

template <class Iterator, class Choice>
std::vector<fs::path> files_in(const fs::path& folder, const Choice& chosen) {
  std::vector<fs::path> files;
  for (const auto& entry : Iterator(folder))
    if (entry.is_regular_file() && chosen(entry.path())) files.push_back(entry.path());
  return files;
}

}  // namespace

std::string digest_of(const fs::path& input) {
  const bool is_folder = fs::is_directory(input);
  const fs::path folder = is_folder ? input : fs::absolute(input).parent_path();
  const std::vector<fs::path> files =
      is_folder ? files_in<fs::recursive_directory_iterator>(folder, [](const fs::path&) { return true; })
      : fs::is_directory(folder)
          ? files_in<fs::directory_iterator>(folder, [&](const fs::path& p) { return is_data_of(input, p); })
          : std::vector<fs::path>{};
  if (!is_folder && files.empty()) return core::sha256_file(input);
  std::vector<std::string> lines;
  for (const fs::path& file : files)
    lines.push_back(file.lexically_relative(folder).generic_string() + " " + core::sha256_file(file) + "\n");
  std::ranges::sort(lines);
  std::string all = is_folder ? "" : core::sha256_file(input) + "\n";
  for (const std::string& line : lines) all += line;
  return core::sha256(all);
}

}  // namespace ostia::app
