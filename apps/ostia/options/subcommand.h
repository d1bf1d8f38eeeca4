#pragma once
/// \file Commands of two words, `ostia pacs find`.

#include "ostia/core/error.h"
#include "ostia/core/task_context.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <functional>
#include <string>

namespace ostia::app {

/// Adds `name` below `above`: `one` runs it, on the `command` that its options fill; with --json.
template <class Command>
CLI::App* add_subcommand_of(CLI::App& above, const char* name, const char* text, const char* example,
                            Command& command, ExitCode (*one)(const Command&, const core::TaskContext&),
                            std::function<ExitCode(const core::TaskContext&)>& run) {
  CLI::App* sub = above.add_subcommand(name, text);
  sub->footer(std::string("Example:\n  ") + example);
  sub->fallthrough();
  sub->callback([&command, &run, one] {
    run = [&command, one](const core::TaskContext& task) { return one(command, task); };
  });
  sub->add_flag("--json", command.json, "One JSON object on standard output");
  return sub;
}

}  // namespace ostia::app
