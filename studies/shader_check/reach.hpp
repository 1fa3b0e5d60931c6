// All that a function of a shader reads, through the functions that it calls.
#pragma once

#include <set>

#include "studies/shader_check/declarations.hpp"

namespace lobelia {

struct Reach {
  std::set<std::string, std::less<>> globals;  ///< of the names that are asked for
  std::set<std::string, std::less<>> members;  ///< each name behind a '.'
  std::set<std::string, std::less<>> names;    ///< all names in the functions
  std::string derivative;  ///< "dFdx", of neighbouring pixels; "" if there is none
};

/// `dropped`: edits; tokens in their parts do not count.
Reach reach_of(std::string_view function, const TokenList& list, const Declarations& declared,
               const std::vector<TextEdit>& dropped);

/// The functions with a body that no other one calls, each once.
std::vector<std::string> uncalled_functions(const TokenList& list, const Declarations& declared);

}  // namespace lobelia
