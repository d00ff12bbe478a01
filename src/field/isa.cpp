#include <cassert>

#include "compiled_data.h"

namespace lascaux {

bool IsSupported(Isa isa) noexcept {
#ifdef LASCAUX_X86_KERNELS
  switch (isa) {
    case Isa::kBaseline:
      return true;
    case Isa::kAvx2:
      return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
    case Isa::kAvx512:
      return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
             __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512dq") &&
             IsSupported(Isa::kAvx2);
  }
  return false;
#else
  return isa == Isa::kBaseline;
#endif
}

Isa BestIsa() noexcept {
  if (IsSupported(Isa::kAvx512)) return Isa::kAvx512;
  return IsSupported(Isa::kAvx2) ? Isa::kAvx2 : Isa::kBaseline;
}

const char* Name(Isa isa) noexcept {
  switch (isa) {
    case Isa::kBaseline:
      return "baseline";
    case Isa::kAvx2:
      return "avx2";
    case Isa::kAvx512:
      return "avx512";
  }
  return "unknown";
}

namespace internal {

const BlockKernel& KernelFor(Isa isa) {
  assert(IsSupported(isa));
#ifdef LASCAUX_X86_KERNELS
  if (isa == Isa::kAvx512) return Avx512Kernel();
  if (isa == Isa::kAvx2) return Avx2Kernel();
#endif
  return BaselineKernel();
}

}  // namespace internal
}  // namespace lascaux
