#pragma once
/// \file What an experiment writes, held against its schema.

#include "schema_rules.h"

#include <gtest/gtest.h>

#include <string>

namespace ostia::experiments {

/// Whether `text` is a document of experiment-NAME.schema.json, and is none any more once a field is missing.
inline ::testing::AssertionResult fits_schema(const std::string& text, const std::string& name) {
  using session::testing::Json;
  const std::string file = "experiment-" + name + ".schema.json";
  const session::testing::Schema rules(file);
  Json whole = Json::parse(core::read_file(std::filesystem::path(OSTIA_SCHEMAS) / file));
  for (const char* about : {"$schema", "$id", "title", "$defs"}) whole.erase(about);
  const Json written = Json::parse(text);
  if (!rules.is_valid(whole, written)) return ::testing::AssertionFailure() << "is no " << file;
  for (const Json& one : whole.at("required")) {
    const auto field = one.get<std::string>();
    Json broken = written;
    broken.erase(field);
    if (rules.is_valid(whole, broken))
      return ::testing::AssertionFailure() << file << " does not miss " << field;
  }
  return ::testing::AssertionSuccess();
}

}  // namespace ostia::experiments
