#include "solver/kernel/kernel.h"

const fg__kernel *fg__kernel_choose(int dimension, fg_vectors most)
{
  bool solid = dimension == 3;
#if defined(__x86_64__)
  bool any = most == FG_VECTORS_WIDEST || most == FG_VECTORS_AVX512;
  if (any && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
      __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw"))
    return solid ? &fg__kernel_3d_avx512 : &fg__kernel_2d_avx512;
  if ((any || most == FG_VECTORS_AVX2) && __builtin_cpu_supports("avx2"))
    return solid ? &fg__kernel_3d_avx2 : &fg__kernel_2d_avx2;
#else
  (void)most;
#endif
  return solid ? &fg__kernel_3d_generic : &fg__kernel_2d_generic;
}
