#pragma once
/// \file The tables of annotations: rows read, written, and their sum.

#include "case_file/database.h"
#include "pressure/pressure_rows.h"
#include "report/report_rows.h"

#include "ostia/session/annotation.h"

#include <cstdint>

namespace ostia::session {

/// Of all rows of annotations: additive, so that a command changes it by its own rows.
std::uint64_t sum_of(const Annotations& annotations);

/// Reads and writes; transactions are the caller's.
class AnnotationRows {
 public:
  explicit AnnotationRows(const Database& database);

  static void write_new(const Database& database);  ///< none yet, in tables just made
  /// Rows that differ.
  void write_change(const Annotations& before, const Annotations& after);
  /// Throws InvalidInput where a row cannot be one, or the sum is not that of the rows.
  Annotations read();

 private:
  void put(const analysis::Measurement& measurement);
  void put(const VesselMark& mark);
  void put_lesions(const VesselMark& mark);
  void read_lesions(Annotations& annotations);
  Statement update_, put_measurement_, erase_measurement_, put_mark_, erase_mark_, read_, read_measurements_,
      read_marks_, put_evaluability_, erase_evaluability_, read_evaluability_, put_lesion_, erase_lesions_,
      read_lesions_;
  PressureRows pressure_;
  ReportRows report_;
};

}  // namespace ostia::session
