#include "input/edit_script.h"
#include "input/mask_input.h"
#include "options/model_options.h"
#include "output/outputs.h"
#include "output/refusal.h"
#include "vessel/extract.h"

#include "ostia/core/error.h"
#include "ostia/core/log.h"
#include "ostia/imaging/image_axes.h"
#include "ostia/io/centerline_file.h"
#include "ostia/pipeline/source.h"
#include "ostia/session/found_model.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <nlohmann/json.hpp>

#include <cstdio>
#include <memory>

namespace ostia::app {
namespace {

using Json = nlohmann::ordered_json;

void add_certainty(const coronary::VesselCertainty& certainty, Json& vessel) {
  vessel["probability"] = certainty.probability;
  vessel["pieces"] = Json::array();
  for (const coronary::VesselPiece& piece : certainty.pieces)
    vessel["pieces"].push_back(
        {{"from_mm", piece.from_mm}, {"to_mm", piece.to_mm}, {"probability", piece.probability}});
}

Json facts_of(const session::FoundModel& result) {
  Json vessels = Json::array();
  const coronary::Extraction& found = result.found;
  for (std::size_t i = 0; i < found.vessels.tree.vessels.size(); ++i) {
    const geometry::Vessel& vessel = found.vessels.tree.vessels[i];
    const coronary::VesselLabel& label = found.vessels.labels[i];
    vessels.push_back({{"id", vessel.id},
                       {"name", vessel.name},
                       {"likeliest", label.likeliest},
                       {"confidence", label.confidence},
                       {"second", label.second},
                       {"second_confidence", label.second_confidence},
                       {"evidence", found.notes[i].evidence},
                       {"length_mm", geometry::vessel_axis(found.vessels.tree, vessel).abscissa.back()},
                       {"doubt", result.doubts[i]}});
    if (!found.certainty.empty()) add_certainty(found.certainty[i], vessels.back());
  }
  return {{"v", 1},
          {"kind", "extraction"},
          {"ostia", found.ostia.size()},
          {"dominance", coronary::word(found.vessels.dominance)},
          {"vessels", vessels},
          {"left_out", found.left_out},
          {"warnings", found.warnings}};
}

void print_extracted(const Json& facts, bool as_json) {
  if (as_json) {
    std::puts(facts.dump(2).c_str());
    return;
  }
  for (const Json& vessel : facts["vessels"]) {
    const std::string doubt = vessel["doubt"];
    std::printf("%-6s %7.1f mm  %s\n", vessel["name"].get<std::string>().c_str(),
                vessel["length_mm"].get<double>(), doubt.c_str());
  }
  std::printf("%zu ostia, %zu vessels, dominance %s\n", facts["ostia"].get<std::size_t>(),
              facts["vessels"].size(), facts["dominance"].get<std::string>().c_str());
}

/// The probability of each place, for the file of lines.
std::vector<io::AlongVessels> along_of(const coronary::Extraction& found) {
  return {{"Probability", [&found](std::int32_t vessel, double s_mm) {
             return coronary::probability_at(found.certainty, found.vessels.tree, vessel, s_mm);
           }}};
}

/// What is refused is told with the file's name, and with the way out that the command line has.
session::FoundModel found_in(const std::filesystem::path& input, const imaging::ImageVolume& image,
                             const coronary::ExtractOptions& options, const core::TaskContext& task) {
  return naming(
      input, [&] { return session::found_model(image, options, task); },
      " (in the workstation, or `ostia model " + own_name(input) + " -o DIR --branch P:P`)",
      may_be_mask(image) ? "; if it is a mask of vessels, say so by --mask" : "");
}

const char* word(coronary::MaskEndChange::Kind kind) {
  if (kind == coronary::MaskEndChange::Kind::shortened) return "shortened";
  return kind == coronary::MaskEndChange::Kind::left_out ? "left out" : "begun earlier";
}

/// What was joined, parted and shortened, beside the vessels.
Json facts_of(const session::MaskModel& result) {
  Json facts = facts_of(result.found);
  facts["kind"] = "extraction of a mask";
  const auto place = [](const geometry::Vec3& p) { return Json{p.x(), p.y(), p.z()}; };
  facts["bridges"] = Json::array();
  for (const coronary::MaskBridge& bridge : result.tree.bridges)
    facts["bridges"].push_back({{"from", place(bridge.from)},
                                {"to", place(bridge.to)},
                                {"length_mm", bridge.length_mm()},
                                {"probability", bridge.probability},
                                {"to_side", bridge.to_side}});
  facts["cuts"] = Json::array();
  for (const coronary::MaskCut& cut : result.tree.cuts)
    facts["cuts"].push_back({{"place", place(cut.place)}, {"radius_mm", cut.radius_mm}});
  facts["ends"] = Json::array();
  for (const coronary::MaskEndChange& end : result.tree.ends)
    facts["ends"].push_back({{"kind", word(end.kind)},
                             {"place", place(end.place)},
                             {"length_mm", end.length_mm},
                             {"vessel", end.vessel}});
  return facts;
}

ExitCode extract_mask(const ExtractCommand& o, NewCase& made, const core::TaskContext& task) {
  coronary::MaskTreeOptions options;
  options.labels.least_confidence = o.least_confidence;
  const MaskCase found = mask_case({o.input.input, o.of_mask.image, o.of_mask.labels, o.of_mask.mask},
                                   options, task.sub(0.0, 0.98));
  for (const std::string& warning : found.model.found.found.warnings) core::log_warning(warning);
  task.throw_if_cancelled();
  made.make(found.model.found, found.image);
  if (!o.lines.empty()) io::write_centerlines(o.lines, found.model.found.model.tree);
  made.commit();
  task.set_progress(1.0);
  print_extracted(facts_of(found.model), o.json);
  return ExitCode::ok;
}

}  // namespace

ExitCode run_extract(const ExtractCommand& o, const core::TaskContext& task) {
  require_output(o.output, {".ostia"});
  require_output(o.lines, line_outputs);
  NewCase made(o.output);
  if (o.of_mask.mask || holds_labels(o.input.input)) {
    if (!o.axes.empty())
      throw UsageError("--axes is for a CT, and " + own_name(o.input.input) + " is a mask");
    return extract_mask(o, made, task);
  }
  if (!o.of_mask.image.empty() || !o.of_mask.labels.empty())
    throw UsageError("--image and --label are for masks, and " + own_name(o.input.input) +
                     " is a CT; give --mask if it is a mask");
  task.set_stage("reading");
  pipeline::SourceOptions reading = source_options(o.input);
  reading.dicom.assume_axial = !o.axes.empty();
  const pipeline::Source source = pipeline::load_ct(o.input.input, reading, task.sub(0.0, 0.1));
  for (const std::string& warning : source.warnings) core::log_warning(warning);
  coronary::ExtractOptions options;
  options.labels.least_confidence = o.least_confidence;
  if (o.vesselness == "hessian") options.growth.likeness = segmentation::TubeMethod::hessian;
  std::shared_ptr<const imaging::ImageVolume> image = source.image;
  if (!o.axes.empty())
    image = std::make_shared<const imaging::ImageVolume>(imaging::with_axes(*image, o.axes));
  const session::FoundModel result = found_in(o.input.input, *image, options, task.sub(0.1, 0.98));
  for (const std::string& warning : result.found.warnings) core::log_warning(warning);
  task.throw_if_cancelled();
  made.make(result, session::ImageReference{source.sha256, source.pseudonym, o.axes});
  if (!o.lines.empty()) io::write_centerlines(o.lines, result.model.tree, along_of(result.found));
  made.commit();
  task.set_progress(1.0);
  print_extracted(facts_of(result), o.json);
  return result.found.left_out.empty() ? ExitCode::ok : ExitCode::quality_failed;
}

void add_mask(CLI::App& app, MaskOptions& o) {
  app.add_option("--image", o.image, "Of a mask: the CT that it was drawn on");
  app.add_option("--label", o.labels, "Of a mask: the labels that are vessels; left out: all but 0")
      ->check(CLI::PositiveNumber)
      ->delimiter(',');
  app.add_flag("--mask", o.mask, "INPUT is a mask, even if it has the values of a CT or of probabilities");
}

void define_extract(CLI::App& app, ExtractCommand& c, std::function<ExitCode(const core::TaskContext&)>& run,
                    const std::function<void(CLI::App&, InputOptions&)>& add_dicom) {
  CLI::App* extract = app.add_subcommand(
      "extract", "The coronary tree of a CT angiogram, or of a mask of one, by itself: a case to be checked");
  extract->footer(
      "Example:\n  ostia extract CT/ -o heart.ostia\n  ostia extract mask.nii.gz --image ct.nii.gz -o "
      "patient.ostia");
  extract->fallthrough();
  extract->add_option("INPUT", c.input.input, "DICOM folder or zip, image, or mask")->required();
  add_dicom(*extract, c.input);
  extract->add_option("-o,--output", c.output, "Case with labelled, editable vessels, .ostia")->required();
  extract->add_option("--lines", c.lines, "Also the centerlines: .vtp or .csv");
  extract
      ->add_option(
          "--axes", c.axes,
          "What the CT's axes i, j, k rise towards, where its file says it wrongly: a letter each of "
          "L or R, P or A, S or I, such as LPS; the case keeps it")
      ->check([](const std::string& axes) {
        try {
          imaging::validate_axes(axes);
          return std::string();
        } catch (const InvalidInput& error) {
          return std::string(error.what());
        }
      });
  extract
      ->add_option("--least-confidence", c.least_confidence,
                   "A vessel that is named with less keeps a number for its name")
      ->check(CLI::Range(0.0, 1.0));
  extract->add_option("--vesselness", c.vesselness, "How likeness to a tube is measured")
      ->check(CLI::IsMember({"flux", "hessian"}));
  add_mask(*extract, c.of_mask);
  extract->add_flag("--json", c.json, "One JSON object on standard output");
  extract->callback([&] { run = [&](const core::TaskContext& task) { return run_extract(c, task); }; });
}

}  // namespace ostia::app
