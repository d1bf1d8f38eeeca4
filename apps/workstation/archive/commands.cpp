#include "archive/commands.h"

#include "archive/dialog.h"
#include "archive/keyring.h"
#include "archive/outbox.h"
#include "archive/servers.h"
#include "commands/table.h"
#include "shell/desk.h"
#include "shell/one_dialog.h"

#include "ostia/core/error.h"

#include <QMessageBox>
#include <functional>
#include <optional>

namespace ostia::workstation {
namespace {

using Servers = std::vector<pacs::ServerDescription>;

/// A file that cannot be read is told, and left as it is.
std::optional<Servers> readable_servers(Desk& desk, const QString& title) {
  try {
    return known_servers();
  } catch (const Error& error) {
    QMessageBox::information(&desk.window, title, QString::fromStdString(error.what()));
    return std::nullopt;
  }
}

void edit_servers(Desk& desk, Keyring& keyring) {
  if (const auto servers = readable_servers(desk, ServersDialog::tr("PACS servers")))
    show_one<ServersDialog>(desk.window, *servers, keyring, desk);
}

/// Without any, those are asked for.
void with_servers(Desk& desk, Keyring& keyring, const QString& title,
                  const std::function<void(const Servers&)>& then) {
  const auto servers = readable_servers(desk, title);
  if (!servers) return;
  if (servers->empty())
    show_one<ServersDialog>(desk.window, *servers, keyring, desk);
  else
    then(*servers);
}

}  // namespace

void add_archive_commands(CommandTable& table, Desk& desk, Opening& opening, Outbox& outbox,
                          Keyring& keyring) {
  table.add({.id = "file.archive",
             .text = Command::tr("From the &PACS\u2026"),
             .tip = Command::tr("Searches in an image archive and opens a series from it."),
             .run = [&] {
               with_servers(desk, keyring, Command::tr("From the PACS"), [&](const Servers& servers) {
                 show_one<ArchiveDialog>(desk.window, servers, keyring, desk, opening);
               });
             }});
  table.add(
      {.id = "file.send",
       .text = Command::tr("&Send to the PACS\u2026"),
       .tip = Command::tr("Sends the case's segmentation, report, measurements, surface and key images."),
       .run =
           [&] {
             with_servers(desk, keyring, Command::tr("Send to the PACS"), [&](const Servers& servers) {
               show_one<SendDialog>(desk.window, servers, outbox, desk);
             });
           },
       .enabled = [&outbox] { return outbox.why_not().isEmpty(); },
       .why_not = [&outbox] { return outbox.why_not(); }});
  table.add({.id = "file.outbox",
             .text = Command::tr("&Outbox\u2026"),
             .tip = Command::tr("What waits to be sent to the PACS, and why it was not."),
             .run = [&] { show_one<OutboxDialog>(desk.window, outbox, desk); }});
  table.add({.id = "file.servers",
             .text = Command::tr("S&ervers\u2026"),
             .tip = Command::tr("Which image archives there are, and how each is reached."),
             .run = [&] { edit_servers(desk, keyring); }});
}

}  // namespace ostia::workstation
