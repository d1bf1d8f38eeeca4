#include "ostia/core/private_folder.h"

#include "ostia/core/error.h"

#include <stdlib.h>

#include <string>
#include <system_error>

namespace ostia::core {

PrivateFolder::PrivateFolder() {
  std::error_code missing;
  const std::filesystem::path all = std::filesystem::temp_directory_path(missing);
  std::string pattern = (all / "ostia-XXXXXX").string();
  if (missing || !::mkdtemp(pattern.data()))
    throw IoError("no temporary folder can be made" + (missing ? std::string() : " in " + all.string()) +
                  "; set TMPDIR to a folder that can be written");
  path_ = pattern;
}

PrivateFolder::~PrivateFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace ostia::core
