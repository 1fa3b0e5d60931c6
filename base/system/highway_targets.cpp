// The part of its library that Highway's headers need: the choice of a kernel's variant for this processor. The library
// itself measures the processor's clock while it is loaded, which takes every process 5 ms (docs/decisions/0009).
#include <hwy/highway.h>

#include <atomic>

namespace hwy {
namespace {

std::atomic<std::int64_t> g_disabled{0}, g_for_test{0};

std::int64_t targets_of_processor() {
  std::int64_t targets = HWY_STATIC_TARGET;
#if HWY_ARCH_X86
  // With these a processor has F16C and LZCNT too.
  if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma") ||
      !__builtin_cpu_supports("bmi") || !__builtin_cpu_supports("bmi2"))
    return targets;
  targets |= HWY_AVX2;
  if (!__builtin_cpu_supports("avx512f") || !__builtin_cpu_supports("avx512vl") ||
      !__builtin_cpu_supports("avx512cd") || !__builtin_cpu_supports("avx512bw") ||
      !__builtin_cpu_supports("avx512dq"))
    return targets;
  targets |= HWY_AVX3;
#endif
  return targets;
}

}  // namespace

std::int64_t SupportedTargets() {
  static const std::int64_t detected = targets_of_processor();
  const std::int64_t mocked = g_for_test, targets = (mocked ? mocked : detected) & ~g_disabled;
  return targets ? targets : HWY_STATIC_TARGET;
}

void DisableTargets(std::int64_t disabled) {
  g_disabled = disabled & ~std::int64_t{HWY_STATIC_TARGET};
  GetChosenTarget().DeInit();
}

void SetSupportedTargetsForTest(std::int64_t targets) {
  g_for_test = targets;
  GetChosenTarget().DeInit();
}

ChosenTarget& GetChosenTarget() {
  static ChosenTarget chosen;
  return chosen;
}

}  // namespace hwy
