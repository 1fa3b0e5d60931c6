// A web server for previewing a site on this machine.
#pragma once

#include <filesystem>
#include <functional>

namespace lobelia::gallery {

/// Serves the files below `site` on 127.0.0.1 until interrupted(): GET and HEAD, no hidden files, and no links out of the
/// site. Answers only requests for 127.0.0.1 or localhost, so that no foreign page can reach it through a name of its own.
/// Some thousand clients may be connected, however slow; a connection without a complete request is closed after half
/// a minute. `port` 0 is any free one. Calls `ready` with the URL once it listens. Works on the calling thread alone, and
/// raises the limit of open files.
/// Throws Error(kInput) if there is no such directory, Error(kOutput) if the port is taken.
void serve_site(const std::filesystem::path& site, int port,
                const std::function<void(const std::string& url)>& ready);

}  // namespace lobelia::gallery
