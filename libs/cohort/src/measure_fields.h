#pragma once
/// \file Which values of a scan's results become rows of a cohort's table, and what they are.

#include <span>
#include <string>

namespace ostia::cohort {

struct MeasureField {
  const char* level;    ///< patient, vessel, segment, stenosis, outlet
  const char* pointer;  ///< where it is: JSON pointer from the result, or from the entry of its level's list
  const char* measure;
  const char* unit;  ///< "1": a number without unit; "": a text
  const char* meaning;
};
std::span<const MeasureField> measure_fields();

struct MeasureLevel {
  const char* stage;  ///< whose result it is read from
  const char* level;
  const char* list;  ///< member of the result; "": the result itself
  const char* item;  ///< JSON pointer of what the entry is called
  const char* prefix;
};
std::span<const MeasureLevel> measure_levels();

struct ColumnWords {
  const char* table;
  const char* column;
  const char* meaning;
};
std::span<const ColumnWords> column_words();

}  // namespace ostia::cohort
