// What every record may say: on which machine, of which highlight.
#pragma once

#include "records/struct_type.hpp"

namespace lobelia::records {

struct Host {
  std::string processor;
  unsigned threads = 0;
  std::string system;
  std::string name;  ///< empty in records that say nothing of nodes
  static const Struct& type();
};

/// This machine, without its name.
Host this_host();
/// The same with it.
Host this_node();

struct Highlight {
  std::string model, lobe, normalisation;
  double exponent = 0, coefficient = 0;
  std::string warning;
  static const Struct& type();
};

}  // namespace lobelia::records
