#pragma once
/// \file Pictures of a case, for a person to judge.

#include "ostia/core/task_context.h"
#include "ostia/figure/picture.h"
#include "ostia/geometry/tri_mesh.h"
#include "ostia/phantom/phantom_case.h"
#include "ostia/phantom/vessel_motion.h"

#include <filesystem>
#include <string>
#include <vector>

namespace ostia::phantom {

/// A picture and what it is called as a file.
struct CasePicture {
  std::string name;  ///< "planes", "mip", "straightened", "tree", "heart", "stenoses", "calibre",
                     ///< "histogram", "motion"
  std::string heading, caption;
  figure::Picture picture;
};

/// Three planes, axial slices, thin and thick maximum intensity projections, straightened views along RCA,
/// LAD and LCX, cross-sections at the stenoses with their contours, HU histogram (these where there is an
/// image), the tree with its names, calibre along the vessels.
std::vector<CasePicture> case_pictures(const CasePlan& plan, const Scan* scan, const geometry::TriMesh& lumen,
                                       const core::TaskContext& task = core::no_task());

/// How far the vessels are from their places in the template, over the beat.
CasePicture motion_picture(const std::vector<VesselMotion>& vessels);

/// `report.html`: one file with the pictures, tables of vessels, stenoses and sections.
void write_case_report(const std::filesystem::path& path, const CasePlan& plan, const Scan* scan,
                       const std::vector<CasePicture>& pictures);

}  // namespace ostia::phantom
