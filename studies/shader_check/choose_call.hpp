// The meaning of a function's parameters and its model, where nobody told them.
#pragma once

#include "studies/shader_check/check.hpp"
#include "studies/shader_check/shader_call.hpp"

namespace lobelia::shader_check {

struct ChosenCall {
  std::size_t call = 0;
  Highlight highlight;
};

/// The first call that gives a model's values. If none does, that of the simplest explanation, among the likeliest few.
/// All calls are run in one process. Throws what run_programs() does.
ChosenCall choose_call(const Request& request, const ShaderCalls& calls);

}  // namespace lobelia::shader_check
