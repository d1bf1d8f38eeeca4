#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/core/log.h"
#include "ostia/experiments/hard.h"
#include "ostia/imaging/image_file.h"
#include "ostia/session/patient_tree.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace ostia::experiments {
namespace fs = std::filesystem;
namespace {

constexpr double mask_rim_mm = 0.5;

/// The name without the ending of an image; empty for another file.
std::string mask_name(const fs::path& file) {
  constexpr std::array<std::string_view, 5> endings{".nii.gz", ".nrrd", ".nii", ".mha", ".mhd"};
  const std::string name = file.filename().string();
  for (const std::string_view ending : endings)
    if (name.ends_with(ending)) return name.substr(0, name.size() - ending.size());
  return {};
}

std::vector<fs::path> masks_of(const fs::path& folder) {
  std::vector<fs::path> masks;
  if (fs::is_directory(folder))
    for (const auto& entry : fs::directory_iterator(folder))
      if (entry.is_regular_file() && !mask_name(entry.path()).empty()) masks.push_back(entry.path());
  if (masks.empty())
    throw InvalidInput(
        folder.filename().string() +
        " holds no masks (.nrrd, .nii.gz, .mha or .mhd): name the folder of patients' coronary "
        "masks, or leave --masks out for drawn hearts");
  std::ranges::sort(masks);
  return masks;
}

HardPatient read_patient_mask(const fs::path& file, const core::TaskContext& task) {
  core::redact_in_logs(file.string(), "mask");
  HardPatient patient;
  patient.name = mask_name(file);
  const imaging::MaskVolume labels = imaging::read_labels(file, task).volume;
  const auto refuse = [&](const std::exception& error) {
    throw InvalidInput(file.filename().string() + ": " + error.what());
  };
  try {
    auto tree = std::make_shared<phantom::PatientTree>(session::patient_of_mask(labels, 1, task));
    tree->rim_mm = mask_rim_mm;
    tree->digest = core::sha256_file(file);
    patient.tree = std::move(tree);
  } catch (const GeometryError& error) {
    refuse(error);
  } catch (const InvalidInput& error) {
    refuse(error);
  }
  return patient;
}

}  // namespace

std::vector<HardPatient> read_hard_patients(const fs::path& folder, const core::TaskContext& task) {
  const std::vector<fs::path> masks = masks_of(folder);
  std::vector<HardPatient> patients;
  const auto count = static_cast<double>(masks.size());
  for (const fs::path& file : masks) {
    const auto done = static_cast<double>(patients.size());
    task.throw_if_cancelled();
    task.set_stage(file.filename().string());
    patients.push_back(read_patient_mask(file, task.sub(done / count, (done + 1.0) / count)));
  }
  return patients;
}

}  // namespace ostia::experiments
