#include "ostia/experiments/extraction.h"

#include "ostia/core/error.h"
#include "ostia/imaging/image_file.h"
#include "ostia/pipeline/manifest.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace ostia::experiments {
namespace fs = std::filesystem;
namespace {

using Clock = std::chrono::steady_clock;

ExtractionRun run_case(const fs::path& folder, const ExtractionScoreOptions& options,
                       const core::TaskContext& task) {
  const ExtractionTruth truth = read_extraction_truth(folder);
  const imaging::ImageVolume image = imaging::read_image(image_of_case(folder)).volume;
  const auto start = Clock::now();
  const auto timed = [&](ExtractionRun run, double seconds, double peak_mb) {
    run.seconds = seconds;
    run.peak_mb = peak_mb;
    return run;
  };
  const auto passed = [&] { return std::chrono::duration<double>(Clock::now() - start).count(); };
  const auto failed = [&](const char* why) {
    return timed(score_of_no_extraction(truth, why), passed(), pipeline::peak_memory_mb());
  };
  try {
    const session::FoundModel found = session::found_model(image, {}, task.sub(0.0, 0.5));
    const double seconds = passed(), peak_mb = pipeline::peak_memory_mb();
    task.set_stage(truth.case_name + ": scores");
    return timed(score_extraction(truth, found, options, task.sub(0.5, 1.0)), seconds, peak_mb);
  } catch (const GeometryError& error) {
    return failed(error.what());
  } catch (const InvalidInput& error) {  // a model whose wall cannot be solved
    return failed(error.what());
  }
}

}  // namespace

void validate(const ExtractionScoreOptions& options) {
  if (!(options.astray_mm > 0.0 && options.astray_mm <= 20.0))
    throw InvalidInput("extraction experiment: a found axis is astray from 0 to 20 mm outside of a lumen");
  if (!(options.threshold > 0.0 && options.threshold < 1.0))
    throw InvalidInput("extraction experiment: the threshold of stenoses lies between 0 and 1");
}

std::vector<fs::path> cases_of_suite(const fs::path& suite) {
  std::vector<fs::path> cases;
  if (fs::is_directory(suite)) {
    for (const auto& entry : fs::directory_iterator(suite))
      if (entry.is_directory() && entry.path().filename().string().starts_with("dataset"))
        cases.push_back(entry.path());
  }
  if (cases.empty())
    throw InvalidInput(suite.filename().string() +
                       " holds no dataset folders; make a suite by `ostia phantom -o DIR --cases 18 "
                       "--preset full --formats nrrd`");
  std::sort(cases.begin(), cases.end());
  return cases;
}

fs::path image_of_case(const fs::path& folder) {
  std::vector<fs::path> images;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string ending = entry.path().extension().string();
    if (entry.path().filename().string().starts_with("image") && (ending == ".nrrd" || ending == ".mhd"))
      images.push_back(entry.path());
  }
  if (images.empty())
    throw InvalidInput(folder.filename().string() +
                       " holds no image (image*.nrrd or .mhd): make the suite without --truth-only and with "
                       "--formats nrrd");
  return *std::min_element(images.begin(), images.end());
}

std::string name_of(NameVerdict verdict) {
  switch (verdict) {
    case NameVerdict::right:
      return "right";
    case NameVerdict::wrong:
      return "wrong";
    case NameVerdict::unnamed:
      return "unnamed";
    case NameVerdict::missing:
      break;
  }
  return "missing";
}

std::vector<ExtractionRun> extract_suite(const fs::path& suite, const ExtractionScoreOptions& options,
                                         const core::TaskContext& task) {
  validate(options);
  const std::vector<fs::path> cases = cases_of_suite(suite);
  for (const fs::path& one : cases) image_of_case(one);  // before hours of work
  std::vector<ExtractionRun> runs;
  const double count = static_cast<double>(cases.size());
  for (const fs::path& one : cases) {
    const double done = static_cast<double>(runs.size());
    task.throw_if_cancelled();
    task.set_stage(one.filename().string());
    runs.push_back(run_case(one, options, task.sub(done / count, (done + 1.0) / count)));
  }
  return runs;
}

ExtractionSummary summarize(const std::vector<ExtractionRun>& runs, const ExtractionScoreOptions& options) {
  ExtractionSummary out;
  std::vector<evaluation::CenterlineScores> annotated, all;
  std::vector<evaluation::SectionScore> healthy, diseased;
  std::vector<evaluation::Lesion> lesions, found_lesions;
  const auto add = [](std::vector<evaluation::Lesion>& to, const std::vector<evaluation::Lesion>& from,
                      const std::string& case_name) {
    for (evaluation::Lesion lesion : from) {
      lesion.vessel = case_name + " " + lesion.vessel;
      to.push_back(std::move(lesion));
    }
  };
  for (const ExtractionRun& run : runs) {
    for (const VesselRun& vessel : run.vessels) {
      all.push_back(vessel.scores);
      if (vessel.annotated) annotated.push_back(vessel.scores);
      out.right += vessel.verdict == NameVerdict::right ? 1 : 0;
      out.wrong += vessel.verdict == NameVerdict::wrong ? 1 : 0;
      out.unnamed += vessel.verdict == NameVerdict::unnamed ? 1 : 0;
      out.missing += vessel.verdict == NameVerdict::missing ? 1 : 0;
    }
    for (const evaluation::SectionScore& score : run.sections)
      (score.health == geometry::Health::diseased ? diseased : healthy).push_back(score);
    add(lesions, run.lesions, run.case_name);
    add(found_lesions, run.found_lesions, run.case_name);
    out.found_mm += run.found_mm;
    out.astray_mm += run.astray_mm;
    out.most_seconds = std::max(out.most_seconds, run.seconds);
    out.most_mb = std::max(out.most_mb, run.peak_mb);
  }
  if (!annotated.empty()) out.annotated = evaluation::mean_scores(annotated);
  if (!all.empty()) out.all = evaluation::mean_scores(all);
  out.healthy = evaluation::summarize(healthy);
  out.diseased = evaluation::summarize(diseased);
  out.stenoses = evaluation::detect_lesions(lesions, found_lesions, options.threshold);
  return out;
}

}  // namespace ostia::experiments
