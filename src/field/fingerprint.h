/* Telling fields apart by a number. */
#ifndef FG__FINGERPRINT_H
#define FG__FINGERPRINT_H

#include <stdint.h>

#include "base/context.h"

/* A number that differs, but for one case in 2^64, between fields whose grids, scales,
 * samples or valid samples differ in any bit. Texts do not count. A part has the whole
 * field's once it is joined. */
uint64_t fg__field_fingerprint(const fg_field *field);

/* It is the sum, modulo 2^64, of the grid's and of the samples'; the latter is the sum of
 * all parts'. */
uint64_t fg__field_fingerprint_grid(const fg_field *field);
uint64_t fg__field_fingerprint_samples(const fg_field *field);

#endif
