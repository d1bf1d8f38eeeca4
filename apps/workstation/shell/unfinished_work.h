#pragma once
/// \file What would be lost if the window closed now.

class QWidget;

namespace ostia::workstation {

class Jobs;

/// Whether the window may close: nothing is being made that a person waits for, or they have said that it may
/// be lost.
bool may_be_left(const Jobs& jobs, QWidget* parent);

}  // namespace ostia::workstation
