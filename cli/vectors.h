/* The environment variable FLOWGRAIN_KERNEL: which vector instructions an evolution may
 * use, for tests and benchmarks. */
#ifndef VECTORS_H
#define VECTORS_H

#include "flowgrain/evolution.h"

/* Complains of a word that is none of generic, avx2 and avx512; an exit code. */
int vectors_check(void);

/* What it says, the widest where it says nothing. */
fg_vectors vectors_wanted(void);

#endif
