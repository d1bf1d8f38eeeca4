#pragma once
/// \file Files of every kind, each by every command that writes it, from two inputs of a fork of vessels.

#include <filesystem>
#include <string>
#include <vector>

namespace ostia::testing {

enum class SeamKind {
  image,
  mask,
  surface,
  lines,
  network,
  mesh,
  model_case,
  named_case,    ///< its vessels have names that tell which artery they are
  carried_case,  ///< the same, of another image
  journal,
  motion,
  result,
  calcium,
  ffr,
  dicom_object
};

/// A file or folder that a command has made.
struct SeamFile {
  std::string name;  ///< in the folder
  SeamKind kind;
  std::string by;  ///< the command, for messages
};

/// The files, and what the tests of reading need beside them: `tree.swc`, `image.nrrd`, `mask.nrrd`,
/// `lines.vtp`, `lumen.vtp`, `named.ostia`, `filtered.nrrd`, `phases/`, `beating/`.
const std::vector<SeamFile>& seam_files();
/// Where they lie. They are made once, at the first call; what could not be made is told by `seam_faults`.
const std::filesystem::path& seam_folder();
/// Each command that failed, with what it said.
const std::vector<std::string>& seam_faults();

}  // namespace ostia::testing
