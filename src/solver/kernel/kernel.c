#include "solver/kernel/kernel.h"

#include <stdlib.h>
#include <string.h>

fg_status fg__kernel_check(fg_context *context)
{
  static const char *const known[] = {"generic", "avx2", "avx512"};
  const char *wanted = getenv("FLOWGRAIN_KERNEL");
  bool found = !wanted || !*wanted;
  for (size_t k = 0; k < sizeof known / sizeof known[0] && !found; ++k)
    found = strcmp(wanted, known[k]) == 0;
  if (found)
    return FG_STATUS_OK;
  return fg__fail(context, FG_STATUS_ARGUMENT,
                  "FLOWGRAIN_KERNEL=%.100s: generic, avx2 and avx512 are known", wanted);
}

const fg__kernel *fg__kernel_choose(int dimension)
{
  bool solid = dimension == 3;
#if defined(__x86_64__)
  const char *wanted = getenv("FLOWGRAIN_KERNEL");
  bool any = !wanted || !*wanted || strcmp(wanted, "avx512") == 0;
  if (any && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
      __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw"))
    return solid ? &fg__kernel_3d_avx512 : &fg__kernel_2d_avx512;
  if ((any || strcmp(wanted, "avx2") == 0) && __builtin_cpu_supports("avx2"))
    return solid ? &fg__kernel_3d_avx2 : &fg__kernel_2d_avx2;
#endif
  return solid ? &fg__kernel_3d_generic : &fg__kernel_2d_generic;
}
