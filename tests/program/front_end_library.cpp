#include "tests/program/front_end_library.hpp"

#include "lobelia/lobelia.hpp"

namespace lobelia::fixtures {

LibraryAnswer compare_by_library(const std::string& a, const std::string& b,
                                 const std::vector<std::pair<std::string, std::string>>& options,
                                 bool in_memory) {
  try {
    return {in_memory ? compare(read_picture(a), read_picture(b), {}, options).record
                      : compare_files(a, b, {}, options).record,
            ""};
  } catch (const v0::Error& error) {
    return {"", error.what()};
  }
}

}  // namespace lobelia::fixtures
