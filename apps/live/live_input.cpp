#include "live_input.h"

#include "ostia/core/error.h"
#include "ostia/glview/sample_motion.h"
#include "ostia/io/cage_motion_file.h"
#include "ostia/io/surface_file.h"
#include "ostia/io/wfdb_file.h"
#include "ostia/motion/r_peaks.h"

#include <algorithm>
#include <charconv>

namespace ostia::live {
namespace {

namespace fs = std::filesystem;

constexpr double learning_s = 10.0;

void read_model(const Options& options, LiveInput& input) {
  if (options.motion.empty()) {
    glview::SampleHeart heart = glview::sample_heart();
    input.surface = std::move(heart.surface);
    input.motion = std::move(heart.motion);
    return;
  }
  const fs::path file = motion_file(options);
  io::CageMotionFile motion = io::read_cage_motion(file);
  fs::path surface = options.surface;
  if (surface.empty()) {
    if (motion.surface.empty())
      throw InvalidInput(file.string() + " names no surface: give the template with --template");
    surface = file.parent_path() / motion.surface;
  }
  io::LoadedSurface loaded = io::read_surface(surface);
  input.surface = std::move(loaded.surface.mesh);
  input.warnings = std::move(loaded.warnings);
  input.motion = std::move(motion.motion);
}

std::string names_of(const geometry::EcgRecord& record) {
  std::string names;
  for (std::size_t i = 0; i < record.leads.size(); ++i)
    names += (i == 0 ? "" : ", ") + std::to_string(i + 1) +
             (record.leads[i].name.empty() ? "" : " (" + record.leads[i].name + ")");
  return names;
}

std::size_t lead_of(const geometry::EcgRecord& record, const std::string& wanted) {
  if (wanted.empty()) return motion::clearest_lead(record);
  for (std::size_t i = 0; i < record.leads.size(); ++i)
    if (record.leads[i].name == wanted) return i;
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(wanted.data(), wanted.data() + wanted.size(), number);
  if (error == std::errc() && end == wanted.data() + wanted.size() && number >= 1 &&
      number <= record.leads.size())
    return number - 1;
  throw UsageError("--lead: the record has no lead \"" + wanted + "\"; it has " + names_of(record));
}

void read_ecg(const Options& options, LiveInput& input) {
  if (options.ecg.empty()) return;
  try {
    io::WfdbRecord file = io::read_wfdb(options.ecg);
    for (std::string& warning : file.warnings) input.warnings.push_back(std::move(warning));
    const std::size_t lead = lead_of(file.record, options.lead);
    const motion::RPeakDetector can_be_followed(file.record.samples_per_second);
    input.ecg = LiveEcg{std::move(file.record.leads[lead]), file.record.samples_per_second};
  } catch (const UsageError&) {
    throw;
  } catch (const Error& error) {
    input.ecg_failed = true;
    input.warnings.push_back(std::string(error.what()) + "; the tree beats without an electrocardiogram");
  }
}

}  // namespace

fs::path motion_file(const Options& options) {
  return fs::is_directory(options.motion) ? options.motion / "motion.json" : options.motion;
}

LiveInput read_input(const Options& options) {
  LiveInput input;
  read_model(options, input);
  read_ecg(options, input);
  return input;
}

double first_picture_s(const LiveInput& input, const Options& options) {
  if (options.phase || !input.ecg || options.start_s > 0.0) return options.start_s;
  const double length =
      static_cast<double>(input.ecg->lead.values.size()) / std::max(1e-9, input.ecg->samples_per_second);
  return std::min(learning_s, 0.5 * length);
}

}  // namespace ostia::live
