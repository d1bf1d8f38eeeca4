#pragma once
/// \file Electrocardiograms in PhysioNet's format, WFDB. See docs/methods/ecg.md.

#include "ostia/geometry/ecg_record.h"

#include <filesystem>
#include <string>
#include <vector>

namespace ostia::io {

struct WfdbRecord {
  geometry::EcgRecord record;
  std::vector<std::string> warnings;  ///< ends early, a sum that does not agree: the samples are there anyway
};

/// Reads a record by its header, NAME.hea, and the signal files beside it; formats 16, 24, 32, 61, 80, 160,
/// 212, 310 and 311, several files, several samples a frame (averaged). Comments, dates and times of day,
/// where a patient may be described, are not looked at. Throws IoError (no such file), InvalidInput that
/// names file and line: no header of WFDB, another format (by number), records of several segments, signal
/// files in other folders, no sample at all.
WfdbRecord read_wfdb(const std::filesystem::path& header);

/// Reads an annotation file (.atr) in MIT's format: its beats; other marks (rhythm, noise) are left out.
/// Throws IoError, InvalidInput for a file that ends within a mark or has marks that go backwards.
std::vector<geometry::EcgBeat> read_wfdb_beats(const std::filesystem::path& annotations);

/// Writes NAME.hea, NAME.dat (format 16, a thousandth of the unit a step) and, where there are beats,
/// NAME.atr beside them (without beats one that is there is removed). Values beyond 32 units are cut off; NaN
/// stays missing. Throws InvalidInput (a name that is no word of at most 100 letters, digits, - and _; a unit
/// with blanks, a lead's name with control characters; leads of different lengths; no leads), IoError.
void write_wfdb(const std::filesystem::path& header, const geometry::EcgRecord& record,
                const std::vector<geometry::EcgBeat>& beats = {});

}  // namespace ostia::io
