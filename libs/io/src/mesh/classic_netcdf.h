#pragma once
/// \file Whether a netCDF file of the classic kinds is whole: the library reads what is missing as zeros.

#include <filesystem>

namespace ostia::io {

/// Throws InvalidInput where a file that begins as a classic netCDF file does (CDF-1, -2, -5; NetCDF Users
/// Guide, "File format specifications") is shorter than its header says. Of others nothing is said.
void require_whole_netcdf(const std::filesystem::path& path);

}  // namespace ostia::io
