#pragma once
/// \file Whose image is on the table: in the memory of this window and, where the person lets it, in a file
/// of this machine. Never in a case, a log, or what is exported without being asked.

#include "ostia/imaging/series_preview.h"
#include "ostia/session/known_patients.h"
#include "ostia/session/machine_state.h"
#include "ostia/session/workbench.h"

#include <QString>
#include <QStringList>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace ostia::workstation {

/// Of what is known: "Doe, Jane", "4711", "2024-03-01", "CTA 0.6". Empty where it says of nobody.
QStringList identity_parts(const imaging::ShownIdentity& whose);
/// In one line, with dots between.
QString identity_line(const imaging::ShownIdentity& whose);

class Identity {
 public:
  Identity(session::Workbench& bench, session::MachineState& machine, const std::filesystem::path& folder);
  Identity(const Identity&) = delete;
  Identity& operator=(const Identity&) = delete;

  /// Of a series that is being read: it is on the table before its digest is known.
  void expect(const imaging::ShownIdentity& whose);
  /// Of an image that was read. Throws as KnownPatients::remember does, and is known to this window then,
  /// too.
  void take(const std::string& image_sha256, const imaging::ShownIdentity& whose);
  /// Of the image on the table or, without one, of the open case's. Empty where it is not known.
  const imaging::ShownIdentity& now() const { return now_; }
  /// Of any image that this window or this machine knows.
  imaging::ShownIdentity of_image(const std::string& image_sha256) const;
  /// What is kept on this machine goes; this window still knows what is open.
  void forget_all();

  session::Property<bool> on_views{true};  ///< in a corner of each image; remembered
  session::Property<bool> kept{true};  ///< on this machine; remembered. Off: forget_all, and no more of it
  session::Signal<> changed;           ///< `now` is another, or where it is shown

 private:
  void look();
  session::Workbench& bench_;
  session::MachineState& machine_;
  session::KnownPatients store_;
  std::map<std::string, imaging::ShownIdentity> seen_;  // by digest, in this window
  imaging::ShownIdentity now_, expected_;
  std::vector<session::Subscription> own_;
};

}  // namespace ostia::workstation
