#pragma once
/// \file Images in formats that only the readers of the Insight Toolkit (ITK) know.

#include <filesystem>
#include <string>

namespace ostia::imaging {

/// "GIPL", "TIFF", "VTK image" (legacy, structured points), "Analyze" or "HDF5 image" (ITK's own; by its
/// extension, too), by content; empty for any other file, and where none can be read. `read_image` and its
/// like (image_file.h) read these: ITK does so in the worker, within its limits, and what it gives is checked
/// as any other file is.
std::string foreign_image_format(const std::filesystem::path& path);

/// The child's side: writes the image as NRRD. For apps/worker alone. Returns an exit code; what went wrong
/// is on stderr.
int read_foreign_image_in_worker(const std::filesystem::path& in, const std::filesystem::path& out);

}  // namespace ostia::imaging
