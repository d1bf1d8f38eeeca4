#include "case_text.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/core/text.h"

#include <system_error>

namespace ostia::solver {
namespace fs = std::filesystem;

std::string foam_vector(const geometry::Vec3& v) {
  return "(" + core::shortest_text(v[0]) + " " + core::shortest_text(v[1]) + " " + core::shortest_text(v[2]) +
         ")";
}

std::string foam_head(const std::string& type, const std::string& location, const std::string& object) {
  return "FoamFile\n{\n    version     2.0;\n    format      ascii;\n    class       " + type +
         ";\n    location    \"" + location + "\";\n    object      " + object + ";\n}\n\n";
}

void write_case_file(const fs::path& file, const std::string& text) {
  std::error_code error;
  fs::create_directories(file.parent_path(), error);
  if (error) throw IoError("cannot write " + file.parent_path().string() + ": " + error.message());
  core::write_file(file, text);
}

void require_new_folder(const fs::path& folder) {
  std::error_code error;
  if (fs::is_directory(folder, error) && !fs::is_empty(folder, error))
    throw InvalidInput("cannot write the case to " + folder.string() +
                       ": the folder holds something already; name a new folder");
}

}  // namespace ostia::solver
