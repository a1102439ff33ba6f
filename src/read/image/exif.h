/* What a camera says of how it was held. */
#ifndef FG__EXIF_H
#define FG__EXIF_H

#include <stddef.h>

/* The orientation that a TIFF structure of Exif data gives (CIPA DC-008, tag 0x0112): 1
 * to 8, which fg__image_turn takes. 1, as the pixels lie, where there is none or the data
 * are damaged: viewers do the same. */
int fg__exif_orientation(const unsigned char *bytes, size_t size);

#endif
