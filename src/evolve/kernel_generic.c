/* The inner loops for any processor. */
#define FG__KERNEL fg__kernel_generic
#define FG__KERNEL_NAME "generic"
#include "evolve/kernel_body.h"
