#include "ostia/session/phase_images.h"

#include "ostia/core/error.h"
#include "ostia/imaging/image_file.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numeric>

namespace ostia::session {
namespace fs = std::filesystem;
namespace {

constexpr double same_phase = 1e-6;
constexpr std::array<const char*, 5> image_endings{".nii.gz", ".nrrd", ".mhd", ".mha", ".nii"};

std::size_t bytes_of(const imaging::ImageVolume& image) {
  return image.voxels.size() * sizeof(std::int16_t);
}

struct Number {
  double value = 0.0;
  bool percent = false;  ///< a sign of percent follows
};

/// The numbers in a text, without signs: "heart-2_phase37.5%" has 2 and 37.5.
std::vector<Number> numbers_in(const std::string& text) {
  std::vector<Number> found;
  for (std::size_t i = 0; i < text.size();) {
    if (!std::isdigit(static_cast<unsigned char>(text[i]))) {
      ++i;
      continue;
    }
    std::size_t end = i;
    bool point = false;
    while (end < text.size()) {
      const bool digit = std::isdigit(static_cast<unsigned char>(text[end])) != 0;
      const bool fraction = text[end] == '.' && !point && end + 1 < text.size() &&
                            std::isdigit(static_cast<unsigned char>(text[end + 1])) != 0;
      if (!digit && !fraction) break;
      point = point || fraction;
      ++end;
    }
    std::size_t sign = end;
    while (sign < text.size() && text[sign] == ' ') ++sign;
    const bool percent = sign < text.size() && (text[sign] == '%' || text.compare(sign, 3, "pct") == 0);
    found.push_back({std::strtod(text.substr(i, end - i).c_str(), nullptr), percent});
    i = end;
  }
  return found;
}

/// Of times after the R peak, ms, that a whole cycle's even steps make, some of which may be missing.
std::vector<double> phases_of_trigger_times(std::vector<double> times) {
  std::vector<double> sorted = times, steps;
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t i = 1; i < sorted.size(); ++i) steps.push_back(sorted[i] - sorted[i - 1]);
  std::sort(steps.begin(), steps.end());
  const double step = steps[steps.size() / 2];
  if (!(step > 0.0)) return {};
  if (sorted.front() > 0.5 * step)
    throw InvalidInput(
        "the images' trigger times begin " + std::to_string(std::lround(sorted.front())) +
        " ms after the R peak, so that they do not tell how long the cycle is: write the images "
        "into files named by their percent of the cycle, as in phase_35.nrrd");
  const double cycle = sorted.back() - sorted.front() + step;
  for (double& time : times) time = time / cycle - std::floor(time / cycle);
  return times;
}

double share_of(double percent) {
  return percent >= 100.0 ? 0.0 : percent / 100.0;
}

std::optional<std::string> stem_of_image(const fs::path& file) {
  const std::string name = file.filename().string();
  for (const char* ending : image_endings)
    if (name.ends_with(ending)) return name.substr(0, name.size() - std::string(ending).size());
  return std::nullopt;
}

std::vector<PhaseSource> image_files(const fs::path& folder) {
  std::vector<PhaseSource> found;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const auto stem = entry.is_regular_file() ? stem_of_image(entry.path()) : std::nullopt;
    if (!stem) continue;
    if (const auto phase = phase_of_name(*stem)) found.push_back({*phase, entry.path(), {}});
  }
  return found;
}

/// One folder down: `phase-35/image00.nrrd`. A folder with two images says nothing of which is meant.
std::vector<PhaseSource> image_folders(const fs::path& folder) {
  std::vector<PhaseSource> found;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const auto phase = entry.is_directory() ? phase_of_name(entry.path().filename().string()) : std::nullopt;
    if (!phase) continue;
    std::vector<fs::path> images;
    for (const fs::directory_entry& file : fs::directory_iterator(entry.path()))
      if (file.is_regular_file() && stem_of_image(file.path())) images.push_back(file.path());
    if (images.size() == 1) found.push_back({*phase, images.front(), {}});
  }
  return found;
}

/// Series that each have a phase of their own, or were split by it.
std::vector<PhaseSource> series_by_percent(const std::vector<imaging::DicomSeries>& all) {
  std::vector<PhaseSource> found;
  for (const imaging::DicomSeries& one : all)
    if (one.cardiac_percent && *one.cardiac_percent >= 0.0 && *one.cardiac_percent <= 100.0)
      found.push_back({share_of(*one.cardiac_percent), {}, one});
  // One reconstruction with a percent among others that have none is no set of phases.
  return found.size() > 1 || found.size() == all.size() ? found : std::vector<PhaseSource>{};
}

constexpr const char* way_out = "files named by their percent of the cycle, as in phase_35.nrrd";

/// Why none of the DICOM series is of a phase, and the way out.
std::string no_phases(const std::vector<imaging::DicomSeries>& all) {
  const std::string count = std::to_string(all.size());
  const auto is_slice = [](const imaging::DicomSeries& one) { return one.files.size() == 1; };
  const auto is_faulty = [](const imaging::DicomSeries& one) { return !one.faults.empty(); };
  if (all.empty())
    return std::string("no image in the folder says its phase: name image ") + way_out +
           ", or choose a DICOM series with several cardiac phases";
  if (std::all_of(all.begin(), all.end(), is_slice))
    return "the folder's DICOM images are " + count +
           " single slices, each of a position and a time of its own, as cine images of a few positions are; "
           "a phase needs a volume: export series that cover the heart at each phase, or write the volumes "
           "into " +
           way_out;
  if (std::all_of(all.begin(), all.end(), is_faulty))
    return "none of the folder's " + count +
           " DICOM series can be read as a volume: `ostia info` says of each why not; mend that, or write "
           "the "
           "volumes into " +
           way_out;
  return "none of the folder's " + count +
         " DICOM series says its phase: there is no percent of the cardiac phase (0020,9241), no trigger "
         "times within a series (0018,1060) and no percent in a description; write the volumes into " +
         way_out;
}

/// A motion is of one heart.
void require_one_patient(const std::vector<PhaseSource>& found) {
  std::vector<imaging::DicomSeries> series;
  for (const PhaseSource& one : found) series.push_back(*one.series);
  if (imaging::patients_in(series) > 1)
    throw InvalidInput(
        "the phases in this folder are of several patients: give each patient a folder, and choose one");
}

std::vector<PhaseSource> series_of_phases(const fs::path& folder, const core::TaskContext& task) {
  std::vector<imaging::DicomSeries> all = imaging::scan_dicom(folder, task).series;
  const std::string why = no_phases(all);
  std::erase_if(all, [](const imaging::DicomSeries& one) { return !one.faults.empty(); });
  std::vector<PhaseSource> found = series_by_percent(all);
  if (!found.empty()) return found;
  std::vector<imaging::DicomSeries> labelled;
  std::vector<std::string> labels;
  for (const imaging::DicomSeries& one : all)
    if (!one.phase.empty()) {
      labelled.push_back(one);
      labels.push_back(one.phase);
    }
  const std::vector<double> phases = phases_of_labels(labels);
  for (std::size_t i = 0; i < phases.size(); ++i) found.push_back({phases[i], {}, labelled[i]});
  if (!found.empty()) return found;
  for (const imaging::DicomSeries& one : all)
    for (const Number& number : numbers_in(one.description))
      if (number.percent && number.value <= 100.0) {
        found.push_back({share_of(number.value), {}, one});
        break;
      }
  if (found.empty()) throw InvalidInput(why);
  return found;
}

std::vector<PhaseSource> dicom_series(const fs::path& folder, const core::TaskContext& task) {
  std::vector<PhaseSource> found = series_of_phases(folder, task);
  require_one_patient(found);
  return found;
}

}  // namespace

std::optional<double> phase_of_name(const std::string& name) {
  std::optional<double> last, percent;
  for (const Number& number : numbers_in(name)) {
    if (number.value > 100.0) continue;
    last = number.value;
    if (number.percent) percent = number.value;
  }
  if (!last) return std::nullopt;
  return share_of(percent ? *percent : *last);
}

std::vector<double> phases_of_labels(const std::vector<std::string>& labels) {
  const auto all_begin = [&](const char* words) {
    return std::all_of(labels.begin(), labels.end(),
                       [&](const std::string& label) { return label.starts_with(words); });
  };
  std::vector<double> values, totals;
  for (const std::string& label : labels) {
    const std::vector<Number> numbers = numbers_in(label);
    if (numbers.empty()) return {};
    values.push_back(numbers.front().value);
    totals.push_back(numbers.back().value);
  }
  if (values.empty()) return {};
  if (all_begin("cardiac phase")) {
    std::transform(values.begin(), values.end(), values.begin(), share_of);
  } else if (all_begin("phase ")) {
    // Of all that there were, of which some may be left out.
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (values[i] < 1.0 || values[i] > totals[i]) return {};
      values[i] = (values[i] - 1.0) / totals[i];
    }
  } else if (all_begin("trigger time") && values.size() > 1) {
    values = phases_of_trigger_times(values);
  } else {
    return {};
  }
  return values;
}

std::vector<PhaseSource> find_phase_images(const fs::path& folder, const core::TaskContext& task) {
  if (!fs::is_directory(folder))
    throw IoError("the images of the phases are looked for in a folder; this is none");
  std::vector<PhaseSource> found = image_files(folder);
  if (found.empty()) found = image_folders(folder);
  if (found.empty()) found = dicom_series(folder, task);
  std::sort(found.begin(), found.end(),
            [](const PhaseSource& a, const PhaseSource& b) { return a.phase < b.phase; });
  for (std::size_t i = 1; i < found.size(); ++i)
    if (found[i].phase - found[i - 1].phase < same_phase)
      throw InvalidInput("two images in the folder are of the phase " + percent_of_cycle(found[i].phase) +
                         ": keep one of them there");
  return found;
}

PhaseImage read_phase_image(const PhaseSource& source, const core::TaskContext& task) {
  imaging::ImageVolume volume = source.series ? imaging::read_dicom_series(*source.series, {}, task).volume
                                              : imaging::read_image(source.file, task).volume;
  return {std::make_shared<const imaging::ImageVolume>(std::move(volume)), source.phase};
}

PhaseImages::PhaseImages(std::vector<PhaseSource> sources, std::size_t budget_bytes)
    : sources_(std::move(sources)),
      budget_(budget_bytes),
      held_(sources_.size()),
      failed_(sources_.size(), false) {
  if (sources_.empty()) throw InvalidInput("there are no images of phases");
}

std::vector<std::size_t> PhaseImages::by_distance(double phase) const {
  std::vector<std::size_t> order(sources_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return phase_distance(sources_[a].phase, phase) < phase_distance(sources_[b].phase, phase);
  });
  return order;
}

std::size_t PhaseImages::nearest(double phase) const {
  return by_distance(phase).front();
}

std::optional<std::size_t> PhaseImages::wanted(double phase) const {
  std::size_t room = budget_;
  bool first = true;
  for (const std::size_t source : by_distance(phase)) {
    if (failed_[source]) continue;
    const std::size_t needs = held_[source] ? bytes_of(*held_[source]->volume) : one_image_;
    if (!first && needs > room) return std::nullopt;
    if (!held_[source]) return source;
    room -= std::min(room, needs);
    first = false;
  }
  return std::nullopt;
}

void PhaseImages::take(std::size_t source, PhaseImage image, double phase) {
  one_image_ = std::max(one_image_, bytes_of(*image.volume));
  held_[source] = std::make_shared<const PhaseImage>(std::move(image));
  std::size_t room = budget_;
  bool first = true;
  for (const std::size_t one : by_distance(phase)) {
    if (!held_[one]) continue;
    const std::size_t needs = bytes_of(*held_[one]->volume);
    if (!first && needs > room) {
      held_[one].reset();
      continue;
    }
    room -= std::min(room, needs);
    first = false;
  }
}

std::size_t PhaseImages::bytes() const {
  std::size_t sum = 0;
  for (const auto& one : held_)
    if (one) sum += bytes_of(*one->volume);
  return sum;
}

}  // namespace ostia::session
