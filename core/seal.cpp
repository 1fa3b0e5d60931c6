#include "core/seal.hpp"

#include "core/sha256.hpp"

namespace lobelia {

std::string seal_of(Json record) {
  record.erase("seal");
  return hex(sha256(record.dump()));
}

}  // namespace lobelia
