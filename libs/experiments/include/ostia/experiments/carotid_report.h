#pragma once
/// \file What the carotid experiment leaves behind.

#include "ostia/experiments/carotid.h"

#include <filesystem>
#include <string>

namespace ostia::experiments {

std::string parameters_json(const CarotidOptions& options);
std::string carotid_json(const CarotidResult& result, const CarotidOptions& options);
std::string carotid_text(const CarotidResult& result);  ///< the table, for a terminal
/// table.csv, by-calibre.csv, slices.png (a slice of each scan with truth and models), distances.png (models
/// coloured by their signed distance), calibre.png (distance over the lumen's radius), report.html and the
/// models as VTP in the phantom's frame, into an existing folder.
void write_carotid_report(const std::filesystem::path& folder, const CarotidPhantom& phantom,
                          const CarotidResult& result);

}  // namespace ostia::experiments
