/* The inner loops in 2D for any processor. */
#define FG__DIMENSION 2
#define FG__KERNEL fg__kernel_2d_generic
#define FG__KERNEL_NAME "generic"
#include "solver/kernel/body.h"
