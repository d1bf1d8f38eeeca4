#pragma once
/// \file A patient's former case, read and measured for a comparison. For any thread.

#include "ostia/core/task_context.h"
#include "ostia/session/comparison_measures.h"
#include "ostia/session/machine_state.h"
#include "ostia/session/session.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace ostia::workstation {

struct FormerCase {
  session::CaseMoment moment;                 ///< without its image
  std::string digest;                         ///< session::report_digest
  std::shared_ptr<session::Session> session;  ///< for reading alone; whoever shows it takes it
};
/// Throws InvalidInput for a case without vessels, and as CaseFile::open does.
std::shared_ptr<const FormerCase> read_former_case(const std::filesystem::path& path);

/// Where the image is, or the image itself; neither: there is none.
struct FormerImage {
  std::optional<session::KnownImage> known{};
  std::shared_ptr<const imaging::ImageVolume> volume{};
  std::optional<double> tube_kv{};
};
/// As the case has it turned. Throws InvalidInput for another image than the case's, and what reading throws.
FormerImage read_former_image(const FormerCase& former, const FormerImage& image,
                              const core::TaskContext& task);
session::ComparedCase measured_former(const FormerCase& former, const FormerImage& image,
                                      const core::TaskContext& task);
/// Of trees that are hardly of one patient, too: the comparison says so. `known`: the present image, for how
/// it was taken.
session::Comparison compared_now(session::ComparedCase before, session::CaseMoment now,
                                 const std::optional<session::KnownImage>& known,
                                 const core::TaskContext& task);

}  // namespace ostia::workstation
