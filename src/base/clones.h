/* Loops that are compiled for wider vectors, too; the machine's widest are taken when the
 * program starts. Bits are the same: no multiplication is fused with an addition. */
#ifndef FG__CLONES_H
#define FG__CLONES_H

#if defined(__x86_64__) && !defined(__SANITIZE_ADDRESS__) &&                             \
    !defined(__SANITIZE_THREAD__) && defined(__GNUC__) && !defined(__clang__)
#define FG__CLONES __attribute__((target_clones("default", "avx2", "avx512f")))
#else
#define FG__CLONES
#endif

#endif
