#pragma once
// The two kinds of archives.

#include "ostia/pacs/archive.h"

#include <memory>

namespace ostia::pacs {

std::unique_ptr<Archive> dimse_archive(const ServerDescription& server, const Secrets& secrets);
std::unique_ptr<Archive> dicomweb_archive(const ServerDescription& server, const Secrets& secrets);

}  // namespace ostia::pacs
