#include "archive/commands.h"

#include "archive/dialog.h"
#include "archive/keyring.h"
#include "commands/table.h"
#include "shell/desk.h"
#include "shell/one_dialog.h"

#include "ostia/core/error.h"
#include "ostia/pacs/server.h"

#include <QMessageBox>

namespace ostia::workstation {
namespace {

void ask_archive(Desk& desk, Opening& opening, Keyring& keyring) {
  const std::filesystem::path file = pacs::default_servers_file();
  std::vector<pacs::ServerDescription> servers;
  QString reason;
  try {
    if (std::filesystem::exists(file)) servers = pacs::read_servers(file);
  } catch (const Error& error) {
    reason = QString::fromStdString(error.what());
  }
  if (!servers.empty()) return show_one<ArchiveDialog>(desk.window, servers, keyring, desk, opening);
  const QString none = Command::tr("No server is described yet. The manual tells what stands in the file %1.")
                           .arg(QString::fromStdString(file.string()));
  QMessageBox::information(&desk.window, Command::tr("From the PACS"), reason.isEmpty() ? none : reason);
}

}  // namespace

void add_archive_commands(CommandTable& table, Desk& desk, Opening& opening, Keyring& keyring) {
  table.add({.id = "file.archive",
             .text = Command::tr("From the &PACS\u2026"),
             .tip = Command::tr("Searches in an image archive and opens a series from it."),
             .run = [&] { ask_archive(desk, opening, keyring); }});
}

}  // namespace ostia::workstation
