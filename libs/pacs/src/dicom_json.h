#pragma once
// Data sets as JSON (PS3.18 F).

#include "ostia/pacs/archive.h"

#include <cstdint>
#include <string>
#include <vector>

namespace ostia::pacs {

/// What QIDO-RS answers: entries, those without a UID of the level left out and counted. Throws InvalidInput
/// "sends what is no DICOM JSON" (without a subject).
struct FoundPage {
  std::vector<Found> found;
  std::size_t entries = 0, without_uid = 0;
};
FoundPage found_in_json(const std::string& body, Level level);

/// Of the answer to STOW-RS: why the one object was not stored (FailureReason); 0: it was, or nothing is
/// said.
std::uint32_t failure_in_json(const std::string& body);

}  // namespace ostia::pacs
