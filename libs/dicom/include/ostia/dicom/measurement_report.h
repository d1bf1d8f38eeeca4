#pragma once
/// \file Measurements as structured reports (PS3.3 A.35.13 Comprehensive 3D SR, PS3.16 TID 1500).

#include "ostia/dicom/code.h"
#include "ostia/dicom/object.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace ostia::dicom {

struct MeasuredNumber {
  Code name;
  double value = 0.0;
  Code unit;
  std::optional<Code> derivation;  ///< minimum, mean
};

/// A statement in codes, or in words where there is no `value`.
struct Statement {
  Code name;
  std::optional<Code> value;
  std::string text;
};

/// What was measured of one thing: a vessel, a lesion, a kind of plaque (TID 1501).
struct MeasurementGroup {
  std::string tracking;  ///< "S1", "LAD"; the same in an amendment
  std::optional<Code> finding, site;
  std::vector<MeasuredNumber> numbers;
  std::vector<Statement> statements;
};

struct MeasurementReport {
  std::vector<MeasurementGroup> groups;
  std::vector<Statement> statements;  ///< of the patient
};

/// Complete and unverified: a person verifies it where it is read. Refers to the source series' instances.
/// Throws InvalidInput for a report without groups or with a value that is not finite.
DicomDataset measurement_report(const SourceSeries& source, const MeasurementReport& report,
                                const ObjectOptions& options = {});

/// An SR of TID 1500, ours or another's: what of it fits above; the rest is passed over. Throws InvalidInput
/// naming the file where it is none or damaged.
MeasurementReport read_measurement_report(const std::filesystem::path& path);

}  // namespace ostia::dicom
