// A look at a site as a web server would give it, for this machine alone.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace lobelia::gallery {

/// Serves the files below `site` on 127.0.0.1 until interrupted(): GET and HEAD, nothing hidden, nothing that a
/// link leads out of the site, and only for requests that ask for this host by a loopback name, so that no
/// foreign page can reach it through a name of its own. Some thousand clients may be there at once, however slow. Whoever
/// sends nothing, or never ends a request, is closed after half a minute. `port` 0 is any free one. Calls
/// `ready` with the URL once it listens. Works on the calling thread alone, and raises the limit of open files.
/// Throws Error(kInput) if there is no such directory, Error(kOutput) if the port is taken.
void serve_site(const std::filesystem::path& site, int port,
                const std::function<void(const std::string& url)>& ready);

}  // namespace lobelia::gallery
