#include "same_content.h"

#include "store.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"

#include <nlohmann/json.hpp>

#include <vector>

namespace ostia::cohort {
namespace fs = std::filesystem;
namespace {

using nlohmann::json;

constexpr const char* times_of_steps = "step_stamp";  // of a case: docs/reference/case-file.md

std::string content_of_table(const Store& store, const std::string& name) {
  std::string quoted;
  for (const char c : name) quoted += c == '"' ? "\"\"" : std::string(1, c);
  Query rows(store, ("SELECT * FROM \"" + quoted + "\"").c_str());
  std::string digest;
  while (rows.step()) {
    std::string row;
    for (int i = 0; i < rows.columns(); ++i) {
      row += std::to_string(rows.type(i)) + ":";  // before its value is asked for as a text
      row += core::sha256(rows.text(i));
    }
    digest = core::sha256(digest + row);
  }
  return digest;
}

std::string content_of_case(const fs::path& file) {
  const Store store(file, Store::Mode::read);
  std::vector<std::pair<std::string, std::string>> tables;
  {
    Query known(store, "SELECT type, name, coalesce(sql, '') FROM sqlite_master ORDER BY type, name");
    while (known.step()) tables.emplace_back(known.text(0) == "table" ? known.text(1) : "", known.text(2));
  }
  std::string content;
  for (const auto& [table, sql] : tables) {
    content += sql + "\n";
    if (!table.empty() && table != times_of_steps) content += content_of_table(store, table) + "\n";
  }
  return content;
}

void leave_times_out(json& value) {
  if (value.is_object())
    for (const char* name : {"seconds", "peak_mb", "finished", "inputs", "key"}) value.erase(name);
  if (value.is_structured())
    for (json& one : value) leave_times_out(one);
}

std::string content_of_manifest(const fs::path& file) {
  json manifest = json::parse(core::read_file(file));
  leave_times_out(manifest);
  return manifest.dump();
}

}  // namespace

bool holds_times(const std::string& name) {
  return name.ends_with(".ostia") || fs::path(name).filename() == "manifest.json";
}

bool same_but_for_times(const fs::path& one, const fs::path& other) {
  try {
    return one.extension() == ".ostia" ? content_of_case(one) == content_of_case(other)
                                       : content_of_manifest(one) == content_of_manifest(other);
  } catch (const Error&) {
    return false;
  } catch (const json::exception&) {
    return false;
  }
}

}  // namespace ostia::cohort
