#pragma once
/// \file `-` as a file name: commands joined by pipes.

#include "ostia/core/private_folder.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace ostia::app {

/// What a file with these first bytes is called: ".nrrd", ".vtp", ...; "" for what no command reads. `size`
/// is the whole file's, which tells binary STL.
std::string extension_of_content(const std::string& head, std::uintmax_t size);

/// Stands between a command, which knows files alone, and the standard streams. An argument `-` after `-o`,
/// `--output` or another option that names a result is standard output, any other is standard input; `-.stl`
/// is standard output as that format.
class StandardStreams {
 public:
  /// Nothing is read yet. Throws UsageError for `-` twice on one side, and where a command writes a folder.
  explicit StandardStreams(std::vector<std::string> arguments);
  ~StandardStreams();
  StandardStreams(const StandardStreams&) = delete;
  StandardStreams& operator=(const StandardStreams&) = delete;

  bool used() const { return input_.at != 0 || output_.at != 0; }
  /// With temporary files in the place of `-`.
  const std::vector<std::string>& arguments() const { return arguments_; }
  /// Reads standard input to its end into a file named after what it holds. From here on what a command
  /// prints goes to standard error where standard output is taken. Throws InvalidInput for content of no
  /// known kind, or none; IoError, ResourceError.
  void open();
  /// The result goes to standard output. Throws IoError where nobody reads it.
  void deliver();

 private:
  struct Stream {
    std::size_t at = 0;  ///< index of the argument; 0, the command's own at the least: not used
    std::string option;  ///< "--output=" where name and value are one argument
    std::filesystem::path file;
  };
  void take(Stream& stream, std::size_t at, const std::string& option, const std::string& value, bool result);
  void name(Stream& stream, const std::filesystem::path& file);
  void spool_input();

  std::vector<std::string> arguments_;
  std::unique_ptr<core::PrivateFolder> folder_;
  Stream input_, output_;
  bool keeps_kind_ = false;  ///< the output is what the input is
  int standard_output_ = -1;
};

}  // namespace ostia::app
