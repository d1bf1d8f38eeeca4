#pragma once
/// \file The tables of a case file, and how older ones become today's (docs/reference/case-file.md).

#include "case_file/database.h"

#include <functional>

namespace ostia::session {

inline constexpr std::uint32_t application_id = 0x4F535449;  // "OSTI"
inline constexpr std::int32_t schema_version = 8;

/// Tables and header of a new case; inside a transaction.
void create_schema(Database& database);
/// Brings a case of an older version up to date, in one transaction; `check` is run before its end, and what
/// it throws leaves the case as it was. Nothing to do for today's.
void migrate(Database& database, std::int32_t from, const std::function<void()>& check);

}  // namespace ostia::session
