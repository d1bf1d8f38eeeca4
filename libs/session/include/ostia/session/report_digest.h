#pragma once
/// \file What a signature of a report is for.

#include "ostia/lumen/lumen_model.h"
#include "ostia/session/annotation.h"

#include <string>

namespace ostia::session {

/// SHA-256 over model, measurements, readers' words, notes and the image that is at hand (its digest; none:
/// empty), but not how vessels are shown and who signed.
std::string report_content_digest(const lumen::LumenModel& model, const Annotations& annotations,
                                  const std::string& image_sha256 = {});

}  // namespace ostia::session
