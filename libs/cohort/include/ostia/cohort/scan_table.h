#pragma once
/// \file The table that a cohort is made of: a row a scan, checked before anything is made of it.
/// Columns and faults: docs/reference/cohort.md.

#include "ostia/core/task_context.h"

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace ostia::cohort {

enum class ScanKind { image, mask };
std::string name_of(ScanKind kind);

struct ScanRow {
  std::size_t line = 0;        ///< where it begins in the file, from 1
  std::string id;              ///< the scan's, as the table has it
  std::string patient;         ///< the patient's; the scan's where the table has none
  std::filesystem::path scan;  ///< absolute: a file, or a folder of DICOM files
  std::string series;          ///< UID; empty: the only one
  ScanKind kind = ScanKind::image;
};

struct RefusedRow {
  std::size_t line = 0;
  std::string reason;  ///< one of few: "twice", "missing", "formula", ...; names nobody
  std::string text;    ///< for a person, with the cell that it is about
};

struct TableCheck {
  std::size_t rows = 0;                     ///< all of them
  std::vector<RefusedRow> refused;          ///< by line, a row once, for the first fault found
  std::vector<std::string> unused_columns;  ///< that a cohort has no use for
};

class ScanTable {
 public:
  /// Reads CSV with a line of column names. Throws InvalidInput for what concerns the table as a whole: no
  /// `id` or `scan`, a column without a name or twice, more than 64 columns, no row, an open quotation;
  /// IoError; ResourceError above 1 GB.
  static ScanTable read(const std::filesystem::path& file);
  /// Looks at every row, and at the file or folder that it names; the memory taken grows with faults and by
  /// some 100 bytes a row.
  TableCheck check(const core::TaskContext& task = core::no_task()) const;
  /// The rows that `check` does not refuse, in their order.
  void for_each(const TableCheck& check, const std::function<void(const ScanRow&)>& take) const;
  /// SHA-256 of the file.
  std::string digest() const;

 private:
  struct Columns {
    std::size_t count = 0, id = 0, scan = 0;
    std::size_t patient = none, kind = none, series = none;
    static constexpr std::size_t none = static_cast<std::size_t>(-1);
  };
  friend class RowReader;
  std::filesystem::path file_;
  std::string text_;
  std::size_t rows_from_ = 0, first_line_ = 1;  ///< of the text, behind the column names
  Columns columns_;
  std::vector<std::string> unused_;
};

}  // namespace ostia::cohort
