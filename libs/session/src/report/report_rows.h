#pragma once
/// \file The tables of what a case keeps of its report.

#include "case_file/database.h"

#include "ostia/session/report_notes.h"

#include <cstdint>

namespace ostia::session {

/// Of all their rows; 0 without any, so that cases of older versions keep their sums.
std::uint64_t sum_of(const ReportNotes& notes);

/// Transactions are the caller's.
class ReportRows {
 public:
  explicit ReportRows(const Database& database);
  void write(const ReportNotes& before, const ReportNotes& after);  ///< rows that differ
  ReportNotes read();  ///< throws InvalidInput where a row cannot be one

 private:
  Statement put_note_, erase_note_, read_notes_, put_version_, erase_versions_, read_versions_;
};

}  // namespace ostia::session
