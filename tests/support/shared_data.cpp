#include "shared_data.h"

#include <unistd.h>

#include <cstdlib>
#include <map>
#include <mutex>
#include <stdexcept>
#include <vector>

namespace ostia::testing {
namespace fs = std::filesystem;
namespace {

struct Cleaner {
  std::vector<fs::path> folders;
  ~Cleaner() {
    std::error_code ignored;
    for (const fs::path& folder : folders) fs::remove_all(folder, ignored);
  }
};

Cleaner& cleaner() {
  static Cleaner instance;
  return instance;
}

}  // namespace

bool shared_data_required() {
  return std::getenv("OSTIA_SHARED_DATA") != nullptr;
}

std::optional<fs::path> shared_data(const std::string& relative) {
  const char* given = std::getenv("OSTIA_SHARED_DATA");
  const fs::path root =
      given ? fs::path(given) : fs::path(OSTIA_SOURCE_DIR).parent_path() / "shared" / "data";
  const fs::path path = root / relative;
  if (!fs::exists(path)) return std::nullopt;
  return path;
}

fs::path temporary_folder(const std::string& name) {
  static std::mutex mutex;
  const std::lock_guard lock(mutex);
  static int count = 0;
  const fs::path folder = fs::temp_directory_path() / ("ostia-test-" + std::to_string(::getpid()) + "-" +
                                                       std::to_string(count++) + "-" + name);
  fs::create_directories(folder);
  cleaner().folders.push_back(folder);
  return folder;
}

fs::path unpacked(const fs::path& zip) {
  static std::map<fs::path, fs::path> done;
  if (const auto found = done.find(zip); found != done.end()) return found->second;
  const fs::path folder = temporary_folder(zip.stem().string());
  const std::string command =
      "cd '" + folder.string() + "' && cmake -E tar xf '" + fs::absolute(zip).string() + "'";
  if (std::system(command.c_str()) != 0) throw std::runtime_error("cannot unpack " + zip.string());
  return done[zip] = folder;
}

}  // namespace ostia::testing
