#pragma once
/// \file The commands of the image archive.

namespace ostia::workstation {

class CommandTable;
struct Desk;
class Keyring;
class Opening;
class Outbox;

void add_archive_commands(CommandTable& table, Desk& desk, Opening& opening, Outbox& outbox,
                          Keyring& keyring);

}  // namespace ostia::workstation
