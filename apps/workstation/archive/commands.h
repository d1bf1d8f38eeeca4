#pragma once
/// \file The commands of the image archive.

namespace ostia::workstation {

class CommandTable;
struct Desk;
class Keyring;
class Opening;

void add_archive_commands(CommandTable& table, Desk& desk, Opening& opening, Keyring& keyring);

}  // namespace ostia::workstation
