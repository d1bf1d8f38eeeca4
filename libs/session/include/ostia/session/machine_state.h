#pragma once
/// \file What a workstation knows of its machine, outside of any case: where images lie, which cases were
/// open, how the window was. Paths stand here and in no case.

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace ostia::session {

struct RecentCase {
  std::filesystem::path path;  ///< absolute
  std::string pseudonym;       ///< of its image; empty without one
  std::int64_t opened = 0;     ///< seconds since 1970 began
  std::string image_sha256{};  ///< of its image, by which KnownPatients knows whose it is; empty without one
};

struct KnownImage {
  std::filesystem::path path;  ///< absolute; a file, or a folder of DICOM files
  std::string series_uid;      ///< DicomSeries::uid of the one chosen there; empty where none was
};

/// A file `machine.json` in a folder, for this user alone (0600), replaced whole or not at all. Each change
/// reads it anew under a lock, so that several programs keep each other's entries. A file that is damaged or
/// of a newer version is moved aside, and a notice says so; what cannot be read is as if nothing were known.
/// Not safe from several threads at once.
class MachineState {
 public:
  static constexpr std::size_t most_recent_cases = 12;
  static constexpr std::size_t most_images = 1000;

  /// Writes nothing yet; the folder is made by the first change.
  explicit MachineState(std::filesystem::path folder);
  ~MachineState();
  MachineState(MachineState&&) noexcept;
  MachineState& operator=(MachineState&&) noexcept;

  /// Where the image was seen last, if there still is a file or folder. Its content is to be compared when it
  /// is read (CaseFile::check_image).
  std::optional<KnownImage> find_image(const std::string& sha256) const;
  /// Throws IoError, ResourceError, as all changes do: the file is then what it was.
  void remember_image(const std::string& sha256, const std::filesystem::path& path,
                      const std::string& series_uid = {});

  std::vector<RecentCase> recent_cases() const;  ///< newest first; some may be gone meanwhile
  /// It comes first; beyond `most_recent_cases` the oldest go.
  void remember_case(const RecentCase& opened);
  void forget_case(const std::filesystem::path& path);

  std::optional<std::string> setting(const std::string& key) const;
  std::map<std::string, std::string> settings() const;
  void set_setting(const std::string& key, const std::string& value);
  /// Several in one write; others stay.
  void set_settings(const std::map<std::string, std::string>& values);

  /// What the person should know of ("... was damaged and is now ..."), once.
  std::vector<std::string> take_notices();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ostia::session
