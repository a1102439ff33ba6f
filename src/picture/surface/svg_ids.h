/* Names within SVG files that depend on the file alone. */
#ifndef FG__SVG_IDS_H
#define FG__SVG_IDS_H

#include <stdio.h>

/* Writes an SVG file of Cairo's. Cairo numbers surfaces and images through all that the
 * process has ever drawn ("surface7", "image9"); here they are numbered from 1 in the
 * order of their first mention. Returns 0 when there is no memory; what the stream
 * reports is left in it. */
int fg__svg_ids_write(FILE *stream, const char *svg, size_t length);

#endif
