#pragma once
/// \file Walks of a reader through this window: written down, and walked again.

#include <QString>
#include <filesystem>
#include <functional>

namespace ostia::workstation {

class MainWindow;

/// From now until the window goes. Throws IoError where the file cannot be written.
void record_walk(MainWindow& window, const std::filesystem::path& file);

/// Walks as `file` says; pictures and walk.csv go into `folder`. Then `ended`, with why it ended early (empty
/// where it did not). Throws as read_walk does.
void begin_walk(MainWindow& window, const std::filesystem::path& file, const std::filesystem::path& folder,
                std::function<void(const QString& failure)> ended);

}  // namespace ostia::workstation
