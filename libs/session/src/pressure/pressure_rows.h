#pragma once
/// \file The tables of what a case keeps of its pressures.

#include "case_file/database.h"

#include "ostia/session/pressure_notes.h"

#include <cstdint>

namespace ostia::session {

/// Of all their rows; 0 without any, so that cases of older versions keep their sums.
std::uint64_t sum_of(const PressureNotes& notes);

/// Transactions are the caller's.
class PressureRows {
 public:
  explicit PressureRows(const Database& database);
  void write(const PressureNotes& before, const PressureNotes& after);  ///< rows that differ
  PressureNotes read();  ///< throws InvalidInput where a row cannot be one

 private:
  Statement put_input_, erase_input_, read_inputs_, put_what_if_, erase_what_if_, read_what_ifs_;
};

}  // namespace ostia::session
