#pragma once
/// \file What `ostia motion` reads: files by phase, and a motion.

#include "ostia/core/task_context.h"
#include "ostia/imaging/dicom.h"
#include "ostia/io/cage_motion_file.h"
#include "ostia/io/volume_mesh_file.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace ostia::app {

/// What tells a phase: the last number in a file's name, without leading zeros ("7" of "heart2-007"), else
/// the whole name.
std::string phase_of(const std::string& stem);

struct PhaseFile {
  double phase = 0.0;  ///< share of the cycle, in [0, 1)
  std::filesystem::path file;
  std::optional<imaging::DicomSeries> series = {};  ///< in `file`, a folder
};

/// What is taken of folders of a phase, `phase-35`: lumen.vtp, or the image that is there (image*.nrrd and
/// the like, or a folder dicom).
enum class PhaseContent { surfaces, images };

/// The surfaces (.vtp .stl .ply .obj .vtk), cases (.ostia), masks and images of a folder, or those of its
/// subfolders phase-NN, one a phase, rising; for `images` the phases of DICOM series where there are no such
/// files. `frames`: the numbers in names count frames, so many a cycle, from 0 or, where they are 1 to
/// `frames`, from 1; 0: they are percent. Percents of a heartbeat.json and of DICOM files stay what they are.
/// Throws InvalidInput that names the file: no phases, a number that is none of the cycle's, numbers that
/// seem to count frames; IoError.
std::vector<PhaseFile> phase_files(const std::filesystem::path& folder, int frames,
                                   PhaseContent content = PhaseContent::surfaces,
                                   const core::TaskContext& task = core::no_task());

/// What messages call it.
std::string name_of(const PhaseFile& one);

/// Of tetrahedra, the last ones, how many are of layers (io::MeshExportOptions::layer_tetrahedra); 0, with a
/// line in the log, where others are of layers too.
std::size_t layers_at_end(const io::LayeredMesh& mesh);

/// motion.json, or the folder that holds it.
std::filesystem::path motion_path(const std::filesystem::path& motion);
/// `surface` where it is named, else the template beside the motion. Throws InvalidInput where there is none.
std::filesystem::path template_path(const std::filesystem::path& motion, const io::CageMotionFile& file,
                                    const std::filesystem::path& surface);

}  // namespace ostia::app
