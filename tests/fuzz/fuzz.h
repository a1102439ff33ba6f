/* What a fuzz target offers to those who give it bytes: libFuzzer, or replay.c. */
#ifndef FG__FUZZ_H
#define FG__FUZZ_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Stops the program where a promise is broken. */
int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size);

/* Whether the last input was read without a complaint. */
extern bool fg__fuzz_was_read;

#endif
