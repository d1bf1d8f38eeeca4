#include "convert/filter.h"
#include "convert/filter_list.h"
#include "options/model_options.h"
#include "output/outputs.h"
#include "output/refusal.h"
#include "output/told.h"

#include "ostia/core/log.h"
#include "ostia/core/text.h"
#include "ostia/dicom/label_object.h"
#include "ostia/filtering/filter.h"
#include "ostia/imaging/image_file.h"
#include "ostia/pipeline/source.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Validators.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>

namespace ostia::app {
namespace {

using filtering::FilterStep;
using imaging::FloatVolume;

struct FilterInput {
  FloatVolume image;
  bool whole = false;  ///< its file holds whole numbers
};

template <class T>
FilterInput floats_of(const imaging::Volume<T>& image) {
  return {{image.geometry, {image.voxels.begin(), image.voxels.end()}}, true};
}

bool is_whole(const imaging::ImageHeader& header) {
  const bool fractions =
      header.pixel_type == imaging::PixelType::float32 || header.pixel_type == imaging::PixelType::float64;
  return !fractions && header.slope == std::round(header.slope) &&
         header.intercept == std::round(header.intercept);
}

FilterInput read_filter_input(const InputOptions& input, const core::TaskContext& task) {
  const pipeline::SourceKind kind = pipeline::classify(input.input);
  if (kind == pipeline::SourceKind::surface)
    throw InvalidInput("cannot filter " + input.input.string() + ": it is a surface and no image");
  if (kind == pipeline::SourceKind::dicom) {
    const pipeline::Source source = pipeline::load_ct(input.input, source_options(input), task);
    for (const std::string& warning : source.warnings) core::log_warning(warning);
    return floats_of(*source.image);
  }
  if (dicom::label_object_in(input.input)) return floats_of(dicom::read_labels(input.input, task).volume);
  auto loaded = imaging::read_float_image(input.input, task);
  for (const std::string& warning : loaded.header.warnings) core::log_warning(warning);
  return {std::move(loaded.volume), is_whole(loaded.header)};
}

std::vector<FilterStep> steps_of(const std::vector<std::string>& texts) {
  if (texts.empty()) throw UsageError("--with names no filter; `ostia filter --list` shows all");
  std::vector<FilterStep> steps;
  for (const std::string& text : texts) {
    try {
      steps.push_back(filtering::step_of_text(text));
    } catch (const InvalidInput& wrong) {
      throw UsageError(std::string("--with: ") + wrong.what());
    }
  }
  return steps;
}

/// What is stored where nothing is asked for: masks and few labels as bytes, what was whole numbers in its
/// own unit as such, all else as it is.
std::string type_of(const filtering::Filtered& done, bool whole) {
  if (done.values == filtering::Result::own) return "float32";
  const auto [least, most] = std::minmax_element(done.image.voxels.begin(), done.image.voxels.end());
  if (done.values != filtering::Result::same && *most <= 255.0F) return "uint8";
  if (done.values == filtering::Result::same && !whole) return "float32";
  return *least >= -32768.5F && *most <= 32767.5F ? "int16" : "float32";
}

template <class T>
imaging::Volume<T> rounded_to(const FloatVolume& image) {
  constexpr double lowest = std::numeric_limits<T>::min(), highest = std::numeric_limits<T>::max();
  imaging::Volume<T> out{image.geometry, std::vector<T>(image.voxels.size())};
  std::size_t cut = 0;
  for (std::size_t i = 0; i < out.voxels.size(); ++i) {
    const double nearest = std::round(static_cast<double>(image.voxels[i]));
    cut += nearest < lowest || nearest > highest ? 1 : 0;
    out.voxels[i] = static_cast<T>(std::clamp(nearest, lowest, highest));
  }
  if (cut > 0) core::log_warning(counted(cut, "value") + " beyond the type of the output became its bounds");
  return out;
}

void write_filtered(const std::filesystem::path& file, const std::string& type, const FloatVolume& image) {
  if (type == "uint8") return imaging::write_image(file, rounded_to<std::uint8_t>(image));
  if (type == "int16") return imaging::write_image(file, rounded_to<std::int16_t>(image));
  imaging::write_image(file, image);
}

void tell_filtered(const FilterCommand& c, const std::vector<FilterStep>& steps,
                   const filtering::Filtered& done, const std::string& type, double memory_mb) {
  const imaging::Geometry& grid = done.image.geometry;
  ToldJson texts = ToldJson::array();
  for (const FilterStep& step : steps) texts.push_back(filtering::text_of(step));
  const auto [least, most] = std::minmax_element(done.image.voxels.begin(), done.image.voxels.end());
  std::string line = counted(steps.size(), "filter") + ", " + type + ", values from " +
                     core::significant_text(static_cast<double>(*least), 6) + " to " +
                     core::significant_text(static_cast<double>(*most), 6);
  if (!done.unit.empty()) line += " (" + done.unit + ")";
  tell("filter",
       {{"steps", texts},
        {"size", grid.size},
        {"spacing_mm", {grid.spacing.x(), grid.spacing.y(), grid.spacing.z()}},
        {"values", name_of(done.values)},
        {"unit", done.unit},
        {"type", type},
        {"least", *least},
        {"largest", *most},
        {"memory_mb", std::round(memory_mb)}},
       line, c.json);
}

ExitCode list_filters(const FilterCommand& c) {
  if (!c.input.input.empty() || !c.output.empty() || !c.with.empty())
    throw UsageError("--list goes alone, or with --json");
  std::fputs((c.json ? filters_json() : filters_text()).c_str(), stdout);
  return ExitCode::ok;
}

}  // namespace

ExitCode run_filter(const FilterCommand& c, const core::TaskContext& task) {
  if (c.list) return list_filters(c);
  if (c.input.input.empty() || c.output.empty())
    throw UsageError("an image and an output (-o) are needed, or --list");
  const std::vector<FilterStep> steps = steps_of(c.with);
  require_output(c.output, image_outputs);
  task.set_stage("reading");
  FilterInput input = read_filter_input(c.input, task.sub(0.0, 0.15));
  std::optional<imaging::MaskVolume> mask;
  std::optional<FloatVolume> reference;
  if (!c.mask.empty()) mask = imaging::read_mask(c.mask, task.sub(0.15, 0.2)).volume;
  if (!c.reference.empty())
    reference =
        read_filter_input({c.reference, {}, false, {}, {}, {}, false, "lps"}, task.sub(0.15, 0.2)).image;
  const filtering::FilterInputs beside{mask ? &*mask : nullptr, reference ? &*reference : nullptr};
  filtering::Filtered done;
  double memory_mb = 0.0;
  naming(c.input.input, [&] {
    memory_mb = static_cast<double>(filtering::memory_needed(input.image.geometry, steps)) / 1048576.0;
    core::log_info("needs about " + core::rounded_text(memory_mb, 0) + " MB for the filters");
    done = filtering::filtered(std::move(input.image), steps, beside, task.sub(0.2, 0.9));
  });
  for (const std::string& warning : done.warnings) core::log_warning(warning);
  const std::string type = c.type == "auto" ? type_of(done, input.whole) : c.type;
  task.set_stage("writing");
  write_filtered(c.output, type, done.image);
  task.set_progress(1.0);
  tell_filtered(c, steps, done, type, memory_mb);
  return ExitCode::ok;
}

void define_filter(CLI::App& app, FilterCommand& c, std::function<ExitCode(const core::TaskContext&)>& run,
                   const std::function<void(CLI::App&, InputOptions&)>& add_dicom) {
  CLI::App* filter = app.add_subcommand("filter", "An image through filters of the Insight Toolkit (ITK)");
  filter->footer(
      "Example:\n"
      "  ostia filter heart.nrrd -o smooth.nrrd --with median:radius_mm=0.8 --with gaussian:sigma_mm=0.5\n"
      "  ostia filter --list");
  filter->fallthrough();
  filter->add_option("IMAGE", c.input.input, "DICOM folder or zip, image or mask");
  add_dicom(*filter, c.input);
  filter->add_option("-o,--output", c.output, ".nrrd, .mhd, .mha, .nii or .nii.gz");
  filter
      ->add_option("--with", c.with,
                   "A filter and what it is told, NAME or NAME:KEY=VALUE,KEY=VALUE; repeat for a chain")
      ->allow_extra_args(false);
  filter->add_option("--mask", c.mask,
                     "Where n4 works, a mask on the image's grid; left out: what is above 0");
  filter->add_option("--reference", c.reference, "The image that match-histogram goes by");
  filter
      ->add_option(
          "--type", c.type,
          "Of the output's voxels. auto: as the input's, bytes for masks and labels, float32 for values "
          "of another unit")
      ->check(CLI::IsMember({"auto", "int16", "uint8", "float32"}));
  filter->add_flag("--list", c.list, "All filters with their parameters, units, bounds and defaults");
  filter->add_flag("--json", c.json, "One JSON object on standard output");
  filter->callback([&] { run = [&](const core::TaskContext& task) { return run_filter(c, task); }; });
}

}  // namespace ostia::app
