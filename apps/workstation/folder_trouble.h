#pragma once
/// \file What is wrong with the name of a folder that is to be made.

#include <QString>

namespace ostia::workstation {

/// Empty where the folder can be made, as far as can be told without making it: it has a name, its place is
/// there and can be written, no file has the name. A folder that is there already may hold something.
QString folder_trouble(const QString& path);

}  // namespace ostia::workstation
