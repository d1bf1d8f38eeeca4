#include "ostia/evaluation/suite_report.h"

#include "suite_files.h"
#include "suite_pictures.h"

#include "ostia/core/error.h"
#include "ostia/core/log.h"
#include "ostia/core/text.h"
#include "ostia/figure/html_report.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace ostia::evaluation {
namespace {

namespace fs = std::filesystem;

constexpr FindingKind shown_kinds[] = {FindingKind::regression, FindingKind::missing,
                                       FindingKind::improvement, FindingKind::change, FindingKind::extra};

std::string text_of(const std::optional<double>& value) {
  return value ? core::significant_text(*value, 5) : std::string();
}

void add_verdict(figure::HtmlReport& page, const SuiteResult& suite) {
  page.section("Verdict");
  if (suite.passed()) {
    page.notice(figure::Notice::good,
                "Passed: nothing is worse than its tolerance allows, nothing is missing.");
  } else {
    page.notice(figure::Notice::bad,
                "Not passed: " + std::to_string(suite.count(FindingKind::regression)) + " regressions, " +
                    std::to_string(suite.count(FindingKind::missing)) + " missing. A person must look.");
  }
  std::vector<std::pair<std::string, std::string>> rows{
      {"files compared", std::to_string(suite.files.size())},
      {"figures compared", std::to_string(suite.figures)}};
  for (const FindingKind kind : shown_kinds)
    rows.emplace_back(name_of(kind), std::to_string(suite.count(kind)));
  page.key_values(rows);
  page.paragraph(
      "regression: worse than the tolerance allows, or unreadable. missing: the golden run has it, the "
      "result "
      "has not. improvement: better by more than the tolerance. change: a text differs. extra: only the "
      "result has it. The first two fail the comparison.");
}

void add_findings(figure::HtmlReport& page, const SuiteResult& suite, std::size_t most) {
  page.section("Findings");
  if (suite.findings.empty()) return page.paragraph("None.");
  std::vector<std::vector<std::string>> rows;
  for (const Finding& f : suite.findings) {
    if (rows.size() == most) break;
    rows.push_back({name_of(f.kind), f.file, f.key, text_of(f.golden), text_of(f.result),
                    f.golden && f.result ? text_of(f.allowed) : std::string(), f.text});
  }
  page.table({"kind", "file", "key", "golden", "result", "allowed", "what"}, rows);
  if (suite.findings.size() > most)
    page.notice(figure::Notice::note, std::to_string(suite.findings.size() - most) +
                                          " further findings are left out here; suite.json has them all.");
}

std::string worst_of(const ComparedFile& file) {
  const FigurePair* worst = nullptr;
  double largest = -1.0;
  for (const FigurePair& f : file.figures) {
    const double share = std::abs(f.result - f.golden) / std::max(f.allowed, 1e-12);
    if (share > largest) {
      largest = share;
      worst = &f;
    }
  }
  return worst ? worst->key + ": " + text_of(worst->golden) + " / " + text_of(worst->result) : std::string();
}

void add_files(figure::HtmlReport& page, const SuiteResult& suite) {
  page.section("Files");
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < suite.files.size(); ++i) {
    const ComparedFile& file = suite.files[i];
    rows.push_back({std::to_string(i + 1), file.file, name_of(file.kind), std::to_string(file.figures.size()),
                    worst_of(file), file.differs ? "differs" : "as before"});
  }
  page.table({"no.", "file", "compared as", "figures", "farthest off (golden / result)", "verdict"}, rows,
             "Kind \"other\" is compared by its being there alone.");
}

/// Keys of JSON figures, those with findings first, then those that several files share.
std::vector<std::string> keys_to_plot(const SuiteResult& suite) {
  std::map<std::string, std::size_t> files_with, findings_with;
  for (const ComparedFile& file : suite.files)
    if (file.kind == FileKind::figures)
      for (const FigurePair& f : file.figures) ++files_with[f.key];
  for (const Finding& f : suite.findings)
    if (f.golden && f.result && files_with.contains(f.key)) ++findings_with[f.key];
  std::vector<std::string> keys;
  for (const auto& item : files_with) keys.push_back(item.first);
  const auto count = [](const auto& map, const std::string& key) {
    const auto found = map.find(key);
    return found == map.end() ? std::size_t{0} : found->second;
  };
  std::stable_sort(keys.begin(), keys.end(), [&](const std::string& a, const std::string& b) {
    const auto fa = count(findings_with, a), fb = count(findings_with, b);
    if (fa != fb) return fa > fb;
    return count(files_with, a) > count(files_with, b);
  });
  return keys;
}

void add_plots(figure::HtmlReport& page, const SuiteResult& suite, const SuiteReportOptions& options) {
  const std::vector<std::string> keys = keys_to_plot(suite);
  if (keys.empty()) return;
  page.section("Figures, golden against result");
  std::vector<figure::Picture> panels;
  std::string legend;
  for (std::size_t i = 0; i < std::min(keys.size(), options.most_plots); ++i) {
    std::vector<const ComparedFile*> files;
    for (const ComparedFile& file : suite.files) {
      const bool has = std::any_of(file.figures.begin(), file.figures.end(),
                                   [&](const FigurePair& f) { return f.key == keys[i]; });
      if (has && file.kind == FileKind::figures) files.push_back(&file);
    }
    panels.push_back(figure_plot(keys[i], files));
  }
  for (std::size_t first = 0; first < panels.size(); first += 4) {
    const auto end = std::min(first + 4, panels.size());
    const std::vector<figure::Picture> row(panels.begin() + static_cast<std::ptrdiff_t>(first),
                                           panels.begin() + static_cast<std::ptrdiff_t>(end));
    page.picture(figure::grid(row, {.columns = 2, .look = figure::Look::light}),
                 "Each place along x is a file that has the figure; bars are what is allowed.");
  }
  if (keys.size() > panels.size())
    page.paragraph(std::to_string(keys.size() - panels.size()) + " further figures are not plotted.");
}

/// How far off a file is, as a share of what is allowed.
double excess(const ComparedFile& file) {
  double largest = 0.0;
  for (const FigurePair& f : file.figures)
    largest = std::max(largest, std::abs(f.result - f.golden) / std::max(f.allowed, 1e-9));
  return largest;
}

std::vector<const ComparedFile*> files_to_show(const SuiteResult& suite) {
  std::vector<const ComparedFile*> files;
  for (const ComparedFile& file : suite.files) {
    const bool shape = file.kind != FileKind::figures && file.kind != FileKind::other;
    if (shape && !file.figures.empty() && excess(file) > 1e-6) files.push_back(&file);
  }
  std::stable_sort(files.begin(), files.end(),
                   [](const auto* a, const auto* b) { return excess(*a) > excess(*b); });
  return files;
}

void add_pictures(figure::HtmlReport& page, const SuiteResult& suite, const fs::path& golden,
                  const fs::path& result, const SuiteReportOptions& options, const core::TaskContext& task) {
  const std::vector<const ComparedFile*> files = files_to_show(suite);
  if (files.empty()) return;
  page.section("Where shapes and images differ");
  const std::size_t shown = std::min(files.size(), options.most_pictures);
  for (std::size_t i = 0; i < shown; ++i) {
    task.throw_if_cancelled();
    task.set_stage("picture of " + files[i]->file);
    task.set_progress(static_cast<double>(i) / static_cast<double>(shown));
    page.subsection(files[i]->file);
    try {
      const FilePair pair{files[i]->file, golden / files[i]->file, result / files[i]->file};
      for (const CaptionedPicture& p : pictures_of(pair, files[i]->kind, task))
        page.picture(p.picture, p.caption, {}, 1.5);
    } catch (const InvalidInput& failure) {
      page.notice(figure::Notice::warning, std::string("no picture: ") + failure.what());
    }
  }
  if (files.size() > shown)
    page.paragraph(std::to_string(files.size() - shown) + " further files that differ are not shown.");
}

}  // namespace

void write_suite_report(const fs::path& page_path, const SuiteResult& suite, const fs::path& golden,
                        const fs::path& result, const SuiteReportOptions& options,
                        const core::TaskContext& task) {
  figure::HtmlReport page("Comparison of two runs", std::string("Golden run against result; ") +
                                                        (suite.passed() ? "passed" : "not passed"));
  add_verdict(page, suite);
  add_findings(page, suite, options.most_rows);
  add_files(page, suite);
  add_plots(page, suite, options);
  add_pictures(page, suite, golden, result, options, task);
  page.write(page_path);
  task.set_progress(1.0);
}

}  // namespace ostia::evaluation
