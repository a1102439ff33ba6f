/* Telling fields apart by a number. */
#ifndef FG__FINGERPRINT_H
#define FG__FINGERPRINT_H

#include <stdint.h>

#include "base/context.h"

/* A number that differs, but for one case in 2^64, between fields whose grids, scales,
 * samples or valid samples differ in any bit. Texts do not count. */
uint64_t fg__field_fingerprint(const fg_field *field);

#endif
