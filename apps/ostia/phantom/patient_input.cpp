#include "phantom/patient_input.h"

#include "input/input_digest.h"
#include "input/mask_input.h"
#include "output/refusal.h"

#include "ostia/core/error.h"
#include "ostia/core/log.h"
#include "ostia/session/case_file.h"
#include "ostia/session/patient_tree.h"

#include <string>

namespace ostia::app {
namespace {

constexpr double mask_rim_mm = 0.5;

phantom::PatientTree patient_of_case(const std::filesystem::path& file) {
  return session::patient_of(*session::CaseFile::open(file, session::OpenMode::read_only).model());
}

}  // namespace

std::shared_ptr<const phantom::PatientTree> read_patient(const std::filesystem::path& file,
                                                         std::optional<double> rim_mm, std::uint64_t seed,
                                                         const core::TaskContext& task) {
  task.set_stage("the patient's arteries");
  core::redact_in_logs(file.string(), "tree");
  const bool is_case = file.extension() == ".ostia";
  if (!is_case) pipeline::classify(file);  // says so where nothing is there
  if (!is_case && !holds_labels(file))
    throw InvalidInput(
        own_name(file) +
        " is neither a mask nor a case, which --tree takes; of a CT make a case first (ostia extract)");
  auto tree = std::make_shared<phantom::PatientTree>(naming(file, [&] {
    return is_case ? patient_of_case(file)
                   : session::patient_of_mask(read_asked_labels({file, {}, {}}, task), seed, task);
  }));
  for (std::string& remark : tree->remarks) remark = "the patient's tree: " + remark;
  tree->rim_mm = rim_mm.value_or(is_case ? 0.0 : mask_rim_mm);
  tree->digest = digest_of(file);
  return tree;
}

}  // namespace ostia::app
