// The entry point of libFuzzer, compiled once for each check (`make fuzz`). tests/fuzz replays the corpora without it.
#include <cstddef>
#include <cstdint>

#include "tests/fuzz/checks.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  lobelia::fuzz::LOBELIA_CHECK({reinterpret_cast<const char*>(data), size});
  return 0;
}
