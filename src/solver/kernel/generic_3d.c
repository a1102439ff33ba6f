/* The inner loops in 3D for any processor. */
#define FG__DIMENSION 3
#define FG__KERNEL fg__kernel_3d_generic
#define FG__KERNEL_NAME "generic"
#include "solver/kernel/body.h"
