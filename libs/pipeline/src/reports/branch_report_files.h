#pragma once
/// \file The files of a branch report.

#include "ostia/io/polydata_file.h"
#include "ostia/pipeline/branch_report.h"

#include <string>
#include <utility>
#include <vector>

namespace ostia::pipeline {

/// Names and contents of the tables.
std::vector<std::pair<std::string, std::string>> branch_tables(const BranchReport& report);
/// Names and contents of the VTP files.
std::vector<std::pair<std::string, io::Polydata>> branch_polydata(const BranchReport& report);

/// Of a bifurcation's sections: that of the branches that leave it over that of those that come to it; 0
/// where one is not closed or there is none.
double area_ratio(const BranchReport& report, std::int32_t bifurcation);

}  // namespace ostia::pipeline
