#pragma once
/// \file Trees and other networks of vessels as inputs: their units, and how they are mended.

#include "commands.h"

#include "ostia/io/graph_file.h"

#include <nlohmann/json_fwd.hpp>

namespace CLI {
class App;
}

namespace ostia::app {

/// `--repair` is declared by the command, which may have surfaces to mend, too.
/// `of_trees` stands before each text where the command has other inputs as well: "Trees: ".
void add_tree_input(CLI::App& app, TreeInputOptions& options, const std::string& of_trees,
                    const std::string& of_repair);

/// Throws UsageError for options of the repair without it.
void require_repair(const TreeInputOptions& options);

/// Lines that run beside each other where vessels share a way (VMTK's, before its branch extractor) become
/// one tree, and this is told: where points at the places of others are the graph's only fault and what comes
/// of joining them is a tree. Any other graph stays as it is.
void join_lines_side_by_side(io::LoadedGraph& loaded, const core::TaskContext& task);
/// The same, with what was done as text, "" for nothing, instead of a line in the log.
std::string joined_side_by_side(io::LoadedGraph& loaded, const core::TaskContext& task);

/// Reads a network, brings it into mm and mends it where that is asked for; warnings go to the log. `done`
/// gets what the repair did. Throws what io::read_graph and geometry::repaired throw.
io::LoadedGraph read_tree(const InputOptions& input, const TreeInputOptions& options,
                          nlohmann::ordered_json& done, const core::TaskContext& task);

}  // namespace ostia::app
