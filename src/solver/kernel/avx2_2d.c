/* The inner loops in 2D with AVX2 instructions: the build sets the compiler's flags. */
#if defined(__x86_64__)
#define FG__DIMENSION 2
#define FG__KERNEL fg__kernel_2d_avx2
#define FG__KERNEL_NAME "avx2"
#include "solver/kernel/body.h"
#else
typedef int fg__no_2d_avx2; /* ISO C wants a declaration */
#endif
