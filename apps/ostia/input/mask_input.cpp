#include "input/mask_input.h"

#include "output/refusal.h"

#include "ostia/core/error.h"
#include "ostia/core/log.h"
#include "ostia/dicom/label_object.h"
#include "ostia/imaging/image_file.h"
#include "ostia/pipeline/source.h"

#include <algorithm>
#include <array>
#include <utility>

namespace ostia::app {
namespace {

/// "1 (8120 voxels), 2 (310 voxels)".
std::string counts_in_words(const std::array<std::int64_t, 256>& counts,
                            const std::vector<std::int64_t>& file_labels) {
  constexpr int most_told = 12;
  std::string text;
  int told = 0;
  for (std::size_t label = 1; label < counts.size(); ++label) {
    if (counts[label] == 0) continue;
    if (told++ == most_told) return text + ", ...";
    const std::int64_t shown =
        label < file_labels.size() ? file_labels[label] : static_cast<std::int64_t>(label);
    text += (text.empty() ? "" : ", ") + std::to_string(shown) + " (" + std::to_string(counts[label]) +
            " voxels)";
  }
  return text.empty() ? "none but 0" : text;
}

/// How many voxels have each value, and the value that most have.
struct ValueCounts {
  explicit ValueCounts(const imaging::ImageVolume& image) : of(65536, 0) {
    for (const std::int16_t value : image.voxels) ++of[static_cast<std::size_t>(value + 32768)];
    const auto most = std::ranges::max_element(of);
    commonest = static_cast<std::int16_t>(most - of.begin() - 32768);
    negative = std::any_of(of.begin(), of.begin() + 32768, [](std::int64_t count) { return count > 0; });
    dominates = 2 * *most > static_cast<std::int64_t>(image.voxels.size());
  }
  std::size_t different() const {
    return of.size() - static_cast<std::size_t>(std::ranges::count(of, std::int64_t{0}));
  }
  std::vector<std::int64_t> of;
  std::int16_t commonest = 0;
  bool dominates = false, negative = false;
};

/// A CT of which nothing but its vessels was left. None where there are few values and none is negative:
/// labels.
std::optional<imaging::MaskVolume> vessels_on_background(const MaskInput& input,
                                                         const core::TaskContext& task) {
  constexpr std::size_t most_labels = 128;
  if (pipeline::classify(input.file) != pipeline::SourceKind::image || holds_labels(input.file))
    return std::nullopt;
  const imaging::ImageVolume image = imaging::read_image(input.file, task).volume;
  const ValueCounts counts(image);
  if (counts.different() <= most_labels && !counts.negative) return std::nullopt;
  if (!counts.dominates)
    throw InvalidInput(own_name(input.file) + " has " + std::to_string(counts.different()) +
                       " different values and none that most of its voxels have: it is an image, not a mask");
  core::log_warning("its values are a CT's: all that is not " + std::to_string(counts.commonest) +
                    ", as most of its voxels are, is taken as the mask's");
  imaging::MaskVolume mask{image.geometry, {}};
  mask.voxels.reserve(image.voxels.size());
  for (const std::int16_t value : image.voxels) mask.voxels.push_back(value == counts.commonest ? 0 : 1);
  return mask;
}

/// A segmentation and the images that it is said to be of: what both files say of patient and frame of
/// reference.
void require_same_origin(const MaskInput& input, const std::filesystem::path& series_file) {
  const std::optional<std::filesystem::path> object = dicom::label_object_in(input.file);
  if (!object || series_file.empty()) return;
  const std::string why =
      dicom::other_origin(dicom::object_origin(*object), dicom::object_origin(series_file));
  if (!why.empty())
    throw InvalidInput(own_name(input.file) + " and " + own_name(input.image) +
                       " do not belong together: " + why);
}

}  // namespace

imaging::MaskVolume read_asked_labels(const MaskInput& input, const core::TaskContext& task,
                                      const std::optional<imaging::Geometry>& grid) {
  if (input.told && input.labels.empty())
    if (std::optional<imaging::MaskVolume> vessels = vessels_on_background(input, task))
      return std::move(*vessels);
  imaging::LoadedImage<std::uint8_t> loaded = dicom::read_labels(input.file, task, grid);
  for (const std::string& warning : loaded.header.warnings) core::log_warning(warning);
  if (input.labels.empty()) return std::move(loaded.volume);
  std::array<std::int64_t, 256> counts{};
  for (const std::uint8_t voxel : loaded.volume.voxels) ++counts[voxel];
  std::array<bool, 256> wanted{};
  const std::vector<std::int64_t>& file_labels = loaded.header.file_labels;
  for (const int label : input.labels) {
    std::int64_t value = label;
    if (!file_labels.empty())
      value = std::ranges::find(file_labels, std::int64_t{label}) - file_labels.begin();  // 256 at most
    if (value < 1 || value > 255 || counts[static_cast<std::size_t>(value)] == 0)
      throw InvalidInput(own_name(input.file) + " has no voxel of label " + std::to_string(label) +
                         "; its labels are " + counts_in_words(counts, file_labels));
    wanted[static_cast<std::size_t>(value)] = true;
  }
  for (std::uint8_t& voxel : loaded.volume.voxels)
    if (!wanted[voxel]) voxel = 0;
  return std::move(loaded.volume);
}

bool may_be_mask(const imaging::ImageVolume& image) {
  return ValueCounts(image).dominates;
}

MaskCase mask_case(const MaskInput& input, const coronary::MaskTreeOptions& options,
                   const core::TaskContext& task) {
  task.set_stage("reading");
  core::redact_in_logs(input.file.string(), "mask");
  pipeline::Source ct;
  std::optional<imaging::Geometry> grid;
  if (!input.image.empty()) {
    ct = pipeline::load_ct(input.image, {}, task.sub(0.0, 0.1));
    for (const std::string& warning : ct.warnings) core::log_warning(warning);
    require_same_origin(input, ct.series_file);
    grid = ct.image->geometry;
  }
  const imaging::MaskVolume labels = read_asked_labels(input, task.sub(0.1, 0.2), grid);
  MaskCase result;
  result.model = naming(input.file, [&] {
    return session::model_of_mask(labels, ct.image.get(), options, task.sub(0.2, 1.0));
  });
  if (ct.image) result.image = session::ImageReference{ct.sha256, ct.pseudonym};
  return result;
}

}  // namespace ostia::app
