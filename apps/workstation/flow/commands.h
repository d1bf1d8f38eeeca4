#pragma once
/// \file Commands about blood flow: cases for solvers, and their results.

namespace ostia::workstation {

class CommandTable;
struct Desk;
class FlowCases;
class FlowResults;

void add_flow_commands(CommandTable& table, const Desk& desk, FlowCases& cases, FlowResults& results);

}  // namespace ostia::workstation
