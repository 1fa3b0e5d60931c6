// The entry of libFuzzer: `make fuzz`. tests/fuzz replays the corpus without it.
#include <cstddef>
#include <cstdint>

#include "fuzz/scene_reader.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  lobelia::fuzz::check_scene_reader({reinterpret_cast<const char*>(data), size});
  return 0;
}
