// Which build of the program this is, closer than its version.
#pragma once

#include <string>

namespace lobelia {

/// What the linker wrote into the running program (its GNU build ID, in hexadecimal), the same for the same code;
/// where there is none, the SHA-256 of the program's file. Throws Error(kInternal) if neither can be read.
const std::string& build_id();

}  // namespace lobelia
