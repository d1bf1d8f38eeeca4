#pragma once
/// \file The tables of a case file, and how older ones become today's (docs/case-file.md).

#include "database.h"

namespace ostia::session {

inline constexpr std::uint32_t application_id = 0x4F535449;  // "OSTI"
inline constexpr std::int32_t schema_version = 1;

/// Tables and header of a new case; inside a transaction.
void create_schema(Database& database);
/// Brings a case of an older version up to date, in one transaction. Nothing to do for today's.
void migrate(Database& database, std::int32_t from);

}  // namespace ostia::session
