// What a comparison of two runs says, as JSON and for the terminal.

#include "ostia/evaluation/suite.h"

#include <nlohmann/json.hpp>

#include <cmath>

namespace ostia::evaluation {
namespace {

using SuiteJson = nlohmann::ordered_json;

constexpr FindingKind kinds[] = {FindingKind::regression, FindingKind::missing, FindingKind::improvement,
                                 FindingKind::change, FindingKind::extra};

SuiteJson number(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? SuiteJson(*value) : SuiteJson(nullptr);
}

const char* name_of_direction(Direction direction) {
  static constexpr const char* names[] = {"higher_is_better", "lower_is_better", "two_sided"};
  return names[static_cast<int>(direction)];
}

}  // namespace

std::string suite_json(const SuiteResult& result) {
  SuiteJson out{{"v", 1},
                {"passed", result.passed()},
                {"files_compared", result.files.size()},
                {"figures_compared", result.figures}};
  for (const FindingKind kind : kinds) out["counts"][name_of(kind)] = result.count(kind);
  out["findings"] = SuiteJson::array();
  for (const Finding& f : result.findings)
    out["findings"].push_back({{"kind", name_of(f.kind)},
                               {"file", f.file},
                               {"key", f.key},
                               {"golden", number(f.golden)},
                               {"result", number(f.result)},
                               {"allowed", f.allowed},
                               {"text", f.text}});
  out["files"] = SuiteJson::array();
  for (const ComparedFile& file : result.files) {
    SuiteJson one{{"file", file.file},
                  {"kind", name_of(file.kind)},
                  {"differs", file.differs},
                  {"figures", SuiteJson::array()}};
    for (const FigurePair& f : file.figures)
      one["figures"].push_back({{"key", f.key},
                                {"golden", number(f.golden)},
                                {"result", number(f.result)},
                                {"allowed", f.allowed},
                                {"direction", name_of_direction(f.direction)}});
    out["files"].push_back(std::move(one));
  }
  return out.dump(2) + "\n";
}

std::string suite_text(const SuiteResult& result) {
  std::string out = std::to_string(result.files.size()) + " files with " + std::to_string(result.figures) +
                    " figures compared: ";
  for (const FindingKind kind : kinds)
    out += (kind == FindingKind::regression ? "" : ", ") + std::to_string(result.count(kind)) + " " +
           name_of(kind);
  out += result.passed() ? "; passed\n" : "; NOT passed\n";
  for (const Finding& f : result.findings) {
    std::string kind = name_of(f.kind);
    kind.resize(12, ' ');
    out += kind + f.file + (f.key.empty() ? "" : "  " + f.key) + ": " + f.text + "\n";
  }
  return out;
}

}  // namespace ostia::evaluation
