#pragma once
/// \file What the chain on a scan leaves behind.

#include "ostia/experiments/vessel_chain.h"

#include <filesystem>
#include <string>
#include <vector>

namespace ostia::experiments {

/// Of the isosurface's triangles: what [Luboz] 3.3 reconstructs with.
inline constexpr double chain_share = 0.05;

/// What decides, with the scan, whether the chain was run already.
std::string parameters_json(const ChainOptions& options, const std::vector<Vec3>& seeds,
                            const std::vector<Vec3>& rivals);
/// The figures as JSON (docs/schemas/experiment-chain.schema.json).
std::string chain_json(const ChainResult& result, const ChainOptions& options, const std::vector<Vec3>& seeds,
                       const std::vector<Vec3>& rivals);
/// A table for the terminal.
std::string chain_text(const ChainResult& result);

/// Into an existing folder: surfaces.csv, isosurface.vtp, network.vtp, reconstructed.vtp (the nearest of
/// those with 5 % of the triangles, else of all), figure.png (as [Luboz] figure 6), report.html.
void write_chain_report(const std::filesystem::path& folder, const ChainResult& result,
                        const core::TaskContext& task = core::no_task());

}  // namespace ostia::experiments
